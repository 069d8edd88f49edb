#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "engine/contact/contact_term.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "tests/engine/contact/pressed_block.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

using test::block;
using test::disc;
using test::freeTool;

struct ContactCase {
  Enforcement enforcement;
  BasisFamily family;
  int degree;
  double gapLimit = std::numeric_limits<double>::infinity();

  ContactTerm<2>::Options options() const { return {enforcement, 10.0, {}, gapLimit}; }
};

class ContactTangent : public testing::TestWithParam<ContactCase> {};

TEST_P(ContactTangent, AgreesWithCentralDifferences) {
  const Body<2> body = block(GetParam().degree, GetParam().family);
  const Tool tool = disc();
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, GetParam().options(), 2 * body.numNodes);
  Eigen::VectorXd x = test::randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 7);
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
  EXPECT_GT(term.state().reaction(1), 0.0);
}

/// The block under a disc that is free in all its degrees of freedom, in a random state near the reference.
struct BlockUnderFreeDisc {
  Body<2> body;
  Tool tool;
  ContactTerm<2> term;
  Eigen::VectorXd x;

  explicit BlockUnderFreeDisc(const ContactCase& c)
      : body(block(c.degree, c.family)),
        tool(freeTool(disc(), 2 * body.numNodes)),
        term(body, 0, faceFromName<2>("top"), tool, c.options(),
             2 * body.numNodes + static_cast<int>(kToolDofs)),
        x(test::randomState(2 * body.numNodes + static_cast<int>(kToolDofs) + term.numMultipliers(), 2e-3,
                            7)) {}
};

TEST_P(ContactTangent, AgreesWithCentralDifferencesIfTheToolIsFree) {
  BlockUnderFreeDisc free(GetParam());
  EXPECT_LT(test::tangentError(free.term, 0.0, free.x, 1e-6), 1e-6);
  EXPECT_GT(free.term.state().reaction(1), 0.0);
}

TEST_P(ContactTangent, OfAToolThatFollowsASurface) {
  const Body<2> body = block(GetParam().degree, GetParam().family);
  const int first = 2 * body.numNodes;
  const Tool tool = test::followingTool(disc(), first);
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, GetParam().options(), first + 2);
  const Eigen::VectorXd x = test::randomState(first + 2 + term.numMultipliers(), 2e-3, 7);
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
  const Eigen::VectorXd force = test::forceOf(term, 0.0, x);
  const ContactState& state = term.state();
  EXPECT_NEAR(force(first), -state.reaction.dot(tool.normal(0.0)), 1e-15);
  EXPECT_NEAR(force(first + 1), -state.moment.z() / tool.turnLength, 1e-15);
  EXPECT_GT(std::abs(force(first)), 1e-3);
}

TEST_P(ContactTangent, ReactionAndMomentAreTheForcesOnTheFreeTool) {
  BlockUnderFreeDisc free(GetParam());
  Eigen::VectorXd force = Eigen::VectorXd::Zero(free.x.size());
  Assembly out{force};
  ASSERT_TRUE(free.term.evaluate(0.0, free.x, out));
  const ContactState& state = free.term.state();
  const int first = 2 * free.body.numNodes;
  EXPECT_NEAR((force.segment<3>(first) + state.reaction).norm(), 0.0, 1e-15);
  EXPECT_NEAR(force(first + 3), -state.moment.z() / free.tool.turnLength, 1e-15);
  EXPECT_GT(std::abs(state.moment.z()), 1e-4);
}

