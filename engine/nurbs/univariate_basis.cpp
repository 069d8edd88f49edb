#include "engine/nurbs/univariate_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline nurbs {
namespace {

/// Bernstein coefficients of the p+1 B-splines on knot interval i: their blossoms at (a, …, a, b, …, b),
/// evaluated by the de Boor recurrence with one argument per level (row: function, column: Bernstein
/// polynomial).
Eigen::MatrixXd bsplineExtraction(const std::vector<double>& knots, int p, int i) {
  const auto knot = [&](int k) { return knots[static_cast<std::size_t>(k)]; };
  const double a = knot(i), b = knot(i + 1);
  Eigen::MatrixXd C(p + 1, p + 1);
  for (int j = 0; j <= p; ++j) {
    Eigen::VectorXd N = Eigen::VectorXd::Zero(p + 1);
    N(0) = 1.0;
    for (int k = 1; k <= p; ++k) {
      const double x = k <= p - j ? a : b;
      double saved = 0.0;
      for (int r = 0; r < k; ++r) {
        const double right = knot(i + r + 1), left = knot(i + r + 1 - k);
        const double term = N(r) / (right - left);
        N(r) = saved + (right - x) * term;
        saved = (x - left) * term;
      }
      N(k) = saved;
    }
    C.col(j) = N;
  }
  return C;
}

/// Greville abscissa of function i; the middle of the span for degree 0.
double splineAnchor(const std::vector<double>& knots, int degree, int i) {
  const auto knot = knots.begin() + i;
  if (degree == 0) return 0.5 * (knot[0] + knot[1]);
  return std::accumulate(knot + 1, knot + 1 + degree, 0.0) / degree;
}

/// Lagrange polynomials with equally spaced nodes in Bernstein form: the inverse of the Bernstein collocation
/// matrix.
Eigen::MatrixXd lagrangeExtraction(int p) {
  Eigen::MatrixXd nodal(p + 1, p + 1);  // (j, k): Bernstein polynomial j at node k
  for (int k = 0; k <= p; ++k) nodal.col(k) = bernstein(p, 0.0, 1.0, static_cast<double>(k) / p, 0).col(0);
  return nodal.fullPivLu().inverse();
}

}  // namespace

UnivariateBasis UnivariateBasis::bspline(const KnotVector& knots) {
  UnivariateBasis basis;
  basis.family_ = BasisFamily::BSpline;
  basis.degree_ = knots.degree();
  basis.knots_ = knots.knots();
  basis.breakpoints_ = knots.breakpoints();
  basis.makeFunctions();
  return basis;
}

void UnivariateBasis::makeFunctions() {
  numFunctions_ = static_cast<int>(knots_.size()) - degree_ - 1;
  for (int i = degree_; i < numFunctions_; ++i) {
    const auto knot = knots_.begin() + i;
    if (!(knot[1] > knot[0])) continue;
    firstFunction_.push_back(i - degree_);
    extraction_.push_back(bsplineExtraction(knots_, degree_, i));
  }
  for (int i = 0; i < numFunctions_; ++i) anchors_.push_back(splineAnchor(knots_, degree_, i));
}

UnivariateBasis UnivariateBasis::derivativeSpace() const {
  UnivariateBasis basis;
  basis.degree_ = degree_ - 1;
  basis.breakpoints_ = breakpoints_;
  if (family_ == BasisFamily::BSpline)
    basis.knots_.assign(knots_.begin() + 1, knots_.end() - 1);
  else
    for (const double breakpoint : breakpoints_)
      basis.knots_.insert(basis.knots_.end(), static_cast<std::size_t>(degree_), breakpoint);
  basis.makeFunctions();
  return basis;
}

UnivariateBasis UnivariateBasis::lagrange(int degree, std::vector<double> breakpoints) {
  if (degree < 1) throw Error(fmt::format("Lagrange basis: degree {} is below 1", degree));
  if (breakpoints.size() < 2) throw Error("Lagrange basis: at least two breakpoints are needed");
  for (std::size_t b = 1; b < breakpoints.size(); ++b)
    if (!(breakpoints[b] > breakpoints[b - 1]))
      throw Error(fmt::format("Lagrange basis: breakpoint {} = {} does not exceed the one before it ({})",
                              b + 1, breakpoints[b], breakpoints[b - 1]));
  UnivariateBasis basis;
  basis.family_ = BasisFamily::Lagrange;
  basis.degree_ = degree;
  basis.breakpoints_ = std::move(breakpoints);
  basis.knots_ = basis.breakpoints_;
  basis.numFunctions_ = degree * basis.numSpans() + 1;
  const Eigen::MatrixXd extraction = lagrangeExtraction(degree);
  for (int e = 0; e < basis.numSpans(); ++e) {
    basis.firstFunction_.push_back(e * degree);
    basis.extraction_.push_back(extraction);
    for (int k = e == 0 ? 0 : 1; k <= degree; ++k)
      basis.anchors_.push_back(((degree - k) * basis.spanBegin(e) + k * basis.spanEnd(e)) / degree);
  }
  return basis;
}

Eigen::MatrixXd bernstein(int degree, double a, double b, double x, int derivatives) {
  const double h = b - a, s = (x - a) / h, r = (b - x) / h;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(degree + 1, derivatives + 1);
  for (int k = 0; k <= std::min(derivatives, degree); ++k) {
    // Values of degree p-k, then k times the derivative rule B_i^p' = p/h (B_{i-1}^{p-1} - B_i^{p-1}).
    Eigen::VectorXd B = Eigen::VectorXd::Zero(degree + 1);
    B(0) = 1.0;
    for (int p = 1; p <= degree; ++p) {
      const bool differentiate = p > degree - k;
      const double left = differentiate ? -p / h : r, right = differentiate ? p / h : s;
      for (int i = p; i >= 1; --i) B(i) = left * B(i) + right * B(i - 1);
      B(0) *= left;
    }
    result.col(k) = B;
  }
  return result;
}

double UnivariateBasis::parameterAt(double share) const {
  return std::lerp(breakpoints_.front(), breakpoints_.back(), share);
}

double UnivariateBasis::shareOf(double xi) const {
  return (xi - breakpoints_.front()) / (breakpoints_.back() - breakpoints_.front());
}

Eigen::MatrixXd UnivariateBasis::evaluate(int span, double xi, int derivatives) const {
  return extraction(span) * bernstein(degree_, spanBegin(span), spanEnd(span), xi, derivatives);
}

int UnivariateBasis::findSpan(double xi) const {
  const auto above = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), xi);
  return std::clamp(static_cast<int>(above - breakpoints_.begin()) - 1, 0, numSpans() - 1);
}

}  // namespace burnish::inline nurbs
