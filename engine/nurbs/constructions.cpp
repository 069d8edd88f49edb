#include "engine/nurbs/constructions.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"

namespace burnish::inline nurbs {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;

KnotVector knotsOf(const UnivariateBasis& direction) {
  return {direction.degree(), direction.knots()};
}

/// The tensor product of a profile's basis and one more direction.
template <int P>
TensorBasis<P + 1> extended(const Patch<P, 3>& profile, UnivariateBasis more) {
  std::vector<UnivariateBasis> directions;
  for (int d = 0; d < P; ++d) directions.push_back(profile.basis().direction(d));
  directions.push_back(std::move(more));
  return TensorBasis<P + 1>(std::move(directions));
}

/// A path at increasing parameters: places, and rotations from the first of them that never turn about the tangent.
struct Frames {
  std::vector<Vector3d> places;
  std::vector<Matrix3d> rotations;
};

class Path {
 public:
  explicit Path(const Patch<1, 3>& curve) : curve_(curve), basis_(curve.basis().direction(0)) {
    const Eigen::MatrixXd& points = curve.points();
    size_ = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
    const auto& knots = basis_.knots();
    const auto& breakpoints = basis_.breakpoints();
    for (std::size_t k = 1; k + 1 < breakpoints.size(); ++k)
      if (std::count(knots.begin(), knots.end(), breakpoints[k]) >= basis_.degree())
        requireNoCorner(breakpoints[k]);
  }

  double begin() const { return basis_.breakpoints().front(); }
  double end() const { return basis_.breakpoints().back(); }
  double size() const { return size_; }
  Vector3d at(double t) const { return curve_.position(parameter(t)); }

  Vector3d tangent(double t) const {
    const Vector3d d = curve_.jacobian(parameter(t));
    if (!(d.norm() * (end() - begin()) > kRounding * size_))
      throw Error(fmt::format(
          "the path stands still at its parameter {:.4g}; allowed: a path that goes on everywhere", t));
    return d.normalized();
  }

  bool isStraight() const {
    const Vector3d first = tangent(begin());
    const Eigen::Matrix3Xd points = curve_.points();
    for (const auto& point : points.colwise())
      if (first.cross(point - points.col(0)).norm() > kRounding * size_) return false;
    return true;
  }

  Frames frames(const std::vector<double>& parameters) const {
    constexpr int kSteps = 64;  // between two of them: the error of a step is of fifth order
    Frames frames;
    Matrix3d first;
    Vector3d x = at(parameters.front()), t = tangent(parameters.front()), r = t.unitOrthogonal();
    const auto frame = [&] {
      Matrix3d columns;
      columns << r, t.cross(r), t;
      return columns;
    };
    first = frame();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      for (int step = 1; i > 0 && step <= kSteps; ++step) {
        const double parameter =
            std::lerp(parameters[i - 1], parameters[i], static_cast<double>(step) / kSteps);
        const Vector3d next = at(parameter), nextTangent = tangent(parameter), chord = next - x;
        const Vector3d rLeft = r - 2.0 / chord.squaredNorm() * chord.dot(r) * chord;
        const Vector3d tLeft = t - 2.0 / chord.squaredNorm() * chord.dot(t) * chord;
        const Vector3d turn = nextTangent - tLeft;
        r = (rLeft - 2.0 / turn.squaredNorm() * turn.dot(rLeft) * turn).normalized();
        x = next;
        t = nextTangent;
      }
      frames.places.push_back(x);
      frames.rotations.push_back(frame() * first.transpose());
    }
    return frames;
  }

 private:
  static Eigen::Matrix<double, 1, 1> parameter(double t) { return Eigen::Matrix<double, 1, 1>(t); }

  void requireNoCorner(double knot) const {
    constexpr double kStraight = 1e-6;
    const double step = 1e-9 * (end() - begin());
    if ((tangent(knot - step) - tangent(knot)).norm() > kStraight)
      throw Error(fmt::format(
          "the path has a corner at its parameter {:.4g}; allowed: a smooth path, or a sweep for each of its parts",
          knot));
  }

  const Patch<1, 3>& curve_;
  const UnivariateBasis& basis_;
  double size_ = 0.0;
};

struct Arc {
  Vector3d center, axis;
  double angle;
};

