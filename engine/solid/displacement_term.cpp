#include "engine/solid/displacement_term.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/solid/parallel_spans.h"
#include "engine/solid/solid_kernel.h"

namespace burnish {
/// Buffers of one thread; sized at first use, so that the span loop does not allocate.
template <int Dim>
template <Kinematics K>
struct DisplacementTerm<Dim>::Workspace {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> u;  // n x Dim
  KernelFor<K> kernel;
  std::vector<Eigen::Matrix3d> F, elastic;       // Q: in the body, and what the law sees
  std::vector<MaterialResponse<Dim>> responses;  // Q
};

template <int Dim>
DisplacementTerm<Dim>::DisplacementTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                                        const std::optional<ReferenceState>& reference)
    : BulkTerm<Dim>(quadrature, std::move(material), reference) {}

template <int Dim>
template <Kinematics K, class Law>
bool DisplacementTerm<Dim>::evaluateSpan(PointsOf<Law>& points, std::size_t number, const Eigen::VectorXd& x,
                                         Assembly& out, Workspace<K>& work) {
  constexpr int C = kColumns<K>;
  const auto& span = this->quadrature_.spans()[number];
  const Eigen::Index Q = span.weights.size();
  const bool wantTangent = out.system != nullptr;
  gatherNodes<Dim>(x, span.nodes, work.u);
  work.kernel.start(span, wantTangent);

  BulkSummary summary;
  work.F.clear();
  work.elastic.clear();
  work.responses.resize(static_cast<std::size_t>(Q));
  const auto first = static_cast<std::size_t>(span.firstPoint);
  for (Eigen::Index q = 0; q < Q; ++q) {
    const std::size_t point = first + static_cast<std::size_t>(q);
    const Eigen::Matrix3d& F =
        work.F.emplace_back(deformationGradient<K>(work.u, span.G.template middleCols<C>(C * q)));
    const double J = volumeRatio<K>(F) * this->referenceVolumeRatio(point);
    if (!(J > 0.0)) return false;
    summary.minJ = std::min(summary.minJ, J);
    this->J_[point] = J;
    work.elastic.push_back(this->elasticGradient(point, F));
  }
  if (!this->respond(points, first, work.elastic, std::span(work.responses), summary)) return false;

  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto& response = work.responses[static_cast<std::size_t>(q)];
    const double w = this->weights_(span.firstPoint + q);
    this->stress_[first + static_cast<std::size_t>(q)] = response.tau;
    work.kernel.setGradients(q, work.F[static_cast<std::size_t>(q)]);
    work.kernel.setStress(q, w * response.tau);
    if (wantTangent) work.kernel.setModuli(q, w, response.tau, response.c, 0.0);
  }
  this->spanSummaries_[number] = summary;

  work.kernel.multiply();
  this->add(work.kernel, number, out);
  return true;
}

template <int Dim>
template <Kinematics K, class Law>
bool DisplacementTerm<Dim>::evaluateAll(PointsOf<Law>& points, const Eigen::VectorXd& x, Assembly& out) {
  tbb::enumerable_thread_specific<Workspace<K>> workspaces;
  return std::all_of(this->colours_.begin(), this->colours_.end(), [&](const auto& colour) {
    return parallelAll(colour.size(), 8, [&](std::size_t k) {
      return evaluateSpan<K>(points, static_cast<std::size_t>(colour[k]), x, out, workspaces.local());
    });
  });
}

template <int Dim>
bool DisplacementTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  this->points_.startEvaluation(t);
  const bool admissible = withKinematics<Dim>(this->quadrature_.kinematics(), [&](auto kinematics) {
    return this->points_.visit(
        [&](auto& points) { return evaluateAll<decltype(kinematics)::value>(points, x, out); });
  });
  if (admissible) this->summarise();
  return admissible;
}

template class DisplacementTerm<2>;
template class DisplacementTerm<3>;

}  // namespace burnish
