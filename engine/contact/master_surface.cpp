#include "engine/contact/master_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/contact/unknown_lists.h"
#include "engine/core/error.h"
#include "engine/solid/face_quadrature.h"

namespace burnish::inline contact {
namespace {

constexpr int kMaxSteps = 200;
constexpr int kMaxHalvings = 30;

/// Rounding errors of a length, in parts of the coordinates: what double precision allows.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// A step below this part of the coordinates that is not much shorter than the one before is noise.
constexpr double kNoise = 1e-10;

/// Steps longer than this part of the coordinates must not lead away from the position.
constexpr double kChecked = 1e-7;

/// Difference of unit normals below which a line is no kink.
constexpr double kKink = 1e-9;

/// Turn of the normal from which on a kink is rounded, below which jumps of forces do not matter, and cosine of
/// that from which on it is a corner; half the length of what is rounded, in parts of the shorter span.
constexpr double kSmallestTurn = 1e-7;
constexpr double kCornerCosine = 0.5 * std::numbers::sqrt2;
constexpr double kRoundedPart = 0.03;

/// Nodes of a face along one of its rims, in the order of the rim's own parameter.
template <int P>
std::vector<int> rimNodes(const TensorBasis<P>& basis, const std::vector<int>& nodes, int rim) {
  if constexpr (P == 1)
    return {rim == 0 ? nodes.front() : nodes.back()};
  else {
    std::vector<int> result;
    for (const int a : faceFunctions(basis, rim)) result.push_back(nodes[static_cast<std::size_t>(a)]);
    return result;
  }
}

bool areSame(const std::vector<int>& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [&](int node) { return node == nodes.front(); });
}

}  // namespace

