#include "engine/analysis/cost_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/analysis/path_steps.h"
#include "engine/analysis/simulation.h"
#include "engine/analysis/time_grid.h"
#include "engine/material/material.h"
#include "engine/solver/coupling_groups.h"
#include "engine/solver/factor_size.h"

namespace burnish::inline analysis {
namespace {

constexpr double kMicrosecond = 1e-6, kNanosecond = 1e-9;

/// Of the program itself, with its libraries.
constexpr double kBytesOfProgram = 95e6;

/// Bytes per non-zero of K, quadrature point, non-zero of its factor, and unknown.
struct BytesPer {
  double nonZero, point, factorNonZero, unknown;
};
constexpr BytesPer kSymmetricFactors{41, 1420, 21, 0};
constexpr BytesPer kFactorsNearTangent{136, 1710, 5.5, 1490};  ///< for tangents that are not symmetric
constexpr BytesPer kMultigrid{52, 0, 0, 2700};

/// Right-hand sides that a system with a tangent that is not symmetric takes.
constexpr double kSolutionsNearTangent = 25.0;

/// V-cycles that are set up, and iterations, per system with contact, whose zone takes as long as most of these; without it
/// a third of them.
constexpr double kSetUps = 0.3;
double linearIterations(int degree) {
  return degree == 2 ? 14.0 : 22.0;
}

template <int Dim>
class Estimator {
 public:
  Estimator(const Scene& scene, const Model<Dim>& model)
      : scene_(scene), model_(model), hierarchy_(hierarchyFor(scene.solver.newton.linear, model, alone())) {
    for (Term* term : model.terms()) {
      if (hierarchy_) term->keepProducts();
      couplings_.push_back(term->couplings());
      isSymmetric_ &= term->hasSymmetricTangent();
    }
    for (const auto& body : model.bodies()) isPlastic_ |= flows(body.bulk->material());
    countNonZeros();
  }

  CostEstimate estimate() {
    addAssembly();
    addContact();
    addLinearSystems();
    addSteps();
    cost_.bytes += kBytesOfProgram + bytesOfFrame();
    return cost_;
  }

 private:
  bool hasContact() const {
    return !model_.contacts().empty() || !model_.pairs().empty() || !model_.selfContacts().empty();
  }

  void countNonZeros() {
    const CouplingCounts counts(couplings_, model_.prescribed(), model_.numDisplacements());
    for (int unknown = 0; unknown < counts.size(); ++unknown)
      nonZeros_ += static_cast<double>(counts.of(unknown));
  }

  /// The law and geometry of every point, and the tangent of every pair of functions of a span: in the plane by
  /// sums over all points, in space over one direction after the other.
  void addAssembly() {
    for (std::size_t k = 0; k < model_.bodies().size(); ++k) {
      const ModelBody<Dim>& body = model_.bodies()[k];
      const double perPoint = flows(body.bulk->material()) ? (Dim == 2 ? 0.9 : 2.5) : (Dim == 2 ? 0.5 : 1.2);
      double microseconds = 0.0;
      for (const auto& span : body.quadrature->spans()) {
        const auto points = static_cast<double>(span.weights.size());
        const auto pairs = static_cast<double>(span.nodes.size() * span.nodes.size());
        microseconds += perPoint * points + (Dim == 2 ? 0.0015 * points : 0.085) * pairs;
      }
      const double withProjection = hierarchy_ ? 1.35 : Dim == 2 ? 2.0 : 2.8;
      cost_.assembly += microseconds * kMicrosecond * (isProjected(k) ? withProjection : 1.0);
    }
  }

  void addContact() {
    double points = 0.0;
    for (const auto& pair : model_.contacts()) points += pair.term->face().numPoints();
    // Each point looks for its partner, and has more unknowns.
    for (const auto& pair : model_.pairs()) points += 5.0 * pair.term->face().numPoints();
    for (const auto& self : model_.selfContacts()) points += 5.0 * self.term->face().numPoints();
    cost_.contact = (Dim == 2 ? 3.0 : 7.0) * kMicrosecond * points;
  }

  void addBytes(const BytesPer& bytes, double factorNonZeros) {
    cost_.bytes = bytes.nonZero * nonZeros_ + bytes.point * numPoints() +
                  bytes.factorNonZero * factorNonZeros + bytes.unknown * model_.numUnknowns();
  }