/// The circle that a path is on.
std::optional<Arc> arcOf(const Path& path) {
  constexpr int kSamples = 48;
  std::vector<Vector3d> places;
  for (int k = 0; k <= kSamples; ++k)
    places.push_back(path.at(std::lerp(path.begin(), path.end(), static_cast<double>(k) / kSamples)));
  const Vector3d a = places[kSamples / 3] - places[0], b = places[2 * kSamples / 3] - places[0],
                 n = a.cross(b);
  if (n.norm() < 1e-6 * a.norm() * b.norm()) return std::nullopt;
  const Vector3d toCenter =
      (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2.0 * n.squaredNorm());
  Arc arc{places[0] + toCenter, n.normalized(), 0.0};
  const double radius = toCenter.norm();
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vector3d r = places[k] - arc.center;
    if (std::abs(r.norm() - radius) > kRounding * path.size() ||
        std::abs(r.dot(arc.axis)) > kRounding * path.size())
      return std::nullopt;
    if (k == 0) continue;
    const Vector3d before = places[k - 1] - arc.center;
    arc.angle += std::atan2(arc.axis.dot(before.cross(r)), before.dot(r));
  }
  return arc;
}

/// The profile on a path without turning: the sum of both, exact for all curves.
template <int P>
Patch<P + 1, 3> translated(const Patch<P, 3>& profile, const Patch<1, 3>& path) {
  const Eigen::Index n = profile.points().cols(), m = path.points().cols();
  Eigen::MatrixXd points(3, n * m);
  Eigen::VectorXd weights(n * m);
  for (Eigen::Index k = 0; k < m; ++k) {
    points.middleCols(n * k, n) = profile.points().colwise() + (path.points().col(k) - path.points().col(0));
    weights.segment(n * k, n) = path.weights()(k) * profile.weights();
  }
  return {extended(profile, path.basis().direction(0)), points, weights};
}

/// Where the control points of a profile are at some frames: one column each, three rows for every frame.
template <int P>
Eigen::MatrixXd carriedPoints(const Patch<P, 3>& profile, const Frames& frames) {
  const Eigen::Index n = profile.points().cols(), m = std::ssize(frames.places);
  const Eigen::MatrixXd arms = profile.points().colwise() - frames.places.front();
  Eigen::MatrixXd points(3 * m, n);
  for (Eigen::Index k = 0; k < m; ++k)
    points.middleRows(3 * k, 3) = (frames.rotations[static_cast<std::size_t>(k)] * arms).colwise() +
                                  frames.places[static_cast<std::size_t>(k)];
  return points;
}

/// Values of all functions at some parameters: one row for each of these.
Eigen::MatrixXd collocation(const UnivariateBasis& basis, const std::vector<double>& parameters) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(std::ssize(parameters), basis.numFunctions());
  for (Eigen::Index i = 0; i < N.rows(); ++i) {
    const double t = parameters[static_cast<std::size_t>(i)];
    const int span = basis.findSpan(t);
    N.block(i, basis.firstFunction(span), 1, basis.degree() + 1) = basis.evaluate(span, t, 0).transpose();
  }
  return N;
}

/// Values at some parameters, as `carriedPoints` gives them, of splines with these coefficients.
Eigen::MatrixXd combined(const Eigen::MatrixXd& N, const Eigen::MatrixXd& coefficients) {
  return appliedAlong(coefficients, N, 3);
}

std::vector<double> equalParts(int parts) {
  std::vector<double> fractions;
  for (int k = 1; k < parts; ++k) fractions.push_back(static_cast<double>(k) / parts);
  return fractions;
}

template <int P>
Patch<P + 1, 3> fitted(const Patch<P, 3>& profile, const Path& path, const KnotVector& coarse,
                       double tolerance) {
  constexpr int kLowestDegree = 3, kMostParts = 256;
  const KnotVector raised = elevated(coarse, std::max(kLowestDegree - coarse.degree(), 0));
  for (int parts = 1; parts <= kMostParts; parts *= 2) {
    const UnivariateBasis basis = UnivariateBasis::bspline(divided(raised, equalParts(parts)));
    std::vector<double> anchors, between;
    for (int a = 0; a < basis.numFunctions(); ++a) anchors.push_back(basis.anchor(a));
    between.push_back(anchors.front());
    for (std::size_t a = 1; a < anchors.size(); ++a)
      between.push_back(std::midpoint(anchors[a - 1], anchors[a]));
    const Eigen::MatrixXd inverse = collocation(basis, anchors).partialPivLu().inverse();
    const Eigen::MatrixXd coefficients = combined(inverse, carriedPoints(profile, path.frames(anchors)));
    const Eigen::MatrixXd off =
        combined(collocation(basis, between), coefficients) - carriedPoints(profile, path.frames(between));
    double farthest = 0.0;
    for (Eigen::Index k = 0; k < std::ssize(between); ++k)
      farthest = std::max(farthest, off.middleRows(3 * k, 3).colwise().norm().maxCoeff());
    if (farthest > tolerance) continue;
    const Eigen::Index n = profile.points().cols(), m = basis.numFunctions();
    Eigen::MatrixXd points(3, n * m);
    for (Eigen::Index k = 0; k < m; ++k) points.middleCols(n * k, n) = coefficients.middleRows(3 * k, 3);
    return {extended(profile, basis), points, profile.weights().replicate(m, 1)};
  }
  throw Error(fmt::format(
      "the sweep is farther than its tolerance {:.3g} from the path even with {} parts of each of its "
      "knot spans; allowed: a larger tolerance, or a smoother path",
      tolerance, kMostParts));
}

