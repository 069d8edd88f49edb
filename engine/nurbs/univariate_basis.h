#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/knot_vector.h"

namespace burnish::inline nurbs {

enum class BasisFamily { BSpline, Lagrange };

/// A univariate basis as a list of spans on each of which exactly p+1 functions live (theory: "Spaces").
///
/// B-splines and Lagrange polynomials have one representation: on span e the functions are N = C_e B, with
/// the Bernstein polynomials B of degree p on that span and the extraction operator C_e, (p+1) x (p+1). For p
/// = 1 both families are the same functions, bit for bit.
class UnivariateBasis {
 public:
  static UnivariateBasis bspline(const KnotVector& knots);

  /// C^0 Lagrange elements between the breakpoints, nodes equally spaced on each. Throws `Error` for degree <
  /// 1 or breakpoints that do not increase.
  static UnivariateBasis lagrange(int degree, std::vector<double> breakpoints);

  /// The B-splines that span the derivatives of this basis: degree p-1 on the same spans, continuity one less
  /// at every breakpoint, so that elements of a C^0 basis are not joined at all. Degree 0 if p = 1.
  UnivariateBasis derivativeSpace() const;

  BasisFamily family() const { return family_; }
  int degree() const { return degree_; }
  int numFunctions() const { return numFunctions_; }
  int numSpans() const { return static_cast<int>(breakpoints_.size()) - 1; }
  const std::vector<double>& breakpoints() const { return breakpoints_; }

  /// Knots of a B-spline basis; the breakpoints of a Lagrange basis.
  const std::vector<double>& knots() const { return knots_; }

  double spanBegin(int span) const { return breakpoints_[static_cast<std::size_t>(span)]; }
  double spanEnd(int span) const { return breakpoints_[static_cast<std::size_t>(span) + 1]; }

  /// Parameter at a share of the range, from its begin (0) to its end (1), and the share of a parameter.
  double parameterAt(double share) const;
  double shareOf(double xi) const;

  /// Global index of the first of the p+1 consecutive functions of a span.
  int firstFunction(int span) const { return firstFunction_[static_cast<std::size_t>(span)]; }

  /// Extraction operator C_e of a span: row a holds the Bernstein coefficients of function `firstFunction +
  /// a`.
  const Eigen::MatrixXd& extraction(int span) const { return extraction_[static_cast<std::size_t>(span)]; }

  /// Values and derivatives of the span's functions at the parameter xi: (p+1) x (derivatives+1), column k
  /// the k-th derivative with respect to the parameter. xi may lie (slightly) outside the span: the
  /// polynomials are continued.
  Eigen::MatrixXd evaluate(int span, double xi, int derivatives) const;

  /// Span that contains xi (half-open, the last one closed); the end spans for values outside the domain.
  int findSpan(double xi) const;

  /// Parameter attached to a function: Greville abscissa (B-spline) or node (Lagrange).
  double anchor(int function) const { return anchors_[static_cast<std::size_t>(function)]; }

 private:
  UnivariateBasis() = default;

  /// Functions and extraction operators of B-splines from `degree_`, `knots_` and `breakpoints_`.
  void makeFunctions();

  BasisFamily family_ = BasisFamily::BSpline;
  int degree_ = 1;
  int numFunctions_ = 0;
  std::vector<double> knots_;
  std::vector<double> breakpoints_;
  std::vector<int> firstFunction_;
  std::vector<double> anchors_;
  std::vector<Eigen::MatrixXd> extraction_;
};

/// Bernstein polynomials of degree p on [a, b] and their derivatives at x: (p+1) x (derivatives+1).
Eigen::MatrixXd bernstein(int degree, double a, double b, double x, int derivatives);

}  // namespace burnish::inline nurbs
