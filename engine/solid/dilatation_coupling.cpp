#include "engine/solid/dilatation_coupling.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>

#include "engine/solid/bulk_term.h"
#include "engine/solid/parallel_spans.h"

namespace burnish {
namespace {

void sortUnique(auto& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

/// Buffers of one thread, zero between two uses.
template <int Dim>
struct DilatationCoupling<Dim>::Workspace {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd functions;
  Eigen::MatrixXd columns;  // unknowns x Dim

  Workspace(Eigen::Index numUnknowns, Eigen::Index numFunctions)
      : unknowns(Eigen::VectorXd::Zero(numUnknowns)),
        functions(Eigen::VectorXd::Zero(numFunctions)),
        columns(Eigen::MatrixXd::Zero(numUnknowns, Dim)) {}
};

template <int Dim>
DilatationCoupling<Dim>::DilatationCoupling(const SpanQuadrature<Dim>& quadrature,
                                            const DilatationProjection<Dim>& projection)
    : shares_(projection.spans().size()),
      uses_(static_cast<std::size_t>(projection.numFunctions())),
      overlapping_(uses_.size()),
      dependences_(static_cast<std::size_t>(quadrature.numNodes())) {
  for (std::size_t e = 0; e < shares_.size(); ++e) {
    nodes_.push_back(quadrature.spans()[e].nodes);
    functions_.push_back(projection.spans()[e].functions);
    for (std::size_t a = 0; a < functions_[e].size(); ++a)
      uses_[static_cast<std::size_t>(functions_[e][a])].push_back({e, static_cast<Eigen::Index>(a)});
  }
  findColumns();
}

/// The unknowns on which each function depends (columns of Z and C), and those of the functions that it meets
/// in E (columns of Y).
template <int Dim>
void DilatationCoupling<Dim>::findColumns() {
  std::vector<std::vector<int>> near(uses_.size()), far(uses_.size());
  for (std::size_t A = 0; A < uses_.size(); ++A) {
    for (const auto& use : uses_[A]) {
      for (const int unknown : unknownsOf<Dim>(nodes_[use.span])) near[A].push_back(unknown);
      for (const int B : functions_[use.span]) overlapping_[A].push_back(static_cast<std::size_t>(B));
    }
    sortUnique(near[A]);
    sortUnique(overlapping_[A]);
    for (std::size_t k = 0; k < near[A].size(); k += Dim)
      dependences_[static_cast<std::size_t>(near[A][k] / Dim)].push_back({A, k});
  }
  for (std::size_t A = 0; A < uses_.size(); ++A) {
    for (const auto B : overlapping_[A]) far[A].insert(far[A].end(), near[B].begin(), near[B].end());
    sortUnique(far[A]);
  }
  for (const auto& functions : functions_) {
    auto& group = groups_.emplace_back();
    for (const int A : functions) {
      const auto& unknowns = near[static_cast<std::size_t>(A)];
      group.insert(group.end(), unknowns.begin(), unknowns.end());
    }
    sortUnique(group);
  }
  Z_ = C_ = RunColumns(near);
  Y_ = RunColumns(far);
}

/// Sums one part of the spans' shares into the column of a function.
template <int Dim>
void DilatationCoupling<Dim>::gather(std::size_t function, Eigen::MatrixXd Share::*part, RunColumns& into,
                                     Workspace& work) const {
  for (const auto& use : uses_[function]) {
    const auto& nodes = nodes_[use.span];
    const double* value = (shares_[use.span].*part).col(use.place).data();
    for (int d = 0; d < Dim; ++d)
      for (const int node : nodes) work.unknowns(Dim * node + d) += *value++;
  }
  into.take(function, work.unknowns);
}

/// The column of Y = Z E + C of a function.
template <int Dim>
void DilatationCoupling<Dim>::multiplyByE(std::size_t function, Workspace& work) {
  for (const auto& use : uses_[function])
    work.functions(functions_[use.span]) += shares_[use.span].E.col(use.place);
  for (const auto other : overlapping_[function]) {
    double& factor = work.functions(static_cast<Eigen::Index>(other));
    Z_.addTo(other, std::array{factor}, work.unknowns);
    factor = 0.0;
  }
  C_.addTo(function, std::array{1.0}, work.unknowns);
  Y_.take(function, work.unknowns);
}

/// The columns of Y Zᵀ + Z Cᵀ of a node.
template <int Dim>
void DilatationCoupling<Dim>::addColumns(int node, SparseSystem& system, Workspace& work) const {
  for (const auto& [function, entry] : dependences_[static_cast<std::size_t>(node)]) {
    std::array<double, Dim> z, c;
    std::copy_n(Z_.column(function) + entry, Dim, z.begin());
    std::copy_n(C_.column(function) + entry, Dim, c.begin());
    Y_.addTo(function, z, work.columns);
    Z_.addTo(function, c, work.columns);
  }
  for (int d = 0; d < Dim; ++d) system.moveIntoColumn(Dim * node + d, work.columns.col(d));
}

template <int Dim>
void DilatationCoupling<Dim>::addTo(SparseSystem& system) {
  tbb::enumerable_thread_specific<Workspace> workspaces(static_cast<Eigen::Index>(Dim * dependences_.size()),
                                                        static_cast<Eigen::Index>(uses_.size()));
  const auto forAll = [&](std::size_t count, const auto& f) {
    parallelAll(count, 16, [&](std::size_t i) {
      f(i, workspaces.local());
      return true;
    });
  };
  forAll(uses_.size(), [&](std::size_t A, Workspace& work) {
    gather(A, &Share::Z, Z_, work);
    gather(A, &Share::C, C_, work);
  });
  forAll(uses_.size(), [&](std::size_t A, Workspace& work) { multiplyByE(A, work); });
  forAll(dependences_.size(),
         [&](std::size_t node, Workspace& work) { addColumns(static_cast<int>(node), system, work); });
}

template class DilatationCoupling<2>;
template class DilatationCoupling<3>;

}  // namespace burnish
