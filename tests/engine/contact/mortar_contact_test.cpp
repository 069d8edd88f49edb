#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/engine/contact/sliding_blocks.h"

namespace burnish {
namespace {

using test::SlidingStep;

ContactOptions withFriction(double mu) {
  ContactOptions options;
  options.parameter = 2.0;
  options.quadraturePoints = 3;
  if (mu > 0.0) options.friction = FormulaText{fmt::format("{}", mu)};
  options.frictionParameter = 1.3;
  return options;
}

template <int Dim>
void expectConsistentTangent(double mu, double way, bool segments = false, bool axisymmetric = false) {
  SlidingStep<Dim> step(withFriction(mu), way, 0.02, axisymmetric, 0.02, segments);
  auto& term = *step.blocks.term;
  const Eigen::VectorXd force = test::forceOf(term, 0.0, step.x);
  EXPECT_GT(term.state().numActive(), 2);
  if (mu > 0.0) {
    EXPECT_GT(way > 0.01 ? term.state().slipping : term.state().sticking, 0);
  }
  EXPECT_LT(step.blocks.imbalance(step.x, force), 1e-13);
  EXPECT_LT(test::tangentError(term, 0.0, step.x, 1e-6), 1e-7);
  if (mu == 0.0) {
    EXPECT_LT(test::asymmetry(test::tangentOf(term, 0.0, step.x)), 1e-14);
  }
}

TEST(MortarContact, TangentAgreesWithDifferencesAndForcesBalance) {
  for (const double mu : {0.0, 0.3}) {
    expectConsistentTangent<2>(mu, 0.1);
    expectConsistentTangent<2>(mu, 1e-4);
  }
  expectConsistentTangent<3>(0.0, 0.05);
  expectConsistentTangent<3>(0.3, 0.05);
}

TEST(MortarContact, TangentAgreesWithDifferencesAndForcesBalanceOverSegments) {
  for (const double mu : {0.0, 0.3})
    for (const bool axisymmetric : {false, true}) expectConsistentTangent<2>(mu, 0.1, true, axisymmetric);
}

TEST(MortarContact, FrictionIsBoundedByCoulombsLaw) {
  SlidingStep<2> step(withFriction(0.3), 0.1);
  test::forceOf(*step.blocks.term, 0.0, step.x);
  const auto& state = step.blocks.term->state();
  for (Eigen::Index q = 0; q < state.pressure.size(); ++q)
    EXPECT_LE(state.traction.col(q).norm(), 0.3 * std::max(0.0, state.pressure(q)) + 1e-14);
  EXPECT_GT(state.frictionForce, 0.0);
}

TEST(MortarContact, RigidMotionsOfBothBodiesAreNoSlip) {
  SlidingStep<2> step(withFriction(0.3), 0.0, 0.0);
  auto& blocks = step.blocks;
  const Eigen::Rotation2Dd turn(0.4);
  Eigen::VectorXd x = step.accepted;
  const Eigen::MatrixXd reference = blocks.places(0.0 * x), places = blocks.places(x);
  for (Eigen::Index a = 0; a < places.cols(); ++a)
    x.segment<2>(2 * a) = turn * places.col(a).head<2>() + Eigen::Vector2d(0.3, -0.2) - reference.col(a);
  x.tail(blocks.term->numMultipliers()).setZero();
  test::forceOf(*blocks.term, 0.0, x);
  EXPECT_LT(blocks.term->state().slip.cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace burnish