/// Knots over [0, 1].
KnotVector normalised(const KnotVector& knots) {
  const double begin = knots.breakpoints().front(), length = knots.breakpoints().back() - begin;
  std::vector<double> all = knots.knots();
  for (double& knot : all) knot = (knot - begin) / length;
  return {knots.degree(), std::move(all)};
}

Patch<1, 3> withKnotVector(const Patch<1, 3>& curve, const KnotVector& knots) {
  return {TensorBasis<1>({UnivariateBasis::bspline(knots)}), curve.points(), curve.weights()};
}

/// Two curves on the coarsest basis that both have.
void share(Patch<1, 3>& a, Patch<1, 3>& b) {
  constexpr double kSame = 1e-9;
  const KnotVector first = normalised(knotsOf(a.basis().direction(0)));
  KnotVector second = normalised(knotsOf(b.basis().direction(0)));
  std::vector<double> moved = second.knots();
  for (double& knot : moved)
    for (const double other : first.breakpoints())
      if (std::abs(knot - other) < kSame) knot = other;
  second = KnotVector(second.degree(), moved);
  a = withKnotVector(a, first);
  b = withKnotVector(b, second);
  const int degree = std::max(first.degree(), second.degree());
  const KnotVector raisedFirst = elevated(first, degree - first.degree());
  const KnotVector raisedSecond = elevated(second, degree - second.degree());
  std::vector<double> all;
  std::set_union(raisedFirst.knots().begin(), raisedFirst.knots().end(), raisedSecond.knots().begin(),
                 raisedSecond.knots().end(), std::back_inserter(all));
  const KnotVector common(degree, std::move(all));
  a = refined(a, {common});
  b = refined(b, {common});
}

/// Homogeneous coordinates of the control points, the weights of the ends being 1.
Eigen::Matrix4Xd homogeneous(const Patch<1, 3>& curve) {
  const double scale = 1.0 / curve.weights()(0);
  Eigen::Matrix4Xd net(4, curve.points().cols());
  net << curve.points(), Eigen::RowVectorXd::Ones(net.cols());
  return net * (scale * curve.weights()).asDiagonal();
}

}  // namespace

template <int P>
Patch<P + 1, 3> extruded(const Patch<P, 3>& profile, const Vector3d& vector) {
  const Eigen::Index n = profile.points().cols();
  Eigen::MatrixXd points(3, 2 * n);
  points << profile.points(), profile.points().colwise() + vector;
  return {extended(profile, UnivariateBasis::bspline(KnotVector::uniform(1, 1))), points,
          profile.weights().replicate(2, 1)};
}

