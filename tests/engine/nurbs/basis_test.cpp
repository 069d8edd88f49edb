#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"
#include "engine/nurbs/quadrature.h"
#include "engine/nurbs/univariate_basis.h"

namespace burnish {
namespace {

/// Uneven spans and a double knot where the degree allows it.
UnivariateBasis basisOf(BasisFamily family, int degree) {
  if (family == BasisFamily::Lagrange) return UnivariateBasis::lagrange(degree, {0.0, 0.2, 0.5, 1.0});
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  knots.push_back(0.2);
  knots.push_back(0.5);
  if (degree > 1) knots.push_back(0.5);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return UnivariateBasis::bspline(KnotVector(degree, knots));
}

class Basis : public testing::TestWithParam<std::tuple<BasisFamily, int>> {
 protected:
  UnivariateBasis basis_ = basisOf(std::get<0>(GetParam()), std::get<1>(GetParam()));
};

TEST_P(Basis, IsAPartitionOfUnityAndReproducesTheParameter) {
  for (int e = 0; e < basis_.numSpans(); ++e)
    for (const double s : {0.0, 0.3, 0.77, 1.0}) {
      const double xi = basis_.spanBegin(e) + s * (basis_.spanEnd(e) - basis_.spanBegin(e));
      const Eigen::MatrixXd N = basis_.evaluate(e, xi, 1);
      EXPECT_NEAR(N.col(0).sum(), 1.0, 1e-13);
      EXPECT_NEAR(N.col(1).sum(), 0.0, 1e-11);
      double parameter = 0.0;
      for (int a = 0; a < N.rows(); ++a) parameter += N(a, 0) * basis_.anchor(basis_.firstFunction(e) + a);
      EXPECT_NEAR(parameter, xi, 1e-13);
    }
}

TEST_P(Basis, DerivativesAgreeWithDifferences) {
  const double h = 1e-5;
  for (int e = 0; e < basis_.numSpans(); ++e) {
    const double xi = 0.4 * basis_.spanBegin(e) + 0.6 * basis_.spanEnd(e);
    const Eigen::MatrixXd N = basis_.evaluate(e, xi, 3);
    const Eigen::MatrixXd forward = basis_.evaluate(e, xi + h, 2), backward = basis_.evaluate(e, xi - h, 2);
    for (int k = 1; k <= 3; ++k) {
      const Eigen::VectorXd difference = (forward.col(k - 1) - backward.col(k - 1)) / (2.0 * h);
      EXPECT_LT((difference - N.col(k)).norm(), 1e-6 * (1.0 + N.col(k).norm())) << "derivative " << k;
    }
  }
}

TEST_P(Basis, IsAsSmoothAcrossABreakpointAsItsKnotsSay) {
  const int degree = basis_.degree();
  // The breakpoint 0.2 is a simple knot; functions e … e+p live left of it, e+1 … right of it.
  const int smoothness = basis_.family() == BasisFamily::Lagrange ? 0 : degree - 1;
  const Eigen::MatrixXd left = basis_.evaluate(0, 0.2, degree), right = basis_.evaluate(1, 0.2, degree);
  Eigen::MatrixXd jump = Eigen::MatrixXd::Zero(basis_.numFunctions(), degree + 1);
  jump.middleRows(basis_.firstFunction(0), degree + 1) += left;
  jump.middleRows(basis_.firstFunction(1), degree + 1) -= right;
  for (int k = 0; k <= degree; ++k) {
    const double size = jump.col(k).norm() / (1.0 + left.col(k).norm());
    if (k <= smoothness)
      EXPECT_LT(size, 1e-12) << "derivative " << k;
    else
      EXPECT_GT(size, 1e-3) << "derivative " << k;
  }
}

TEST(UnivariateBasis, SharesOfTheRangeEndExactlyAtItsEnds) {
  const auto basis = UnivariateBasis::lagrange(1, {-0.1, 0.25, 0.7});
  EXPECT_EQ(basis.parameterAt(0.0), -0.1);
  EXPECT_EQ(basis.parameterAt(1.0), 0.7);
  EXPECT_NEAR(basis.parameterAt(0.25), 0.1, 1e-15);
  EXPECT_EQ(basis.shareOf(-0.1), 0.0);
  EXPECT_EQ(basis.shareOf(0.7), 1.0);
  EXPECT_NEAR(basis.shareOf(0.1), 0.25, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(All, Basis,
                         testing::Combine(testing::Values(BasisFamily::BSpline, BasisFamily::Lagrange),
                                          testing::Range(1, 6)));

TEST(Lagrange, IsOneAtItsOwnNodeAndZeroAtTheOthers) {
  const auto basis = UnivariateBasis::lagrange(4, {0.0, 1.0, 3.0});
  for (int i = 0; i < basis.numFunctions(); ++i) {
    const int e = basis.findSpan(basis.anchor(i));
    const Eigen::VectorXd N = basis.evaluate(e, basis.anchor(i), 0).col(0);
    for (int a = 0; a <= 4; ++a) EXPECT_NEAR(N(a), basis.firstFunction(e) + a == i ? 1.0 : 0.0, 1e-13);
  }
}

TEST(Lagrange, OfDegreeOneIsTheBSplineOfDegreeOneBitForBit) {
  const auto lagrange = UnivariateBasis::lagrange(1, {0.0, 0.3, 1.0});
  const auto bspline = UnivariateBasis::bspline(KnotVector(1, {0.0, 0.0, 0.3, 1.0, 1.0}));
  for (const double xi : {0.0, 0.1, 0.299, 0.3, 0.7, 1.0}) {
    const int e = lagrange.findSpan(xi);
    ASSERT_EQ(e, bspline.findSpan(xi));
    EXPECT_EQ(lagrange.evaluate(e, xi, 1), bspline.evaluate(e, xi, 1));
  }
}

TEST(Lagrange, RefusesBreakpointsThatDoNotIncrease) {
  EXPECT_THROW(UnivariateBasis::lagrange(2, {0.0, 0.5, 0.5}), Error);
  EXPECT_THROW(UnivariateBasis::lagrange(0, {0.0, 0.5}), Error);
}

TEST(GaussLegendre, IsExactUpToDegreeTwoNMinusOne) {
  for (int n = 1; n <= 12; ++n) {
    const QuadratureRule rule = gaussLegendre(n);
    for (int k = 0; k <= 2 * n - 1; ++k)
      EXPECT_NEAR(rule.weights.dot(rule.points.array().pow(k).matrix()), 1.0 / (k + 1), 1e-14)
          << n << " " << k;
  }
}

}  // namespace
}  // namespace burnish
