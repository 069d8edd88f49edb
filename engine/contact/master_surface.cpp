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

namespace burnish {
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

/// Turn of the tangent from which on a kink is rounded, below which jumps of forces do not matter, and cosine of
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
  if (point.isRounded) return 0.0;
  Eigen::Matrix<double, Dim - 1, Dim - 1> m = point.tangents.transpose() * point.tangents, k;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      k(a, b) = gap * normal.dot(point.curvatures.col(secondDerivative(a, b)));
  for (int a = 0; a < Dim - 1; ++a) {
    if (moves[static_cast<std::size_t>(a)]) continue;
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
  if constexpr (Dim == 2) {
    for (int f = 0; f < numFaces(); ++f) {
      const UnivariateBasis& univariate = basis(f).direction(0);
      auto& roundings = faces_[static_cast<std::size_t>(f)].roundings;
      roundings.assign(static_cast<std::size_t>(univariate.numSpans()), {});
      for (int span = 0; span < univariate.numSpans(); ++span)
        for (const int side : {0, 1}) {
          const double end = side == 0 ? univariate.spanBegin(span) : univariate.spanEnd(span);
          roundings[static_cast<std::size_t>(span)][static_cast<std::size_t>(side)] =
              roundingOf({f, span, Eigen::Vector<double, P>::Constant(end)}, side);
        }
    }
  }
}

/// place: an end of its span. None where there is no kink, or a corner.
template <int Dim>
std::optional<typename MasterSurface<Dim>::Rounding> MasterSurface<Dim>::roundingOf(
    const SurfacePlace<Dim>& place, int side) const {
  const auto edge = across(place, 0, side);
  if (!edge) return std::nullopt;
  // Towards the other span: up at the end of a span, down at its begin; on from there the other way about.
  const double sign = side == 0 ? -1.0 : 1.0, signThere = edge->side == 0 ? 1.0 : -1.0;
  const Eigen::Vector<double, Dim> tangent = sign * unroundedAt(place).tangents.col(0),
                                   tangentThere = signThere * unroundedAt(edge->place).tangents.col(0);
  const double speed = tangent.norm(), speedThere = tangentThere.norm();
  const double turn = (tangentThere / speedThere - tangent / speed).norm();
  if (!(turn > kSmallestTurn) || !(tangent.dot(tangentThere) > kCornerCosine * speed * speedThere))
    return std::nullopt;
  const auto spanSize = [&](const SurfacePlace<Dim>& there) {
    const UnivariateBasis& univariate = basis(there.face).direction(0);
    return univariate.spanEnd(there.span) - univariate.spanBegin(there.span);
  };
  const double length = kRoundedPart * std::min(speed * spanSize(place), speedThere * spanSize(edge->place));
  return Rounding{place, edge->place, length / speed, sign * length / speed, signThere * length / speedThere};
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

/// Adds ¼ u² (y'(0⁺) - y'(0⁻)), u = 1 - |s|, to a point of what is rounded.
template <int Dim>
void MasterSurface<Dim>::round(SurfacePoint<Dim>& point) const {
  const SurfacePlace<Dim> place = point.place;
  const auto& roundings = at(place.face).roundings;
  if (roundings.empty()) return;
  for (const auto& rounding : roundings[static_cast<std::size_t>(place.span)]) {
    if (!rounding) continue;
    const double u = 1.0 - std::abs(place.xi(0) - rounding->here.xi(0)) / rounding->width;
    if (!(u > 0.0)) continue;
    const double du = (rounding->hereByLength > 0.0 ? 1.0 : -1.0) / rounding->width;
    const double b = 0.25 * u * u, db = 0.5 * u * du, ddb = 0.5 * du * du;
    const auto add = [&](const SurfacePlace<Dim>& side, double byLength) {
      const SurfacePoint<Dim> there = unroundedAt(side);
      const auto places = placesAmong(point.nodes, there.nodes);
      const auto size = std::ssize(point.nodes);
      point.shape.R.conservativeResizeLike(Eigen::VectorXd::Zero(size));
      point.shape.dR.conservativeResizeLike(decltype(point.shape.dR)::Zero(size, P));
      point.shape.ddR.conservativeResizeLike(decltype(point.shape.ddR)::Zero(size, P * (P + 1) / 2));
      const Eigen::VectorXd dR = byLength * there.shape.dR.col(0);
      point.shape.R(places) += b * dR;
      point.shape.dR(places, 0) += db * dR;
      point.shape.ddR(places, 0) += ddb * dR;
      const Eigen::Vector<double, Dim> tangent = byLength * there.tangents.col(0);
      point.x += b * tangent;
      point.tangents.col(0) += db * tangent;
      point.curvatures.col(0) += ddb * tangent;
    };
    add(rounding->there, rounding->thereByLength);
    add(rounding->here, -rounding->hereByLength);
    point.normal = at(place.face).outward * areaVector<Dim>(point.tangents).normalized();
    point.isRounded = true;
  }
}

template <int Dim>
SurfacePoint<Dim> MasterSurface<Dim>::unroundedAt(const SurfacePlace<Dim>& place) const {
  const Face& face = at(place.face);
  const std::vector<int> functions = face.trace.basis().spanFunctions(place.span);
  SurfacePoint<Dim> point;
  point.place = place;
  for (const int a : functions) point.nodes.push_back(face.nodes[static_cast<std::size_t>(a)]);
  point.shape = secondOrderShape<P>(face.trace.basis(), face.trace.weights(), place.span, place.xi);
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> points = face.points(Eigen::all, functions);
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

template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> MasterSurface<Dim>::hull(int face, int span) const {
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
  const Eigen::RowVectorXd weights = weighted.colwise().sum();
  if (!(weights.minCoeff() > 0.0)) return {};
  Eigen::Matrix<double, Dim, Eigen::Dynamic> points = at(face).points(Eigen::all, functions) * weighted;
  points.array().rowwise() /= weights.array();
  if (at(face).roundings.empty()) return points;
  for (const auto& rounding : at(face).roundings[static_cast<std::size_t>(span)]) {
    // What is rounded is within ¼ (y'(0⁺) - y'(0⁻)) of the span.
    if (!rounding) continue;
    const Eigen::Vector<double, Dim> jump =
        rounding->thereByLength * unroundedAt(rounding->there).tangents.col(0) -
        rounding->hereByLength * unroundedAt(rounding->here).tangents.col(0);
    const Eigen::Index count = points.cols();
    points.conservativeResize(Eigen::NoChange, 2 * count);
    points.rightCols(count) = points.leftCols(count).colwise() + 0.25 * jump;
  }
  return points;
}

template struct Foot<2>;
template struct Foot<3>;
template class MasterSurface<2>;
template class MasterSurface<3>;

}  // namespace burnish
