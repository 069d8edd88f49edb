#include "engine/material/initial_states.h"

#include <algorithm>

#include "engine/material/symmetric_tensor.h"

namespace burnish::inline material {
namespace {

constexpr int kMostIterations = 100;

/// Smallest share of a Newton correction.
constexpr double kLeastShare = 1e-6;

/// Name of the equivalent plastic strain among the numbers that go along to a new mesh.
constexpr const char* kCarriedPlasticStrain = "e_p";

/// What a point answers.
struct Answer {
  Eigen::Vector3d stress;     ///< principal Cauchy stresses σ
  Eigen::Matrix3d stiffness;  ///< ∂σ_A/∂ln λ_B
  double plasticWork = 0.0;   ///< of flowing to it
};

/// The law at a point with the elastic stretches; empty if it cannot answer.
std::optional<Answer> answerAt(const Material& material, const Eigen::Vector3d& stretches,
                               const Eigen::VectorXd& numbers) {
  const Eigen::Matrix3d V = stretches.asDiagonal();
  MaterialPoints points(material, 1);
  points.begin({V}, numbers);
  points.startEvaluation(0.0);
  MaterialResponse<3> response;
  const bool answers =
      points.visit([&]<class Law>(PointsOf<Law>& p) { return p.template evaluate<3>(0, V, response); });
  if (!answers) return std::nullopt;
  const Eigen::Vector3d tau = response.tau.template head<3>();
  Eigen::Matrix3d stiffness = response.c.template topLeftCorner<3, 3>();
  stiffness.diagonal() += 2.0 * tau;
  stiffness.colwise() -= tau;
  return Answer{tau / V.determinant(), stiffness / V.determinant(), response.plasticWork};
}

}  // namespace

bool carriesPlasticStrain(const MaterialParameters& material) {
  return std::ranges::any_of(carriedKinds(material),
                             [](const CarriedKind& kind) { return kind.name == kCarriedPlasticStrain; });
}

std::optional<PointStates> stateWithStress(const Material& material, const Eigen::Matrix3d& stress,
                                           double e_p) {
  constexpr double kRelative = 1e-9, kRounding = 1e-14;
  PointStates states = MaterialPoints(material, 1).carried({Eigen::Matrix3d::Identity()});
  for (std::size_t k = 0; k < states.kinds.size(); ++k)
    if (states.kinds[k].name == kCarriedPlasticStrain) states.numbers(static_cast<Eigen::Index>(k), 0) = e_p;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(stress);
  const Eigen::Vector3d wanted = axes.eigenvalues();
  const double E = youngsModulus(material), nu = poissonsRatio(material), size = wanted.cwiseAbs().maxCoeff();
  const double bulk = E / (3.0 * (1.0 - 2.0 * nu));  // by which the rounding of stretches is multiplied
  const double allowed = std::max(kRelative * size, kRounding * (E + bulk));
  const double allowedFlow = kRelative * size * size / E;
  const auto missingIn = [&](const Answer& answer) { return (wanted - answer.stress).cwiseAbs().maxCoeff(); };
  Eigen::Vector3d logarithms = Eigen::Vector3d::Zero();
  auto answer = answerAt(material, Eigen::Vector3d::Ones(), states.numbers);
  if (!answer) return std::nullopt;
  // Newton's method down to rounding. A correction that overshoots or flows is halved until it does neither.
  for (int k = 0; k < kMostIterations; ++k) {
    const double missing = missingIn(*answer);
    const Eigen::Vector3d correction = answer->stiffness.partialPivLu().solve(wanted - answer->stress);
    bool improves = false;
    for (double share = 1.0; !improves && share > (missing > allowed ? kLeastShare : 0.5); share *= 0.5) {
      const Eigen::Vector3d next = logarithms + share * correction;
      const auto there = answerAt(material, next.array().exp(), states.numbers);
      improves = there && there->plasticWork <= allowedFlow && missingIn(*there) < missing;
      if (!improves) continue;
      logarithms = next;
      answer = there;
    }
    if (!improves) break;
  }
  if (!(missingIn(*answer) <= allowed)) return std::nullopt;
  const Eigen::Vector3d squares = (2.0 * logarithms).array().exp();
  states.b_e = {axes.eigenvectors() * squares.asDiagonal() * axes.eigenvectors().transpose()};
  return states;
}

}  // namespace burnish::inline material