/// A rigid motion of body and tool together changes neither gaps nor pressures, and turns the reaction.
TEST(FreeTool, MovesWithTheBody) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool = freeTool({"plate", Plane{{0.0, 0.495, 0.0}, {0.1, -1.0, 0.0}}}, 2 * body.numNodes);
  const int firstMultiplier = 2 * body.numNodes + static_cast<int>(kToolDofs);
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, {Enforcement::MortarPenalty, 10.0},
                      firstMultiplier);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(firstMultiplier), force = x;
  Assembly out{force};
  ASSERT_TRUE(term.evaluate(0.0, x, out));
  const ContactState before = term.state();

  const double angle = 0.7;
  const Eigen::Vector2d shift(0.2, -0.4), pivot = tool.pivot.head<2>();
  const Eigen::Rotation2Dd R(angle);
  for (int a = 0; a < body.numNodes; ++a) {
    const Eigen::Vector2d X = body.nodePositions().col(a);
    x.segment<2>(2 * a) = R * (X - pivot) + pivot + shift - X;
  }
  x.segment<2>(2 * body.numNodes) = shift;
  x(2 * body.numNodes + 3) = angle * tool.turnLength;
  force.setZero();
  ASSERT_TRUE(term.evaluate(0.0, x, out));
  EXPECT_NEAR((term.state().gap - before.gap).norm(), 0.0, 1e-14);
  EXPECT_NEAR((term.state().reaction.head<2>() - R * before.reaction.head<2>()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(term.state().moment.z(), before.moment.z(), 1e-14);
  EXPECT_GT(std::abs(before.moment.z()), 1e-4);
}

/// A tool that nothing touches would have no stiffness; the nearest function holds it and says with what.
TEST(FreeTool, StaysInTouchWithTheNearestFunction) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool = freeTool({"plate", Plane{{0.0, 0.6, 0.0}, {0.1, -1.0, 0.0}}}, 2 * body.numNodes);
  const int firstMultiplier = 2 * body.numNodes + static_cast<int>(kToolDofs);
  for (const auto enforcement :
       {Enforcement::AugmentedLagrangian, Enforcement::MortarPenalty, Enforcement::PointwisePenalty}) {
    ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, {enforcement, 10.0}, firstMultiplier);
    const Eigen::VectorXd x = Eigen::VectorXd::Zero(firstMultiplier + term.numMultipliers());
    Eigen::VectorXd force = x;
    Assembly out{force};
    ASSERT_TRUE(term.evaluate(0.0, x, out));
    EXPECT_EQ(term.state().pull, 0.0);
    EXPECT_TRUE(force.isZero(0.0));
    term.keepInTouch({});
    EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
    EXPECT_GT(term.state().pull, 0.0);
    EXPECT_LT(term.state().reaction(1), 0.0) << "the body pulls the tool";
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ContactTangent,
    testing::Values(ContactCase{Enforcement::AugmentedLagrangian, BasisFamily::BSpline, 2},
                    ContactCase{Enforcement::AugmentedLagrangian, BasisFamily::BSpline, 3},
                    ContactCase{Enforcement::AugmentedLagrangian, BasisFamily::Lagrange, 2},
                    ContactCase{Enforcement::MortarPenalty, BasisFamily::BSpline, 2},
                    ContactCase{Enforcement::MortarPenalty, BasisFamily::Lagrange, 4},
                    ContactCase{Enforcement::AugmentedLagrangian, BasisFamily::BSpline, 2, 0.05},
                    ContactCase{Enforcement::AugmentedLagrangian, BasisFamily::Lagrange, 2, 0.05},
                    ContactCase{Enforcement::MortarPenalty, BasisFamily::BSpline, 4, 0.05},
                    ContactCase{Enforcement::PointwisePenalty, BasisFamily::BSpline, 2}));

TEST(LimitedGap, IsInFullUpToTheLimitAndTwiceTheLimitBeyondThreeOfIt) {
  const double c = 0.02;
  for (const double gap : {-1.0, 0.0, c}) {
    EXPECT_EQ(limitedGap(gap, c).value, gap);
    EXPECT_EQ(limitedGap(gap, c).slope, 1.0);
    EXPECT_EQ(limitedGap(gap, c).curvature, 0.0);
  }
  for (const double gap : {3.0 * c, 5.0}) {
    EXPECT_NEAR(limitedGap(gap, c).value, 2.0 * c, 1e-15);
    EXPECT_NEAR(limitedGap(gap, c).slope, 0.0, 1e-15);
    EXPECT_NEAR(limitedGap(gap, c).curvature, 0.0, 1e-12);
  }
  EXPECT_EQ(limitedGap(5.0, std::numeric_limits<double>::infinity()).value, 5.0);
  const double h = 1e-6;
  for (double gap = 1.1 * c; gap < 3.0 * c; gap += 0.2 * c) {
    const auto before = limitedGap(gap - h, c), here = limitedGap(gap, c), after = limitedGap(gap + h, c);
    EXPECT_NEAR(here.slope, (after.value - before.value) / (2.0 * h), 1e-6);
    EXPECT_NEAR(here.curvature, (after.slope - before.slope) / (2.0 * h), 1e-4);
  }
}

