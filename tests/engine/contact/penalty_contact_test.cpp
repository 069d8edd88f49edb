// Penalties of averaged gaps and of points over a partner, with and without friction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "engine/contact/contact_term.h"
#include "engine/contact/tool_partner.h"
#include "tests/engine/contact/pressed_block.h"
#include "tests/engine/contact/sliding_blocks.h"

namespace burnish {
namespace {

using test::SlidingStep;

constexpr std::array kPenalties{Enforcement::MortarPenalty, Enforcement::PointwisePenalty};

ContactOptions penalty(Enforcement method, double mu) {
  ContactOptions options{method, 2.0, 3};
  if (mu > 0.0) options.friction = FormulaText{fmt::format("{}", mu)};
  options.frictionParameter = 1.3;
  return options;
}

template <int Dim>
void expectConsistentTangent(const ContactOptions& options, double way, bool axisymmetric = false,
                             bool segments = false) {
  SlidingStep<Dim> step(options, way, 0.0, axisymmetric, 0.0043, segments);
  auto& term = *step.blocks.term;
  ASSERT_EQ(term.numMultipliers(), 0);
  const Eigen::VectorXd force = test::forceOf(term, 0.0, step.x);
  EXPECT_GT(term.state().pressure.maxCoeff(), 0.0);
  ASSERT_GT(term.state().gap.cwiseAbs().minCoeff(), 5e-6) << "a kink within the differences";
  EXPECT_LT(step.blocks.imbalance(step.x, force), 1e-13);
  EXPECT_LT(test::tangentError(term, 0.0, step.x, 1e-6), 1e-6);
  if (options.hasFriction()) {
    EXPECT_GT(way > 0.01 ? term.state().slipping : term.state().sticking, 0);
    EXPECT_GT(term.state().frictionForce, 0.0);
  } else {
    EXPECT_LT(test::asymmetry(test::tangentOf(term, 0.0, step.x)), 1e-14);
  }
}

TEST(Penalty, TangentAgreesWithDifferencesAndForcesBalance) {
  for (const Enforcement method : kPenalties)
    for (const bool axisymmetric : {false, true}) {
      expectConsistentTangent<2>(penalty(method, 0.0), 0.1, axisymmetric);
      expectConsistentTangent<2>(penalty(method, 0.3), 0.1, axisymmetric);
      expectConsistentTangent<2>(penalty(method, 0.9), 1e-4, axisymmetric);
    }
}

TEST(Penalty, TangentAgreesWithDifferencesAndForcesBalanceOverSegments) {
  for (const bool axisymmetric : {false, true})
    for (const double mu : {0.0, 0.3})
      expectConsistentTangent<2>(penalty(Enforcement::MortarPenalty, mu), 0.1, axisymmetric, true);
}

TEST(Penalty, TangentAgreesWithDifferencesInSpace) {
  for (const Enforcement method : kPenalties) {
    expectConsistentTangent<3>(penalty(method, 0.0), 0.05);
    expectConsistentTangent<3>(penalty(method, 0.3), 0.05);
    expectConsistentTangent<3>(penalty(method, 0.9), 1e-4);
  }
}

TEST(Penalty, TangentAgreesWithDifferencesAtTheShearLimitAndOnRoughFaces) {
  for (const Enforcement method : kPenalties) {
    ContactOptions limited = penalty(method, 0.3);
    limited.shearLimit = 1e-3;
    expectConsistentTangent<2>(limited, 0.1);
    ContactOptions rough = penalty(method, 0.0);
    rough.rough = true;
    expectConsistentTangent<2>(rough, 1e-3);
  }
}

/// Of averaged gaps ε/2 Σ A_A g_A², of points ∫ ε/2 g² dΓ.
TEST(Penalty, ForcesAreTheDerivativeOfTheContactEnergy) {
  constexpr double h = 1e-6;
  for (const Enforcement method : kPenalties) {
    SlidingStep<2> step(penalty(method, 0.0), 0.1);
    auto& term = *step.blocks.term;
    const auto direction = test::randomState(step.x.size(), 1.0, 5);
    const auto energyAt = [&](double way) {
      static_cast<void>(test::forceOf(term, 0.0, step.x + way * direction));
      return term.state().energy;
    };
    const double slope = (energyAt(h) - energyAt(-h)) / (2.0 * h);
    EXPECT_NEAR(test::forceOf(term, 0.0, step.x).dot(direction), slope, 1e-7 * std::abs(slope));
    EXPECT_GT(std::abs(slope), 1e-3);
  }
}

/// What is left of friction when a state is accepted is there when the next step begins.
TEST(Penalty, TractionsOfFrictionAreRemembered) {
  for (const Enforcement method : kPenalties) {
    SlidingStep<3> step(penalty(method, 0.9), 1e-3);
    auto& term = *step.blocks.term;
    for (int k = 0; k < 2; ++k) {
      static_cast<void>(test::forceOf(term, 0.0, step.x));
      term.accept();
    }
    const Eigen::Matrix3Xd before = term.state().traction;
    static_cast<void>(test::forceOf(term, 0.0, step.x));
    EXPECT_LT(term.state().slip.norm(), 1e-13);
    EXPECT_GT(before.norm(), 1e-4);
    EXPECT_LT((term.state().traction - before).norm(), 1e-13 * before.norm());
  }
}

/// Two blocks that touch along a plane are turned together about its normal, and about another axis.
TEST(Penalty, RememberedTractionsTurnWithTheBodies) {
  const auto block = [](int spans, double height) {
    return test::lifted<3>(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}),
                                   std::vector<KnotVector>(3, KnotVector::uniform(1, spans))),
                           0.0, height);
  };
  for (const Enforcement method : kPenalties) {
    test::Blocks<3> blocks(block(2, 1.0), block(3, 0.0), penalty(method, 0.9), false);
    auto& term = *blocks.term;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(blocks.numUnknowns());
    const Eigen::MatrixXd reference = blocks.places(zero);
    static_cast<void>(test::forceOf(term, 0.0, zero));
    term.accept();
    Eigen::MatrixXd places = reference;
    places.leftCols(blocks.upper.numNodes).colwise() += Eigen::Vector3d(0.004, -0.01, 0.003);
    const auto evaluate = [&] {
      static_cast<void>(test::forceOf(term, 0.0, Eigen::VectorXd((places - reference).reshaped())));
    };
    evaluate();
    const Eigen::Vector3d force = term.state().reaction;
    EXPECT_GT(force.head<1>().norm(), 1e-3);
    term.accept();
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0.0, 1.0, 0.0), Eigen::Vector3d(1.0, 2.0, 0.5)}) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, axis.normalized()).toRotationMatrix();
      Eigen::Vector3d expected = term.state().reaction;
      for (int k = 0; k < 5; ++k) {
        places = turn * places;
        expected = turn * expected;
        evaluate();
        EXPECT_LT(term.state().slip.norm(), 1e-13);
        term.accept();
      }
      evaluate();
      EXPECT_LT((term.state().reaction - expected).norm(), 1e-13 * force.norm());
      EXPECT_NEAR(term.state().reaction.norm(), force.norm(), 1e-13);
    }
  }
}

