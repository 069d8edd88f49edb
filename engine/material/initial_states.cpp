#include "engine/material/initial_states.h"

#include <algorithm>
#include <limits>

#include "engine/material/symmetric_tensor.h"

namespace burnish {
namespace {

constexpr int kMostIterations = 200;

/// Name of the equivalent plastic strain among the numbers that go along to a new mesh.
constexpr const char* kCarriedPlasticStrain = "e_p";

/// What a point answers.
struct Answer {
  Eigen::Vector3d stress;    ///< principal Cauchy stresses
  double plasticWork = 0.0;  ///< of flowing to it
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
  return Answer{response.tau.template head<3>() / V.determinant(), response.plasticWork};
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
  // The compliance of small strains finds the stretches in a few corrections, down to rounding.
  Eigen::Vector3d logarithms = Eigen::Vector3d::Zero(), found = logarithms;
  double smallest = std::numeric_limits<double>::infinity(), flow = 0.0;
  for (int k = 0; k < kMostIterations; ++k) {
    const auto answer = answerAt(material, logarithms.array().exp(), states.numbers);
    if (!answer) return std::nullopt;
    const Eigen::Vector3d missing = wanted - answer->stress;
    if (missing.cwiseAbs().maxCoeff() >= smallest) break;
    smallest = missing.cwiseAbs().maxCoeff();
    found = logarithms;
    flow = answer->plasticWork;
    logarithms += ((1.0 + nu) * missing - Eigen::Vector3d::Constant(nu * missing.sum())) / E;
  }
  const double bulk = E / (3.0 * (1.0 - 2.0 * nu));  // by which the rounding of stretches is multiplied
  if (smallest > std::max(kRelative * size, kRounding * (E + bulk)) || flow > kRelative * size * size / E)
    return std::nullopt;
  const Eigen::Vector3d squares = (2.0 * found).array().exp();
  states.b_e = {axes.eigenvectors() * squares.asDiagonal() * axes.eigenvectors().transpose()};
  return states;
}

}  // namespace burnish
