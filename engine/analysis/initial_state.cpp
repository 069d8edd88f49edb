#include "engine/analysis/initial_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/input_error.h"
#include "engine/material/initial_states.h"
#include "engine/material/symmetric_tensor.h"
#include "engine/rezoning/state_transfer.h"

namespace burnish::inline analysis {
namespace {

/// Formulas of the initial state of a body; zero where the scene gives none.
struct Formulas {
  struct Part {
    std::string key;
    std::optional<Formula> formula;

    /// Throws `InputError` at the key if the value is not finite.
    double operator()(const Eigen::Vector3d& X) const {
      double value = 0.0;
      if (formula) placed(key, [&] { value = (*formula)(X, 0.0); });
      return value;
    }
  };

  std::array<Part, 6> stress;  ///< xx yy zz xy yz zx
  Part plasticStrain;

  Formulas(const Scene& scene, const InitialSpec& spec, const std::string& path) {
    const auto part = [&](const std::string& key, const std::optional<FormulaText>& text) {
      return Part{fmt::format("{}.{}", path, key),
                  text ? std::optional(Formula(*text, scene.definitions)) : std::nullopt};
    };
    const InitialStressSpec given = spec.stress.value_or(InitialStressSpec{});
    stress = {part("stress.xx", given.xx), part("stress.yy", given.yy), part("stress.zz", given.zz),
              part("stress.xy", given.xy), part("stress.yz", given.yz), part("stress.zx", given.zx)};
    plasticStrain = part("plastic_strain", spec.plasticStrain);
  }

  Eigen::Matrix3d stressAt(const Eigen::Vector3d& X) const {
    SymmetricTensor<3> components;
    for (std::size_t k = 0; k < stress.size(); ++k) components(static_cast<Eigen::Index>(k)) = stress[k](X);
    return fullTensor<3>(components);
  }
};

/// Reference positions of the quadrature points, 3 x points.
template <int Dim>
Eigen::Matrix3Xd pointPositions(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature) {
  Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, quadrature.numPoints());
  const Eigen::MatrixXd nodes = body.nodePositions();
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature.spans())
    positions.template topRows<Dim>().middleCols(span.firstPoint, span.weights.size()) =
        nodes(Eigen::all, span.nodes) * span.values(buffer);
  return positions;
}

/// Cauchy stress at all quadrature points of a body, components x points.
template <int Dim>
Eigen::MatrixXd cauchyStress(const BulkTerm<Dim>& bulk) {
  Eigen::MatrixXd stress(kVoigt<Dim>, std::ssize(bulk.kirchhoffStress()));
  for (Eigen::Index q = 0; q < stress.cols(); ++q) {
    const auto k = static_cast<std::size_t>(q);
    stress.col(q) = bulk.kirchhoffStress()[k] / bulk.jacobians()[k];
  }
  return bulk.portion().whole(std::move(stress), Receivers::All);
}

template <int Dim>
std::vector<Eigen::MatrixXd> stressesOf(const Model<Dim>& model) {
  std::vector<Eigen::MatrixXd> stresses;
  for (const auto& body : model.bodies()) stresses.push_back(cauchyStress(*body.bulk));
  return stresses;
}

/// The largest norm of a tensor among columns.
template <int Dim>
double largestNorm(const Eigen::MatrixXd& tensors) {
  double largest = 0.0;
  for (Eigen::Index q = 0; q < tensors.cols(); ++q)
    largest = std::max(largest, std::sqrt(squaredNorm<Dim>(tensors.col(q))));
  return largest;
}

/// What is said of a stress with which a point of the material has no state. flows: whether the law has a yield stress.
std::string unbearable(const Eigen::Matrix3d& stress, const std::string& place, bool flows) {
  const double pressure = -stress.trace() / 3.0;
  const double mises = std::sqrt(1.5) * (stress + pressure * Eigen::Matrix3d::Identity()).norm();
  if (flows)
    return fmt::format(
        "found a von Mises stress of {:.6g} at {}, with which the material flows at once or that it "
        "cannot bear; allowed: below the yield stress",
        mises, place);
  return fmt::format(
      "found a von Mises stress of {:.6g} and a pressure of {:.6g} at {}; the law has no state with this "
      "stress, allowed: smaller ones",
      mises, pressure, place);
}

}  // namespace

bool hasInitialState(const Scene& scene) {
  return std::ranges::any_of(scene.allBodies(),
                             [](const BodySpec& body) { return body.initial.has_value(); });
}

template <int Dim>
std::optional<ReferenceState> initialState(const Scene& scene, std::size_t number, const Body<Dim>& body,
                                           const SpanQuadrature<Dim>& quadrature) {
  const BodySpec& spec = scene.allBodies()[number];
  if (!spec.initial) return std::nullopt;
  const std::string key = scene.bodyKey(number, "initial");
  const Formulas formulas(scene, *spec.initial, key);
  const Material material = MaterialLaws::make(spec.material);
  const Eigen::Matrix3Xd X = pointPositions(body, quadrature);
  PointStates all;
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const Eigen::Matrix3d stress = formulas.stressAt(X.col(q));
    const double e_p = formulas.plasticStrain(X.col(q));
    const auto placeText = [&] {
      std::string text = fmt::format("({:.6g}, {:.6g}", X(0, q), X(1, q));
      return Dim == 2 ? text + ")" : fmt::format("{}, {:.6g})", text, X(2, q));
    };
    if (e_p < 0.0)
      throw InputError(key + ".plastic_strain",
                       fmt::format("found {:.6g} at {}; allowed: at least 0", e_p, placeText()));
    auto state = stateWithStress(material, stress, e_p);
    if (!state)
      throw InputError(key + ".stress", unbearable(stress, placeText(), carriesPlasticStrain(spec.material)));
    if (all.b_e.empty()) {
      all.kinds = state->kinds;
      all.numbers.resize(state->numbers.rows(), X.cols());
    }
    all.b_e.push_back(state->b_e.front());
    all.numbers.col(q) = state->numbers;
  }
  return referenceState(quadrature, all);
}

template <int Dim>
double settleInitialState(Simulation<Dim>& simulation) {
  const auto before = stressesOf(*simulation.model);
  const NewtonReport report = simulation.stepping.settle();
  if (report.outcome != NewtonOutcome::Converged)
    throw RunError(
        fmt::format("the initial stress finds no equilibrium ({}); give one that the supports and "
                    "loads of the start balance more nearly",
                    describe(report.outcome)));
  const auto after = stressesOf(*simulation.model);
  double change = 0.0, size = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    change = std::max(change, largestNorm<Dim>(after[k] - before[k]));
    size = std::max(size, largestNorm<Dim>(before[k]));
  }
  return size == 0.0 ? 0.0 : change / size;
}

template std::optional<ReferenceState> initialState(const Scene&, std::size_t, const Body<2>&,
                                                    const SpanQuadrature<2>&);
template std::optional<ReferenceState> initialState(const Scene&, std::size_t, const Body<3>&,
                                                    const SpanQuadrature<3>&);
template double settleInitialState(Simulation<2>&);
template double settleInitialState(Simulation<3>&);

}  // namespace burnish::inline analysis
