#include "engine/solid/bulk_term.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/core/blas.h"
#include "engine/solid/deformation_gradients.h"
#include "engine/solid/displacement_term.h"
#include "engine/solid/parallel_spans.h"
#include "engine/solid/projected_term.h"

namespace burnish::inline solid {
namespace {

template <int Dim>
CouplingGroups spanGroups(const SpanQuadrature<Dim>& quadrature) {
  CouplingGroups groups;
  for (const auto& span : quadrature.spans()) groups.push_back(unknownsOf<Dim>(span.nodes));
  return groups;
}

/// Spans that follow each other add to the same entries of the tangent, which are at hand while they do: no cache holds
/// all of it. A body of few spans is divided into as many batches as it has.
std::vector<SpanBatches> colouredBatches(const CouplingGroups& groups, int numUnknowns) {
  constexpr std::size_t kLongest = 8, kFewest = 64;
  const std::size_t length = std::clamp<std::size_t>(groups.size() / kFewest, 1, kLongest);
  SpanBatches batches;
  CouplingGroups unknowns;
  for (std::size_t e = 0; e < groups.size(); ++e) {
    if (e % length == 0) {
      batches.emplace_back();
      unknowns.emplace_back();
    }
    batches.back().push_back(static_cast<int>(e));
    unknowns.back().insert(unknowns.back().end(), groups[e].begin(), groups[e].end());
  }
  std::vector<SpanBatches> colours;
  for (const auto& colour : colourGroups(unknowns, numUnknowns)) {
    colours.emplace_back();
    for (const int batch : colour) colours.back().push_back(batches[static_cast<std::size_t>(batch)]);
  }
  return colours;
}

}  // namespace

template <int Dim>
BulkTerm<Dim>::BulkTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                        const std::optional<ReferenceState>& reference)
    : quadrature_(quadrature),
      points_(std::move(material), static_cast<std::size_t>(quadrature.numPoints())),
      groups_(spanGroups(quadrature)),
      colours_(colouredBatches(groups_, Dim * quadrature_.numNodes())),
      weights_(quadrature.numPoints()) {
  pinLibrariesToOneThread();
  const auto points = static_cast<std::size_t>(quadrature_.numPoints());
  stress_.assign(points, Stress::Zero());
  J_.assign(points, 1.0);
  spanSummaries_.resize(groups_.size());
  for (const auto& span : quadrature.spans()) {
    weights_.segment(span.firstPoint, span.weights.size()) = span.weights;
    firstPoints_.push_back(span.firstPoint);
  }
  if (!reference) return;
  assert(reference->stretch.size() == points);
  assert(reference->weights.size() == weights_.size());
  stretch_ = reference->stretch;
  for (std::size_t k = 0; k < reference->gradients.size(); ++k)
    stretch_[k] = reference->gradients[k].inverse() * stretch_[k];
  weights_ = reference->weights;
  plasticWork_ = reference->plasticWork;
  points_.begin(reference->stretch, reference->numbers);
}

template <int Dim>
std::vector<Eigen::Matrix3d> BulkTerm<Dim>::gradientsOfLaw(const Eigen::VectorXd& x) const {
  std::vector<Eigen::Matrix3d> gradients(J_.size());
  forEachGradient(
      quadrature_, [&](std::size_t span) { return firstPoint(span); }, x,
      [&](std::size_t point, const Eigen::Matrix3d& F) { gradients[point] = elasticGradient(point, F); });
  return gradients;
}

template <int Dim>
PointStates BulkTerm<Dim>::carried(const Eigen::VectorXd& x) const {
  PointStates states = points_.carried(gradientsOfLaw(x));
  if (team_->isAlone()) return states;
  constexpr Eigen::Index kTensor = 9;
  const Eigen::Index numbers = states.numbers.rows();
  Eigen::MatrixXd columns(kTensor + numbers, std::ssize(states.b_e));
  for (Eigen::Index q = 0; q < columns.cols(); ++q)
    columns.col(q) << states.b_e[static_cast<std::size_t>(q)].reshaped(), states.numbers.col(q);
  columns = portion().whole(std::move(columns), Receivers::All);
  states.numbers = columns.bottomRows(numbers);
  states.b_e.clear();
  for (const auto& column : columns.colwise())
    states.b_e.emplace_back(column.template head<kTensor>().reshaped(3, 3));
  return states;
}

template <int Dim>
double BulkTerm<Dim>::stressFreeVolume() const {
  const Eigen::VectorXd all = portion().whole(weights_.transpose(), Receivers::All).transpose();
  return all.sum();
}

template <int Dim>
double BulkTerm<Dim>::largestStretch(const Eigen::VectorXd& x) const {
  double largest = 0.0;
  forEachGradient(
      quadrature_, [&](std::size_t span) { return firstPoint(span); }, x,
      [&](std::size_t, const Eigen::Matrix3d& F) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> b(F * F.transpose(), Eigen::EigenvaluesOnly);
        largest = std::max(largest, std::sqrt(b.eigenvalues()(2)));
      });
  return largest;
}

template <int Dim>
bool BulkTerm<Dim>::touchesOwn(std::size_t span) const {
  return std::any_of(groups_[span].begin(), groups_[span].end(),
                     [&](int unknown) { return division_.isOwn(unknown); });
}

