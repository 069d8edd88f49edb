#include "engine/nurbs/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline nurbs {
namespace {

/// Bernstein coefficients (rows) of degree p raised to degree q.
Eigen::MatrixXd elevatedBernstein(Eigen::MatrixXd coefficients, Eigen::Index q) {
  for (Eigen::Index p = coefficients.rows() - 1; p < q; ++p) {
    Eigen::MatrixXd raised(p + 2, coefficients.cols());
    raised.row(0) = coefficients.row(0);
    raised.row(p + 1) = coefficients.row(p);
    for (Eigen::Index i = 1; i <= p; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(p + 1);
      raised.row(i) = s * coefficients.row(i - 1) + (1.0 - s) * coefficients.row(i);
    }
    coefficients = std::move(raised);
  }
  return coefficients;
}

/// Blossom of polynomials in Bernstein form on [a, b] (one per column) at as many arguments as their degree.
Eigen::RowVectorXd blossom(Eigen::MatrixXd coefficients, double a, double b, const double* arguments) {
  for (Eigen::Index level = coefficients.rows() - 1; level >= 1; --level) {
    const double s = (*arguments++ - a) / (b - a);
    for (Eigen::Index i = 0; i < level; ++i)
      coefficients.row(i) = (1.0 - s) * coefficients.row(i) + s * coefficients.row(i + 1);
  }
  return coefficients.row(0);
}

int multiplicity(const KnotVector& knots, double value) {
  return static_cast<int>(std::count(knots.knots().begin(), knots.knots().end(), value));
}

void requireNested(const KnotVector& coarse, const KnotVector& fine) {
  const int raise = fine.degree() - coarse.degree();
  if (raise < 0)
    throw Error(fmt::format("refinement: degree {} cannot be lowered to {}", coarse.degree(), fine.degree()));
  if (coarse.breakpoints().front() != fine.breakpoints().front() ||
      coarse.breakpoints().back() != fine.breakpoints().back())
    throw Error("refinement: the knot vectors do not cover the same interval");
  for (const double x : coarse.breakpoints())
    if (multiplicity(fine, x) < multiplicity(coarse, x) + raise)
      throw Error(
          fmt::format("refinement: the finer knot vector is smoother than the coarse one at knot {}", x));
}

/// The breakpoint that a place inside the domain means, or the place itself.
double snapped(const KnotVector& knots, double place) {
  constexpr double kClose = 1e-3;
  const auto& breakpoints = knots.breakpoints();
  const auto end = std::upper_bound(breakpoints.begin(), breakpoints.end() - 1, place);
  const double a = *(end - 1), b = *end;
  if (place - a < kClose * (b - a)) return a;
  return b - place < kClose * (b - a) ? b : place;
}

}  // namespace

Eigen::MatrixXd refinementMatrix(const KnotVector& coarse, const KnotVector& fine) {
  requireNested(coarse, fine);
  const auto basis = UnivariateBasis::bspline(coarse);
  const int q = fine.degree();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(fine.numFunctions(), coarse.numFunctions());
  for (int i = 0; i < fine.numFunctions(); ++i) {
    // Any non-empty span in the function's support gives its coefficient; the one around the Greville
    // abscissa extrapolates least.
    const double* knots = fine.knots().data() + i;
    const double x = std::clamp(fine.greville(i), knots[0], knots[q + 1]);
    int span = basis.findSpan(x);
    while (basis.spanBegin(span) >= knots[q + 1]) --span;
    const Eigen::MatrixXd bezier = elevatedBernstein(basis.extraction(span).transpose(), q);
    T.block(i, basis.firstFunction(span), 1, coarse.degree() + 1) =
        blossom(bezier, basis.spanBegin(span), basis.spanEnd(span), knots + 1);
  }
  return T;
}

Eigen::MatrixXd appliedAlong(const Eigen::MatrixXd& values, const Eigen::MatrixXd& T, Eigen::Index stride) {
  const Eigen::Index n = T.cols(), m = T.rows(), blocks = values.rows() / (n * stride);
  Eigen::MatrixXd result(blocks * m * stride, values.cols());
  for (Eigen::Index b = 0; b < blocks; ++b)
    for (Eigen::Index s = 0; s < stride; ++s) {
      const Eigen::MatrixXd line = values(Eigen::seqN(b * n * stride + s, n, stride), Eigen::all);
      result(Eigen::seqN(b * m * stride + s, m, stride), Eigen::all) = T * line;
    }
  return result;
}

