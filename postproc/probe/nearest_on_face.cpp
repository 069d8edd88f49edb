#include "postproc/probe/nearest_on_face.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "engine/nurbs/second_order_shape.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {
namespace {

constexpr int kFewestStarts = 20;  // per direction of the face
constexpr int kMostSteps = 100, kMostHalvings = 40;
constexpr double kStill = 1e-14;  // of the size of the face: a step that changes nothing
constexpr double kFoot = 1e-9;    // likewise: how far from normal to the face a way to it may be

}  // namespace

/// The face at some parameters as seen from a position.
template <int Dim>
struct NearestOnFace<Dim>::Place {
  static constexpr int kSecond = Dim * (Dim - 1) / 2;

  Parameter xi;
  Point point, way;                            ///< from the point to the position
  Eigen::Matrix<double, Dim, Dim - 1> slopes;  ///< by the parameters
  Eigen::Matrix<double, Dim, kSecond> bends;   ///< second derivatives, see `secondDerivative`
};

template <int Dim>
NearestOnFace<Dim>::NearestOnFace(Patch<Dim - 1, Dim> face) : face_(std::move(face)) {
  std::array<std::vector<double>, Dim - 1> shares;
  Eigen::Index count = 1;
  for (int d = 0; d < Dim - 1; ++d) {
    const UnivariateBasis& basis = face_.basis().direction(d);
    std::vector<double>& own = shares[static_cast<std::size_t>(d)];
    own = subdividedSpans(basis, std::max(2, 1 + kFewestStarts / basis.numSpans()));
    low_(d) = own.front();
    high_(d) = own.back();
    count *= std::ssize(own);
  }
  starts_.resize(Eigen::NoChange, count);
  startPoints_.resize(Eigen::NoChange, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    auto rest = static_cast<std::size_t>(k);
    for (std::size_t d = 0; d < shares.size(); rest /= shares[d].size(), ++d)
      starts_(static_cast<Eigen::Index>(d), k) = shares[d][rest % shares[d].size()];
    startPoints_.col(k) = face_.position(starts_.col(k));
    box_.extend(Point(startPoints_.col(k)));
  }
}

template <int Dim>
typename NearestOnFace<Dim>::Found NearestOnFace<Dim>::operator()(const Point& position) const {
  Eigen::Index nearest = 0;
  (startPoints_.colwise() - position).colwise().squaredNorm().minCoeff(&nearest);
  const double size = box_.sizes().maxCoeff(), still = kStill * size;
  Place best = placeAt(starts_.col(nearest), position);
  for (int k = 0; k < kMostSteps; ++k) {
    const double distance = best.way.norm(), rounding = kStill * std::max(size, distance);
    Parameter change = step(best);
    Place next = placeAt(clamped(best.xi + change), position);
    for (int half = 0; half < kMostHalvings && next.way.norm() > distance + rounding; ++half) {
      change *= 0.5;
      next = placeAt(clamped(best.xi + change), position);
    }
    if (next.way.norm() > distance + rounding) break;
    const double moved = (best.slopes * (next.xi - best.xi)).norm();
    best = std::move(next);
    if (moved <= still) break;
  }
  const double along = (best.slopes * best.slopes.completeOrthogonalDecomposition().solve(best.way)).norm();
  const bool isFoot = along <= kFoot * size;
  Found found{best.xi, best.point, isFoot, isFoot ? 0.0 : along / best.way.norm()};
  for (int d = 0; d < Dim - 1; ++d)
    found.ends[static_cast<std::size_t>(d)] =
        (best.xi(d) == high_(d) ? 1 : 0) - (best.xi(d) == low_(d) ? 1 : 0);
  return found;
}

template <int Dim>
typename NearestOnFace<Dim>::Place NearestOnFace<Dim>::placeAt(const Parameter& xi,
                                                               const Point& position) const {
  const int span = face_.findSpan(xi);
  const auto shape = secondOrderShape<Dim - 1>(face_.basis(), face_.weights(), span, xi);
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> points =
      face_.points()(Eigen::all, face_.basis().spanFunctions(span));
  const Point point = points * shape.R;
  return {xi, point, position - point, points * shape.dR, points * shape.ddR};
}

/// Of Newton's method for the square of the distance; where that is not convex of Gauss and Newton, with the least step
/// where the slopes vanish. Parameters at an end beyond which it would lead stay.
template <int Dim>
typename NearestOnFace<Dim>::Parameter NearestOnFace<Dim>::step(const Place& place) const {
  const Parameter downhill = place.slopes.transpose() * place.way;
  std::vector<int> free;
  for (int d = 0; d < Dim - 1; ++d)
    if ((place.xi(d) > low_(d) || downhill(d) > 0.0) && (place.xi(d) < high_(d) || downhill(d) < 0.0))
      free.push_back(d);
  Parameter change = Parameter::Zero();
  if (free.empty()) return change;
  Eigen::Matrix<double, Dim - 1, Dim - 1> curvature = place.slopes.transpose() * place.slopes;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      curvature(a, b) -= place.way.dot(place.bends.col(secondDerivative(a, b)));
  const Eigen::LLT<Eigen::MatrixXd> newton(Eigen::MatrixXd(curvature(free, free)));
  change(free) = newton.info() == Eigen::Success
                     ? Eigen::VectorXd(newton.solve(downhill(free)))
                     : Eigen::VectorXd(Eigen::MatrixXd(place.slopes(Eigen::all, free))
                                           .completeOrthogonalDecomposition()
                                           .solve(place.way));
  return change;
}

template <int Dim>
typename NearestOnFace<Dim>::Parameter NearestOnFace<Dim>::clamped(const Parameter& xi) const {
  return xi.cwiseMax(low_).cwiseMin(high_);
}

template class NearestOnFace<2>;
template class NearestOnFace<3>;

}  // namespace burnish
