#include "engine/solid/projected_term.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "engine/core/blas.h"
#include "engine/material/volume_change.h"
#include "engine/solid/parallel_spans.h"
#include "engine/solid/solid_kernel.h"

namespace burnish::inline solid {
namespace {

/// D : T for the gradient D of every unknown of a span, node by node: Dim·n values.
/// gradients: in the reference, at a point.
template <Kinematics K, class G, class Stress, class Out>
void contract(const G& gradients, const Eigen::Matrix3d& F, const Stress& T, Out&& out) {
  constexpr int C = kColumns<K>;
  Eigen::Matrix<double, C, kDimOf<K>> components = Eigen::Matrix<double, C, kDimOf<K>>::Zero();
  for (int i = 0; i < kDimOf<K>; ++i)
    for (int j = 0; j < C; ++j)
      if (gradientPlace<K>(i, j) >= 0) components(j, i) = T(gradientPlace<K>(i, j));
  const Eigen::Matrix<double, C, kDimOf<K>> pushed = pushForward<K>(F) * components;
  out.reshaped(kDimOf<K>, gradients.rows()).noalias() = pushed.transpose() * gradients.transpose();
}

/// F̄ from F V_e.
void projectVolume(Eigen::Matrix3d& gradient, int m, double Jbar, double J) {
  gradient.topLeftCorner(m, m) *= std::pow(Jbar / J, 1.0 / m);
}

/// det F V_e − 1.
double dilatationOf(const Eigen::Matrix3d& gradient) {
  return VolumeChange(gradient - Eigen::Matrix3d::Identity()).minusOne();
}

/// The energy φ(d) = μ/4 d⁴ of the change of volume d = ln(J/J̄) that J̄ does not see, and its derivatives.
struct UnseenDilatation {
  double energy, stress, stiffness;

  UnseenDilatation(double shearModulus, double J, double Jbar) {
    const double d = std::log(J / Jbar);
    energy = 0.25 * shearModulus * d * d * d * d;
    stress = shearModulus * d * d * d;
    stiffness = 3.0 * shearModulus * d * d;
  }
};

/// Of the stresses that work on the volume which is projected.
template <Kinematics K>
double meanStress(const MaterialResponse<kDimOf<K>>& response) {
  return response.tau.template head<kColumns<K>>().mean();
}

/// Factors of the second variation at a point, split by the gradients D of the displacement and the relative
/// changes η = δJ̄/J̄:  D : c : D + (D τ̄) : D + r tr(D D)  +  2 η (B : D)  +  e η². If the law's c is not symmetric, B
/// is what D meets η with, and `transposedB` what η meets D with.
template <Kinematics K, bool Symmetric>
struct PointModuli {
  static constexpr int kDim = kDimOf<K>;
  typename MaterialResponse<kDim>::Tangent c;
  typename MaterialResponse<kDim>::Stress B, transposedB;
  double e;
  double r;

  /// p: mean stress on J̄; stiffness: φ''; projected: the share of J̄'s stresses that comes back to this
  /// point.
  PointModuli(const MaterialResponse<kDim>& response, double p, double stiffness, double projected) {
    constexpr double m = kColumns<K>;
    const auto one = blockIdentity<K>();
    const typename MaterialResponse<kDim>::Stress traced = response.c * one;
    const double volumetric = one.dot(traced) / (m * m) + 2.0 * meanStress<K>(response) / m + stiffness;
    const typename MaterialResponse<kDim>::Stress a = (traced + 2.0 * response.tau) / m;
    B = a - volumetric * one;
    if constexpr (Symmetric) {
      c = response.c - one * a.transpose() - a * one.transpose() +
          (volumetric + projected) * one * one.transpose();
    } else {
      const typename MaterialResponse<kDim>::Stress left =
          (response.c.transpose() * one + 2.0 * response.tau) / m;
      transposedB = left - volumetric * one;
      c = response.c - one * left.transpose() - a * one.transpose() +
          (volumetric + projected) * one * one.transpose();
    }
    e = volumetric - p;
    r = p - projected;
  }
};

}  // namespace

/// Buffers of one thread.
template <int Dim>
template <Kinematics K>
struct ProjectedTerm<Dim>::Workspace {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> u;  // n x Dim
  Eigen::MatrixXd perPoint;                      // Dim·n x Q: a value of every unknown at every point
  Eigen::MatrixXd transposedPerPoint;            // the same; of laws without a symmetric tangent alone
  Eigen::MatrixXd gradients;                     // as the span asks for it
  KernelFor<K> kernel;
  KernelFor<K, false> generalKernel;