/// The mortar penalty has the energy ε/2 Σ A_A g_A² of limited gaps, and forces are its derivative.
TEST(GapLimit, ForcesAreTheDerivativeOfTheEnergyAndNothingPressesWhereTheFaceIsOpen) {
  for (const bool axisymmetric : {false, true}) {
    Body<2> body = block(3, BasisFamily::BSpline);
    body.axisymmetric = axisymmetric;
    const Tool tool = axisymmetric ? Tool{"ball", Sphere{{0.0, 0.74, 0.0}, 0.3}} : disc();
    const double limit = 0.05, size = 1.0 / 6.0;
    ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, {Enforcement::MortarPenalty, 10.0, {}, limit},
                        2 * body.numNodes);
    const Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes);
    const Eigen::VectorXd force = test::forceOf(term, 0.0, x);
    const ContactState state = term.state();
    EXPECT_NEAR(state.energy,
                5.0 * (state.averageGap.array() < 0.0)
                          .select(term.weights().array() * state.averageGap.array().square(), 0.0)
                          .sum(),
                1e-16);
    const auto direction = test::randomState(2 * body.numNodes, 1.0, 5);
    const double h = 1e-6;
    const auto energyAt = [&](double step) {
      static_cast<void>(test::forceOf(term, 0.0, step * direction));
      return term.state().energy;
    };
    EXPECT_NEAR(force.dot(direction), (energyAt(h) - energyAt(-h)) / (2.0 * h), 1e-8 * force.norm());

    int pressed = 0, open = 0;
    for (Eigen::Index q = 0; q < state.gap.size(); ++q) {
      if (state.gap(q) < 0.0) pressed += state.pressure(q) > 0.0 ? 1 : 0;
      if (state.gap(q) <= 3.0 * limit * size) continue;
      EXPECT_EQ(state.pressure(q), 0.0);
      ++open;
    }
    EXPECT_GT(pressed, 3);
    EXPECT_GT(open, 3);
  }
}

TEST(GapLimit, WhatLiesOpenIsNotActive) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool plate{"plate", Plane{{0.0, 0.6, 0.0}, {0.0, -1.0, 0.0}}};
  const int first = 2 * body.numNodes;
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), plate,
                      {Enforcement::AugmentedLagrangian, 10.0, {}, 0.02}, first);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(first + term.numMultipliers());
  x.tail(term.numMultipliers()).setConstant(-100.0);
  const Eigen::VectorXd force = test::forceOf(term, 0.0, x);
  EXPECT_EQ(term.state().numActive(), 0);
  EXPECT_NEAR((force.tail(term.numMultipliers()) - 10.0 * term.weights()).norm(), 0.0, 1e-14);
  EXPECT_TRUE(force.head(first).isZero(0.0));
}

TEST(ContactTangentOfOtherTools, AgreesWithCentralDifferences) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool plate{"plate", Plane{{0.0, 0.48, 0.0}, {0.1, -1.0, 0.0}}};
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), plate, {Enforcement::AugmentedLagrangian, 10.0},
                      2 * body.numNodes);
  EXPECT_LT(test::tangentError(term, 0.0,
                               test::randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 8), 1e-6),
            1e-6);
  EXPECT_GT(term.state().reaction(1), 0.0);
}

TEST(ContactTangentInThreeDimensions, AgreesWithCentralDifferences) {
  const Body<3> body =
      makeBody(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}),
                       {KnotVector::uniform(2, 3), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)}));
  const std::array<Tool, 2> tools{Tool{"ball", Sphere{{0.45, 0.55, 0.5 + 0.7}, 0.8}},
                                  Tool{"roller", Cylinder{{0.5, 0.5, 0.5 + 0.24}, {1.0, 0.2, 0.0}, 0.3}}};
  const double full = std::numeric_limits<double>::infinity();
  for (const Tool& tool : tools)
    for (const auto& [enforcement, gapLimit] : {std::pair{Enforcement::AugmentedLagrangian, full},
                                                std::pair{Enforcement::AugmentedLagrangian, 0.05},
                                                std::pair{Enforcement::PointwisePenalty, full}}) {
      ContactTerm<3> term(body, 0, faceFromName<3>("front"), tool, {enforcement, 10.0, {}, gapLimit},
                          3 * body.numNodes);
      const Eigen::VectorXd x = test::randomState(3 * body.numNodes + term.numMultipliers(), 2e-3, 9);
      EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6) << tool.name;
      EXPECT_GT(term.state().reaction(2), 0.0) << tool.name;
    }
}

TEST(ContactTerm, AStateThatLetsTheToolThroughIsNotAdmissible) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  Tool tool = disc();
  tool.shape = Cylinder{{0.4, 0.5 + 0.1, 0.0}, Eigen::Vector3d::UnitZ(), 0.3};
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, {Enforcement::AugmentedLagrangian, 10.0},
                      2 * body.numNodes);
  bool admissible = true;
  static_cast<void>(test::forceOf(term, 0.0, Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers()),
                                  &admissible));
  EXPECT_FALSE(admissible) << "0.2 deep in a disc of radius 0.3";
}

}  // namespace
}  // namespace burnish