template <int Dim>
double Foot<Dim>::shareOfRadius() const {
  Eigen::Matrix<double, Dim - 1, Dim - 1> m = point.tangents.transpose() * point.tangents, k;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      k(a, b) = gap * normal.dot(point.curvatures.col(secondDerivative(a, b)));
  for (int a = 0; a < Dim - 1; ++a) {
    if (moves[static_cast<std::size_t>(a)] && !point.isRounded[static_cast<std::size_t>(a)]) continue;
    const double square = m(a, a);
    m.row(a).setZero();
    m.col(a).setZero();
    m(a, a) = square;
    k.row(a).setZero();
    k.col(a).setZero();
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, Dim - 1, Dim - 1>> solver(
      k, m, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

template <int Dim>
MasterSurface<Dim>::MasterSurface(const Body<Dim>& body, const std::vector<FacePlace>& faces) {
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (std::find(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(k), faces[k]) !=
        faces.begin() + static_cast<std::ptrdiff_t>(k))
      throw Error(fmt::format("contact: the face {} of patch {} is named twice", faceName(faces[k].face),
                              faces[k].patch + 1));
    const auto& patch = body.patches[static_cast<std::size_t>(faces[k].patch)];
    Face face{tracePatch(patch, faces[k].face), {}, outwardSign(patch, faces[k].face), {}, {}, {}, {}};
    for (const int a : faceFunctions(patch.basis(), faces[k].face))
      face.nodes.push_back(body.nodes[static_cast<std::size_t>(faces[k].patch)][static_cast<std::size_t>(a)]);
    face.points = face.trace.points();
    faces_.push_back(std::move(face));
  }
  glueRims();
}

template <int Dim>
void MasterSurface<Dim>::glueRims() {
  struct Rim {
    int face, rim;
    std::vector<int> nodes;
  };
  std::vector<Rim> rims;
  for (int f = 0; f < numFaces(); ++f)
    for (int r = 0; r < 2 * P; ++r) {
      Rim rim{f, r, rimNodes(basis(f), nodes(f), r)};
      if (Dim == 3 && areSame(rim.nodes))
        faces_[static_cast<std::size_t>(f)].collapsed[static_cast<std::size_t>(r)] = true;
      else
        rims.push_back(std::move(rim));
    }
  const auto glue = [&](const Rim& from, const Rim& to, bool reversed) {
    auto& place = faces_[static_cast<std::size_t>(from.face)].glued[static_cast<std::size_t>(from.rim)];
    if (place) throw Error("contact: more than two faces of one surface meet in a common edge");
    place = Glue{to.face, to.rim, reversed};
  };
  for (std::size_t i = 0; i < rims.size(); ++i)
    for (std::size_t j = i + 1; j < rims.size(); ++j) {
      const std::vector<int> backwards(rims[j].nodes.rbegin(), rims[j].nodes.rend());
      const bool same = rims[i].nodes == rims[j].nodes;
      if (!same && rims[i].nodes != backwards) continue;
      glue(rims[i], rims[j], !same);
      glue(rims[j], rims[i], !same);
    }
}

template <int Dim>
void MasterSurface<Dim>::roundKinks() {
  const auto forEachEdge = [&](const auto& visit) {
    for (int f = 0; f < numFaces(); ++f)
      for (int span = 0; span < basis(f).numSpans(); ++span)
        for (int d = 0; d < P; ++d)
          for (const int side : {0, 1}) {
            Edge edge{{f, span, {}}, d, side};
            edge.place.xi(d) = spanEnd(edge.place, d, side);
            visit(edge);
          }
  };
  const auto among = [](auto& lists, const Edge& edge) -> auto& {
    return lists[static_cast<std::size_t>(edge.place.span)]
                [static_cast<std::size_t>(2 * edge.direction + edge.side)];
  };
  Creases creases;
  bool any = false;
  for (int f = 0; f < numFaces(); ++f) creases.emplace_back(static_cast<std::size_t>(basis(f).numSpans()));
  forEachEdge([&](const Edge& edge) {
    auto& crease = among(creases[static_cast<std::size_t>(edge.place.face)], edge);
    crease = creaseAt(edge);
    any = any || (crease && crease->isKink);
  });
  for (Face& face : faces_) {
    face.widths.clear();
    if (any) face.widths.resize(static_cast<std::size_t>(face.trace.basis().numSpans()));
  }
  if (!any) return;
  forEachEdge([&](Edge edge) {
    auto& widths = among(faces_[static_cast<std::size_t>(edge.place.face)].widths, edge);
    for (const int end : {0, 1}) {
      if constexpr (P == 2) edge.place.xi(1 - edge.direction) = spanEnd(edge.place, 1 - edge.direction, end);
      widths[static_cast<std::size_t>(end)] = widthAtCorner(edge, creases);
    }
  });
}

template <int Dim>
double MasterSurface<Dim>::spanEnd(const SurfacePlace<Dim>& place, int direction, int side) const {
  const UnivariateBasis& univariate = basis(place.face).direction(direction);
  const int number = basis(place.face).spanIndex(place.span)[static_cast<std::size_t>(direction)];
  return side == 0 ? univariate.spanBegin(number) : univariate.spanEnd(number);
}

template <int Dim>
double MasterSurface<Dim>::spanSize(const SurfacePlace<Dim>& place, int direction) const {
  return spanEnd(place, direction, 1) - spanEnd(place, direction, 0);
}

/// None where the surface ends and where functions are smooth. The places along it are enough to see every kink
/// that functions of this degree can have.
template <int Dim>
std::optional<typename MasterSurface<Dim>::Crease> MasterSurface<Dim>::creaseAt(Edge edge) const {
  const int d = edge.direction;
  if (!isAtRim(edge.place, d, edge.side)) {
    const UnivariateBasis& univariate = basis(edge.place.face).direction(d);
    const int number = basis(edge.place.face).spanIndex(edge.place.span)[static_cast<std::size_t>(d)];
    const int begin = edge.side == 0 ? number : number + 1;
    if (univariate.firstFunction(begin) - univariate.firstFunction(begin - 1) < univariate.degree())
      return std::nullopt;
  }
  const int parts = P == 1 ? 0 : basis(edge.place.face).direction(1 - d).degree();
  Crease crease;
  for (int k = 0; k <= parts; ++k) {
    if constexpr (P == 2)
      edge.place.xi(1 - d) = std::lerp(spanEnd(edge.place, 1 - d, 0), spanEnd(edge.place, 1 - d, 1),
                                       static_cast<double>(k) / parts);
    const auto other = across(edge.place, d, edge.side);
    if (!other) return std::nullopt;
    const SurfacePoint<Dim> here = unroundedAt(edge.place), there = unroundedAt(other->place);
    crease.isKink = crease.isKink || (here.normal - there.normal).norm() > kSmallestTurn;
    crease.isCorner = crease.isCorner || here.normal.dot(there.normal) <= kCornerCosine;
    crease.speed += here.tangents.col(d).norm();
    crease.speedThere += there.tangents.col(other->direction).norm();
  }
  return crease;
}

/// Half of what is rounded about an edge, in the parameter across, at the corner of the span that is its place.
/// Zero in space where the edge or the one behind that corner is too sharp, and where the line neither goes on as
/// one behind the corner nor ends with the surface.
template <int Dim>
double MasterSurface<Dim>::widthAtCorner(const Edge& edge, const Creases& creases) const {
  const auto creaseOf = [&](const SurfacePlace<Dim>& place, int direction, int side) {
    return creases[static_cast<std::size_t>(place.face)][static_cast<std::size_t>(place.span)]
                  [static_cast<std::size_t>(2 * direction + side)];
  };
  const SurfacePlace<Dim>& here = edge.place;
  auto crease = creaseOf(here, edge.direction, edge.side);
  if (!crease) return 0.0;
  const Edge there = *across(here, edge.direction, edge.side);
  const double size = spanSize(here, edge.direction), sizeThere = spanSize(there.place, there.direction);
  if constexpr (P == 2) {
    const auto onwards = [&](const Edge& from) {
      return across(from.place, 1 - from.direction, sideOf(from.place, 1 - from.direction));
    };
    const auto next = onwards(edge), nextThere = onwards(there);
    if (next.has_value() != nextThere.has_value()) return 0.0;
    if (next) {
      const int direction = 1 - next->direction, side = sideOf(next->place, direction);
      const auto opposite = across(next->place, direction, side);
      const auto nextCrease = creaseOf(next->place, direction, side);
      if (!nextCrease || opposite->place.face != nextThere->place.face ||
          opposite->place.span != nextThere->place.span)
        return 0.0;
      crease->isKink = crease->isKink || nextCrease->isKink;
      crease->isCorner = crease->isCorner || nextCrease->isCorner;
      crease->speed += nextCrease->speed * (spanSize(next->place, direction) / size);
      crease->speedThere +=
          nextCrease->speedThere * (spanSize(nextThere->place, 1 - nextThere->direction) / sizeThere);
    }
  }
  if (!crease->isKink || crease->isCorner) return 0.0;
  return kRoundedPart * std::min(crease->speed * size, crease->speedThere * sizeThere) / crease->speed;
}

template <int Dim>
void MasterSurface<Dim>::moveTo(const Eigen::VectorXd& x) {
  for (Face& face : faces_) {
    face.points = face.trace.points();
    for (std::size_t a = 0; a < face.nodes.size(); ++a)
      face.points.col(static_cast<Eigen::Index>(a)) += x.template segment<Dim>(Dim * face.nodes[a]);
  }
}

template <int Dim>
void MasterSurface<Dim>::archive(StateArchive& archive) {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    Eigen::VectorXd points = faces_[f].points.reshaped();
    archive.fixedField(fmt::format("face_{}", f), points);
    faces_[f].points = points.reshaped(Dim, faces_[f].points.cols());
  }
}

template <int Dim>
SurfacePlace<Dim> MasterSurface<Dim>::placeOf(int face, const Eigen::Vector<double, Dim - 1>& xi) const {
  return {face, at(face).trace.findSpan(xi), xi};
}

template <int Dim>
double MasterSurface<Dim>::largestWayFrom(const MasterSurface& other) const {
  double largest = 0.0;
  for (std::size_t face = 0; face < faces_.size(); ++face)
    largest =
        std::max(largest, (faces_[face].points - other.faces_[face].points).colwise().norm().maxCoeff());
  return largest;
}

template <int Dim>
SurfacePoint<Dim> MasterSurface<Dim>::at(const SurfacePlace<Dim>& place) const {
  SurfacePoint<Dim> point = unroundedAt(place);
  round(point);
  return point;
}

template <int Dim>
void MasterSurface<Dim>::round(SurfacePoint<Dim>& point) const {
  if (at(point.place.face).widths.empty()) return;
  std::array<std::optional<Rounding>, P> roundings;
  for (int d = 0; d < P; ++d) {
    auto& rounding = roundings[static_cast<std::size_t>(d)];
    rounding = roundingAt(point.place, d);
    if (!rounding) continue;
    for (const Edge& side : {rounding->there, rounding->here})
      add(rounding->blend * widthAlong(side, 1 - d), slopeInto(side), 1 - d, point);
    point.isRounded[static_cast<std::size_t>(d)] = true;
  }
  if (!roundings.front() && !roundings.back()) return;
  if constexpr (P == 2)
    if (roundings[0] && roundings[1]) roundCrossing(*roundings[0], *roundings[1], point);
  point.normal = at(point.place.face).outward * areaVector<Dim>(point.tangents).normalized();
}

/// Adds b_0 b_1 Σ y_01, with the widths beside the point; the span behind an edge has another parameter along it,
/// and so another width across it.
template <int Dim>
void MasterSurface<Dim>::roundCrossing(const Rounding& first, const Rounding& second,
                                       SurfacePoint<Dim>& point) const {
  const Blend both = first.blend * second.blend;
  const auto addTwist = [&](const Edge& edge0, const Edge& edge1, const SurfacePlace<Dim>& corner,
                            double stretch) {
    const SurfacePoint<Dim> there = unroundedAt(corner);
    const double factor = sideOf(corner, 0) == sideOf(corner, 1) ? std::abs(stretch) : -std::abs(stretch);
    add(both * widthAlong(edge0, 1) * widthAlong(edge1, 0),
        {there.nodes, factor * there.shape.ddR.rightCols(1), factor * there.curvatures.rightCols(1)}, 0,
        point);
  };
  const auto over = [&](const SurfacePlace<Dim>& corner, int d) {
    return *across(corner, d, sideOf(corner, d));
  };
  SurfacePlace<Dim> corner = point.place;
  corner.xi(0) = first.here.place.xi(0);
  corner.xi(1) = second.here.place.xi(1);
  const Edge beside0 = over(corner, 0), beside1 = over(corner, 1),
             opposite = over(beside0.place, 1 - beside0.direction);
  addTwist(first.here, second.here, corner, 1.0);
  addTwist(first.there, second.here, beside0.place, beside0.stretch);
  addTwist(first.here, second.there, beside1.place, beside1.stretch);
  addTwist(first.there, second.there, opposite.place,
           opposite.stretch * over(beside1.place, 1 - beside1.direction).stretch);
}

/// At which end of a span in a direction a corner of it is.
template <int Dim>
int MasterSurface<Dim>::sideOf(const SurfacePlace<Dim>& corner, int direction) const {
  return corner.xi(direction) == spanEnd(corner, direction, 0) ? 0 : 1;
}

template <int Dim>
typename MasterSurface<Dim>::Blend MasterSurface<Dim>::Blend::operator*(const Blend& other) const {
  Blend product{b * other.b, d * other.b + b * other.d, dd * other.b + b * other.dd};
  for (int i = 0; i < P; ++i)
    for (int j = i; j < P; ++j) product.dd(secondDerivative(i, j)) += d(i) * other.d(j) + d(j) * other.d(i);
  return product;
}

/// Half of what is rounded about an edge, w = w_0 + (w_1 - w_0) (3 t² - 2 t³) with t from 0 to 1 between both ends,
/// constant beyond, with derivatives by the parameter `along` of the span from which one came over the edge.
template <int Dim>
typename MasterSurface<Dim>::Blend MasterSurface<Dim>::widthAlong(const Edge& edge, int along) const {
  const auto& [begin, end] = at(edge.place.face)
                                 .widths[static_cast<std::size_t>(edge.place.span)]
                                        [static_cast<std::size_t>(2 * edge.direction + edge.side)];
  Blend width{begin};
  if constexpr (P == 2) {
    const int alongThere = 1 - edge.direction;
    const double size = spanSize(edge.place, alongThere), rise = end - begin;
    const double way = edge.place.xi(alongThere) - spanEnd(edge.place, alongThere, 0);
    const double t = std::clamp(way / size, 0.0, 1.0), dt = edge.stretch / size;
    width.b += rise * t * t * (3.0 - 2.0 * t);
    width.d(along) = rise * 6.0 * t * (1.0 - t) * dt;
    if (way >= 0.0 && way <= size) width.dd(along) = rise * (6.0 - 12.0 * t) * dt * dt;
  }
  return width;
}

/// None where a place is not on the rounded side of an edge across that parameter.
template <int Dim>
std::optional<typename MasterSurface<Dim>::Rounding> MasterSurface<Dim>::roundingAt(
    const SurfacePlace<Dim>& place, int direction) const {
  for (const int side : {0, 1}) {
    Edge edge{place, direction, side};
    edge.place.xi(direction) = spanEnd(place, direction, side);
    const Blend width = widthAlong(edge, 1 - direction);
    const double w = width.b, way = std::abs(place.xi(direction) - edge.place.xi(direction));
    const double u = 1.0 - way / w;  // no number on a corner with w = 0
    if (!(u > 0.0)) continue;
    Blend blend{0.25 * u * u};
    const double du = (side == 0 ? -1.0 : 1.0) / w;
    blend.d(direction) = 0.5 * u * du;
    blend.dd(direction) = 0.5 * du * du;
    if constexpr (P == 2) {
      const int along = 1 - direction;
      const double dw = width.d(along), ddw = width.dd(along), duAlong = way * dw / (w * w);
      blend.d(along) = 0.5 * u * duAlong;
      blend.dd(along) = 0.5 * (duAlong * duAlong + u * way * (ddw - 2.0 * dw * dw / w) / (w * w));
      blend.dd(2) = 0.5 * (du * duAlong - u * du * dw / w);
    }
    return Rounding{edge, *across(edge.place, direction, side), blend};
  }
  return std::nullopt;
}

/// ∂y/∂ξ^d on an edge by its span's parameter d across, into the span, and derivatives of that along the edge, by
/// the parameter of the span from which one came over it.
template <int Dim>
typename MasterSurface<Dim>::EdgeSum MasterSurface<Dim>::slopeInto(const Edge& edge) const {
  const Face& face = at(edge.place.face);
  EdgeSum slope;
  slope.nodes = spanNodes(edge.place);
  slope.f = crossingDerivatives<P>(face.trace.basis(), face.trace.weights(), edge.place.span, edge.place.xi,
                                   edge.direction);
  double factor = edge.side == 0 ? 1.0 : -1.0;
  for (auto column : slope.f.colwise()) {
    column *= factor;
    factor *= edge.stretch;
  }
  slope.y = spanPoints(edge.place) * slope.f;
  return slope;
}

/// Adds a blended sum, which changes with the parameter `along`, if at all.
template <int Dim>
void MasterSurface<Dim>::add(const Blend& blend, const EdgeSum& sum, int along, SurfacePoint<Dim>& point) {
  const auto places = placesAmong(point.nodes, sum.nodes);
  const auto size = std::ssize(point.nodes);
  point.shape.R.conservativeResizeLike(Eigen::VectorXd::Zero(size));
  point.shape.dR.conservativeResizeLike(decltype(point.shape.dR)::Zero(size, P));
  point.shape.ddR.conservativeResizeLike(decltype(point.shape.ddR)::Zero(size, P * (P + 1) / 2));
  const auto addTo = [&](auto&& value, auto&& first, auto&& second, const auto& columns) {
    value += blend.b * columns.col(0);
    for (int c = 0; c < P; ++c) first.col(c) += blend.d(c) * columns.col(0);
    for (int c = 0; c < P * (P + 1) / 2; ++c) second.col(c) += blend.dd(c) * columns.col(0);
    if (columns.cols() == 1) return;
    first.col(along) += blend.b * columns.col(1);
    second.col(along) += 2.0 * blend.d(along) * columns.col(1) + blend.b * columns.col(2);
    second.col(2) += blend.d(1 - along) * columns.col(1);
  };
  addTo(point.shape.R(places), point.shape.dR(places, Eigen::all), point.shape.ddR(places, Eigen::all),
        sum.f);
  addTo(point.x, point.tangents, point.curvatures, sum.y);
}

template <int Dim>
std::vector<int> MasterSurface<Dim>::spanNodes(const SurfacePlace<Dim>& place) const {
  const Face& face = at(place.face);
  std::vector<int> nodes;
  for (const int a : face.trace.basis().spanFunctions(place.span))
    nodes.push_back(face.nodes[static_cast<std::size_t>(a)]);
  return nodes;
}

template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> MasterSurface<Dim>::spanPoints(
    const SurfacePlace<Dim>& place) const {
  const Face& face = at(place.face);
  return face.points(Eigen::all, face.trace.basis().spanFunctions(place.span));
}

template <int Dim>
SurfacePoint<Dim> MasterSurface<Dim>::unroundedAt(const SurfacePlace<Dim>& place) const {
  const Face& face = at(place.face);
  SurfacePoint<Dim> point;
  point.place = place;
  point.nodes = spanNodes(place);
  point.shape = secondOrderShape<P>(face.trace.basis(), face.trace.weights(), place.span, place.xi);
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> points = spanPoints(place);
  point.x = points * point.shape.R;
  point.tangents = points * point.shape.dR;
  point.curvatures = points * point.shape.ddR;
  point.normal = face.outward * areaVector<Dim>(point.tangents).normalized();
  return point;
}

template <int Dim>
bool MasterSurface<Dim>::isAtRim(const SurfacePlace<Dim>& place, int direction, int side) const {
  const int index = basis(place.face).spanIndex(place.span)[static_cast<std::size_t>(direction)];
  return index == (side == 0 ? 0 : basis(place.face).direction(direction).numSpans() - 1);
}

template <int Dim>
bool MasterSurface<Dim>::isFree(const SurfacePlace<Dim>& place, int direction, int side) const {
  const auto rim = static_cast<std::size_t>(2 * direction + side);
  return isAtRim(place, direction, side) && !at(place.face).glued[rim] && !at(place.face).collapsed[rim];
}

template <int Dim>
double MasterSurface<Dim>::limit(const SurfacePlace<Dim>& place, int direction, int side,
                                 bool beyondRims) const {
  const UnivariateBasis& univariate = basis(place.face).direction(direction);
  const int index = basis(place.face).spanIndex(place.span)[static_cast<std::size_t>(direction)];
  const double begin = univariate.spanBegin(index), end = univariate.spanEnd(index);
  const double beyond = beyondRims && isFree(place, direction, side) ? end - begin : 0.0;
  return side == 0 ? begin - beyond : end + beyond;
}

template <int Dim>
std::optional<typename MasterSurface<Dim>::Edge> MasterSurface<Dim>::across(const SurfacePlace<Dim>& place,
                                                                            int direction, int side) const {
  const auto& from = basis(place.face);
  auto index = from.spanIndex(place.span);
  const auto d = static_cast<std::size_t>(direction);
  if (!isAtRim(place, direction, side)) {
    index[d] += side == 0 ? -1 : 1;
    return Edge{{place.face, from.spanNumber(index), place.xi}, direction, 1 - side};
  }
  const auto& glue = at(place.face).glued[static_cast<std::size_t>(2 * direction + side)];
  if (!glue) return std::nullopt;
  const auto& to = basis(glue->face);
  Edge edge{{glue->face, 0, {}}, glue->rim / 2, glue->rim % 2};
  typename TensorBasis<P>::Index there{};
  const UnivariateBasis& onto = to.direction(edge.direction);
  const int last = edge.side == 0 ? 0 : onto.numSpans() - 1;
  there[static_cast<std::size_t>(edge.direction)] = last;
  edge.place.xi(edge.direction) = edge.side == 0 ? onto.spanBegin(last) : onto.spanEnd(last);
  if constexpr (P == 2) {
    const UnivariateBasis& along = from.direction(1 - direction);
    const UnivariateBasis& other = to.direction(1 - edge.direction);
    const int number = index[1 - d];
    const double share = (place.xi(1 - direction) - along.spanBegin(number)) /
                         (along.spanEnd(number) - along.spanBegin(number));
    const int counterpart = glue->reversed ? other.numSpans() - 1 - number : number;
    there[static_cast<std::size_t>(1 - edge.direction)] = counterpart;
    edge.place.xi(1 - edge.direction) = std::lerp(other.spanBegin(counterpart), other.spanEnd(counterpart),
                                                  glue->reversed ? 1.0 - share : share);
    edge.stretch = (glue->reversed ? -1.0 : 1.0) *
                   (other.spanEnd(counterpart) - other.spanBegin(counterpart)) /
                   (along.spanEnd(number) - along.spanBegin(number));
  }
  edge.place.span = to.spanNumber(there);
  return edge;
}

template <int Dim>
std::vector<typename MasterSurface<Dim>::Edge> MasterSurface<Dim>::edgesAround(
    const SurfacePlace<Dim>& place) const {
  std::vector<Edge> edges;
  std::vector<SurfacePlace<Dim>> places{place};
  const auto add = [&](const SurfacePlace<Dim>& next) {
    const bool isKnown = std::any_of(places.begin(), places.end(), [&](const auto& known) {
      return known.face == next.face && known.span == next.span && known.xi == next.xi;
    });
    if (!isKnown) places.push_back(next);
  };
  for (std::size_t k = 0; k < places.size(); ++k) {
    const SurfacePlace<Dim> here = places[k];
    const auto index = basis(here.face).spanIndex(here.span);
    for (int d = 0; d < P; ++d)
      for (int side = 0; side < 2; ++side) {
        const UnivariateBasis& univariate = basis(here.face).direction(d);
        const int number = index[static_cast<std::size_t>(d)];
        if (here.xi(d) != (side == 0 ? univariate.spanBegin(number) : univariate.spanEnd(number))) continue;
        edges.push_back({here, d, side});
        if (const auto next = across(here, d, side)) add(next->place);
        if constexpr (P == 2) {
          if (!isAtRim(here, d, side) || !at(here.face).collapsed[static_cast<std::size_t>(2 * d + side)])
            continue;
          const UnivariateBasis& along = basis(here.face).direction(1 - d);
          for (int e = 0; e < along.numSpans(); ++e) {
            auto there = index;
            there[static_cast<std::size_t>(1 - d)] = e;
            SurfacePlace<Dim> middle{here.face, basis(here.face).spanNumber(there), here.xi};
            middle.xi(1 - d) = 0.5 * (along.spanBegin(e) + along.spanEnd(e));
            add(middle);
          }
        }
      }
  }
  return edges;
}

template <int Dim>
std::vector<SurfacePlace<Dim>> MasterSurface<Dim>::around(const SurfacePlace<Dim>& place) const {
  std::vector<SurfacePlace<Dim>> places{place};
  for (const Edge& edge : edgesAround(place)) {
    const bool isKnown = std::any_of(places.begin(), places.end(), [&](const auto& known) {
      return known.face == edge.place.face && known.span == edge.place.span;
    });
    if (!isKnown) places.push_back(edge.place);
  }
  return places;
}

template <int Dim>
double MasterSurface<Dim>::overhang(const SurfacePlace<Dim>& place) const {
  double largest = -std::numeric_limits<double>::infinity();
  const auto index = basis(place.face).spanIndex(place.span);
  for (int d = 0; d < P; ++d) {
    const UnivariateBasis& univariate = basis(place.face).direction(d);
    const int number = index[static_cast<std::size_t>(d)];
    const double begin = univariate.spanBegin(number), end = univariate.spanEnd(number);
    if (isFree(place, d, 0)) largest = std::max(largest, (begin - place.xi(d)) / (end - begin));
    if (isFree(place, d, 1)) largest = std::max(largest, (place.xi(d) - end) / (end - begin));
  }
  return largest;
}

template <int Dim>
std::optional<Foot<Dim>> MasterSurface<Dim>::footAt(const SurfacePoint<Dim>& point,
                                                    const Eigen::Vector<double, Dim>& position,
                                                    const std::array<bool, Dim - 1>& held) const {
  Foot<Dim> foot;
  foot.point = point;
  const Eigen::Vector<double, Dim> way = position - point.x;
  bool isKink = false;
  Eigen::Vector<double, Dim> sum = Eigen::Vector<double, Dim>::Zero();
  if (std::any_of(held.begin(), held.end(), [](bool h) { return h; })) {
    for (const auto& place : around(point.place)) {
      const Eigen::Vector<double, Dim> normal = at(place).normal;
      isKink = isKink || (normal - point.normal).norm() > kKink;
      sum += normal;
    }
  }
  if (!isKink) {
    foot.moves.fill(true);
    foot.normal = point.normal;
    foot.gap = way.dot(point.normal);
  } else {
    for (std::size_t d = 0; d < held.size(); ++d) foot.moves[d] = !held[d];
    const double distance = way.norm();
    foot.gap = way.dot(sum) < 0.0 ? -distance : distance;
    foot.normal = sum.normalized();
    if (distance > kRounding * (position.norm() + point.x.norm())) {
      foot.edgeCurvature = 1.0 / foot.gap;
      foot.normal = foot.edgeCurvature * way;
    }
  }
  if (!foot.normal.allFinite()) return std::nullopt;
  return foot;
}

template <int Dim>
std::optional<Foot<Dim>> MasterSurface<Dim>::project(const Eigen::Vector<double, Dim>& position,
                                                     const SurfacePlace<Dim>& start) const {
  using Square = Eigen::Matrix<double, P, P>;
  using Parameters = Eigen::Vector<double, P>;
  SurfacePoint<Dim> point = at(start);
  double lastLength = std::numeric_limits<double>::infinity();
  // Long steps on the way stop at free rims: only a foot that has come to rest there goes on.
  bool beyondRims = overhang(start) > 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const SurfacePlace<Dim>& place = point.place;
    const Eigen::Vector<double, Dim> way = position - point.x;
    const double scale = position.norm() + point.x.norm(), rounding = kRounding * scale;

    // Whether the distance falls along a parameter, and which way: -1, 0, 1.
    const auto downhill = [&](const SurfacePoint<Dim>& there, int d) {
      const double residual = there.tangents.col(d).dot(way);
      if (std::abs(residual) <= rounding * there.tangents.col(d).norm()) return 0;
      return residual > 0.0 ? 1 : -1;
    };
    const auto fallsInto = [&](const Edge& edge, const SurfacePoint<Dim>& there) {
      return downhill(there, edge.direction) == (edge.side == 0 ? 1 : -1);
    };

    // Over edges behind which the distance falls; parameters that have to stop at an edge are held.
    std::array<bool, P> held{};
    std::optional<SurfacePoint<Dim>> beyond;
    for (int d = 0; d < P && !beyond; ++d) {
      const int way1 = downhill(point, d);
      if (way1 == 0) continue;
      const int side = way1 < 0 ? 0 : 1;
      if (place.xi(d) != limit(place, d, side, beyondRims)) continue;
      if (beyondRims && isFree(place, d, side)) return std::nullopt;
      held[static_cast<std::size_t>(d)] = true;
      const auto edge = across(place, d, side);
      if (!edge) continue;
      SurfacePoint<Dim> there = at(edge->place);
      if (fallsInto(*edge, there)) beyond = std::move(there);
    }
    if (beyond) {
      point = std::move(*beyond);
      continue;
    }

    // Newton's step in the parameters that are free, as far as the span goes.
    Square m = point.tangents.transpose() * point.tangents, h;
    for (int a = 0; a < P; ++a)
      for (int b = 0; b < P; ++b) h(a, b) = m(a, b) - way.dot(point.curvatures.col(secondDerivative(a, b)));
    Parameters residual = point.tangents.transpose() * way, delta;
    std::array<bool, P> fixed = held;
    double share = 1.0;
    int stopped = -1;
    for (bool again = true; again;) {
      for (int d = 0; d < P; ++d) {
        if (!fixed[static_cast<std::size_t>(d)]) continue;
        for (Square* matrix : {&m, &h}) {
          matrix->row(d).setZero();
          matrix->col(d).setZero();
          (*matrix)(d, d) = 1.0;
        }
        residual(d) = 0.0;
      }
      Eigen::LLT<Square> factor(h);
      if (factor.info() != Eigen::Success)
        factor.compute(m + std::numeric_limits<double>::epsilon() * m.trace() * Square::Identity());
      delta = factor.solve(residual);
      again = false;
      share = 1.0;
      stopped = -1;
      for (int d = 0; d < P; ++d) {
        if (delta(d) == 0.0) continue;
        const double room = std::abs(limit(place, d, delta(d) < 0.0 ? 0 : 1, beyondRims) - place.xi(d));
        if (std::abs(delta(d)) <= share * room) continue;
        if (room == 0.0) {
          again = fixed[static_cast<std::size_t>(d)] = true;
        } else if (const double part = room / std::abs(delta(d)); part < share) {
          share = part;
          stopped = d;
        }
      }
    }
    const double length = (point.tangents * delta).norm();
    if (!std::isfinite(length)) return std::nullopt;
    const bool isConverged = length <= rounding || (length <= kNoise * scale && length >= 0.5 * lastLength);
    lastLength = length;

    if (isConverged && std::any_of(held.begin(), held.end(), [](bool h1) { return h1; })) {
      for (const Edge& edge : edgesAround(place)) {
        SurfacePoint<Dim> there = at(edge.place);
        if (!fallsInto(edge, there)) continue;
        beyond = std::move(there);
        break;
      }
      if (beyond) {
        point = std::move(*beyond);
        continue;
      }
      bool isAtFreeRim = false;
      for (int d = 0; d < P && !beyondRims; ++d)
        isAtFreeRim = isAtFreeRim ||
                      (held[static_cast<std::size_t>(d)] && isFree(place, d, downhill(point, d) < 0 ? 0 : 1));
      if (isAtFreeRim) {
        beyondRims = true;
        continue;
      }
    }

    const auto moved = [&](double part) {
      SurfacePlace<Dim> next = place;
      next.xi += part * delta;
      for (int d = 0; d < P; ++d)
        next.xi(d) = std::clamp(next.xi(d), limit(place, d, 0, beyondRims), limit(place, d, 1, beyondRims));
      if (stopped >= 0 && part == share)
        next.xi(stopped) = limit(place, stopped, delta(stopped) < 0.0 ? 0 : 1, beyondRims);
      return at(next);
    };
    SurfacePoint<Dim> next = moved(share);
    if (isConverged) return footAt(next, position, held);
    for (int k = 0;
         k < kMaxHalvings && share * length > kChecked * scale && !((position - next.x).norm() <= way.norm());
         ++k) {
      share *= 0.5;
      stopped = -1;
      next = moved(share);
    }
    point = std::move(next);
  }
  return std::nullopt;
}