  template <bool Symmetric>
  auto& kernelFor() {
    if constexpr (Symmetric)
      return kernel;
    else
      return generalKernel;
  }

  Eigen::VectorXd e;  // Q: weighted factors of η²
};

template <int Dim>
ProjectedTerm<Dim>::ProjectedTerm(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature,
                                  Material material, const std::optional<ReferenceState>& reference)
    : ProjectedTerm(quadrature, std::move(material), reference, DilatationProjection<Dim>(body, quadrature)) {
}

template <int Dim>
ProjectedTerm<Dim>::ProjectedTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                                  const std::optional<ReferenceState>& reference,
                                  DilatationProjection<Dim> projection)
    : BulkTerm<Dim>(quadrature, std::move(material), reference),
      projection_(std::move(projection)),
      shares_(quadrature.spans().size()),
      shearModulus_(shearModulus(this->material())),
      F_(static_cast<std::size_t>(quadrature.numPoints())),
      responses_(F_.size()),
      Jbar_(Eigen::VectorXd::Ones(quadrature.numPoints())),
      stressOnJbar_(Eigen::VectorXd::Zero(quadrature.numPoints())),
      dilatation_(Eigen::VectorXd::Zero(projection_.numFunctions())),
      pressure_(Eigen::VectorXd::Zero(projection_.numFunctions())),
      spanDilatations_(quadrature.spans().size()) {}

template <int Dim>
CouplingGroups ProjectedTerm<Dim>::couplings() const {
  CouplingGroups groups = BulkTerm<Dim>::couplings();
  if (product_) return groups;
  const CouplingGroups wide = DilatationCoupling<Dim>::groups(this->quadrature_, projection_);
  groups.insert(groups.end(), wide.begin(), wide.end());
  return groups;
}

template <int Dim>
void ProjectedTerm<Dim>::keepProducts() {
  product_.emplace(this->groups_, projection_, shares_, this->colours_);
}

template <int Dim>
void ProjectedTerm<Dim>::divideAmong(const Team& team, const Division& division) {
  BulkTerm<Dim>::divideAmong(team, division);
  projection_.divideAmong(team, this->workedOn(), {this->own().begin(), this->own().end()});
  if (product_) keepProducts();
  this->portion().reduce(F_);
  this->portion().reduce(responses_);
  Jbar_ = this->portion().part(Jbar_.transpose()).transpose();
  stressOnJbar_ = this->portion().part(stressOnJbar_.transpose()).transpose();
}

template <int Dim>
std::vector<Eigen::Matrix3d> ProjectedTerm<Dim>::gradientsOfLaw(const Eigen::VectorXd& x) const {
  auto gradients = BulkTerm<Dim>::gradientsOfLaw(x);
  Eigen::VectorXd dilatations(std::ssize(gradients));
  for (Eigen::Index k = 0; k < dilatations.size(); ++k)
    dilatations(k) = dilatationOf(gradients[static_cast<std::size_t>(k)]);
  const Eigen::VectorXd projected = projection_.project(this->firstPoints(), dilatations);
  const int m = gradientColumns(this->quadrature_.kinematics());
  for (Eigen::Index k = 0; k < dilatations.size(); ++k)
    projectVolume(gradients[static_cast<std::size_t>(k)], m, 1.0 + projected(k), 1.0 + dilatations(k));
  return gradients;
}

