#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "engine/contact/integral_contact_term.h"
#include "engine/contact/tool_contact.h"
#include "engine/contact/tool_partner.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/tools/box.h"
#include "engine/tools/edge.h"
#include "engine/tools/nurbs_shape.h"
#include "engine/tools/union.h"
#include "tests/engine/contact/pressed_block.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

constexpr double kParameter = 10.0;

/// More points than usual: the tangent leaves out that the points of a split span move, by which only the
/// rule's error changes, and that must be small beside the differences on these few spans.
ContactOptions integral() {
  return {Enforcement::IntegralAugmentedLagrangian, kParameter, 8};
}

using test::block;
using test::disc;
using test::freeTool;

std::vector<bool> noneHeld(int unknowns) {
  return std::vector<bool>(static_cast<std::size_t>(unknowns), false);
}

struct IntegralCase {
  BasisFamily family;
  int degree;
  bool axisymmetric = false;
};

/// The block under a disc in a random state with multipliers of the size of the gaps, so that the contact
/// ends within spans. The disc may be free.
struct Pressed {
  Body<2> body;
  int first;
  Tool tool;
  IntegralContactTerm<2> term;
  Eigen::VectorXd x;

  Pressed(const IntegralCase& c, bool isFree)
      : body(block(c.degree, c.family, c.axisymmetric)),
        first(2 * body.numNodes + (isFree ? static_cast<int>(kToolDofs) : 0)),
        tool(isFree ? freeTool(disc(), 2 * body.numNodes) : disc()),
        term(body, 0, faceFromName<2>("top"), onTool<2>(tool), integral(), first,
             noneHeld(2 * body.numNodes)),
        x(test::randomState(first + term.numMultipliers(), 2e-3, 7)) {
    x.tail(term.numMultipliers()) = test::randomState(term.numMultipliers(), 0.2, 3);
  }
};

class IntegralContact : public testing::TestWithParam<IntegralCase> {};

TEST_P(IntegralContact, TangentAgreesWithCentralDifferencesAndIsSymmetric) {
  for (const bool isFree : {false, true}) {
    Pressed pressed(GetParam(), isFree);
    EXPECT_LT(test::tangentError(pressed.term, 0.0, pressed.x, 1e-6), 1e-7);
    EXPECT_GT(pressed.term.state().reaction(1), 0.0);
    EXPECT_GT(pressed.term.state().numActive(), 0);
    EXPECT_LT(pressed.term.state().numActive(), pressed.term.face().numFunctions());
    EXPECT_LT(test::asymmetry(test::tangentOf(pressed.term, 0.0, pressed.x)), 1e-14);
  }
}

/// R is the derivative of L_c = ∫ (p² - λ²)/(2r) dΓ.
TEST_P(IntegralContact, ForcesAreTheDerivativeOfTheEnergy) {
  Pressed pressed(GetParam(), false);
  const Eigen::VectorXd force = test::forceOf(pressed.term, 0.0, pressed.x);
  const auto direction = test::randomState(pressed.x.size(), 1.0, 5);
  const double h = 1e-6;
  const auto energyAt = [&](double step) {
    static_cast<void>(test::forceOf(pressed.term, 0.0, pressed.x + step * direction));
    return pressed.term.state().energy;
  };
  EXPECT_NEAR(force.dot(direction), (energyAt(h) - energyAt(-h)) / (2.0 * h), 1e-7 * force.norm());
}