/// Bézier points of a span without what is rounded and, in the last row, their weights.
template <int Dim>
Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> MasterSurface<Dim>::bezierPoints(int face, int span) const {
  const TensorBasis<P>& tensor = basis(face);
  const auto index = tensor.spanIndex(span);
  Eigen::MatrixXd C = tensor.direction(0).extraction(index[0]);
  if constexpr (P == 2) {
    const Eigen::MatrixXd first = C, second = tensor.direction(1).extraction(index[1]);
    C.resize(first.rows() * second.rows(), first.cols() * second.cols());
    for (Eigen::Index i = 0; i < second.rows(); ++i)
      for (Eigen::Index j = 0; j < second.cols(); ++j)
        C.block(i * first.rows(), j * first.cols(), first.rows(), first.cols()) = second(i, j) * first;
  }
  const std::vector<int> functions = tensor.spanFunctions(span);
  const Eigen::VectorXd w = at(face).trace.weights()(functions);
  const Eigen::MatrixXd weighted = w.asDiagonal() * C;
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> points(Dim + 1, C.cols());
  points.template bottomRows<1>() = weighted.colwise().sum();
  points.template topRows<Dim>() = at(face).points(Eigen::all, functions) * weighted;
  points.template topRows<Dim>().array().rowwise() /= points.template bottomRows<1>().array();
  return points;
}