/// F, J, and what the span contributes to J̄ and its derivative; false where J is not positive.
template <int Dim>
template <Kinematics K>
bool ProjectedTerm<Dim>::measure(std::size_t number, const Eigen::VectorXd& x, bool wantTangent,
                                 Workspace<K>& work) {
  constexpr int C = kColumns<K>;
  const auto& span = this->quadrature_.spans()[number];
  const auto n = static_cast<Eigen::Index>(span.nodes.size());
  const Eigen::Index Q = span.weights.size();
  gatherNodes<Dim>(x, span.nodes, work.u);
  const Eigen::MatrixXd& gradients = span.gradients(work.gradients);
  work.perPoint.resize(Dim * n, wantTangent ? Q : 0);

  BulkSummary summary;
  Eigen::VectorXd dilatation(Q);
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto G = gradients.template middleCols<C>(C * q);
    const auto point = static_cast<std::size_t>(this->firstPoint(number) + q);
    F_[point] = deformationGradient<K>(work.u, G);
    const double J = volumeRatio<K>(F_[point]) * this->referenceVolumeRatio(point);
    if (!(J > 0.0)) return false;
    this->J_[point] = J;
    summary.minJ = std::min(summary.minJ, J);
    dilatation(q) = dilatationOf(this->elasticGradient(point, F_[point]));
    if (!wantTangent) continue;
    contract<K>(G, F_[point], J * blockIdentity<K>(), work.perPoint.col(q));
  }
  this->spanSummaries_[number] = summary;
  const Eigen::MatrixXd& L = projection_.spans()[number].L;
  spanDilatations_[number] = L * dilatation;
  if (!wantTangent) return true;
  multiplyTransposed(work.perPoint, L, shares_[number].Z);
  if (product_) multiplyTransposed(work.perPoint, projection_.sharesByItself(number), shares_[number].z);
  return true;
}

/// The law at F̄; false where J̄ is not positive or the law cannot answer.
template <int Dim>
template <Kinematics K, class Law>
bool ProjectedTerm<Dim>::respondOnSpan(PointsOf<Law>& points, std::size_t number) {
  const int firstPoint = this->firstPoint(number);
  const auto& projected = projection_.spans()[number];
  const Eigen::VectorXd dilatation = projected.N.transpose() * dilatation_(projected.functions);
  for (Eigen::Index q = 0; q < dilatation.size(); ++q) {
    const auto point = static_cast<std::size_t>(firstPoint + q);
    const double J = this->J_[point];
    const double Jbar = 1.0 + dilatation(q);
    if (!(Jbar > 0.0)) return false;
    Jbar_(firstPoint + q) = Jbar;
    Eigen::Matrix3d Fbar = this->elasticGradient(point, F_[point]);
    projectVolume(Fbar, kColumns<K>, Jbar, J);
    if (!this->respond(points, point, this->weights_(firstPoint + q), Fbar, responses_[point],
                       this->spanSummaries_[number]))
      return false;
    const UnseenDilatation unseen(shearModulus_, J, Jbar);
    this->spanSummaries_[number].strainEnergy += this->weights_(firstPoint + q) * unseen.energy;
    stressOnJbar_(firstPoint + q) = meanStress<K>(responses_[point]) - unseen.stress;
    this->stress_[point] = (J / Jbar) * responses_[point].tau;
  }
  return true;
}

/// Σ N w p/J̄, the force on the coefficients of J̄.
template <int Dim>
void ProjectedTerm<Dim>::gatherPressure() {
  const Eigen::VectorXd weighted = this->weights_.cwiseProduct(stressOnJbar_).cwiseQuotient(Jbar_);
  pressure_ = projection_.sumOverSpans([&](std::size_t e) -> Eigen::VectorXd {
    return projection_.spans()[e].N *
           weighted.segment(this->firstPoint(e), this->quadrature_.spans()[e].weights.size());
  });
}

