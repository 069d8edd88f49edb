#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/analysis/build_model.h"
#include "engine/core/error.h"
#include "engine/material/initial_states.h"
#include "engine/material/symmetric_tensor.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Stress and plastic strain that a body has before the run.
namespace burnish {
namespace {

using samples::replaced;
using test::Outcome;
using testing::HasSubstr;
using Strings = std::vector<std::string>;

/// Cauchy stress that a law answers in a state.
Eigen::Matrix3d stressIn(const Material& material, const PointStates& state) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> b(state.b_e.front());
  const Eigen::Matrix3d V = b.operatorSqrt();
  MaterialPoints points(material, 1);
  points.begin({V}, state.numbers);
  points.startEvaluation(0.0);
  MaterialResponse<3> response;
  EXPECT_TRUE(points.visit([&](auto& p) { return p.template evaluate<3>(0, V, response); }));
  return fullTensor<3>(response.tau) / V.determinant();
}

const Eigen::Matrix3d kStress{{-0.3, 0.1, 0.05}, {0.1, 0.2, -0.08}, {0.05, -0.08, 0.15}};

std::vector<Material> materials() {
  const HardeningParameters linear = LinearHardening{2.0, 5.0};
  Chaboche::Parameters chaboche;
  chaboche.E = 100.0;
  chaboche.nu = 0.3;
  chaboche.hardening = linear;
  return {NeoHookean({100.0, 0.3}), J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, linear}),
          J2Plasticity({100.0, 0.3, ElasticLaw::Hencky, linear}), Chaboche(chaboche)};
}

TEST(InitialState, IsTheOneInWhichTheLawAnswersTheStress) {
  for (const Material& material : materials()) {
    const auto state = stateWithStress(material, kStress, 0.0);
    ASSERT_TRUE(state);
    EXPECT_LT((stressIn(material, *state) - kStress).norm(), 1e-11);
  }
}

TEST(InitialState, OfEqualPrincipalStressesToo) {
  const Eigen::Matrix3d stress = -0.4 * Eigen::Matrix3d::Identity();
  for (const Material& material : materials())
    EXPECT_LT((stressIn(material, stateWithStress(material, stress, 0.0).value()) - stress).norm(), 1e-11);
}

TEST(InitialState, OfStressesNextToNoneToo) {
  for (const double size : {0.0, 1e-18, 1e-9})
    for (const Material& material : materials())
      EXPECT_LT((stressIn(material, stateWithStress(material, size * kStress, 0.0).value()) - size * kStress)
                    .norm(),
                1e-12);
}

TEST(InitialState, OfRubberMayBeLarge) {
  const Material rubber = NeoHookean({100.0, 0.3});
  for (const double size : {-500.0, -90.0, 90.0, 500.0}) {
    const Eigen::Matrix3d stress = Eigen::Vector3d(0.0, size, 0.1 * size).asDiagonal();
    const auto state = stateWithStress(rubber, stress, 0.0);
    ASSERT_TRUE(state) << size;
    EXPECT_LT((stressIn(rubber, *state) - stress).norm(), 1e-9 * std::abs(size)) << size;
  }
  const Eigen::Matrix3d tension = 100.0 * Eigen::Matrix3d::Identity();
  EXPECT_FALSE(stateWithStress(rubber, tension, 0.0))
      << "rubber that is pulled on all sides gives way before";
}

TEST(InitialState, DoesNotExistAboveTheYieldStress) {
  const HardeningParameters linear = LinearHardening{2.0, 5.0};
  const Material metal = J2Plasticity({100.0, 0.3, ElasticLaw::Hencky, linear});
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  stress(0, 0) = 1.9;
  EXPECT_TRUE(stateWithStress(metal, stress, 0.0));
  stress(0, 0) = 2.05;
  EXPECT_FALSE(stateWithStress(metal, stress, 0.0));
  EXPECT_TRUE(stateWithStress(metal, stress, 0.1)) << "hardened to 2.5";
}

/// A block between walls and a floor that lets it slide: every stress that depends on Y alone, without a part along
/// y, is in equilibrium there.
const std::string kHeld = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], spans: [4, 4]}
material: {law: j2, E: 1000, nu: 0.3, elastic: hencky, hardening: {law: linear, sigma0: 2, modulus: 10}}
initial: {stress: {xx: -1 + Y, zz: -0.5 + 0.3*Y}}
supports:
  - {face: left, symmetry: true}
  - {face: bottom, symmetry: true}
  - {name: wall, face: right, fix: [x]}
measures:
  - {name: low, kind: point, parameters: [0.5, 0], fields: [stress, plastic_strain, von_mises]}
  - {name: high, kind: point, parameters: [0.5, 1], fields: [stress, plastic_strain]}
solver: {tolerance: 1e-12}
steps: [{until: 1, count: 2}]
output: {vtu: false, reactions: true}
)";

