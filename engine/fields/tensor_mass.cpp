#include "engine/fields/tensor_mass.h"

#include <cmath>
#include <utility>

#include "engine/nurbs/quadrature.h"

namespace burnish::inline fields {
namespace {

/// ∫ N_i N_j dξ.
Eigen::MatrixXd massOf(const UnivariateBasis& basis) {
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(basis.numFunctions(), basis.numFunctions());
  const Eigen::Index n = basis.degree() + 1;
  const QuadratureRule rule = gaussLegendre(static_cast<int>(n));
  for (int e = 0; e < basis.numSpans(); ++e) {
    const double length = basis.spanEnd(e) - basis.spanBegin(e);
    for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
      const Eigen::VectorXd N = basis.evaluate(e, basis.spanBegin(e) + length * rule.points(q), 0);
      mass.block(basis.firstFunction(e), basis.firstFunction(e), n, n) +=
          length * rule.weights(q) * N * N.transpose();
    }
  }
  return mass;
}

}  // namespace

void TensorMassInverse::setUp(const Body<3>& body, int firstNode, const Eigen::VectorXd& diagonal) {
  Eigen::VectorXd functionsOf = Eigen::VectorXd::Zero(diagonal.size());  // per row
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    const auto& basis = body.patches[p].basis();
    Part part;
    Eigen::VectorXd own = Eigen::VectorXd::Ones(1);  // diagonal of the Kronecker product
    for (int d = 0; d < 3; ++d) {
      const Eigen::MatrixXd mass = massOf(basis.direction(d));
      own = (own * mass.diagonal().transpose()).reshaped().eval();
      part.mass[static_cast<std::size_t>(d)].compute(mass);
    }
    for (const int node : body.nodes[p]) {
      part.rows.push_back(node - firstNode);
      functionsOf(part.rows.back()) += 1.0;
    }
    part.scale = (own.array() / diagonal(part.rows).array()).sqrt();
    parts_.push_back(std::move(part));
  }
  for (Part& part : parts_) part.scale.array() /= functionsOf(part.rows).array().sqrt();
}

Eigen::VectorXd TensorMassInverse::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  for (const Part& part : parts_) {
    Eigen::VectorXd values = part.scale.cwiseProduct(b(part.rows));
    Eigen::Index before = 1;  // functions of the directions before
    for (const auto& mass : part.mass) {
      const Eigen::Index n = mass.rows();
      for (Eigen::Index k = 0; k < values.size(); k += before * n) {
        Eigen::Map<Eigen::MatrixXd> slice(values.data() + k, before, n);
        slice = mass.solve(slice.transpose()).transpose().eval();
      }
      before *= n;
    }
    for (std::size_t a = 0; a < part.rows.size(); ++a)
      x(part.rows[a]) += part.scale(static_cast<Eigen::Index>(a)) * values(static_cast<Eigen::Index>(a));
  }
  return x;
}

}  // namespace burnish::inline fields
