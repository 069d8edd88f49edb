#include "engine/fields/projection.h"

#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/fields/tensor_mass.h"
#include "engine/solver/sparse_system.h"

namespace burnish::inline fields {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// ∫ R_A R_B dV over the body's own nodes.
template <int Dim>
Matrix massMatrix(const SpanQuadrature<Dim>& quadrature, int firstNode, int numNodes) {
  CouplingGroups groups;
  for (const auto& span : quadrature.spans())
    for (int& node : groups.emplace_back(span.nodes)) node -= firstNode;
  SparseSystem system(std::vector<bool>(static_cast<std::size_t>(numNodes), false), {groups});
  Eigen::MatrixXd buffer;
  for (std::size_t e = 0; e < groups.size(); ++e) {
    const auto& span = quadrature.spans()[e];
    const Eigen::MatrixXd& R = span.values(buffer);
    system.add(0, e, R * span.weights.asDiagonal() * R.transpose());
  }
  return system.leading();
}

}  // namespace

template <>
class Projection<2>::Mass {
 public:
  Mass(const Body<2>&, int, const Matrix& mass) {
    factor_.setMode(Eigen::CholmodSupernodalLLt);
    factor_.compute(mass);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const { return factor_.solve(rhs); }

 private:
  Eigen::CholmodDecomposition<Matrix> factor_;
};

template <>
class Projection<3>::Mass {
 public:
  Mass(const Body<3>& body, int firstNode, Matrix mass) : mass_(std::move(mass)) {
    gradients_.setTolerance(1e-14);
    gradients_.preconditioner().setUp(body, firstNode, mass_.diagonal());
    gradients_.compute(mass_);
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const {
    if (!rhs.allFinite())
      return Eigen::MatrixXd::Constant(rhs.rows(), rhs.cols(), std::numeric_limits<double>::quiet_NaN());
    Eigen::MatrixXd solution = gradients_.solve(rhs);
    if (gradients_.info() != Eigen::Success)
      throw Error(
          "a field at quadrature points could not be projected onto the body: conjugate gradients stall");
    return solution;
  }

 private:
  Matrix mass_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, TensorMassInverse> gradients_;
};

template <int Dim>
Projection<Dim>::Projection(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature)
    : quadrature_(quadrature) {
  const auto [first, end] = body.nodeRange();
  firstNode_ = first;
  numNodes_ = end - first;
  mass_ = std::make_unique<Mass>(body, first, massMatrix(quadrature, first, numNodes_));
}

template <int Dim>
Projection<Dim>::~Projection() = default;
template <int Dim>
Projection<Dim>::Projection(Projection&&) noexcept = default;

template <int Dim>
Eigen::MatrixXd Projection<Dim>::project(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(quadrature_.numNodes(), values.cols());
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature_.spans())
    rhs(span.nodes, Eigen::all) += span.values(buffer) * span.weights.asDiagonal() *
                                   values.middleRows(span.firstPoint, span.weights.size());
  const Eigen::MatrixXd solution = mass_->solve(rhs.middleRows(firstNode_, numNodes_));
  rhs.middleRows(firstNode_, numNodes_) = solution;
  return rhs;
}

template class Projection<2>;
template class Projection<3>;

}  // namespace burnish::inline fields
