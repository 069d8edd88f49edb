#include "postproc/probe/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/solid/face_quadrature.h"
#include "postproc/probe/body_locator.h"
#include "postproc/probe/gauge_rule.h"
#include "postproc/probe/laid_line.h"
#include "postproc/probe/nearest_on_face.h"
#include "postproc/probe/path_samples.h"

namespace burnish {
namespace {

/// Of the size of a body: how far outside of it a given point may lie, as its numbers are rounded, and
/// material outside of a mesh that was made on the way.
constexpr double kGivenOutside = 1e-6, kMovedOutside = 1e-3;

constexpr int kSpotLines = 32;        // parallel lines whose mean stands for a spot
constexpr int kSpotLinesInSpace = 8;  // in each of its two directions

/// A path as a function of the distance.
struct MeasuredPath {
  PathProbe probe;
  double end = 0.0;                   ///< from 0
  std::array<double, 2> ofWindows{};  ///< what windows may cover
  std::string where;                  ///< a point of it has to be, in messages
};

template <int Dim>
class PathMaker {
 public:
  using Point = Eigen::Vector<double, Dim>;

  PathMaker(const ModelRecord& model, const FrameRecord& frame, const ProbedFields& fields,
            const ProbeOptions& options)
      : model_(model),
        frame_(frame),
        fields_(fields),
        options_(options),
        bodies_(meshOf(model, frame), deformed() ? frame.displacement : Eigen::MatrixXd()) {}

  MeasuredPath operator()(const LinePath& line) const {
    const Ends ends = endsOf(line);
    return {straight(ends.begin, (ends.end - ends.begin) / ends.length),
            ends.length,
            {-0.5 * options_.window, ends.length + 0.5 * options_.window},
            inBody()};
  }

  MeasuredPath operator()(const FacePath& path) const {
    const FacePlace face = facePlace(model_, frame_, path.address);
    if constexpr (Dim == 2) {
      const ArcLengthCurve curve(trace(face));
      if (!(curve.length() > 0.0))
        throw Error(fmt::format("face: {} is a point; expected a face that has a length", path.address.face));
      const auto probe = [this, face, curve](double distance) {
        return pointOfFace(distance, face, Eigen::Vector<double, 1>(curve.parameterAt(distance)));
      };
      return {probe, curve.length(), {0.0, curve.length()}, inBody()};
    } else {
      throw areaIsNoPath(trace(face), path.address.face);
    }
  }

  MeasuredPath operator()(const LaidPath& path) const {
    if constexpr (Dim == 3) {
      const Ends ends = endsOf(path.line);
      const FacePlace face = facePlace(model_, frame_, path.address);
      const LaidLine line(trace(face), ends.begin, ends.end, options_.points, options_.window);
      const auto probe = [this, face, line](double distance) {
        const LaidLine::Place place = line.at(distance);
        return place.xi ? pointOfFace(distance, face, *place.xi) : outside(distance, place.position);
      };
      return {probe, line.length(), line.ofWindows(), line.where(path.address.face)};
    } else {
      throw planeFaceIsPath();
    }
  }

  MeasuredPath operator()(const DepthPath& path) const {
    const FacePlace face = facePlace(model_, frame_, path.address);
    const MeshPlace<Dim> start = onFace(face, parameters(face, path.place));
    if (options_.spot > 0.0) return belowSpot(face, start, path.length);
    const Point begin = bodies_.patch(start.patch).position(start.xi);
    const PathProbe probe = intoBody(begin, surfaceAxes(face, start), start);
    const double whole = depthAt(probe, smallestStep(start, face));
    if (!(whole > 0.0))
      throw Error(fmt::format("depth: the body has no depth below {}; expected another place on face {}",
                              pointText(begin), path.address.face));
    return {probe, path.length ? std::min(*path.length, whole) : whole, {0.0, whole}, inBody()};
  }

 private:
  struct Ends {
    Point begin, end;
    double length = 0.0;
  };