template <int P>
Patch<P + 1, 3> revolved(const Patch<P, 3>& profile, const Vector3d& center, const Vector3d& axis,
                         double angle) {
  if (!(angle > 0.0) || angle > 2.0 * std::numbers::pi + kRounding || !(axis.norm() > 0.0))
    throw Error(fmt::format(
        "revolution: angle of {} rad about an axis of length {}; more than 0, at most 2 pi, and a "
        "direction are needed",
        angle, axis.norm()));
  const int arcs = std::max(static_cast<int>(std::ceil(angle / (std::numbers::pi / 2) - 1e-9)), 1);
  const double half = 0.5 * angle / arcs;
  std::vector<double> knots{0.0, 0.0, 0.0};
  for (int k = 1; k < arcs; ++k) knots.insert(knots.end(), 2, static_cast<double>(k) / arcs);
  knots.insert(knots.end(), 3, 1.0);
  const Vector3d direction = axis.normalized();
  const Eigen::MatrixXd arms = profile.points().colwise() - center;
  const Eigen::MatrixXd along = direction * (direction.transpose() * arms);
  const Eigen::MatrixXd across = arms - along;
  const Eigen::Index n = arms.cols();
  Eigen::MatrixXd points(3, n * (2 * arcs + 1));
  Eigen::VectorXd weights(points.cols());
  for (int k = 0; k <= 2 * arcs; ++k) {
    const double weight = k % 2 == 0 ? 1.0 : std::cos(half);
    const Matrix3d turn = Eigen::AngleAxisd(k * half, direction).toRotationMatrix();
    points.middleCols(n * k, n) = (along + turn * across / weight).colwise() + center;
    weights.segment(n * k, n) = weight * profile.weights();
  }
  points.leftCols(n) = profile.points();
  return {extended(profile, UnivariateBasis::bspline(KnotVector(2, std::move(knots)))), points, weights};
}

template <int P>
Patch<P + 1, 3> sweptAlong(const Patch<P, 3>& profile, const Patch<1, 3>& path, double tolerance) {
  const Path along(path);
  if (along.isStraight()) return translated(profile, path);
  if (const auto arc = arcOf(along)) return revolved(profile, arc->center, arc->axis, arc->angle);
  return fitted(profile, along, knotsOf(path.basis().direction(0)), tolerance);
}

Patch<2, 3> coonsPatch(const Patch<1, 3>& bottom, const Patch<1, 3>& right, const Patch<1, 3>& top,
                       const Patch<1, 3>& left) {
  Patch<1, 3> south = bottom, north = top, west = left, east = right;
  share(south, north);
  share(west, east);
  const Eigen::Matrix4Xd S = homogeneous(south), N = homogeneous(north), W = homogeneous(west),
                         E = homogeneous(east);
  const UnivariateBasis u = south.basis().direction(0), v = west.basis().direction(0);
  const Eigen::Index n = S.cols(), m = W.cols();
  Eigen::MatrixXd points(3, n * m);
  Eigen::VectorXd weights(n * m);
  // The coefficients of u and v are their Greville abscissae.
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const double s = u.anchor(static_cast<int>(i)), t = v.anchor(static_cast<int>(j));
      const Eigen::Vector4d corners = (1.0 - t) * ((1.0 - s) * S.col(0) + s * S.col(n - 1)) +
                                      t * ((1.0 - s) * N.col(0) + s * N.col(n - 1));
      Eigen::Vector4d point =
          (1.0 - t) * S.col(i) + t * N.col(i) + (1.0 - s) * W.col(j) + s * E.col(j) - corners;
      if (!(point(3) > 0.0))
        throw Error(fmt::format(
            "the curves give the Coons patch a weight of {:.3g} inside, which must be positive; allowed: "
            "arcs of at most a right angle, or several patches",
            point(3)));
      points.col(i + n * j) = point.head<3>() / point(3);
      weights(i + n * j) = point(3);
    }
  return {TensorBasis<2>({u, v}), std::move(points), std::move(weights)};
}

double lengthOf(const Patch<1, 3>& curve) {
  constexpr int kSamples = 1000;
  const UnivariateBasis& basis = curve.basis().direction(0);
  const auto at = [&](int k) {
    return curve.position(Eigen::Matrix<double, 1, 1>(basis.parameterAt(static_cast<double>(k) / kSamples)));
  };
  double length = 0.0;
  for (int k = 0; k < kSamples; ++k) length += (at(k + 1) - at(k)).norm();
  return length;
}

Patch<2> inPlane(const Patch<2, 3>& face) {
  return {face.basis(), face.points().topRows<2>(), face.weights()};
}

template Patch<2, 3> extruded(const Patch<1, 3>&, const Vector3d&);
template Patch<3, 3> extruded(const Patch<2, 3>&, const Vector3d&);
template Patch<2, 3> revolved(const Patch<1, 3>&, const Vector3d&, const Vector3d&, double);
template Patch<3, 3> revolved(const Patch<2, 3>&, const Vector3d&, const Vector3d&, double);
template Patch<2, 3> sweptAlong(const Patch<1, 3>&, const Patch<1, 3>&, double);
template Patch<3, 3> sweptAlong(const Patch<2, 3>&, const Patch<1, 3>&, double);

}  // namespace burnish::inline nurbs
