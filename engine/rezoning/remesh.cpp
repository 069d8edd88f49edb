#include "engine/rezoning/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/collocation.h"
#include "engine/rezoning/curve_fit.h"
#include "engine/rezoning/mesh_energy.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline rezoning {
namespace {

/// Quality from which a transfinite mesh is used as it is.
constexpr double kGoodQuality = 0.3;

/// Places at which a face's curvature is looked at, and from which parts of its length.
constexpr int kCurvatures = 401;
constexpr double kCurvatureShare = 0.005;

/// Sizes of knot spans along a curve within which it does not turn by more than an angle.
std::vector<double> sizeLimits(const ArcLengthCurve& curve, double turn) {
  if (turn == 0.0) return {};
  std::vector<double> limits = curve.curvatures(kCurvatures, kCurvatureShare * curve.length());
  for (double& limit : limits) limit = limit * curve.length() > turn ? turn / limit : curve.length();
  return limits;
}

UnivariateBasis basisLike(const UnivariateBasis& old, const std::vector<double>& breakpoints) {
  const int degree = old.degree();
  if (old.family() == BasisFamily::Lagrange) return UnivariateBasis::lagrange(degree, breakpoints);
  std::vector<double> knots(static_cast<std::size_t>(degree), breakpoints.front());
  knots.insert(knots.end(), breakpoints.begin(), breakpoints.end());
  knots.insert(knots.end(), static_cast<std::size_t>(degree), breakpoints.back());
  return UnivariateBasis::bspline(KnotVector(degree, std::move(knots)));
}

std::vector<double> reversed(const std::vector<double>& breakpoints) {
  std::vector<double> result;
  for (auto b = breakpoints.rbegin(); b != breakpoints.rend(); ++b) result.push_back(1.0 - *b);
  return result;
}

/// A mesh in the making: the basis and the four boundaries.
struct Frame {
  TensorBasis<2> basis;
  std::array<FittedCurve, 4> boundaries;
};

double anchorShare(const UnivariateBasis& basis, int function) {
  return basis.shareOf(basis.anchor(function));
}

void setBoundary(const TensorBasis<2>& basis, FaceId face, const FittedCurve& curve,
                 Eigen::MatrixXd& points) {
  points(Eigen::all, faceFunctions(basis, face)) = curve.points;
}

/// Bilinearly blended boundaries; the anchors are the coefficients of the parameters themselves.
Patch<2> transfinite(const Frame& frame) {
  const auto& basis = frame.basis;
  Eigen::MatrixXd points(2, basis.numFunctions());
  const auto& [left, right, bottom, top] = frame.boundaries;
  const int n = basis.direction(0).numFunctions(), m = basis.direction(1).numFunctions();
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = anchorShare(basis.direction(0), i), v = anchorShare(basis.direction(1), j);
      points.col(basis.functionNumber({i, j})) =
          (1.0 - u) * left.points.col(j) + u * right.points.col(j) + (1.0 - v) * bottom.points.col(i) +
          v * top.points.col(i) - (1.0 - u) * (1.0 - v) * bottom.points.col(0) -
          u * (1.0 - v) * bottom.points.col(n - 1) - (1.0 - u) * v * top.points.col(0) -
          u * v * top.points.col(n - 1);
    }
  return {basis, std::move(points), Eigen::VectorXd::Ones(basis.numFunctions())};
}

/// The deformed patch with the parameters of its own that have the new shares of arc length on the face and
/// on the first of the two faces beside it.
Patch<2> reparametrised(const Patch<2>& deformed, const Frame& frame,
                        const std::array<ArcLengthCurve, 4>& curves, FaceId face) {
  const auto& basis = frame.basis;
  const int along = 1 - face / 2;
  std::array<std::vector<double>, 2> parameters;
  for (int d = 0; d < 2; ++d) {
    const auto& curve = curves[static_cast<std::size_t>(d == along ? face : 2 * along)];
    for (int a = 0; a < basis.direction(d).numFunctions(); ++a)
      parameters[static_cast<std::size_t>(d)].push_back(
          curve.parameterAt(anchorShare(basis.direction(d), a) * curve.length()));
  }
  const auto n = std::ssize(parameters[0]), m = std::ssize(parameters[1]);
  std::array<Eigen::MatrixXd, 2> values{Eigen::MatrixXd(n, m), Eigen::MatrixXd(n, m)};
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d X = deformed.position(
          {parameters[0][static_cast<std::size_t>(i)], parameters[1][static_cast<std::size_t>(j)]});
      for (std::size_t d = 0; d < 2; ++d) values[d](i, j) = X(static_cast<Eigen::Index>(d));
    }
  const auto collocation = [&](int d) {
    return valuesAtAnchors(basis.direction(d), basis.direction(d)).partialPivLu();
  };
  const auto first = collocation(0), second = collocation(1);
  Eigen::MatrixXd points(2, n * m);
  for (std::size_t d = 0; d < 2; ++d) {
    const Eigen::MatrixXd rows = first.solve(values[d]);
    const Eigen::MatrixXd coefficients = second.solve(rows.transpose()).transpose();
    points.row(static_cast<Eigen::Index>(d)) = coefficients.reshaped().transpose();
  }
  setBoundary(basis, face, frame.boundaries[static_cast<std::size_t>(face)], points);
  return {basis, std::move(points), Eigen::VectorXd::Ones(n * m)};
}

}  // namespace

