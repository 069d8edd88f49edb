#include "postproc/surface/face_roughness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/closest_point.h"
#include "engine/solid/face_quadrature.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/probe/face_address.h"
#include "postproc/probe/path_text.h"

namespace burnish {
namespace {

constexpr int kPerSpan = 64, kPerSpanInSpace = 16;  // places per knot span and direction

/// Places on a face, now and in the undeformed body, dim x places, and the area of each, outwards.
struct FacePlaces {
  Eigen::MatrixXd now, before, areas;
  std::array<int, 2> grid{};  ///< first fastest; 0: not one
};

/// Equally distant parameters in every span, both ends included, and how much of the range each stands for.
struct ParameterRow {
  std::vector<double> at, weights;
};

ParameterRow parametersAlong(const UnivariateBasis& basis, int perSpan) {
  ParameterRow row{subdividedSpans(basis, perSpan), {}};
  for (std::size_t k = 0; k < row.at.size(); ++k) {
    const double before = row.at[k == 0 ? 0 : k - 1], behind = row.at[std::min(k + 1, row.at.size() - 1)];
    row.weights.push_back(0.5 * (behind - before));
  }
  return row;
}

template <int Dim>
FacePlaces placesOf(const PatchRecord& record, const Eigen::MatrixXd& displacement, FaceId face) {
  const Patch<Dim> now = patchGeometry<Dim>(record, displacement), before = patchGeometry<Dim>(record);
  const Patch<Dim - 1, Dim> surface = tracePatch(now, face), undeformed = tracePatch(before, face);
  const double sign = outwardSign(now, face);
  const ParameterRow first =
      parametersAlong(surface.basis().direction(0), Dim == 2 ? kPerSpan : kPerSpanInSpace);
  ParameterRow second{{0.0}, {1.0}};
  if constexpr (Dim == 3) second = parametersAlong(surface.basis().direction(1), kPerSpanInSpace);
  FacePlaces places;
  places.grid = {static_cast<int>(first.at.size()), static_cast<int>(second.at.size())};
  const auto count = static_cast<Eigen::Index>(first.at.size() * second.at.size());
  for (Eigen::MatrixXd* all : {&places.now, &places.before, &places.areas}) all->resize(Dim, count);
  Eigen::Index next = 0;
  for (std::size_t j = 0; j < second.at.size(); ++j)
    for (std::size_t i = 0; i < first.at.size(); ++i, ++next) {
      Eigen::Vector<double, Dim - 1> xi;
      xi(0) = first.at[i];
      if constexpr (Dim == 3) xi(1) = second.at[j];
      places.now.col(next) = surface.position(xi);
      places.before.col(next) = undeformed.position(xi);
      places.areas.col(next) =
          sign * first.weights[i] * second.weights[j] * areaVector<Dim>(surface.jacobian(xi));
    }
  return places;
}

/// Two points. what: they are, in messages.
LinePath pointsOf(const char* key, const std::string& text, int dim, const char* what) {
  ProbeSpec spec;
  spec.line = text;
  try {
    return std::get<LinePath>(pathOf(spec, dim));
  } catch (const Error&) {
    throw Error(fmt::format("{}: found {}; expected {}, {}", key, quoted(text),
                            dim == 2 ? "X0,Y0:X1,Y1" : "X0,Y0,Z0:X1,Y1,Z1", what));
  }
}

/// Whether a text is two points of a plane or in space.
bool areTwoPoints(const std::string& text) {
  return std::ranges::any_of(std::array{2, 3}, [&](int dim) {
    try {
      pointsOf("", text, dim, "");
      return true;
    } catch (const Error&) {
      return false;
    }
  });
}

/// The grid of these numbers of a grid, which increase, if they make one.
std::array<int, 2> gridOf(const std::vector<Eigen::Index>& kept, int along) {
  std::size_t first = 1;
  while (first < kept.size() && kept[first] == kept[0] + static_cast<Eigen::Index>(first) &&
         kept[first] % along != 0)
    ++first;
  if (kept.size() % first != 0) return {};
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (kept[k] !=
        kept[0] + static_cast<Eigen::Index>(k % first) + along * static_cast<Eigen::Index>(k / first))
      return {};
  return {static_cast<int>(first), static_cast<int>(kept.size() / first)};
}

/// Keeps the places that lay in the box. Of a line those between the first and the last of them.
void keepWithin(FacePlaces& places, const std::string& within) {
  if (within.empty()) return;
  const auto dim = static_cast<int>(places.now.rows());
  const LinePath corners = pointsOf("within", within, dim, "two corners of a box");
  const double slack =  // a face may lie in a side of the box
      1e-9 * (places.before.rowwise().maxCoeff() - places.before.rowwise().minCoeff()).norm();
  const Eigen::VectorXd low = corners.begin.cwiseMin(corners.end).array() - slack,
                        high = corners.begin.cwiseMax(corners.end).array() + slack;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < places.before.cols(); ++k)
    if ((places.before.col(k).array() >= low.array()).all() &&
        (places.before.col(k).array() <= high.array()).all())
      kept.push_back(k);
  if (kept.size() < 2)
    throw Error(fmt::format("within: nothing of the face lay in the box {} of the undeformed body", within));
  if (dim == 2) {
    const Eigen::Index first = kept.front(), last = kept.back();
    kept.clear();
    for (Eigen::Index k = first; k <= last; ++k) kept.push_back(k);
  }
  places.grid = gridOf(kept, places.grid[0]);
  for (Eigen::MatrixXd* all : {&places.now, &places.before, &places.areas})
    *all = (*all)(Eigen::all, kept).eval();
}

/// Calls `act` with the patch that has the face, the frame that has the patch, and the face's number in it.
template <class Act>
auto withFace(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec, const Act& act) {
  PictureOptions shown;
  shown.bodies = spec.bodies;
  return withShownModel(model, frame, shown, [&](const ModelRecord& chosen, const FrameRecord& its) {
    const FacePlace face = facePlace(chosen, its, {spec.face, spec.patch});
    return act(meshOf(chosen, its).patches[static_cast<std::size_t>(face.patch)], its, face.face);
  });
}

template <int Dim>
FacePlaces placesOn(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  return withFace(model, frame, spec, [&](const PatchRecord& patch, const FrameRecord& its, FaceId face) {
    FacePlaces places = placesOf<Dim>(patch, its.displacement, face);
    keepWithin(places, spec.within);
    return places;
  });
}

/// The place of a face that lies over a point of a line, found from the one before.
class Stylus {
 public:
  /// From the place of the face that is nearest to the first point of the line to the one that is nearest to the other. sign:
  /// `outwardSign` of the face.
  Stylus(const Patch<2, 3>& face, double sign, const LinePath& line) : face_(face) {
    const Eigen::Vector2d first = placeAt(line.begin), last = placeAt(line.end);
    const Eigen::Vector3d normals[] = {normalAt(first, sign), normalAt(last, sign)};
    if (!(normals[0].dot(normals[1]) > kMostTurn))
      throw Error("line: the face turns by more than 60 degrees between its ends; expected a shorter one");
    up_ = (normals[0] + normals[1]).normalized();
    requireOver(line.begin, first, line);
    requireOver(line.end, last, line);
    xi_ = first;
    begin_ = face.position(first);
    const Eigen::Vector3d way = face.position(last) - begin_, along = way - way.dot(up_) * up_;
    length_ = along.norm();
    if (!(length_ > 0.01 * (line.end - line.begin).norm()))
      throw Error("line: goes across the face; expected two points over the face, apart");
    along_ = along / length_;
    across_ = up_.cross(along_);
  }

