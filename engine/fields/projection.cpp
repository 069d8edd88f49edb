#include "engine/fields/projection.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <vector>

#include "engine/solver/sparse_system.h"

namespace burnish {

template <int Dim>
struct Projection<Dim>::Factor {
  Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>> mass;
};

template <int Dim>
Projection<Dim>::Projection(const SpanQuadrature<Dim>& quadrature)
    : quadrature_(quadrature), factor_(std::make_unique<Factor>()) {
  CouplingGroups groups;
  int lowest = quadrature_.numNodes(), highest = 0;
  for (const auto& span : quadrature_.spans())
    for (const int node : groups.emplace_back(span.nodes)) {
      lowest = std::min(lowest, node);
      highest = std::max(highest, node);
    }
  firstNode_ = lowest;
  for (auto& group : groups)
    for (int& node : group) node -= firstNode_;
  SparseSystem system(std::vector<bool>(static_cast<std::size_t>(highest + 1 - lowest), false), {groups});
  for (std::size_t e = 0; e < groups.size(); ++e) {
    const auto& span = quadrature_.spans()[e];
    system.add(0, e, span.R * span.weights.asDiagonal() * span.R.transpose());
  }
  factor_->mass.setMode(Eigen::CholmodSupernodalLLt);
  factor_->mass.compute(system.tangent());
}

template <int Dim>
Projection<Dim>::~Projection() = default;
template <int Dim>
Projection<Dim>::Projection(Projection&&) noexcept = default;

template <int Dim>
Eigen::MatrixXd Projection<Dim>::project(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(quadrature_.numNodes(), values.cols());
  for (const auto& span : quadrature_.spans())
    rhs(span.nodes, Eigen::all) +=
        span.R * span.weights.asDiagonal() * values.middleRows(span.firstPoint, span.weights.size());
  const Eigen::Index own = factor_->mass.rows();
  const Eigen::MatrixXd solution = factor_->mass.solve(rhs.middleRows(firstNode_, own));
  rhs.middleRows(firstNode_, own) = solution;
  return rhs;
}

template class Projection<2>;
template class Projection<3>;

}  // namespace burnish