template <int Dim>
template <Kinematics K, bool Symmetric>
void ProjectedTerm<Dim>::assemble(std::size_t number, Assembly& out, Workspace<K>& work) {
  constexpr int C = kColumns<K>;
  const auto& span = this->quadrature_.spans()[number];
  const int firstPoint = this->firstPoint(number);
  const auto& projected = projection_.spans()[number];
  const auto n = static_cast<Eigen::Index>(span.nodes.size());
  const Eigen::Index Q = span.weights.size();
  const bool wantTangent = out.system != nullptr;
  const Eigen::MatrixXd& gradients = span.gradients(work.gradients);
  auto& kernel = work.template kernelFor<Symmetric>();
  kernel.start(span, gradients, wantTangent);
  work.perPoint.resize(Dim * n, wantTangent ? Q : 0);
  work.transposedPerPoint.resize(Dim * n, wantTangent && !Symmetric ? Q : 0);
  work.e.resize(Q);

  const Eigen::VectorXd pull = projected.L.transpose() * pressure_(projected.functions);
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto point = static_cast<std::size_t>(firstPoint + q);
    const auto& response = responses_[point];
    const double w = this->weights_(firstPoint + q), Jbar = Jbar_(firstPoint + q);
    const double p = stressOnJbar_(firstPoint + q);
    const double balanced = pull(q) * this->J_[point] / w;  // J̄'s stresses, back at this point
    kernel.setGradients(q, F_[point]);
    kernel.setStress(q, w * (response.tau + (balanced - p) * blockIdentity<K>()));
    if (!wantTangent) continue;
    const UnseenDilatation unseen(shearModulus_, this->J_[point], Jbar);
    const PointModuli<K, Symmetric> moduli(response, p, unseen.stiffness, balanced);
    kernel.setModuli(q, w, response.tau, moduli.c, moduli.r);
    const auto G = gradients.template middleCols<C>(C * q);
    contract<K>(G, F_[point], (w / Jbar) * moduli.B, work.perPoint.col(q));
    if (!Symmetric)
      contract<K>(G, F_[point], (w / Jbar) * moduli.transposedB, work.transposedPerPoint.col(q));
    work.e(q) = w * moduli.e / (Jbar * Jbar);
  }

  kernel.multiply();
  this->add(kernel, number, out);
  if (!wantTangent) return;
  DilatationShare& share = shares_[number];
  multiplyTransposed(work.perPoint, projected.N, share.C);
  if (!Symmetric) multiplyTransposed(work.transposedPerPoint, projected.N, share.transposedC);
  share.E = projected.N * work.e.asDiagonal() * projected.N.transpose();
  if (product_) out.system->add(out.term, number, product_->ofSpan(number));
}

template <int Dim>
template <Kinematics K>
bool ProjectedTerm<Dim>::evaluateAll(const Eigen::VectorXd& x, Assembly& out) {
  const auto forAll = [&](const auto& f) {
    const auto& numbers = projection_.workedOn();
    return this->allRanks(parallelAll(
        numbers.size(), 8, [&](std::size_t k) { return f(static_cast<std::size_t>(numbers[k])); }));
  };
  const bool wantTangent = out.system != nullptr;
  tbb::enumerable_thread_specific<Workspace<K>> workspaces;
  if (!forAll([&](std::size_t e) { return measure<K>(e, x, wantTangent, workspaces.local()); })) return false;
  dilatation_ = projection_.sumOverSpans([&](std::size_t e) { return spanDilatations_[e]; });
  const bool responded = this->points_.visit(
      [&](auto& points) { return forAll([&](std::size_t e) { return respondOnSpan<K>(points, e); }); });
  if (!responded) return false;
  gatherPressure();
  this->points_.visit([&]<class Law>(PointsOf<Law>&) {
    parallelBatches(this->colours_, [&](std::size_t span) {
      assemble<K, !MayBeUnsymmetric<Law>>(span, out, workspaces.local());
      return true;
    });
  });
  if (wantTangent) {
    if (product_) {
      product_->renew();
      out.system->addProduct(*product_);
    } else {
      (coupling_ ? *coupling_ : coupling_.emplace(this->quadrature_, projection_, shares_))
          .addTo(*out.system);
    }
  }
  return this->conclude(true, out);
}

template <int Dim>
bool ProjectedTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  this->points_.startEvaluation(t);
  return withKinematics<Dim>(this->quadrature_.kinematics(), [&](auto kinematics) {
    return evaluateAll<decltype(kinematics)::value>(x, out);
  });
}

template class ProjectedTerm<2>;
template class ProjectedTerm<3>;

}  // namespace burnish::inline solid