TEST_P(IntegralContact, ReactionAndMomentAreTheForcesOnTheFreeTool) {
  Pressed pressed(GetParam(), true);
  const Eigen::VectorXd force = test::forceOf(pressed.term, 0.0, pressed.x);
  const ContactState& state = pressed.term.state();
  const int unknown = 2 * pressed.body.numNodes;
  if (GetParam().axisymmetric) {  // of whole rings only the axial force is left
    EXPECT_NEAR(force(unknown + 1) + state.reaction.y(), 0.0, 1e-15);
    EXPECT_EQ(state.moment.norm(), 0.0);
    return;
  }
  EXPECT_NEAR((force.segment<3>(unknown) + state.reaction).norm(), 0.0, 1e-15);
  EXPECT_NEAR(force(unknown + 3), -state.moment.z() / pressed.tool.turnLength, 1e-15);
  EXPECT_GT(std::abs(state.moment.z()), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    All, IntegralContact,
    testing::Values(IntegralCase{BasisFamily::BSpline, 2}, IntegralCase{BasisFamily::BSpline, 3},
                    IntegralCase{BasisFamily::BSpline, 4}, IntegralCase{BasisFamily::Lagrange, 2},
                    IntegralCase{BasisFamily::Lagrange, 4}, IntegralCase{BasisFamily::BSpline, 2, true},
                    IntegralCase{BasisFamily::Lagrange, 2, true}));

TEST(IntegralContactInThreeDimensions, TangentAgreesWithCentralDifferences) {
  const Body<3> body =
      makeBody(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}),
                       {KnotVector::uniform(2, 3), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)}));
  const std::array<Tool, 2> tools{Tool{"ball", Sphere{{0.45, 0.55, 0.5 + 0.7}, 0.8}},
                                  Tool{"roller", Cylinder{{0.5, 0.5, 0.5 + 0.24}, {1.0, 0.2, 0.0}, 0.3}}};
  for (const Tool& tool : tools) {
    IntegralContactTerm<3> term(body, 0, faceFromName<3>("front"), onTool<3>(tool), integral(),
                                3 * body.numNodes, noneHeld(3 * body.numNodes));
    Eigen::VectorXd x = test::randomState(3 * body.numNodes + term.numMultipliers(), 2e-3, 9);
    x.tail(term.numMultipliers()) = test::randomState(term.numMultipliers(), 0.1, 3);
    EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6) << tool.name;
    EXPECT_GT(term.state().reaction(2), 0.0) << tool.name;
  }
}

/// ∫ g M_A dΓ of a plate that is tilted against the face is that of a polynomial.
TEST(IntegralContact, ConstraintsOfAPressedFaceAreIntegralsOfTheGap) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool plate{"plate", Plane{{0.0, 0.49, 0.0}, {0.01, -1.0, 0.0}}};
  const int first = 2 * body.numNodes;
  IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(plate), integral(), first,
                              noneHeld(first));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(first + term.numMultipliers());
  const Eigen::VectorXd force = test::forceOf(term, 0.0, x);
  // The gap is linear along the face, so that B-spline quasi-interpolation at the anchors has no error.
  const Eigen::VectorXd gaps = term.referenceGaps(gapTo(plate, plate.pose(0.0)));
  EXPECT_NEAR(force.tail(gaps.size()).sum(), term.weights().dot(gaps), 1e-15);
  EXPECT_NEAR(term.state().area, 1.0, 1e-14);
  EXPECT_NEAR(term.state().largestPenetration(), -term.smallestReferenceGap(gapTo(plate, plate.pose(0.0))),
              2e-3);
}

/// Tools whose curvature jumps within the span that they press: a wedge with a tip, a box with its corner, two discs, a curve.
std::vector<Tool> kinkedTools() {
  const Edge wedge{{0.47, 0.48, 0.0}, {0.1, -1.0, 0.0}, Direction(Eigen::Vector3d::UnitZ()), 150.0, 0.05};
  const RoundedBox box{{0.75, 0.62, 0.0}, {0.6, 0.3, 1.0}, 0.1, Eigen::Matrix3d::Identity()};
  Eigen::Matrix3Xd points(3, 6);
  points << 0.2, 0.3, 0.45, 0.55, 0.7, 0.9, 0.6, 0.5, 0.47, 0.49, 0.5, 0.62, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  const Patch<1, 3> curve(
      TensorBasis<1>({UnivariateBasis::bspline(KnotVector(2, {0, 0, 0, 1, 2, 3, 4, 4, 4}))}), points,
      Eigen::VectorXd::Ones(6));
  return {{"wedge", wedge},
          {"box", box},
          {"discs", Union{{Cylinder{{0.4, 0.67, 0.0}, {0.0, 0.0, 1.0}, 0.2},
                           Cylinder{{0.6, 0.57, 0.0}, {0.0, 0.0, 1.0}, 0.1}},
                          0.0}},
          {"curve", makeNurbsShape(curve, false)}};
}

TEST(IntegralContact, ToolsWhoseCurvatureJumpsHaveAConsistentTangentAndExactForces) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const int first = 2 * body.numNodes;
  for (const Tool& tool : kinkedTools()) {
    IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(tool), integral(), first,
                                noneHeld(first));
    const Eigen::VectorXd x = test::randomState(first + term.numMultipliers(), 2e-3, 7);
    // Where the discs meet the normal jumps, too, and the tangent does not know that such a place moves.
    EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), tool.name == "discs" ? 1e-5 : 1e-6) << tool.name;

    // The force of the flat face without multipliers is r times the area between it and the tool.
    static_cast<void>(test::forceOf(term, 0.0, Eigen::VectorXd::Zero(x.size())));
    constexpr int kPieces = 200000;
    double area = 0.0;
    for (int k = 0; k < kPieces; ++k)
      area += std::max(0.0, -tool.query(tool.pose(0.0), {(k + 0.5) / kPieces, 0.5, 0.0}).gap) / kPieces;
    EXPECT_GT(area, 1e-3) << tool.name;
    EXPECT_NEAR(term.state().pressed, kParameter * area, 1e-6 * kParameter * area) << tool.name;
  }
}