  void addLinearSystems() {
    if (hierarchy_) {
      addBytes(kMultigrid, 0.0);
      const double withProducts = bytesOfProducts();
      cost_.bytes += withProducts;
      double rows = 0.0;  // of all levels, over those of the finest
      for (const auto& P : hierarchy_->prolongations) rows += static_cast<double>(P.rows());
      if (rows > 0.0) rows /= static_cast<double>(hierarchy_->prolongations.front().rows());
      const double iterations = linearIterations(scene_.allBodies().front().degree);
      cost_.linearSystems = kNanosecond * nonZeros_ *
                            (50.0 * kSetUps + (withProducts > 0.0 ? 10.0 : 2.7) * rows * iterations) *
                            (hasContact() ? 1.0 : 1.0 / 3.0);
      return;
    }
    const FactorSize factors = factorSize(freeNodes(), model_.body().numNodes, Dim);
    addBytes(isSymmetric_ ? kSymmetricFactors : kFactorsNearTangent, factors.nonZeros);
    const double factorisation = 0.04 * factors.operations + 10.0 * factors.nonZeros + 15.0 * nonZeros_ +
                                 1000.0 * model_.numUnknowns();
    const double solution = 1.75 * factors.nonZeros;
    cost_.linearSystems =
        kNanosecond *
        (isSymmetric_ ? factorisation + solution : 1.3 * factorisation + kSolutionsNearTangent * solution);
  }

  /// Nodes that are coupled with each other.
  std::vector<std::vector<int>> freeNodes() const {
    std::vector<std::vector<int>> groups;
    for (const CouplingGroups& term : couplings_)
      for (const auto& group : term) {
        std::vector<int>& nodes = groups.emplace_back();
        for (const int unknown : group)
          if (unknown < model_.numDisplacements() && !model_.prescribed()[static_cast<std::size_t>(unknown)])
            nodes.push_back(unknown / Dim);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      }
    return groups;
  }

  bool isProjected(std::size_t body) const {
    return scene_.allBodies()[body].formulation == Formulation::ProjectedDilatation;
  }

  /// Of what F-bar keeps of spans and points for products with its tangent.
  double bytesOfProducts() const {
    double numbers = 0.0;
    for (std::size_t k = 0; k < model_.bodies().size(); ++k) {
      if (!isProjected(k)) continue;
      const double functions = std::pow(scene_.allBodies()[k].degree, Dim);
      for (const auto& span : model_.bodies()[k].quadrature->spans())
        numbers += 3.0 * Dim * functions * static_cast<double>(span.nodes.size()) +
                   (55.0 + 2.0 * functions) * static_cast<double>(span.weights.size());
    }
    return numbers * sizeof(double);
  }

  double numPoints() const {
    double points = 0.0;
    for (const auto& body : model_.bodies()) points += body.quadrature->numPoints();
    return points;
  }

  /// Of the finer mesh that is written for viewers.
  double numCells() const {
    double spans = 0.0;
    for (const auto& body : model_.bodies()) spans += static_cast<double>(body.quadrature->spans().size());
    return scene_.output.vtu ? spans * std::pow(scene_.output.subdivision, Dim) : 0.0;
  }

  double bytesOfFrame() const { return 180.0 * numCells(); }

  void addSteps() {
    cost_.iterationsPerStep = (isPlastic_ ? 4.0 : 3.0) + (!hasContact() ? 0.0 : Dim == 2 ? 1.0 : 2.0);
    PathSteps pathSteps(scene_);
    pathSteps.expect(scene_);
    int frames = 1;
    double before = 0.0;
    for (const TimePoint& point : timeGrid(scene_, model_.corners())) {
      const double way = point.time - before, size = pathSteps.size(before, point.time, point.nominalStep);
      cost_.steps += std::max(1, static_cast<int>(std::lround(way / size)));
      frames += point.frame ? 1 : 0;
      before = point.time;
    }
    cost_.fieldsAndFrames = kMicrosecond * (0.4 * cost_.steps * numPoints() +
                                            frames * (25.0 * model_.numUnknowns() + 4.3 * numCells()));
  }

  const Scene& scene_;
  const Model<Dim>& model_;
  const std::optional<Hierarchy> hierarchy_;
  std::vector<CouplingGroups> couplings_;  ///< of all terms
  double nonZeros_ = 0.0;                  ///< of K
  bool isSymmetric_ = true;
  bool isPlastic_ = false;
  CostEstimate cost_;
};

}  // namespace

template <int Dim>
CostEstimate estimateCost(const Scene& scene, const Model<Dim>& model) {
  return Estimator<Dim>(scene, model).estimate();
}

template CostEstimate estimateCost(const Scene&, const Model<2>&);
template CostEstimate estimateCost(const Scene&, const Model<3>&);

}  // namespace burnish::inline analysis
