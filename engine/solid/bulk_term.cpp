#include "engine/solid/bulk_term.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>
#include <variant>

#include "engine/core/blas.h"

namespace burnish {
namespace {

/// Place of the tensor components (i, j) in the vector of `kVoigt`.
template <int Dim>
constexpr int voigt(int i, int j) {
  if (i == j) return i;
  constexpr std::array<int, 4> place{-1, 3, 5, 4};  // by i + j: xy, zx, yz
  return place[static_cast<std::size_t>(i + j)];
}

/// Pairs (i, k) of directions with i <= k: the other blocks of the tangent are their transposes.
template <int Dim>
constexpr int kPairs = Dim*(Dim + 1) / 2;

}  // namespace

/// Buffers of one thread; sized at first use, so that the span loop does not allocate.
template <int Dim>
struct BulkTerm<Dim>::Workspace {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> u;  // n x Dim
  Eigen::MatrixXd g;                             // n x Dim·Q: spatial gradients
  /// kPairs·n + Dim rows x Dim·Q: gradients times the weighted moduli, one block per pair (i, k), then the
  /// weighted Kirchhoff stresses. Times gᵀ: blocks of the tangent and the forces.
  Eigen::MatrixXd h;
  Eigen::MatrixXd blocks;  // kPairs·n + Dim x n
  Eigen::MatrixXd K;       // Dim·n x Dim·n, component by component
};

template <int Dim>
BulkTerm<Dim>::BulkTerm(const SpanQuadrature<Dim>& quadrature, Material material)
    : quadrature_(quadrature), material_(std::move(material)) {
  pinLibrariesToOneThread();
  for (const auto& span : quadrature_.spans()) {
    std::vector<int> group;
    for (int d = 0; d < Dim; ++d)
      for (const int node : span.nodes) group.push_back(Dim * node + d);
    groups_.push_back(std::move(group));
  }
  colours_ = colourGroups(groups_, Dim * quadrature_.numNodes());
  const auto points = static_cast<std::size_t>(quadrature_.numPoints());
  accepted_.resize(points);
  trial_.resize(points);
  stress_.assign(points, Stress::Zero());
  J_.assign(points, 1.0);
  spanSummaries_.resize(groups_.size());
}

template <int Dim>
template <class Law>
bool BulkTerm<Dim>::evaluateSpan(const Law& law, std::size_t number, const Eigen::VectorXd& x, Assembly& out,
                                 Workspace& work) {
  const auto& span = quadrature_.spans()[number];
  const auto n = static_cast<Eigen::Index>(span.nodes.size());
  const Eigen::Index Q = span.weights.size();
  const bool wantTangent = out.system != nullptr;

  const Eigen::Index stressRow = wantTangent ? kPairs<Dim> * n : 0;

  work.u.resize(n, Dim);
  for (Eigen::Index a = 0; a < n; ++a)
    work.u.row(a) = x.segment<Dim>(Dim * span.nodes[static_cast<std::size_t>(a)]);
  work.g.resize(n, Dim * Q);
  work.h.resize(stressRow + Dim, Dim * Q);

  BulkSummary summary;
  MaterialResponse<Dim> response;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto G = span.G.template middleCols<Dim>(Dim * q);
    Eigen::Matrix<double, Dim, Dim> planar = Eigen::Matrix<double, Dim, Dim>::Identity();
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) planar(i, j) += work.u.col(i).dot(G.col(j));
    F.template topLeftCorner<Dim, Dim>() = planar;
    const double J = planar.determinant();
    const auto point = static_cast<std::size_t>(span.firstPoint + q);
    if (!(J > 0.0) || !law.template evaluate<Dim>(F, accepted_[point], trial_[point], response)) return false;

    const double w = span.weights(q);
    J_[point] = J;
    stress_[point] = response.tau;
    summary.strainEnergy += w * response.strainEnergy;
    summary.plasticWorkIncrement += w * response.plasticWork;
    summary.maxPlasticStrain = std::max(summary.maxPlasticStrain, trial_[point].e_p);
    summary.minJ = std::min(summary.minJ, J);

    auto g = work.g.template middleCols<Dim>(Dim * q);
    g.noalias() = G * planar.inverse();
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) work.h(stressRow + i, Dim * q + j) = w * response.tau(voigt<Dim>(i, j));
    if (!wantTangent) continue;
    Eigen::Index pair = 0;
    for (int i = 0; i < Dim; ++i)
      for (int k = i; k < Dim; ++k, ++pair) {
        Eigen::Matrix<double, Dim, Dim> moduli;  // (j, l): c_ijkl + δ_ik τ_jl
        for (int j = 0; j < Dim; ++j)
          for (int l = 0; l < Dim; ++l)
            moduli(j, l) = w * (response.c(voigt<Dim>(i, j), voigt<Dim>(k, l)) +
                                (i == k ? response.tau(voigt<Dim>(j, l)) : 0.0));
        work.h.template block<Eigen::Dynamic, Dim>(pair * n, Dim * q, n, Dim).noalias() = g * moduli;
      }
  }
  spanSummaries_[number] = summary;

  multiplyTransposed(work.h, work.g, work.blocks);
  for (Eigen::Index a = 0; a < n; ++a)
    out.force.segment<Dim>(Dim * span.nodes[static_cast<std::size_t>(a)]) +=
        work.blocks.col(a).template segment<Dim>(stressRow);
  if (!wantTangent) return true;

  work.K.resize(Dim * n, Dim * n);
  Eigen::Index pair = 0;
  for (int i = 0; i < Dim; ++i)
    for (int k = i; k < Dim; ++k, ++pair) {
      const auto block = work.blocks.middleRows(pair * n, n);  // (a, b): entry (i, k) of functions a and b
      work.K.block(i * n, k * n, n, n) = block;
      if (i != k) work.K.block(k * n, i * n, n, n) = block.transpose();
    }
  out.system->add(out.term, number, work.K);
  return true;
}

template <int Dim>
template <class Law>
bool BulkTerm<Dim>::evaluateAll(const Law& law, const Eigen::VectorXd& x, Assembly& out) {
  tbb::enumerable_thread_specific<Workspace> workspaces;
  std::atomic<bool> admissible{true};
  for (const auto& colour : colours_) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, colour.size(), 8), [&](const auto& range) {
      Workspace& work = workspaces.local();
      for (std::size_t k = range.begin(); k != range.end() && admissible; ++k)
        if (!evaluateSpan(law, static_cast<std::size_t>(colour[k]), x, out, work)) admissible = false;
    });
    if (!admissible) return false;
  }
  return true;
}

template <int Dim>
bool BulkTerm<Dim>::evaluate(double, const Eigen::VectorXd& x, Assembly& out) {
  if (!std::visit([&](const auto& law) { return evaluateAll(law, x, out); }, material_)) return false;
  summary_ = {};
  for (const auto& span : spanSummaries_) {
    summary_.strainEnergy += span.strainEnergy;
    summary_.plasticWorkIncrement += span.plasticWorkIncrement;
    summary_.maxPlasticStrain = std::max(summary_.maxPlasticStrain, span.maxPlasticStrain);
    summary_.minJ = std::min(summary_.minJ, span.minJ);
  }
  return true;
}

template <int Dim>
void BulkTerm<Dim>::accept() {
  accepted_ = trial_;
  plasticWork_ += summary_.plasticWorkIncrement;
}

template class BulkTerm<2>;
template class BulkTerm<3>;

}  // namespace burnish