KnotVector withKnots(const KnotVector& knots, const std::vector<double>& added) {
  std::vector<double> all = knots.knots();
  all.insert(all.end(), added.begin(), added.end());
  std::sort(all.begin(), all.end());
  return {knots.degree(), std::move(all)};
}

KnotVector elevated(const KnotVector& knots, int times) {
  std::vector<double> all = knots.knots();
  for (int k = 0; k < times; ++k)
    all.insert(all.end(), knots.breakpoints().begin(), knots.breakpoints().end());
  std::sort(all.begin(), all.end());
  return {knots.degree() + times, std::move(all)};
}

KnotVector divided(const KnotVector& knots, const std::vector<double>& fractions) {
  std::vector<double> added;
  const auto& breakpoints = knots.breakpoints();
  for (std::size_t e = 0; e + 1 < breakpoints.size(); ++e)
    for (const double s : fractions)
      added.push_back(breakpoints[e] + s * (breakpoints[e + 1] - breakpoints[e]));
  return withKnots(knots, added);
}

KnotVector creased(const KnotVector& knots, const std::vector<double>& places) {
  KnotVector result = knots;
  const double begin = knots.breakpoints().front(), end = knots.breakpoints().back();
  for (const double s : places) {
    const double place = snapped(result, begin + s * (end - begin));
    const int missing = std::max(knots.degree() - multiplicity(result, place), 0);
    result = withKnots(result, std::vector<double>(static_cast<std::size_t>(missing), place));
  }
  return result;
}

template <int P, int S>
Patch<P, S> refined(const Patch<P, S>& patch, const std::vector<KnotVector>& target) {
  if (target.size() != static_cast<std::size_t>(P))
    throw Error(fmt::format("refinement: {} knot vectors given, {} needed", target.size(), P));
  Eigen::MatrixXd homogeneous(patch.points().cols(), S + 1);
  homogeneous.leftCols(S) = (patch.points() * patch.weights().asDiagonal()).transpose();
  homogeneous.col(S) = patch.weights();

  std::vector<UnivariateBasis> directions;
  Eigen::Index stride = 1;
  for (int d = 0; d < P; ++d) {
    const auto& old = patch.basis().direction(d);
    if (old.family() != BasisFamily::BSpline)
      throw Error("refinement: only B-spline directions can be refined");
    const auto& knots = target[static_cast<std::size_t>(d)];
    const Eigen::MatrixXd T = refinementMatrix(KnotVector(old.degree(), old.knots()), knots);
    homogeneous = appliedAlong(homogeneous, T, stride);
    stride *= T.rows();
    directions.push_back(UnivariateBasis::bspline(knots));
  }
  const Eigen::VectorXd weights = homogeneous.col(S);
  Eigen::MatrixXd points = homogeneous.leftCols(S).transpose() * weights.cwiseInverse().asDiagonal();
  return {TensorBasis<P>(std::move(directions)), std::move(points), weights};
}

template <int P, int S>
Patch<P, S> lagrangeInterpolant(const Patch<P, S>& patch, int degree,
                                const std::vector<std::vector<double>>& breakpoints) {
  std::vector<UnivariateBasis> directions;
  for (const auto& list : breakpoints) directions.push_back(UnivariateBasis::lagrange(degree, list));
  TensorBasis<P> basis(std::move(directions));
  Eigen::MatrixXd points(S, basis.numFunctions());
  for (int a = 0; a < basis.numFunctions(); ++a) points.col(a) = patch.position(basis.anchor(a));
  const int n = basis.numFunctions();
  return {std::move(basis), std::move(points), Eigen::VectorXd::Ones(n)};
}

template Patch<2, 2> refined(const Patch<2, 2>&, const std::vector<KnotVector>&);
template Patch<3, 3> refined(const Patch<3, 3>&, const std::vector<KnotVector>&);
template Patch<1, 2> refined(const Patch<1, 2>&, const std::vector<KnotVector>&);
template Patch<1, 3> refined(const Patch<1, 3>&, const std::vector<KnotVector>&);
template Patch<2, 2> lagrangeInterpolant(const Patch<2, 2>&, int, const std::vector<std::vector<double>>&);
template Patch<3, 3> lagrangeInterpolant(const Patch<3, 3>&, int, const std::vector<std::vector<double>>&);

}  // namespace burnish::inline nurbs