template <int Dim>
void BulkTerm<Dim>::divideAmong(const Team& team, const Division& division) {
  team_ = &team;
  division_ = division;
  std::vector<std::vector<int>> spansOf(static_cast<std::size_t>(team.size()));
  std::vector<int> kept, own;  // points
  for (std::size_t e = 0; e < groups_.size(); ++e) {
    const int owner = division.ownerOf(groups_[e].front());
    spansOf[static_cast<std::size_t>(owner)].push_back(static_cast<int>(e));
    firstPoints_[e] = touchesOwn(e) ? static_cast<int>(kept.size()) : -1;
    if (firstPoints_[e] < 0) continue;
    const auto& span = quadrature_.spans()[e];
    for (int q = 0; q < span.weights.size(); ++q) {
      if (owner == team.rank()) own.push_back(static_cast<int>(kept.size()));
      kept.push_back(span.firstPoint + q);
    }
  }
  for (const auto& spans : spansOf) {
    shareOfSpans_.items.insert(shareOfSpans_.items.end(), spans.begin(), spans.end());
    shareOfSpans_.begins.push_back(static_cast<int>(shareOfSpans_.items.size()));
  }
  // Those that are left add up in the order of all.
  for (auto& batches : colours_)
    for (auto& batch : batches)
      std::erase_if(batch, [&](int e) { return firstPoints_[static_cast<std::size_t>(e)] < 0; });

  points_.divide({team, quadrature_.numPoints(), std::move(kept), std::move(own)});
  portion().reduce(stress_);
  portion().reduce(J_);
  if (!stretch_.empty()) portion().reduce(stretch_);
  weights_ = portion().part(weights_.transpose()).transpose();
}

template <int Dim>
std::vector<int> BulkTerm<Dim>::workedOn() const {
  std::vector<int> spans;
  for (std::size_t e = 0; e < firstPoints_.size(); ++e)
    if (firstPoints_[e] >= 0) spans.push_back(static_cast<int>(e));
  return spans;
}

template <int Dim>
std::span<const int> BulkTerm<Dim>::own() const {
  const auto rank = static_cast<std::size_t>(team_->rank());
  return std::span(shareOfSpans_.items)
      .subspan(static_cast<std::size_t>(shareOfSpans_.begins[rank]),
               static_cast<std::size_t>(shareOfSpans_.begins[rank + 1] - shareOfSpans_.begins[rank]));
}

template <int Dim>
bool BulkTerm<Dim>::conclude(bool admissible, Assembly& out) {
  if (!team_->all(admissible)) return false;
  if (!team_->isAlone()) {
    Eigen::VectorXd ordered = out.force(division_.order);
    team_->gather(asSpan(ordered), division_.begins);
    out.force(division_.order) = ordered;
  }
  exchange(
      *team_, shareOfSpans_, 3,
      [&](int e, double* to) {
        const BulkSummary& span = spanSummaries_[static_cast<std::size_t>(e)];
        to[0] = span.strainEnergy, to[1] = span.plasticWorkIncrement, to[2] = span.minJ;
      },
      [&](int e, const double* from) {
        spanSummaries_[static_cast<std::size_t>(e)] = {from[0], from[1], from[2]};
      });
  summarise();
  return true;
}

template <int Dim>
void BulkTerm<Dim>::summarise() {
  summary_ = {};
  for (const auto& span : spanSummaries_) {
    summary_.strainEnergy += span.strainEnergy;
    summary_.plasticWorkIncrement += span.plasticWorkIncrement;
    summary_.minJ = std::min(summary_.minJ, span.minJ);
  }
}

template <int Dim>
void BulkTerm<Dim>::accept() {
  points_.accept();
  plasticWork_ += summary_.plasticWorkIncrement;
}

template <int Dim>
void BulkTerm<Dim>::archive(StateArchive& archive) {
  points_.archive(archive);
  archive.field("plastic_work", plasticWork_);
}

template <int Dim>
std::vector<int> unknownsOf(const std::vector<int>& nodes) {
  std::vector<int> unknowns;
  for (const int node : nodes)
    for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * node + d);
  return unknowns;
}

template <int Dim>
std::unique_ptr<BulkTerm<Dim>> makeBulkTerm(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature,
                                            Material material, Formulation formulation,
                                            const std::optional<ReferenceState>& reference) {
  if (formulation == Formulation::ProjectedDilatation)
    return std::make_unique<ProjectedTerm<Dim>>(body, quadrature, std::move(material), reference);
  return std::make_unique<DisplacementTerm<Dim>>(quadrature, std::move(material), reference);
}

template class BulkTerm<2>;
template class BulkTerm<3>;
template std::vector<int> unknownsOf<2>(const std::vector<int>&);
template std::vector<int> unknownsOf<3>(const std::vector<int>&);
template std::unique_ptr<BulkTerm<2>> makeBulkTerm(const Body<2>&, const SpanQuadrature<2>&, Material,
                                                   Formulation, const std::optional<ReferenceState>&);
template std::unique_ptr<BulkTerm<3>> makeBulkTerm(const Body<3>&, const SpanQuadrature<3>&, Material,
                                                   Formulation, const std::optional<ReferenceState>&);

}  // namespace burnish::inline solid
