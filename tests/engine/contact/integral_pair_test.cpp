// Contact with complementarity at the quadrature points between faces of two bodies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/contact/sliding_blocks.h"

namespace burnish {
namespace {

using test::SlidingStep;

/// Many points: the tangent leaves out that points move with a split, by which only the rule's error changes.
ContactOptions integral(double mu, int points) {
  ContactOptions options{Enforcement::IntegralAugmentedLagrangian, 10.0, points};
  if (mu > 0.0) options.friction = FormulaText{fmt::format("{}", mu)};
  options.frictionParameter = 7.0;
  return options;
}

/// Largest difference between the tangent and central differences along some directions, relative to the
/// tangent's largest entry.
double errorAlongDirections(Term& term, const Eigen::VectorXd& x) {
  constexpr double h = 1e-7;
  const Eigen::MatrixXd K = test::tangentOf(term, 0.0, x);
  double error = 0.0;
  for (const unsigned seed : {21U, 22U, 23U, 24U, 25U, 26U}) {
    const auto direction = test::randomState(x.size(), 1.0, seed);
    const Eigen::VectorXd change =
        (test::forceOf(term, 0.0, x + h * direction) - test::forceOf(term, 0.0, x - h * direction)) /
        (2.0 * h);
    error = std::max(error, (change - K * direction).cwiseAbs().maxCoeff());
  }
  return error / K.cwiseAbs().maxCoeff();
}

template <int Dim>
void expectConsistentTangent(const ContactOptions& options, double way, bool axisymmetric = false,
                             bool segments = false) {
  SlidingStep<Dim> step(options, way, 0.05, axisymmetric, 0.004, segments);
  auto& term = *step.blocks.term;
  const Eigen::VectorXd force = test::forceOf(term, 0.0, step.x);
  EXPECT_GT(term.state().pressure.maxCoeff(), 0.0);
  EXPECT_EQ(term.state().pressure.minCoeff(), 0.0) << "contact ends within the face";
  EXPECT_LT(step.blocks.imbalance(step.x, force), 1e-13);
  EXPECT_LT(errorAlongDirections(term, step.x), 1e-6);
  if (options.hasFriction()) {
    const auto& sliding = term.state().sliding;
    EXPECT_GT(std::count(sliding.begin(), sliding.end(), way > 0.01 ? 2 : 1), 0);
  } else {
    EXPECT_LT(test::asymmetry(test::tangentOf(term, 0.0, step.x)), 1e-14);
  }
}

TEST(IntegralPair, TangentAgreesWithDifferencesAndForcesBalance) {
  expectConsistentTangent<2>(integral(0.0, 8), 0.1);
  for (const bool axisymmetric : {false, true}) {
    expectConsistentTangent<2>(integral(0.3, 4), 0.1, axisymmetric);
    expectConsistentTangent<2>(integral(0.9, 4), 1e-4, axisymmetric);
  }
  expectConsistentTangent<2>(integral(0.0, 8), 0.1, true);
}

TEST(IntegralPair, TangentAgreesWithDifferencesAndForcesBalanceOverSegments) {
  for (const bool axisymmetric : {false, true}) {
    expectConsistentTangent<2>(integral(0.0, 8), 0.1, axisymmetric, true);
    expectConsistentTangent<2>(integral(0.3, 4), 0.1, axisymmetric, true);
  }
}

TEST(IntegralPair, TangentAgreesWithDifferencesInSpace) {
  expectConsistentTangent<3>(integral(0.0, 3), 0.05);
  expectConsistentTangent<3>(integral(0.3, 3), 0.05);
  expectConsistentTangent<3>(integral(0.9, 3), 1e-4);
}

TEST(IntegralPair, TangentAgreesWithDifferencesAtTheShearLimitAndOnRoughFaces) {
  ContactOptions limited = integral(0.3, 4);
  limited.shearLimit = 0.01;
  expectConsistentTangent<2>(limited, 0.1);
  ContactOptions rough = integral(0.0, 4);
  rough.rough = true;
  expectConsistentTangent<2>(rough, 1e-3);
}

/// The upper block hangs over the end of the lower one: where it has no partner it bears no pressure, whatever
/// its multipliers.
TEST(IntegralPair, PointsWithoutAPartnerBearNoPressure) {
  constexpr double kShift = 0.43;
  const auto block = [](int spans) {
    return refined(rectangle({0.0, 0.0}, {1.0, 1.0}),
                   std::vector<KnotVector>(2, KnotVector::uniform(2, spans)));
  };
  for (const double mu : {0.0, 0.3}) {
    test::Blocks<2> blocks(test::lifted<2>(block(2), kShift, 1.0), block(3), integral(mu, 8), false);
    auto& term = *blocks.term;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(blocks.numUnknowns());
    for (int node = 0; node < blocks.upper.numNodes; ++node) x(2 * node + 1) = -0.01;
    x.segment(term.firstMultiplier(), term.face().numFunctions()).setConstant(-0.3);
    const Eigen::VectorXd force = test::forceOf(term, 0.0, x);
    const auto& state = term.state();
    const Eigen::MatrixXd positions = term.face().positions(x);
    for (Eigen::Index q = 0; q < positions.cols(); ++q) {
      const bool hasPartner = positions(0, q) < 1.0;
      EXPECT_EQ(std::isfinite(state.gap(q)), hasPartner);
      EXPECT_NEAR(state.pressure(q), hasPartner ? 0.4 : 0.0, 1e-14);
    }
    EXPECT_LT(blocks.imbalance(x, force), 1e-13);
    // In between the nearest quadrature point decides.
    EXPECT_NEAR(state.area, 1.0 - kShift, 0.05);
    EXPECT_NEAR(state.reaction(1), -0.4 * state.area, 1e-14);
    EXPECT_LT(errorAlongDirections(term, x), 1e-6);
  }
}

}  // namespace
}  // namespace burnish