  Ends endsOf(const LinePath& line) const {
    const Point begin = pointOf(line.begin, "line"), end = pointOf(line.end, "line");
    const double length = lineLength(begin, end, bodies_.size());
    requireNotTooLong("window", options_.window, bodies_.size());
    return {begin, end, length};
  }

  std::string inBody() const {
    return fmt::format("in the {} body of frame {}, which lies {}", deformed() ? "deformed" : "undeformed",
                       frame_.index, extentText(bodies_));
  }

  /// What is on a face at a length of a path.
  ProbePoint pointOfFace(double distance, const FacePlace& face,
                         const Eigen::Vector<double, Dim - 1>& parameters) const {
    const MeshPlace<Dim> place = onFace(face, parameters);
    std::optional<SurfaceAxes> axes;
    if (fields_.needsAxes()) axes = surfaceAxes(face, place, "face");
    return bodies_.point(distance, place, frame_, fields_, axes);
  }

  /// outward: normal of length 1; first, second: along the face, the second one in space alone.
  static SurfaceAxes surfaceAxes(const Point& outward, const Point& first, const Point& second) {
    const Point along = (first - first.dot(outward) * outward).normalized();
    if constexpr (Dim == 2) {
      return (SurfaceAxes() << outward(0), along(0), 0.0, outward(1), along(1), 0.0, 0.0, 0.0, 1.0)
          .finished();
    } else {
      const Point across = outward.cross(along);
      return (SurfaceAxes() << outward, along, across.dot(second) < 0.0 ? Point(-across) : across).finished();
    }
  }

  SurfaceAxes surfaceAxes(const FacePlace& face, const MeshPlace<Dim>& place,
                          const char* key = "depth") const {
    const Eigen::Matrix<double, Dim, Dim> jacobian = bodies_.patch(place.patch).jacobian(place.xi);
    const int across = face.face / 2, first = across == 0 ? 1 : 0,
              second = Dim - 1 == across ? Dim - 2 : Dim - 1;
    return surfaceAxes(outwardNormal(face, place, key), jacobian.col(first), jacobian.col(second));
  }

  /// Where lines begin that stand for a spot, and the axes that they share.
  struct SpotLines {
    MeshPlace<Dim> middle;
    std::vector<MeshPlace<Dim>> begins;
    SurfaceAxes axes;
  };

  /// In the plane, side by side over the length of the spot; into the body across its chord.
  SpotLines linesOfSpot(const FacePlace& face, const MeshPlace<Dim>& middle) const requires(Dim == 2) {
    const ArcLengthCurve curve(trace(face));
    const double at = curve.lengthTo(middle.xi(1 - face.face / 2)), begin = at - 0.5 * options_.spot,
                 end = at + 0.5 * options_.spot;
    if (!(begin >= 0.0 && end <= curve.length()))
      throw Error(
          fmt::format("spot: found a length of {:.6g} around {:.6g} along the face, which is {:.6g} long; "
                      "expected one that does not reach beyond its ends",
                      options_.spot, at, curve.length()));
    const Point chord = curve.at(end) - curve.at(begin), across = Point(chord(1), -chord(0)).normalized();
    const bool isOutward = across.dot(outwardNormal(face, middle)) > 0.0;
    SpotLines lines{middle, {}, surfaceAxes(isOutward ? across : Point(-across), chord, {})};
    for (int k = 0; k < kSpotLines; ++k)
      lines.begins.push_back(onFace(
          face, Eigen::Vector<double, 1>(curve.parameterAt(std::lerp(begin, end, (k + 0.5) / kSpotLines)))));
    return lines;
  }

