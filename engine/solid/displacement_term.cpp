#include "engine/solid/displacement_term.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "engine/solid/parallel_spans.h"
#include "engine/solid/solid_kernel.h"

namespace burnish::inline solid {
/// Buffers of one thread; sized at first use, so that the span loop does not allocate.
template <int Dim>
template <Kinematics K, bool Symmetric>
struct DisplacementTerm<Dim>::Workspace {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> u;  // n x Dim
  Eigen::MatrixXd gradients;                     // as the span asks for it
  KernelFor<K, Symmetric> kernel;
};

template <int Dim>
DisplacementTerm<Dim>::DisplacementTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                                        const std::optional<ReferenceState>& reference)
    : BulkTerm<Dim>(quadrature, std::move(material), reference) {}

template <int Dim>
template <Kinematics K, class Law, class Work>
bool DisplacementTerm<Dim>::evaluateSpan(PointsOf<Law>& points, std::size_t number, const Eigen::VectorXd& x,
                                         Assembly& out, Work& work) {
  constexpr int C = kColumns<K>;
  const auto& span = this->quadrature_.spans()[number];
  const int firstPoint = this->firstPoint(number);
  const Eigen::Index Q = span.weights.size();
  const bool wantTangent = out.system != nullptr;
  gatherNodes<Dim>(x, span.nodes, work.u);
  const Eigen::MatrixXd& gradients = span.gradients(work.gradients);
  work.kernel.start(span, gradients, wantTangent);

  BulkSummary summary;
  MaterialResponse<Dim> response;
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto G = gradients.template middleCols<C>(C * q);
    const Eigen::Matrix3d F = deformationGradient<K>(work.u, G);
    const auto point = static_cast<std::size_t>(firstPoint + q);
    const double J = volumeRatio<K>(F) * this->referenceVolumeRatio(point);
    const double w = this->weights_(firstPoint + q);
    if (!(J > 0.0) || !this->respond(points, point, w, this->elasticGradient(point, F), response, summary))
      return false;
    summary.minJ = std::min(summary.minJ, J);
    this->J_[point] = J;
    this->stress_[point] = response.tau;

    work.kernel.setGradients(q, F);
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
  tbb::enumerable_thread_specific<Workspace<K, !MayBeUnsymmetric<Law>>> workspaces;
  return parallelBatches(this->colours_, [&](std::size_t span) {
    return evaluateSpan<K>(points, span, x, out, workspaces.local());
  });
}

template <int Dim>
bool DisplacementTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  this->points_.startEvaluation(t);
  const bool admissible = withKinematics<Dim>(this->quadrature_.kinematics(), [&](auto kinematics) {
    return this->points_.visit(
        [&](auto& points) { return evaluateAll<decltype(kinematics)::value>(points, x, out); });
  });
  return this->conclude(admissible, out);
}

template class DisplacementTerm<2>;
template class DisplacementTerm<3>;

}  // namespace burnish::inline solid