/// Control points that a support holds across the face share the multiplier of their neighbour.
TEST(IntegralContact, HeldEndsHaveNoMultiplierOfTheirOwn) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool = disc();
  const int first = 2 * body.numNodes;
  std::vector<bool> held = noneHeld(first);
  const auto functions = faceFunctions(body.patches[0].basis(), faceFromName<2>("top"));
  held[static_cast<std::size_t>(2 * functions.front() + 1)] = true;  // across the face
  held[static_cast<std::size_t>(2 * functions.back())] = true;       // along it
  IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(tool), integral(), first, held);
  EXPECT_EQ(term.numMultipliers(), term.face().numFunctions() - 1);
  EXPECT_NEAR(term.weights().sum(), 1.0, 1e-14);
  Eigen::VectorXd x = test::randomState(first + term.numMultipliers(), 2e-3, 7);
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-7);

  const int n = term.face().numFunctions();
  const Eigen::VectorXd ofAll = IntegralContactTerm<2>(body, 0, faceFromName<2>("top"), onTool<2>(tool),
                                                       integral(), first, noneHeld(first))
                                    .weights();
  EXPECT_LT((term.functionWeights() - ofAll).norm(), 1e-14);
  const Eigen::VectorXd coefficients = Eigen::VectorXd::LinSpaced(n, 1.0, n);
  term.setMultipliers(0, coefficients, x);
  Eigen::VectorXd shared = coefficients;
  shared.head(2).setConstant(1.5);
  EXPECT_EQ(term.multipliers(0, x), shared);
}

TEST(IntegralContact, TractionsAlongTheFaceHaveMultipliersBehindThoseAcross) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool = disc();
  const int first = 2 * body.numNodes;
  std::vector<bool> held = noneHeld(first);
  const auto functions = faceFunctions(body.patches[0].basis(), faceFromName<2>("top"));
  held[static_cast<std::size_t>(2 * functions.back())] = true;  // along the face
  ContactOptions rubs = integral();
  rubs.friction = FormulaText{"0.3"};
  IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(tool), rubs, first, held);
  const int n = term.face().numFunctions();
  ASSERT_EQ(term.numMultipliers(), 2 * n - 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(first + term.numMultipliers());
  term.setMultipliers(1, Eigen::VectorXd::LinSpaced(n, 1.0, n), x);
  EXPECT_EQ(x.tail(n - 1).head(n - 2), Eigen::VectorXd::LinSpaced(n - 2, 1.0, n - 2));
  EXPECT_EQ(x(x.size() - 1), n - 0.5);
  EXPECT_TRUE(x.head(first + n).isZero(0.0));
}

/// A tool that nothing touches would have no stiffness; the nearest point holds it and says with what.
TEST(IntegralContact, AFreeToolStaysInTouchWithTheNearestPoint) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool = freeTool({"plate", Plane{{0.0, 0.6, 0.0}, {0.1, -1.0, 0.0}}}, 2 * body.numNodes);
  const int first = 2 * body.numNodes + static_cast<int>(kToolDofs);
  IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(tool), integral(), first,
                              noneHeld(2 * body.numNodes));
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(first + term.numMultipliers());
  EXPECT_TRUE(test::forceOf(term, 0.0, x).isZero(0.0));
  EXPECT_EQ(term.state().pull, 0.0);
  term.keepInTouch({});
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
  EXPECT_GT(term.state().pull, 0.0);
  EXPECT_LT(term.state().reaction(1), 0.0) << "the body pulls the tool";
}

TEST(IntegralContact, AStateThatLetsTheToolThroughIsNotAdmissible) {
  const Body<2> body = block(2, BasisFamily::BSpline);
  const Tool tool{"disc", Cylinder{{0.4, 0.5 + 0.1, 0.0}, Eigen::Vector3d::UnitZ(), 0.3}};
  const int first = 2 * body.numNodes;
  IntegralContactTerm<2> term(body, 0, faceFromName<2>("top"), onTool<2>(tool), integral(), first,
                              noneHeld(first));
  bool admissible = true;
  static_cast<void>(
      test::forceOf(term, 0.0, Eigen::VectorXd::Zero(first + term.numMultipliers()), &admissible));
  EXPECT_FALSE(admissible) << "0.2 deep in a disc of radius 0.3";
}

}  // namespace
}  // namespace burnish