/// The terms over a partner against the one that knows tools alone.
class WithoutFriction : public testing::TestWithParam<Enforcement> {
 protected:
  /// Evaluates both terms and compares them.
  void expectTheSame(FaceContact<2>& one, FaceContact<2>& other, const Eigen::VectorXd& x) {
    // Penalties of pairs count gaps less by 1e-13 of the body's size.
    const double same = isPenalty(GetParam()) ? 1e-10 : 1e-13;
    const Eigen::MatrixXd K = test::tangentOf(one, 0.0, x);
    EXPECT_LT((test::tangentOf(other, 0.0, x) - K).cwiseAbs().maxCoeff(), same * K.cwiseAbs().maxCoeff());
    const Eigen::VectorXd force = test::forceOf(one, 0.0, x);
    EXPECT_LT((test::forceOf(other, 0.0, x) - force).norm(), same * force.norm());
    EXPECT_GT(force.norm(), 0.0);
    EXPECT_NEAR(other.state().energy, one.state().energy, same * one.state().energy);
    EXPECT_NEAR(other.state().pull, one.state().pull, same * one.state().pull);
    EXPECT_LT((other.state().reaction - one.state().reaction).norm(), same * one.state().reaction.norm());
    EXPECT_LT((other.state().averageGap - one.state().averageGap).norm(), 1e-12);
    EXPECT_EQ(other.state().active, one.state().active);
  }
};

