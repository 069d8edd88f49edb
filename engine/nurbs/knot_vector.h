#pragma once
#include <vector>

namespace burnish::inline nurbs {

/// An open knot vector Ξ of degree p, eqs. (11)-(13).
///
/// Terminology: a *knot* is an entry of Ξ; a *knot span* is a non-empty half-open interval [ξ_i, ξ_{i+1}),
/// the last one closed; a *breakpoint* is a knot counted once; the *multiplicity* of a breakpoint is how
/// often it stands in Ξ. The basis is C^{p-m} at a breakpoint of multiplicity m. *Open* means multiplicity
/// p+1 at both ends.
class KnotVector {
 public:
  /// Throws `Error` unless the knots are open, non-decreasing, with interior multiplicity at most p
  /// (continuity C^0).
  KnotVector(int degree, std::vector<double> knots);

  /// Open and uniform on [0, 1] with the given number of knot spans.
  static KnotVector uniform(int degree, int spans);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  const std::vector<double>& breakpoints() const { return breakpoints_; }
  int numFunctions() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  int numSpans() const { return static_cast<int>(breakpoints_.size()) - 1; }

  /// Index i of the knot interval [ξ_i, ξ_{i+1}) that is non-empty span number `span`.
  int intervalOfSpan(int span) const { return intervals_[static_cast<std::size_t>(span)]; }

  /// Greville abscissa (ξ_{i+1} + … + ξ_{i+p}) / p of function i.
  double greville(int function) const;

  bool operator==(const KnotVector&) const = default;

 private:
  int degree_;
  std::vector<double> knots_;
  std::vector<double> breakpoints_;
  std::vector<int> intervals_;
};

}  // namespace burnish::inline nurbs
