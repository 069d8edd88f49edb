#include "postproc/probe/contact_probe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/closest_point.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/contact_grid.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/probe/body_locator.h"
#include "postproc/probe/laid_line.h"
#include "postproc/probe/nearest_on_face.h"
#include "postproc/probe/path_samples.h"
#include "postproc/probe/path_text.h"

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

void requireContactFields(const FrameRecord& frame, const ProbeSpec& spec) {
  const std::vector<std::string> known = contactFieldsOf(frame);
  for (const std::string& name : spec.fields)
    if (std::ranges::count(known, name) == 0)
      throw Error(fmt::format("field: found {}; contact fields of frame {}: {}.", quoted(name), frame.index,
                              known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

/// The contacts of a face, one or more.
std::vector<const ContactRecord*> contactsOfFace(const FrameRecord& frame, const FacePlace& face,
                                                 const ProbeSpec& spec) {
  std::vector<const ContactRecord*> contacts;
  for (const ContactRecord& contact : frame.contact)
    if (contact.patch == face.patch && contact.face == faceName(face.face) &&
        contact.quadraturePoints.cols() > 0)
      contacts.push_back(&contact);
  if (contacts.empty())
    throw Error(
        fmt::format("face: {} is in no contact that the scene knows; it has no contact fields", spec.face));
  return contacts;
}

FacePoints facePoints(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const FacePlace face = facePlace(model, frame, {spec.face, spec.patch});
  const PatchRecord& record = meshOf(model, frame).patches[static_cast<std::size_t>(face.patch)];
  std::vector<Eigen::VectorXd> values(spec.fields.size());
  Eigen::MatrixXd places;
  for (const ContactRecord* contact : contactsOfFace(frame, face, spec)) {
    places = contact->quadraturePoints;
    for (std::size_t f = 0; f < values.size(); ++f)
      combine(values[f], contactValues(*contact, spec.fields[f]), spec.fields[f]);
  }
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

/// The fields of one contact of a face in space, between the rows and columns of its points.
class ContactOnFace {
 public:
  /// nearest: of the deformed face.
  ContactOnFace(const MeshRecord& mesh, const ContactRecord& contact, const NearestOnFace<3>& nearest,
                const std::vector<std::string>& fields) {
    const ContactGrid grid = contactGrid(3, mesh, contact);
    box_ = grid.box;
    for (std::size_t d = 0; d < ways_.size(); ++d)
      for (int k = 0; k < box_.extent[d]; ++k) {
        IndexBox::Index index{};
        index[d] = k;
        const Eigen::Vector3d position = grid.positions.col(box_.number(index));
        ways_[d].push_back(nearest(position).xi(static_cast<Eigen::Index>(d)));
      }
    for (const std::string& field : fields) {
      values_.push_back(contactValues(contact, field)(grid.recordedAt));
      isState_.push_back(!statesOfContactField(field).empty());
    }
  }

  /// One field at parameters of the face: bilinear in them between four points, constant beyond the outermost ones; a state
  /// is that of the nearest one.
  double operator()(std::size_t field, const Eigen::Vector2d& xi) const {
    std::array<std::array<int, 2>, 2> around{};  // per direction
    std::array<double, 2> shares{};
    for (std::size_t d = 0; d < ways_.size(); ++d) {
      const std::vector<double>& ways = ways_[d];
      const double way = std::clamp(xi(static_cast<Eigen::Index>(d)), ways.front(), ways.back());
      const auto behind = std::ranges::upper_bound(ways, way);
      const int next = static_cast<int>(std::min(behind - ways.begin(), std::ssize(ways) - 1)),
                before = std::max(0, next - 1);
      const double begin = ways[static_cast<std::size_t>(before)],
                   length = ways[static_cast<std::size_t>(next)] - begin;
      around[d] = {before, next};
      shares[d] = length > 0.0 ? (way - begin) / length : 0.0;
      if (isState_[field]) shares[d] = std::round(shares[d]);
    }
    const auto value = [&](std::size_t i, std::size_t j) {
      return values_[field](box_.number({around[0][i], around[1][j], 0}));
    };
    return std::lerp(std::lerp(value(0, 0), value(1, 0), shares[0]),
                     std::lerp(value(0, 1), value(1, 1), shares[0]), shares[1]);
  }

 private:
  IndexBox box_;
  std::array<std::vector<double>, 2> ways_;  ///< parameters of the columns and of the rows, which increase
  std::vector<Eigen::VectorXd> values_;      ///< per field, by the number in the box
  std::vector<bool> isState_;                ///< per field
};

/// Contact fields as a function of the length.
struct ContactPath {
  PathProbe probe;
  double length = 0.0;
  std::array<double, 2> ofWindows{};
  std::vector<ProbePoint> points;
  std::string where;  ///< a point has to be, in messages
};

/// Along a line that is laid on the deformed face.
ContactPath laidContact(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const FacePlace face = facePlace(model, frame, {spec.face, spec.patch});
  const MeshRecord& mesh = meshOf(model, frame);
  const PatchRecord& record = mesh.patches[static_cast<std::size_t>(face.patch)];
  const Patch<2, 3> undeformed = tracePatch(patchGeometry<3>(record), face.face),
                    deformed = tracePatch(patchGeometry<3>(record, frame.displacement), face.face);
  const ProbePath path = pathOf(spec, 3);
  const auto* laid = std::get_if<LaidPath>(&path);
  if (laid == nullptr) throw areaIsNoPath(deformed, spec.face);
  const NearestOnFace<3> nearest(deformed);
  std::vector<ContactOnFace> contacts;
  for (const ContactRecord* contact : contactsOfFace(frame, face, spec))
    contacts.emplace_back(mesh, *contact, nearest, spec.fields);
  const double size = BodyLocator<3>(mesh, frame.displacement).size();
  static_cast<void>(lineLength(laid->line.begin, laid->line.end, size));
  requireNotTooLong("window", spec.window.value_or(0.0), size);
  const LaidLine line(deformed, laid->line.begin, laid->line.end, spec.points, spec.window.value_or(0.0));
  const PathProbe probe = [=, fields = spec.fields, body = record.body](double length) {
    const LaidLine::Place place = line.at(length);
    ProbePoint point{length, place.xi ? body : ProbePoint::kOutside, place.position,
                     Eigen::Vector3d::Constant(ProbePoint::kNone),
                     Eigen::VectorXd::Constant(std::ssize(fields), ProbePoint::kNone)};
    if (!place.xi) return point;
    point.reference = undeformed.position(*place.xi);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      Eigen::VectorXd all;
      for (const ContactOnFace& contact : contacts)
        combine(all, Eigen::VectorXd::Constant(1, contact(f, *place.xi)), fields[f]);
      point.values(static_cast<Eigen::Index>(f)) = all(0);
    }
    return point;
  };
  return {probe, line.length(), line.ofWindows(), samplesAlong(probe, 0.0, line.length(), spec.points),
          line.where(spec.face)};
}

/// Along all of a face of a plane body.
ContactPath wholeFaceContact(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const FacePoints face = facePoints(model, frame, spec);
  return {
      [face](double s) { return face.at(s); }, face.length, {0.0, face.length}, face.points, "on the face"};
}

ContactPath contactPath(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  requireContactFields(frame, spec);
  if (model.dim == 3) return laidContact(model, frame, spec);
  if (!spec.line.empty()) throw planeFaceIsPath();
  return wholeFaceContact(model, frame, spec);
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
  ContactPath path = contactPath(model, frame, spec);
  requireAnyInside(path.points, "line", path.where);
  if (spec.window)
    path.points = windowAverages(path.probe, std::move(path.points), *spec.window, path.ofWindows[0],
                                 path.ofWindows[1]);
  return {"", model.dim, model.lengthUnit, contactChoices(model, frame, spec), std::move(path.points)};
}

ProbePoint probedContactMean(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const ContactPath path = contactPath(model, frame, spec);
  const Eigen::VectorXd unknown = Eigen::VectorXd::Constant(model.dim, ProbePoint::kNone);
  return {frame.time, ProbePoint::kOutside, unknown, unknown,
          meanAlong(path.probe, samplesAlong(path.probe, 0.0, path.length, spec.points))};
}

}  // namespace burnish
