#include "engine/rezoning/curve_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/nurbs/quadrature.h"

namespace burnish::inline rezoning {

FittedCurve fitCurve(const ArcLengthCurve& curve, const UnivariateBasis& basis) {
  const int pointsPerSpan = 2 * basis.degree() + 2;
  const QuadratureRule rule = gaussLegendre(pointsPerSpan);
  const Eigen::Index numPoints = static_cast<Eigen::Index>(pointsPerSpan) * basis.numSpans();
  const Eigen::Index n = basis.numFunctions();
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(numPoints, n);
  Eigen::MatrixXd places(numPoints, 2);
  Eigen::VectorXd roots(numPoints);  // of the weights
  std::vector<Eigen::Vector2d> normals;
  for (int e = 0; e < basis.numSpans(); ++e)
    for (int q = 0; q < pointsPerSpan; ++q) {
      const Eigen::Index row = static_cast<Eigen::Index>(e) * pointsPerSpan + q;
      const double xi = std::lerp(basis.spanBegin(e), basis.spanEnd(e), rule.points(q));
      N.row(row).segment(basis.firstFunction(e), basis.degree() + 1) = basis.evaluate(e, xi, 0).col(0);
      roots(row) = std::sqrt(rule.weights(q) * (basis.spanEnd(e) - basis.spanBegin(e)));
      places.row(row) = curve.at(xi * curve.length());
      const Eigen::Vector2d tangent = curve.tangentAt(xi * curve.length());
      normals.emplace_back(-tangent.y(), tangent.x());
    }

  FittedCurve fit{Eigen::MatrixXd(2, n), 0.0};
  fit.points.col(0) = curve.at(0.0);
  fit.points.col(n - 1) = curve.at(curve.length());
  if (n > 2) {
    const Eigen::MatrixXd rest =
        places - N.col(0) * fit.points.col(0).transpose() - N.col(n - 1) * fit.points.col(n - 1).transpose();
    fit.points.middleCols(1, n - 2) = (roots.asDiagonal() * N.middleCols(1, n - 2))
                                          .householderQr()
                                          .solve(roots.asDiagonal() * rest)
                                          .transpose();
  }
  const Eigen::MatrixXd deviation = N * fit.points.transpose() - places;
  for (Eigen::Index k = 0; k < numPoints; ++k)
    fit.normalError =
        std::max(fit.normalError, std::abs(deviation.row(k).dot(normals[static_cast<std::size_t>(k)])));
  return fit;
}

}  // namespace burnish::inline rezoning