template <int Dim>
Eigen::AlignedBox<double, Dim> MasterSurface<Dim>::box(int face, int span) const {
  using Box = Eigen::AlignedBox<double, Dim>;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  const auto sharpBox = [&](int f, int s) {
    const auto points = bezierPoints(f, s);
    lowest = std::min(lowest, points.template bottomRows<1>().minCoeff());
    highest = std::max(highest, points.template bottomRows<1>().maxCoeff());
    return Box(points.template topRows<Dim>().rowwise().minCoeff(),
               points.template topRows<Dim>().rowwise().maxCoeff());
  };
  Box box = sharpBox(face, span);
  int degree = 0;
  if (isRounded(face, span)) {
    // What is rounded is a sum of Bézier points as the span is, with some of the spans around. Derivatives give
    // these factors up to b w p times the ratio of weights, per direction.
    Box all = box;
    SurfacePlace<Dim> corner{face, span, {}};
    for (unsigned number = 0; number < 1u << P; ++number) {
      for (int d = 0; d < P; ++d) corner.xi(d) = spanEnd(corner, d, static_cast<int>(number >> d & 1u));
      for (const SurfacePlace<Dim>& place : around(corner)) {
        all.extend(sharpBox(place.face, place.span));
        for (int d = 0; d < P; ++d) degree = std::max(degree, basis(place.face).direction(d).degree());
      }
    }
    const double factor = 0.25 * kRoundedPart * degree * highest / lowest;
    const double share = std::min(1.0, std::pow(1.0 + factor, P) - 1.0);
    box = Box(box.min() + share * (all.min() - box.min()), box.max() + share * (all.max() - box.max()));
  }
  return lowest > 0.0 ? box : Box();
}

template <int Dim>
bool MasterSurface<Dim>::isRounded(int face, int span) const {
  const auto& widths = at(face).widths;
  if (widths.empty()) return false;
  const auto& edges = widths[static_cast<std::size_t>(span)];
  return std::any_of(edges.begin(), edges.end(),
                     [](const auto& ends) { return ends[0] > 0.0 || ends[1] > 0.0; });
}

template struct Foot<2>;
template struct Foot<3>;
template class MasterSurface<2>;
template class MasterSurface<3>;

}  // namespace burnish::inline contact
