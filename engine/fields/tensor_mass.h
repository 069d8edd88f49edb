#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline fields {

/// An approximate inverse of a body's mass matrix ∫ R_A R_B dV: patch by patch the Kronecker product of the
/// univariate mass matrices, scaled on both sides so that its diagonal is that of the mass matrix. Iterations
/// with it do not grow with the mesh (Loli, Sangalli, Tani: Easy and efficient preconditioning of the
/// isogeometric mass matrix, 2022). A preconditioner as Eigen's iterative solvers ask for one.
class TensorMassInverse {
 public:
  /// firstNode: node behind the first row; diagonal: of the mass matrix.
  void setUp(const Body<3>& body, int firstNode, const Eigen::VectorXd& diagonal);

  template <class Matrix>
  TensorMassInverse& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  TensorMassInverse& factorize(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  TensorMassInverse& compute(const Matrix&) {
    return *this;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Part {
    std::array<Eigen::LLT<Eigen::MatrixXd>, 3> mass;  ///< per direction
    std::vector<int> rows;                            ///< per function
    Eigen::VectorXd scale;
  };
  std::vector<Part> parts_;  ///< per patch
};

}  // namespace burnish::inline fields
