// The contact patch test: a flat rigid plate pressed on a block whose sides and bottom stand on rollers gives
// a uniform state, so the contact traction is the same everywhere, whatever the basis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

Scene pressedBlock(const std::string& basis, int degree, const std::string& contact) {
  return parseScene(fmt::format(R"(
basis: {}
degree: {}
geometry: {{shape: rectangle, size: [2.0, 1.0], spans: [5, 2]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports:
  - {{face: bottom, fix: [y]}}
  - {{face: left, symmetry: true}}
  - {{face: right, fix: [x]}}
tools:
  - {{name: plate, shape: plane, origin: [0.0, 1.0], normal: [0.0, -1.0],
     motion: {{times: [0, 1], y: [0, -0.2]}}}}
contact:
  - {{tool: plate, face: top, {}}}
steps: [{{until: 1, count: 4}}]
)",
                                basis, degree, contact),
                    "pressed block");
}

class ContactPatchTest : public testing::TestWithParam<std::tuple<std::string, int, std::string>> {};

TEST_P(ContactPatchTest, TractionIsUniform) {
  const auto& [basis, degree, contact] = GetParam();
  const auto outcome = test::run(pressedBlock(basis, degree, contact), "contact_patch");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;

  // Uniaxial strain λ = 0.8: P_22 = μ (λ − 1/λ) + Λ ln λ / λ with Lame's constants μ, Λ.
  const double E = 10.0, nu = 0.3, stretch = 0.8;
  const double mu = E / (2.0 * (1.0 + nu)), lame = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double exact = -(mu * (stretch - 1.0 / stretch) + lame * std::log(stretch) / stretch);
  const auto& record = outcome.lastFrame.contact.front();
  EXPECT_LT((record.quadraturePressure.array() - exact).abs().maxCoeff(), 1e-10 * exact);
  EXPECT_LT((record.pressure.array() - exact).abs().maxCoeff(), 1e-10 * exact);
  EXPECT_LT(record.quadratureGap.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(outcome.history.column("plate.fy").back(), 2.0 * exact, 1e-9 * exact);
}

INSTANTIATE_TEST_SUITE_P(All, ContactPatchTest,
                         testing::Combine(testing::Values("nurbs", "lagrange"), testing::Range(1, 5),
                                          testing::Values("method: augmented-lagrangian",
                                                          "method: augmented-lagrangian, gap_limit: 0.02")));

TEST(ContactPatchTest, PenaltyMethodsAreUniformTooAndPenetrateByPressureOverParameter) {
  for (const char* method : {"penalty", "pointwise-penalty"}) {
    const auto outcome =
        test::run(pressedBlock("nurbs", 2, fmt::format("method: {}", method)), "contact_patch_penalty");
    ASSERT_TRUE(outcome.summary.completed) << method;
    const auto& contact = outcome.lastFrame.contact.front();
    const double pressure = contact.quadraturePressure.mean();
    EXPECT_LT((contact.quadraturePressure.array() - pressure).abs().maxCoeff(), 1e-9 * pressure) << method;
    EXPECT_NEAR(-contact.quadratureGap.mean(), pressure / outcome.summary.contactParameter, 1e-9) << method;
    const auto& end = outcome.summary.end;
    EXPECT_NEAR(end.contactEnergy, 0.5 * pressure * 2.0 * end.maxPenetration, 1e-9 * end.contactEnergy)
        << method;
  }
}

/// A block under a punch whose face ends in a corner, beyond which it rises.
test::Outcome pressedByCorner(int spans, const std::string& contact) {
  return test::run(parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: rectangle, size: [2.0, 1.0], spans: [{}, {}]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports:
  - {{face: bottom, fix: [x, y]}}
tools:
  - {{name: punch, shape: polyline, points: [[-1, 1.01], [1.03, 1.01], [2.03, 2.01], [-1, 2.01]],
     motion: {{times: [0, 1], y: [0, -0.11]}}}}
contact:
  - {{tool: punch, face: top, method: augmented-lagrangian{}}}
steps: [{{until: 1, count: 5}}]
)",
                                          spans, spans / 2, contact),
                              "corner"),
                   "corner");
}

TEST(GapLimit, KeepsTheFaceOutOfAToolThatItTurnsAwayFromAtACorner) {
  const auto full = pressedByCorner(20, ""), limited = pressedByCorner(20, ", gap_limit: 0.02"),
             fine = pressedByCorner(60, ", gap_limit: 0.02");
  for (const auto* outcome : {&full, &limited, &fine})
    ASSERT_TRUE(outcome->summary.completed) << outcome->summary.stoppedBecause;
  EXPECT_LT(limited.summary.largestPenetration, 0.6 * full.summary.largestPenetration);
  const auto force = [](const test::Outcome& outcome) { return outcome.history.column("punch.fy").back(); };
  EXPECT_LT(std::abs(force(limited) - force(fine)), 0.4 * std::abs(force(full) - force(fine)));
}

}  // namespace
}  // namespace burnish