TEST_P(WithoutFriction, TermsOverAPartnerAreThatOfTools) {
  const Body<2> body = test::block(2, BasisFamily::BSpline);
  const Tool tool = test::freeTool(test::disc(), 2 * body.numNodes);
  const int first = 2 * body.numNodes + static_cast<int>(kToolDofs);
  const FaceId top = faceFromName<2>("top");
  const ContactOptions options{GetParam(), 10.0};
  ContactTerm<2> ofTools(body, 0, top, tool, options, first);
  const auto term = makePartnerContact<2>(body, 0, top, onTool<2>(tool), options, first, {}, {});
  ASSERT_EQ(term->numMultipliers(), ofTools.numMultipliers());
  Eigen::VectorXd x = test::randomState(first + term->numMultipliers(), 2e-3, 7);
  expectTheSame(ofTools, *term, x);
  EXPECT_GT(term->state().reaction(1), 0.0);
  const auto gapAt = gapTo(tool, tool.pose(0.0));
  EXPECT_NEAR(term->smallestReferenceGap(gapAt), ofTools.smallestReferenceGap(gapAt), 1e-15);

  if (averagesGaps(GetParam())) {
    const Eigen::VectorXd origin = test::randomState(term->face().numFunctions(), 0.01, 3);
    ofTools.measureGapsFrom(origin);
    term->measureGapsFrom(origin);
    expectTheSame(ofTools, *term, x);
  }
}

TEST_P(WithoutFriction, AFreeToolStaysInTouchWithTheNearestPoint) {
  const Body<2> body = test::block(2, BasisFamily::BSpline);
  const Tool tool = test::freeTool({"plate", Plane{{0.0, 0.6, 0.0}, {0.1, -1.0, 0.0}}}, 2 * body.numNodes);
  const int first = 2 * body.numNodes + static_cast<int>(kToolDofs);
  const FaceId top = faceFromName<2>("top");
  ContactOptions options{GetParam(), 10.0};
  ContactTerm<2> ofTools(body, 0, top, tool, options, first);
  auto term = makePartnerContact<2>(body, 0, top, onTool<2>(tool), options, first, {}, {});
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(first + term->numMultipliers());
  EXPECT_TRUE(test::forceOf(*term, 0.0, x).isZero(0.0));
  ofTools.keepInTouch({});
  term->keepInTouch({});
  expectTheSame(ofTools, *term, x);
  EXPECT_GT(term->state().pull, 0.0);

  // What only keeps in touch does not rub.
  options.friction = FormulaText{"0.3"};
  term = makePartnerContact<2>(body, 0, top, onTool<2>(tool), options, first, {}, {});
  term->keepInTouch({});
  const Eigen::VectorXd rubbed = Eigen::VectorXd::Zero(first + term->numMultipliers());
  EXPECT_LT(test::tangentError(*term, 0.0, rubbed, 1e-6), 1e-6);
  EXPECT_GT(term->state().pull, 0.0);
  EXPECT_EQ(term->state().frictionForce, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Methods, WithoutFriction,
                         testing::Values(Enforcement::AugmentedLagrangian, Enforcement::MortarPenalty,
                                         Enforcement::PointwisePenalty));

}  // namespace
}  // namespace burnish