  /// In space, over a square along the first direction of the face and across it, seen along the normal in its middle.
  SpotLines linesOfSpot(const FacePlace& face, const MeshPlace<Dim>& middle) const requires(Dim == 3) {
    constexpr double kBeside = 0.1;  // of the spot: how far from under its square the face may begin
    const Patch<Dim>& patch = bodies_.patch(middle.patch);
    const SurfaceAxes axes = surfaceAxes(face, middle);
    const Point normal = axes.col(0), first = axes.col(1), across = axes.col(2),
                centre = patch.position(middle.xi);
    SpotLines lines{middle, {}, axes};
    const NearestOnFace<Dim> nearest(trace(face));
    for (int k = 0; k < kSpotLinesInSpace * kSpotLinesInSpace; ++k) {
      const double u = (k % kSpotLinesInSpace + 0.5) / kSpotLinesInSpace - 0.5,
                   v = (k / kSpotLinesInSpace + 0.5) / kSpotLinesInSpace - 0.5;
      const Point above = centre + options_.spot * (u * first + v * across);
      const MeshPlace<Dim>& begin = lines.begins.emplace_back(onFace(face, nearest(above).xi));
      const Point away = patch.position(begin.xi) - above;
      if ((away - away.dot(normal) * normal).norm() > kBeside * options_.spot)
        throw Error(fmt::format(
            "spot: found a square of {:.6g} around {} that reaches beyond face {}; expected a smaller "
            "one, or another place",
            options_.spot, pointText(centre), faceName(face.face)));
    }
    return lines;
  }

  /// Means over parallel lines that begin on the face; the positions are those of the line in the middle.
  MeasuredPath belowSpot(const FacePlace& face, const MeshPlace<Dim>& middle,
                         const std::optional<double>& length) const {
    const SpotLines spot = linesOfSpot(face, middle);
    const auto from = [&](const MeshPlace<Dim>& begin) {
      return intoBody(bodies_.patch(begin.patch).position(begin.xi), spot.axes, begin);
    };
    std::vector<PathProbe> lines;
    double whole = std::numeric_limits<double>::max();
    for (const MeshPlace<Dim>& begin : spot.begins) {
      lines.push_back(from(begin));
      whole = std::min(whole, depthAt(lines.back(), smallestStep(middle, face)));
    }
    if (!(whole > 0.0))
      throw Error(fmt::format("spot: the body has no depth below all of it; expected a shorter one than {}",
                              options_.spot));
    const auto mean = [line = from(spot.middle), lines = std::move(lines)](double distance) {
      ProbePoint point = line(distance);
      Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(point.values.size());
      int count = 0;
      for (const PathProbe& one : lines) {
        const ProbePoint found = one(distance);
        if (found.body == ProbePoint::kOutside) continue;
        sum += found.values.array();
        ++count;
        if (point.body == ProbePoint::kOutside) point = found;
      }
      if (count > 0) point.values = sum.matrix() / count;
      return point;
    };
    return {mean, length ? std::min(*length, whole) : whole, {0.0, whole}, inBody()};
  }

  bool deformed() const { return options_.body == ProbedBody::Deformed; }

  Point pointOf(const Eigen::VectorXd& point, const char* path) const {
    if (point.size() != Dim)
      throw Error(fmt::format("{}: found {}; the body has {} dimensions", path, pointText(point), Dim));
    return point;
  }

  PathProbe intoBody(const Point& begin, const SurfaceAxes& axes, const MeshPlace<Dim>& near) const {
    return straight(begin, -axes.col(0).template head<Dim>(), near, axes);
  }

  PathProbe straight(const Point& begin, const Point& direction,
                     std::optional<MeshPlace<Dim>> near = std::nullopt,
                     const std::optional<SurfaceAxes>& axes = std::nullopt) const {
    return [this, begin, direction, near, axes](double distance) mutable {
      const Point position = begin + distance * direction;
      const auto found = bodies_.find(position, near);
      if (!found) return outside(distance, position);
      near = found;
      return bodies_.point(distance, *found, frame_, fields_, axes);
    };
  }

