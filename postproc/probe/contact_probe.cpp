#include "postproc/probe/contact_probe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/closest_point.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/probe/path_samples.h"

namespace burnish {
namespace {

/// The points of a face in contact, in order along it.
struct FacePoints {
  double length = 0.0;
  std::vector<ProbePoint> points;

  /// Linear between the points, constant beyond the outermost ones.
  ProbePoint at(double s) const {
    const auto behind =
        std::ranges::upper_bound(points, s, {}, [](const ProbePoint& point) { return point.at; });
    ProbePoint result = behind == points.end() ? points.back() : *behind;
    if (behind != points.begin() && behind != points.end()) {
      const ProbePoint& before = *std::prev(behind);
      const double share = (s - before.at) / (behind->at - before.at);
      result.values = (1.0 - share) * before.values + share * behind->values;
    }
    result.at = s;
    return result;
  }
};

/// What several partners make of a point.
void combine(Eigen::VectorXd& all, const Eigen::VectorXd& values, const std::string& field) {
  if (all.size() == 0)
    all = values;
  else if (field == "contact_pressure" || field == "friction_traction")
    all += values;
  else
    all = all.cwiseMax(values);
}

FacePoints facePoints(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  if (model.dim != 2)
    throw Error(
        "field: contact fields are probed along faces of plane bodies; draw them with burnish render");
  const std::vector<std::string> known = contactFieldsOf(frame);
  for (const std::string& name : spec.fields)
    if (std::ranges::count(known, name) == 0)
      throw Error(fmt::format("field: found {}; contact fields of frame {}: {}.", quoted(name), frame.index,
                              known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
  const FacePlace face = facePlace(model, frame, {spec.face, spec.patch});
  const PatchRecord& record = meshOf(model, frame).patches[static_cast<std::size_t>(face.patch)];
  std::vector<Eigen::VectorXd> values(spec.fields.size());
  Eigen::MatrixXd places;
  for (const ContactRecord& contact : frame.contact) {
    if (contact.patch != face.patch || faceFromName<2>(contact.face) != face.face) continue;
    places = contact.quadraturePoints;
    for (std::size_t f = 0; f < values.size(); ++f)
      combine(values[f], contactValues(contact, spec.fields[f]), spec.fields[f]);
  }
  if (places.cols() == 0)
    throw Error(
        fmt::format("face: {} is in no contact that the scene knows; it has no contact fields", spec.face));
  const Patch<1, 2> curve = tracePatch(patchGeometry<2>(record, frame.displacement), face.face);
  const ArcLengthCurve lengths(curve);
  FacePoints result{lengths.length(), {}};
  const UnivariateBasis& basis = curve.basis().direction(0);
  std::vector<Eigen::Vector<double, 1>> starts;
  for (int span = 0; span < basis.numSpans(); ++span)
    starts.emplace_back(0.5 * (basis.spanBegin(span) + basis.spanEnd(span)));
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    constexpr int kSteps = 30;
    const double xi = closestPoint(curve, Eigen::Vector2d(places.col(k)), starts, kSteps).xi(0);
    ProbePoint point{lengths.lengthTo(xi), record.body, places.col(k),
                     Eigen::Vector2d::Constant(ProbePoint::kNone), Eigen::VectorXd(std::ssize(values))};
    for (std::size_t f = 0; f < values.size(); ++f) point.values(static_cast<Eigen::Index>(f)) = values[f](k);
    result.points.push_back(std::move(point));
  }
  std::ranges::stable_sort(result.points, {}, [](const ProbePoint& point) { return point.at; });
  return result;
}

}  // namespace

bool isOfContact(const ProbeSpec& spec) {
  return !spec.fields.empty() && isContactField(spec.fields.front());
}

std::vector<FieldChoice> contactChoices(const ModelRecord& model, const FrameRecord& frame,
                                        const ProbeSpec& spec) {
  std::vector<FieldChoice> choices;
  for (const std::string& name : spec.fields) choices.push_back(chooseField(model, frame, name));
  return choices;
}

ProbedRun probedContact(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  FacePoints face = facePoints(model, frame, spec);
  if (spec.window)
    face.points =
        windowAverages([&](double s) { return face.at(s); }, face.points, *spec.window, 0.0, face.length);
  return {"", model.dim, model.lengthUnit, contactChoices(model, frame, spec), std::move(face.points)};
}

ProbePoint probedContactMean(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const FacePoints face = facePoints(model, frame, spec);
  const PathProbe probe = [&](double s) { return face.at(s); };
  const Eigen::VectorXd unknown = Eigen::VectorXd::Constant(model.dim, ProbePoint::kNone);
  return {frame.time, ProbePoint::kOutside, unknown, unknown,
          meanAlong(probe, samplesAlong(probe, 0.0, face.length, spec.points))};
}

}  // namespace burnish
