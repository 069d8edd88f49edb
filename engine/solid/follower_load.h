#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/core/formula.h"
#include "engine/core/schedule.h"
#include "engine/solid/body.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solid/load_term.h"

namespace burnish::inline solid {

/// A load per current area that follows a face: a pressure p against the outward normal n and, in two
/// dimensions, a shear s along the tangent m of growing parameter,
///
///     δΠ = −∫ (−p n + s m) · δu da,      n da = ± rot(x_ξ) dξ  or  ± x_ξ × x_η dξ dη,      m da = x_ξ dξ
///
/// (theory: "Volume change without locking"). The tangent is not symmetric. p and s are formulas in the
/// reference position and the time.
template <int Dim>
class FollowerLoad final : public LoadTerm {
 public:
  enum class Direction { Pressure, Shear };

  /// face: a face (or part) of the patch, whose side it is on. An empty schedule means a factor of 1.
  FollowerLoad(const Body<Dim>& body, int patch, FaceId side, FaceQuadrature<Dim> face, Direction direction,
               Formula intensity, Schedule factor);

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  bool hasSymmetricTangent() const override { return false; }
  void requireFinite(const std::vector<double>& times) const override;

 private:
  using Vector = Eigen::Vector<double, Dim>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  using Tangents = Eigen::Matrix<double, Dim, Dim - 1>;

  /// Force per parameter for an intensity of one, and its derivatives with respect to the tangents.
  Vector direction(const Tangents& tangents) const;
  Matrix derivative(const Tangents& tangents, int tangent) const;

  std::vector<int> unknowns(const typename FaceQuadrature<Dim>::Span& span) const;

  FaceQuadrature<Dim> face_;
  Direction kind_;
  Formula intensity_;
  Schedule factor_;
  bool axisymmetric_;
  double outward_ = 1.0;  ///< sign that makes the normal of the tangents the outward one
};

}  // namespace burnish::inline solid