  /// Where there is no material, only the position in the probed body is known.
  ProbePoint outside(double distance, const Point& position) const {
    const Eigen::VectorXd unknown = Eigen::VectorXd::Constant(Dim, ProbePoint::kNone);
    return {distance, ProbePoint::kOutside, deformed() ? Eigen::VectorXd(position) : unknown,
            deformed() ? unknown : Eigen::VectorXd(position),
            Eigen::VectorXd::Constant(std::ssize(fields_.choices()), ProbePoint::kNone)};
  }

  Patch<Dim - 1, Dim> trace(const FacePlace& face) const {
    return tracePatch(bodies_.patch(static_cast<std::size_t>(face.patch)), face.face);
  }

  /// The place in the mesh of parameters of a face.
  MeshPlace<Dim> onFace(const FacePlace& face, const Eigen::Vector<double, Dim - 1>& parameters) const {
    MeshPlace<Dim> place{static_cast<std::size_t>(face.patch), {}};
    const int across = face.face / 2;
    for (int d = 0, k = 0; d < Dim; ++d)
      place.xi(d) = d == across ? bodies_.patch(place.patch).basis().direction(d).parameterAt(face.face % 2)
                                : parameters(k++);
    return place;
  }

  /// Parameters of the face at a length along it or at its nearest point.
  Eigen::Vector<double, Dim - 1> parameters(const FacePlace& face, const Eigen::VectorXd& place) const {
    const Patch<Dim - 1, Dim> surface = trace(face);
    if constexpr (Dim == 2)
      if (place.size() == 1) {
        const ArcLengthCurve curve(surface);
        if (!(place(0) >= 0.0 && place(0) <= curve.length()))
          throw Error(
              fmt::format("depth: found the place {:.6g}; expected a length along the face, 0 to {:.6g}",
                          place(0), curve.length()));
        return Eigen::Vector<double, 1>(curve.parameterAt(place(0)));
      }
    return NearestOnFace<Dim>(surface)(pointOf(place, "depth")).xi;
  }

  Point outwardNormal(const FacePlace& face, const MeshPlace<Dim>& place, const char* key = "depth") const {
    const Patch<Dim>& patch = bodies_.patch(place.patch);
    const Eigen::Matrix<double, Dim, Dim> jacobian = patch.jacobian(place.xi);
    Eigen::Matrix<double, Dim, Dim - 1> tangents;
    for (int d = 0, column = 0; d < Dim; ++d)
      if (d != face.face / 2) tangents.col(column++) = jacobian.col(d);
    const Point area = outwardSign(patch, face.face) * areaVector<Dim>(tangents);
    if (!(area.norm() > 0.0))
      throw Error(fmt::format("{}: face {} has no normal at {}; expected another place", key,
                              faceName(face.face), pointText(patch.position(place.xi))));
    return area.normalized();
  }

  /// A part of the span that is next to a place of a face.
  double smallestStep(const MeshPlace<Dim>& place, const FacePlace& face) const {
    const Patch<Dim>& patch = bodies_.patch(place.patch);
    const int across = face.face / 2;
    const UnivariateBasis& basis = patch.basis().direction(across);
    const int span = basis.findSpan(place.xi(across));
    return 0.1 * (basis.spanEnd(span) - basis.spanBegin(span)) * patch.jacobian(place.xi).col(across).norm();
  }

  /// How far the body goes. Steps grow from the first one, which must not jump over the body, as spans do
  /// away from a face.
  double depthAt(const PathProbe& probe, double step) const {
    constexpr double kGrowth = 1.1;
    const double size = bodies_.size(), largest = size / 400.0;
    double inside = 0.0;
    if (probe(inside).body == ProbePoint::kOutside) return inside;
    for (step = std::clamp(step, 1e-9 * size, largest);; step = std::min(kGrowth * step, largest)) {
      const std::vector<ProbePoint> next = samplesAlong(probe, inside, inside + step, 2);
      if (next.size() > 2) return next[1].at;  // behind it there are the points of the border
      inside += step;
    }
  }