double meshQuality(const Patch<2>& patch) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  const int points = std::max(patch.basis().direction(0).degree(), patch.basis().direction(1).degree()) + 1;
  for (int span = 0; span < patch.basis().numSpans(); ++span) {
    const Eigen::MatrixXd net = patch.points()(Eigen::all, patch.basis().spanFunctions(span));
    for (const auto& xi : spanRule(patch.basis(), span, points).points) {
      const Eigen::Matrix2d jacobian = net * patch.shape(span, xi).dR;
      smallest = std::min(smallest, jacobian.determinant());
      largest = std::max(largest, jacobian.determinant());
    }
  }
  return largest > 0.0 ? smallest / largest : -1.0;
}

std::optional<Remeshing> remesh(const Patch<2>& deformed, const RemeshOptions& options) {
  const std::array<ArcLengthCurve, 4> curves{
      ArcLengthCurve(tracePatch(deformed, 0)), ArcLengthCurve(tracePatch(deformed, 1)),
      ArcLengthCurve(tracePatch(deformed, 2)), ArcLengthCurve(tracePatch(deformed, 3))};
  const auto across = static_cast<std::size_t>(options.face / 2), along = 1 - across;
  const double length = curves[static_cast<std::size_t>(options.face)].length();
  const double depth = 0.5 * (curves[2 * along].length() + curves[2 * along + 1].length());
  const SpanDistribution distribution =
      distributeSpans(length, options.finest, options.spans[along], {options.mesh.growth, options.rounding},
                      sizeLimits(curves[static_cast<std::size_t>(options.face)], options.mesh.turn));
  std::vector<double> layers =
      distributeLayers(depth, options.mesh.firstLayer * distribution.finest, options.spans[across]);
  if (options.face % 2 == 1) layers = reversed(layers);

  std::vector<UnivariateBasis> directions;
  for (std::size_t d = 0; d < 2; ++d)
    directions.push_back(basisLike(deformed.basis().direction(static_cast<int>(d)),
                                   d == along ? distribution.breakpoints : layers));
  Frame frame{TensorBasis<2>(directions), {}};
  double boundaryError = 0.0;
  for (std::size_t face = 0; face < 4; ++face) {
    frame.boundaries[face] = fitCurve(curves[face], directions[1 - face / 2]);
    boundaryError = std::max(boundaryError, frame.boundaries[face].normalError);
  }

  Patch<2> mesh = transfinite(frame);
  double quality = meshQuality(mesh);
  if (quality < kGoodQuality) {
    Eigen::Vector2d size;
    size(static_cast<Eigen::Index>(along)) = length;
    size(static_cast<Eigen::Index>(across)) = depth;
    std::vector<Patch<2>> starts{reparametrised(deformed, frame, curves, options.face)};
    if (quality > 0.0) starts.push_back(mesh);
    for (const Patch<2>& start : starts) {
      const double before = meshQuality(start);
      if (before > quality) {
        mesh = start;
        quality = before;
      }
      if (!(before > 0.0)) continue;
      const auto better = relaxed(start, size, options.face);
      if (!better) continue;
      if (meshQuality(*better) > quality) {
        mesh = *better;
        quality = meshQuality(*better);
      }
      break;  // the other start relaxes to the same mesh
    }
  }
  if (!(quality > options.mesh.smallestDeterminant)) return std::nullopt;
  return Remeshing{std::move(mesh), boundaryError, quality, distribution.smallest};
}

}  // namespace burnish::inline rezoning