  double length() const { return length_; }

  /// Throws `Error` where no place of the face lies over or below the line.
  double heightAt(double distance) {
    constexpr int kMostSteps = 50;
    constexpr double kOn = 1e-9;  // of the length
    for (int step = 0; step < kMostSteps; ++step) {
      const Eigen::Vector3d away = face_.position(xi_) - begin_ - distance * along_;
      const Eigen::Vector2d miss(along_.dot(away), across_.dot(away));
      if (miss.norm() <= kOn * length_) return up_.dot(away);
      const Eigen::Matrix<double, 3, 2> jacobian = face_.jacobian(xi_);
      Eigen::Matrix2d slopes;
      slopes << along_.transpose() * jacobian, across_.transpose() * jacobian;
      const Eigen::Vector2d next = xi_ - slopes.partialPivLu().solve(miss);
      for (int d = 0; d < 2; ++d) {
        const UnivariateBasis& basis = face_.basis().direction(d);
        xi_(d) = std::clamp(next(d), basis.parameterAt(0), basis.parameterAt(1));
      }
    }
    throw Error(fmt::format("line: leaves the face {:.6g} behind its first point; expected one over the face",
                            distance));
  }

 private:
  static constexpr double kMostTurn = 0.5;  // cosine of the largest angle between normals at the ends