  const ModelRecord& model_;
  const FrameRecord& frame_;
  const ProbedFields& fields_;
  const ProbeOptions& options_;
  BodyLocator<Dim> bodies_;
};

/// What a path is called in messages.
struct PathWord {
  const char* operator()(const LinePath&) const { return "line"; }
  const char* operator()(const FacePath&) const { return "face"; }
  const char* operator()(const LaidPath&) const { return "line"; }
  const char* operator()(const DepthPath&) const { return "depth"; }
};

template <int Dim>
std::vector<ProbePoint> probedPathIn(const ModelRecord& model, const FrameRecord& frame,
                                     const ProbedFields& fields, const ProbePath& path,
                                     const ProbeOptions& options) {
  const PathMaker<Dim> maker(model, frame, fields, options);
  const MeasuredPath measured = std::visit(maker, path);
  const char* word = std::visit(PathWord{}, path);
  std::vector<ProbePoint> points = samplesAlong(measured.probe, 0.0, measured.end, options.points);
  requireAnyInside(points, word, measured.where);
  for (std::size_t k = 0; k < fields.choices().size(); ++k)
    if (std::ranges::all_of(
            points, [k](const ProbePoint& p) { return std::isnan(p.values(static_cast<Eigen::Index>(k))); }))
      throw Error(
          fmt::format("{}: none of the bodies on it has the field {}", word, fields.choices()[k].name));
  if (options.window > 0.0)
    points = windowAverages(measured.probe, std::move(points), options.window, measured.ofWindows[0],
                            measured.ofWindows[1]);
  if (options.penetration > 0.0)
    points =
        penetrationAverages(measured.probe, std::move(points), options.penetration, measured.ofWindows[1]);
  return points;
}

template <int Dim>
ProbePoint probedMeanIn(const ModelRecord& model, const FrameRecord& frame, const ProbedFields& fields,
                        const ProbePath& path, const ProbeOptions& options) {
  const PathMaker<Dim> maker(model, frame, fields, options);
  const MeasuredPath measured = std::visit(maker, path);
  const Eigen::VectorXd unknown = Eigen::VectorXd::Constant(Dim, ProbePoint::kNone);
  return {frame.time, ProbePoint::kOutside, unknown, unknown,
          meanAlong(measured.probe, samplesAlong(measured.probe, 0.0, measured.end, options.points))};
}

}  // namespace

std::vector<ProbePoint> probedPath(const ModelRecord& model, const FrameRecord& frame,
                                   const ProbedFields& fields, const ProbePath& path,
                                   const ProbeOptions& options) {
  return model.dim == 2 ? probedPathIn<2>(model, frame, fields, path, options)
                        : probedPathIn<3>(model, frame, fields, path, options);
}

ProbePoint probedMean(const ModelRecord& model, const FrameRecord& frame, const ProbedFields& fields,
                      const ProbePath& path, const ProbeOptions& options) {
  return model.dim == 2 ? probedMeanIn<2>(model, frame, fields, path, options)
                        : probedMeanIn<3>(model, frame, fields, path, options);
}

class MaterialPoint::Finder {
 public:
  virtual ~Finder() = default;
  virtual ProbePoint in(const FrameRecord& frame, const ProbedFields& fields) const = 0;
};

template <int Dim>
class MaterialPoint::FinderIn final : public Finder {
 public:
  FinderIn(const ModelRecord& model, const Eigen::VectorXd& reference, double window)
      : mesh_(model.mesh), bodies_(mesh_, {}), reference_(reference), found_(bodies_.nearest(reference_)) {
    if (!(found_.distance <= kGivenOutside * bodies_.size()))
      throw Error(fmt::format("point: {} is {:.3g} outside of the undeformed body, which lies {}",
                              pointText(reference_), found_.distance, extentText(bodies_)));
    if (window > 0.0) addGauge(window);
  }

