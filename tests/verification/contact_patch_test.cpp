// The contact patch test: a flat rigid plate pressed on a block whose sides and bottom stand on rollers gives
// a uniform state, so the contact traction is the same everywhere, whatever the basis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/run_scene.h"

namespace burnish {
namespace {

Scene pressedBlock(const std::string& basis, int degree, const std::string& method) {
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
  - {{tool: plate, face: top, method: {}}}
steps: [{{until: 1, count: 4}}]
)",
                                basis, degree, method),
                    "pressed block");
}

class ContactPatchTest : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(ContactPatchTest, TractionIsUniform) {
  const auto& [basis, degree] = GetParam();
  const auto outcome = test::run(pressedBlock(basis, degree, "augmented-lagrangian"), "contact_patch");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;

  // Uniaxial strain λ = 0.8: P_22 = μ (λ − 1/λ) + Λ ln λ / λ with Lame's constants μ, Λ.
  const double E = 10.0, nu = 0.3, stretch = 0.8;
  const double mu = E / (2.0 * (1.0 + nu)), lame = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double exact = -(mu * (stretch - 1.0 / stretch) + lame * std::log(stretch) / stretch);
  const auto& contact = outcome.lastFrame.contact.front();
  EXPECT_LT((contact.quadraturePressure.array() - exact).abs().maxCoeff(), 1e-10 * exact);
  EXPECT_LT((contact.pressure.array() - exact).abs().maxCoeff(), 1e-10 * exact);
  EXPECT_LT(contact.quadratureGap.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(outcome.history.column("plate.fy").back(), 2.0 * exact, 1e-9 * exact);
}

INSTANTIATE_TEST_SUITE_P(All, ContactPatchTest,
                         testing::Combine(testing::Values("nurbs", "lagrange"), testing::Range(1, 5)));

TEST(ContactPatchTest, PenaltyMethodsAreUniformTooAndPenetrateByPressureOverParameter) {
  for (const char* method : {"penalty", "pointwise-penalty"}) {
    const auto outcome = test::run(pressedBlock("nurbs", 2, method), "contact_patch_penalty");
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

}  // namespace
}  // namespace burnish