  /// The parameters of the place that is nearest to a point.
  Eigen::Vector2d placeAt(const Eigen::Vector3d& point) const {
    constexpr int kStarts = 20, kSteps = 50;  // of the search, per direction
    std::vector<double> shares;
    for (int k = 0; k <= kStarts; ++k) shares.push_back(static_cast<double>(k) / kStarts);
    return closestPoint(face_, point, parameterGrid(face_.basis(), shares), kSteps).xi;
  }

  Eigen::Vector3d normalAt(const Eigen::Vector2d& xi, double sign) const {
    return (sign * areaVector<3>(face_.jacobian(xi))).normalized();
  }

  /// Throws `Error` if a point lies beside the place of the face that is nearest to it, seen along the mean normal.
  void requireOver(const Eigen::Vector3d& point, const Eigen::Vector2d& xi, const LinePath& line) const {
    constexpr double kBeside = 0.01;  // of the line: the body may have moved
    const Eigen::Vector3d away = point - face_.position(xi);
    const double beside = (away - away.dot(up_) * up_).norm();
    if (!(beside <= kBeside * (line.end - line.begin).norm()))
      throw Error(
          fmt::format("line: found ({:.6g}), which lies {:.3g} beside the face; expected a point of the face",
                      fmt::join(point, ", "), beside));
  }

  const Patch<2, 3>& face_;
  Eigen::Vector2d xi_;
  Eigen::Vector3d up_, begin_, along_, across_;
  double length_ = 0.0;
};

Profile profileAlong(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  if (model.dim == 2)
    throw Error("line: found a plane body; expected no line, as the profile is that along the face");
  const LinePath line = pointsOf("line", spec.line, 3, "two points of the way of a stylus");
  return withFace(model, frame, spec, [&](const PatchRecord& patch, const FrameRecord& its, FaceId face) {
    const Patch<3> body = patchGeometry<3>(patch, its.displacement);
    const Patch<2, 3> surface = tracePatch(body, face);
    Stylus stylus(surface, outwardSign(body, face), line);
    const int spans = surface.basis().direction(0).numSpans() + surface.basis().direction(1).numSpans();
    Profile profile{0.0, stylus.length() / (kPerSpanInSpace * spans),
                    Eigen::VectorXd(kPerSpanInSpace * spans + 1)};
    for (Eigen::Index k = 0; k < profile.heights.size(); ++k)
      profile.heights(k) = stylus.heightAt(static_cast<double>(k) * profile.spacing);
    return profile;
  });
}

Profile profileOfChord(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  const FacePlaces places = placesOn<2>(model, frame, spec);
  const Eigen::Vector2d begin = places.now.col(0), end = places.now.rightCols<1>();
  const Eigen::Vector2d up = places.areas.rowwise().sum(), chord = end - begin;
  if (!(chord.norm() > 1e-6 * (places.now.rowwise().maxCoeff() - places.now.rowwise().minCoeff()).norm()))
    throw Error("face: it ends where it begins; expected within, a box of the part to be looked at");
  Eigen::Matrix2d frameOfChord;  // rows: along, and out of the material
  frameOfChord.row(0) = chord.normalized();
  frameOfChord.row(1) << -frameOfChord(0, 1), frameOfChord(0, 0);
  if (frameOfChord.row(1).dot(up) < 0.0) frameOfChord.row(1) *= -1.0;
  const Eigen::Matrix2Xd local = frameOfChord * (places.now.colwise() - begin);
  return profileOf(local, static_cast<int>(places.now.cols()));
}

}  // namespace