  ProbePoint in(const FrameRecord& frame, const ProbedFields& fields) const override {
    if (!frame.mesh) {
      ProbePoint point = bodies_.point(frame.time, found_.place, frame, fields);
      if (!gauge_.empty())
        point.values = meanOf(point.values.size(), [&](const GaugePoint& one) {
          return bodies_.point(frame.time, one.place, frame, fields).values;
        });
      return point;
    }
    const BodyLocator<Dim> moved(*frame.mesh, {});
    const auto found = moved.nearest(reference_, body());
    ProbePoint point = moved.point(frame.time, found.place, frame, fields);
    if (found.distance > kMovedOutside * bodies_.size()) {
      point.body = ProbePoint::kOutside;
      point.current.setConstant(ProbePoint::kNone);
      point.values.setConstant(ProbePoint::kNone);
    } else if (!gauge_.empty()) {
      point.values = meanOf(point.values.size(), [&](const GaugePoint& one) -> Eigen::VectorXd {
        const auto own = moved.nearest(one.reference, body());
        if (own.distance > kMovedOutside * bodies_.size()) return {};
        return moved.point(frame.time, own.place, frame, fields).values;
      });
    }
    return point;
  }

 private:
  /// A point of the window that lies in the undeformed body.
  struct GaugePoint {
    Eigen::Vector<double, Dim> reference;
    MeshPlace<Dim> place;
    double weight = 0.0;
  };

  int body() const { return mesh_.patches[found_.place.patch].body; }

  void addGauge(double window) {
    constexpr double kOnBorder = 1e-9;  // of the size of the body
    constexpr std::size_t kFewest = 16;
    requireNotTooLong("window", window, bodies_.size());
    const GaugeRule<Dim> rule = gaugeRule<Dim>(0.5 * window);
    for (Eigen::Index k = 0; k < rule.weights.size(); ++k) {
      const Eigen::Vector<double, Dim> reference = reference_ + rule.offsets.col(k);
      const auto found = bodies_.nearest(reference, body());
      if (found.distance <= kOnBorder * bodies_.size())
        gauge_.push_back({reference, found.place, rule.weights(k)});
    }
    if (gauge_.size() < kFewest)
      throw Error(fmt::format(
          "window: only {} of the {} points of the {} of diameter {:.6g} about {} lie in the body; "
          "expected a smaller one",
          gauge_.size(), rule.weights.size(), Dim == 2 ? "disc" : "ball", window, pointText(reference_)));
  }

  /// count: of the fields. valuesOf: at a point; nothing where there is no material any more.
  template <class ValuesOf>
  Eigen::VectorXd meanOf(Eigen::Index count, const ValuesOf& valuesOf) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
    double weight = 0.0;
    for (const GaugePoint& one : gauge_) {
      const Eigen::VectorXd values = valuesOf(one);
      if (values.size() == 0) continue;
      sum += one.weight * values;
      weight += one.weight;
    }
    return sum / weight;  // kNone if there is none
  }

  MeshRecord mesh_;
  BodyLocator<Dim> bodies_;
  Eigen::Vector<double, Dim> reference_;
  typename BodyLocator<Dim>::Nearest found_;
  std::vector<GaugePoint> gauge_;  ///< empty without a window
};

MaterialPoint::MaterialPoint(const ModelRecord& model, const Eigen::VectorXd& reference, double window) {
  if (reference.size() != model.dim)
    throw Error(fmt::format("point: found {}; the body has {} dimensions", pointText(reference), model.dim));
  if (model.dim == 2)
    finder_ = std::make_unique<FinderIn<2>>(model, reference, window);
  else
    finder_ = std::make_unique<FinderIn<3>>(model, reference, window);
}

MaterialPoint::~MaterialPoint() = default;

ProbePoint MaterialPoint::in(const FrameRecord& frame, const ProbedFields& fields) const {
  return finder_->in(frame, fields);
}

}  // namespace burnish