Outcome ranHeld(const std::string& yaml, const std::string& name, const Strings& overrides = {}) {
  return test::run(parseScene(yaml, "test.yaml", overrides), "initial_" + name);
}

TEST(InitialState, InEquilibriumStaysAsItIs) {
  const Outcome ran = ranHeld(kHeld, "held");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  EXPECT_LT(ran.summary.initialStressChange.value(), 1e-3)
      << "stretches of 1e-3 alter the balance by as much";
  EXPECT_NEAR(ran.history.column("low.stress_xx").front(), -1.0, 2e-3);
  EXPECT_NEAR(ran.history.column("low.stress_zz").front(), -0.5, 2e-3);
  EXPECT_NEAR(ran.history.column("high.stress_zz").back(), -0.2, 2e-3);
  EXPECT_NEAR(ran.history.column("wall.fx").back(), 0.5, 1e-3);
  EXPECT_TRUE(ran.summary.doubts.empty());
}

TEST(InitialState, OfAUniformStressIsKeptToRounding) {
  const Outcome ran = ranHeld(kHeld, "uniform", {"initial.stress.xx=-1", "initial.stress.zz=-0.4"});
  EXPECT_LT(ran.summary.initialStressChange.value(), 1e-10);
  EXPECT_NEAR(ran.history.column("low.stress_xx").back(), -1.0, 1e-9);
}

TEST(InitialState, WithoutAHoldRelaxes) {
  const Outcome ran = ranHeld(kHeld, "free",
                              {"supports=[{face: left, symmetry: true}, {face: bottom, symmetry: true}]",
                               "initial.stress.xx=-1", "initial.stress.zz=0"});
  EXPECT_NEAR(ran.summary.initialStressChange.value(), 1.0 * std::sqrt(1.0 + 0.09), 2e-3)
      << "xx goes, and takes nu times as much of zz along";
  EXPECT_NEAR(ran.history.column("low.stress_xx").front(), 0.0, 1e-3);
}

TEST(InitialState, ItsEnergyCountsAsWorkDoneBefore) {
  const HistoryTable history = ranHeld(kHeld, "energy").history;
  EXPECT_GT(history.column("strain_energy").front(), 1e-4);
  EXPECT_EQ(history.column("external_work").front(), history.column("strain_energy").front());
}

/// With an initial plastic strain the bar yields at the stress that belongs to it.
TEST(InitialState, PlasticStrainHardens) {
  const std::string pulled = replaced(
      replaced(kHeld, "initial: {stress: {xx: -1 + Y, zz: -0.5 + 0.3*Y}}", "initial: {plastic_strain: 0.05}"),
      "fix: [x]}", "move: {times: [0, 1], x: [0, 0.01]}}");
  const HistoryTable hard = ranHeld(pulled, "hard", {"steps[0].count=20"}).history,
                     soft =
                         ranHeld(pulled, "soft", {"steps[0].count=20", "initial.plastic_strain=0"}).history;
  EXPECT_NEAR(hard.column("low.plastic_strain").front(), 0.05, 1e-12);
  EXPECT_GT(soft.column("low.plastic_strain").back(), 1e-3);
  for (const HistoryTable& history : {hard, soft})
    EXPECT_NEAR(
        history.column("low.von_mises").back() / (2.0 + 10.0 * history.column("low.plastic_strain").back()),
        1.0, 2e-3);
}

std::string errorOfHeld(const Strings& overrides, const std::string& yaml = kHeld) {
  try {
    buildModel<2>(parseScene(yaml, "test.yaml", overrides));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(InitialState, RefusesWhatMakesNoSense) {
  EXPECT_EQ(errorOfHeld({}), "no error");
  EXPECT_THAT(errorOfHeld({"initial.stress.xx=-3"}),
              HasSubstr("initial.stress: found a von Mises stress of "));
  EXPECT_THAT(errorOfHeld({"material={law: neo-hookean, E: 1, nu: 0.3}", "measures=[]",
                           "initial.stress={xx: 1, yy: 1, zz: 1}"}),
              HasSubstr("; the law has no state with this stress"));
  EXPECT_THAT(errorOfHeld({"initial.stress.xx=1/(Y - Y)"}), HasSubstr("initial.stress.xx: "));
  EXPECT_THAT(errorOfHeld({"initial.stress.xx=t"}),
              HasSubstr("initial.stress.xx: found \"t\", which depends on t"));
  EXPECT_THAT(errorOfHeld({"initial.stress.yz=1"}),
              HasSubstr("initial.stress.yz: found a component of three-dim"));
  EXPECT_THAT(errorOfHeld({"initial.plastic_strain=-1"}), HasSubstr("initial.plastic_strain: found -1 at ("));
  EXPECT_THAT(errorOfHeld({"material={law: neo-hookean, E: 1000, nu: 0.3}", "initial.plastic_strain=1"}),
              HasSubstr("initial.plastic_strain: found for a material that does not flow"));
}

}  // namespace
}  // namespace burnish