std::vector<InputProblem> conflictsIn(const RoughnessSpec& spec) {
  if (spec.line.empty() || spec.within.empty()) return {};
  return {{"line", "found beside within; expected one of the two"}};
}

std::vector<InputProblem> mistakesIn(const RoughnessSpec& spec) {
  for (const auto& [key, text] : {std::pair{"within", spec.within}, std::pair{"line", spec.line}})
    if (!text.empty() && !areTwoPoints(text))
      return {
          {key, fmt::format("found {}; expected two points, X0,Y0:X1,Y1, in space with Z", quoted(text))}};
  return conflictsIn(spec);
}

FaceProfile faceProfile(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  for (const InputProblem& problem : conflictsIn(spec))
    throw Error(fmt::format("{}: {}", problem.path, problem.text));
  if (!hasProfile(model, spec))
    throw Error("line: missing; a face in space is an area, expected the way of a stylus over it");
  FaceProfile result{
      spec.line.empty() ? profileOfChord(model, frame, spec) : profileAlong(model, frame, spec), {}};
  result.roughness = roughnessOf(result.profile, spec.cutoff);
  result.profile = levelled(result.profile);
  if (spec.cutoff) result.profile = roughnessProfile(result.profile, *spec.cutoff);
  return result;
}

FaceArea faceArea(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  if (spec.cutoff)
    throw Error("cutoff: areas are not filtered; expected it of faces of plane bodies, or beside line");
  const FacePlaces places = placesOn<3>(model, frame, spec);
  const Eigen::Vector3d up = places.areas.rowwise().sum();
  constexpr double kClosed = 0.1;  // of the area: what its mean normal then stands for is no direction
  if (!(up.norm() > kClosed * places.areas.colwise().norm().sum()))
    throw Error(
        "face: it goes round and has no mean plane; expected within, a box of the part to be looked at, or line");
  return {roughnessOf(places.now, places.areas.colwise().norm().transpose(), up), places.now, up.normalized(),
          places.grid};
}

ModelFrame heightMap(const ModelRecord& model, const FrameRecord& frame, const FaceArea& area) {
  const auto [along, across] = area.grid;
  if (along < 2 || across < 2)
    throw Error("within: what is left of the face is no grid of its parameters; expected a box along these");
  const Eigen::Matrix3Xd& places = area.places;
  const auto at = [&](int i, int j) -> Eigen::Vector3d { return places.col(i + j * along); };
  const Eigen::Vector3d first = at(along - 1, 0) - at(0, 0) + at(along - 1, across - 1) - at(0, across - 1),
                        second = at(0, across - 1) - at(0, 0) + at(along - 1, across - 1) - at(along - 1, 0);
  const bool isTurned = first.cross(second).dot(area.up) < 0.0;  // as seen from outside
  const Eigen::Vector3d right = first.normalized(), up = area.up.cross(right).normalized();
  std::vector<Eigen::Index> order;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i) order.push_back(i + along * (isTurned ? across - 1 - j : j));
  PatchRecord patch;
  for (const int count : area.grid) {
    DirectionRecord& direction = patch.directions.emplace_back();
    direction.knots = {0.0};
    for (int k = 0; k < count; ++k) direction.knots.push_back(static_cast<double>(k) / (count - 1));
    direction.knots.push_back(1.0);
  }
  patch.points.resize(2, places.cols());
  patch.points.row(0) = right.transpose() * places(Eigen::all, order);
  patch.points.row(1) = up.transpose() * places(Eigen::all, order);
  patch.weights.setOnes(places.cols());
  patch.nodes.resize(static_cast<std::size_t>(places.cols()));
  std::iota(patch.nodes.begin(), patch.nodes.end(), 0);
  ModelFrame map;
  map.model.program = model.program;
  map.model.title = model.title;
  map.model.lengthUnit = model.lengthUnit;
  map.model.mesh = {static_cast<int>(places.cols()), {std::move(patch)}};
  map.model.bodies = {""};
  map.model.subdivision = 1;
  map.frame.index = frame.index;
  map.frame.step = frame.step;
  map.frame.time = frame.time;
  map.frame.displacement.setZero(2, places.cols());
  map.frame.fields[kHeightField] = {{}, model.lengthUnit, area.roughness.heights(order).transpose()};
  return map;
}

}  // namespace burnish
