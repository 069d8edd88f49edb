#include "engine/solid/dilatation_coupling.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>

#include "engine/solid/bulk_term.h"
#include "engine/solid/parallel_spans.h"

namespace burnish::inline solid {
namespace {

using Lists = std::vector<std::vector<int>>;

/// For each list of numbers the union of the members with these numbers, ascending.
Lists unions(const Lists& lists, const Lists& members, int limit) {
  Lists result;
  std::vector<bool> isIn(static_cast<std::size_t>(limit), false);
  for (const auto& list : lists) {
    auto& numbers = result.emplace_back();
    for (const int member : list)
      for (const int number : members[static_cast<std::size_t>(member)]) {
        if (!isIn[static_cast<std::size_t>(number)]) numbers.push_back(number);
        isIn[static_cast<std::size_t>(number)] = true;
      }
    std::sort(numbers.begin(), numbers.end());
    for (const int number : numbers) isIn[static_cast<std::size_t>(number)] = false;
  }
  return result;
}

/// Unknowns of lists of nodes.
template <int Dim>
Lists unknownsOfLists(const Lists& lists) {
  Lists unknowns;
  for (const auto& nodes : lists) unknowns.push_back(unknownsOf<Dim>(nodes));
  return unknowns;
}

template <int Dim>
Lists nodesOfSpans(const SpanQuadrature<Dim>& quadrature) {
  Lists nodes;
  for (const auto& span : quadrature.spans()) nodes.push_back(span.nodes);
  return nodes;
}

template <int Dim>
Lists functionsOfSpans(const DilatationProjection<Dim>& projection) {
  Lists functions;
  for (const auto& span : projection.spans()) functions.push_back(span.functions);
  return functions;
}

Lists spansOfFunctions(const Lists& functions, int numFunctions) {
  Lists spans(static_cast<std::size_t>(numFunctions));
  for (std::size_t e = 0; e < functions.size(); ++e)
    for (const int function : functions[e])
      spans[static_cast<std::size_t>(function)].push_back(static_cast<int>(e));
  return spans;
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
                                            const DilatationProjection<Dim>& projection,
                                            const std::vector<DilatationShare>& shares)
    : shares_(shares),
      nodes_(nodesOfSpans(quadrature)),
      functions_(functionsOfSpans(projection)),
      uses_(static_cast<std::size_t>(projection.numFunctions())),
      dependences_(static_cast<std::size_t>(quadrature.numNodes())) {
  for (std::size_t e = 0; e < functions_.size(); ++e)
    for (std::size_t a = 0; a < functions_[e].size(); ++a)
      uses_[static_cast<std::size_t>(functions_[e][a])].push_back({e, static_cast<Eigen::Index>(a)});
  const Lists spans = spansOfFunctions(functions_, projection.numFunctions());
  overlapping_ = unions(spans, functions_, projection.numFunctions());
  findColumns(unions(spans, nodes_, quadrature.numNodes()));
}

template <int Dim>
CouplingGroups DilatationCoupling<Dim>::groups(const SpanQuadrature<Dim>& quadrature,
                                               const DilatationProjection<Dim>& projection) {
  const Lists functions = functionsOfSpans(projection);
  const Lists nodes = unions(spansOfFunctions(functions, projection.numFunctions()), nodesOfSpans(quadrature),
                             quadrature.numNodes());
  return unknownsOfLists<Dim>(unions(functions, nodes, quadrature.numNodes()));
}

/// nodes: on which each function depends. Rows of Z and C are their unknowns, those of Y the ones of all
/// functions that the function meets in E.
template <int Dim>
void DilatationCoupling<Dim>::findColumns(const std::vector<std::vector<int>>& nodes) {
  for (std::size_t A = 0; A < nodes.size(); ++A)
    for (std::size_t k = 0; k < nodes[A].size(); ++k)
      dependences_[static_cast<std::size_t>(nodes[A][k])].push_back({A, Dim * k});
  Z_ = C_ = transposedC_ = RunColumns(unknownsOfLists<Dim>(nodes));
  Y_ = RunColumns(unknownsOfLists<Dim>(unions(overlapping_, nodes, static_cast<int>(dependences_.size()))));
}

/// Sums one part of the spans' shares into the column of a function.
template <int Dim>
void DilatationCoupling<Dim>::gather(std::size_t function, Eigen::MatrixXd DilatationShare::*part,
                                     RunColumns& into, Workspace& work) const {
  for (const auto& use : uses_[function]) {
    const auto& nodes = nodes_[use.span];
    const double* value = (shares_[use.span].*part).col(use.place).data();
    for (const int node : nodes)
      for (int d = 0; d < Dim; ++d) work.unknowns(Dim * node + d) += *value++;
  }
  into.take(function, work.unknowns);
}

/// The column of Y = Z E + C of a function.
template <int Dim>
void DilatationCoupling<Dim>::multiplyByE(std::size_t function, Workspace& work) {
  for (const auto& use : uses_[function])
    work.functions(functions_[use.span]) += shares_[use.span].E.col(use.place);
  for (const int other : overlapping_[function]) {
    double& factor = work.functions(other);
    Z_.addTo(static_cast<std::size_t>(other), std::array{factor}, work.unknowns);
    factor = 0.0;
  }
  C_.addTo(function, std::array{1.0}, work.unknowns);
  Y_.take(function, work.unknowns);
}

/// The columns of Y Zᵀ + Z Cᵀ of a node.
template <int Dim>
void DilatationCoupling<Dim>::addColumns(int node, SparseSystem& system, Workspace& work) const {
  const RunColumns& right = isSymmetric_ ? C_ : transposedC_;
  for (const auto& [function, entry] : dependences_[static_cast<std::size_t>(node)]) {
    std::array<double, Dim> z, c;
    std::copy_n(Z_.column(function) + entry, Dim, z.begin());
    std::copy_n(right.column(function) + entry, Dim, c.begin());
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
  isSymmetric_ =
      std::ranges::all_of(shares_, [](const auto& share) { return share.transposedC.size() == 0; });
  forAll(uses_.size(), [&](std::size_t A, Workspace& work) {
    gather(A, &DilatationShare::Z, Z_, work);
    gather(A, &DilatationShare::C, C_, work);
    if (!isSymmetric_) gather(A, &DilatationShare::transposedC, transposedC_, work);
  });
  forAll(uses_.size(), [&](std::size_t A, Workspace& work) { multiplyByE(A, work); });
  forAll(dependences_.size(),
         [&](std::size_t node, Workspace& work) { addColumns(static_cast<int>(node), system, work); });
}

template class DilatationCoupling<2>;
template class DilatationCoupling<3>;

}  // namespace burnish::inline solid
