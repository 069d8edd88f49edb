// Coulomb friction of a face on a rigid tool.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/contact/partner_contact.h"
#include "engine/contact/tool_partner.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

struct FrictionCase {
  double mu = 0.0;  ///< rough if zero
  BasisFamily family = BasisFamily::BSpline;
  int degree = 2;
  bool axisymmetric = false;
  bool isFree = false;
  std::optional<double> shearLimit{};
  std::string law{};  ///< instead of mu
  Enforcement method = Enforcement::IntegralAugmentedLagrangian;
  bool spins = false;    ///< a ball about its middle
  bool follows = false;  ///< a surface, and is free to turn

  bool sticks() const { return mu == 0.0 || mu > 1.0; }

  ContactOptions options() const {
    ContactOptions options{method, 10.0, 8};
    options.rough = mu == 0.0;
    if (mu > 0.0) options.friction = FormulaText{fmt::format("{}", mu)};
    if (!law.empty()) options.friction = FormulaText{law};
    options.shearLimit = shearLimit;
    options.frictionParameter = 7.0;
    return options;
  }
};

template <int Dim>
Tool movedTool(Tool tool, const FrictionCase& c, int firstUnknown) {
  if (c.spins) {
    tool.pivot = tool.shape.middle();
    tool.turnLength = 0.3;
    for (std::size_t k = 0; k < 3; ++k) {
      tool.unknowns[k] = firstUnknown + static_cast<int>(k);
      tool.unknowns[kSpin + k] = firstUnknown + 3 + static_cast<int>(k);
    }
    return tool;
  }
  tool.pivot = {0.3, 0.8, 0.1};
  if (Dim == 3) tool.axis = Eigen::Vector3d(0.2, -0.3, 1.0).normalized();
  tool.turnLength = 1.7;
  if (c.follows) {
    tool.motion[0] = [](double t) { return 0.003 * t; };
    tool.normal = [](double t) { return Eigen::Vector3d(0.3 + t, 0.8, Dim == 3 ? 0.5 : 0.0).normalized(); };
    tool.unknowns[kNormal] = firstUnknown;
    tool.unknowns[kTurn] = firstUnknown + 1;
    return tool;
  }
  if (c.isFree) {
    for (std::size_t dof = 0; dof < kToolDofs; ++dof)
      tool.unknowns[dof] = firstUnknown + static_cast<int>(dof);
  } else {
    tool.motion[0] = [](double t) { return 0.003 * t; };
    tool.motion[kTurn] = [](double t) { return 0.02 * t; };
  }
  return tool;
}

/// A block under a tool: pressed and accepted in one random state, looked at in another one near to it.
template <int Dim>
struct Rubbed {
  Body<Dim> body;
  int first;
  Tool tool;
  std::unique_ptr<FaceContact<Dim>> contact;
  FaceContact<Dim>& term;
  Eigen::VectorXd x;

  Rubbed(Body<Dim> itsBody, FaceId face, const Tool& itsTool, const FrictionCase& c)
      : body(std::move(itsBody)),
        first(Dim * body.numNodes + (c.spins     ? 6
                                     : c.follows ? 2
                                     : c.isFree  ? static_cast<int>(kToolDofs)
                                                 : 0)),
        tool(movedTool<Dim>(itsTool, c, Dim * body.numNodes)),
        contact(makePartnerContact<Dim>(
            body, 0, face, onTool<Dim>(tool), c.options(), first,
            std::vector<bool>(static_cast<std::size_t>(Dim * body.numNodes), false), {})),
        term(*contact) {
    const Eigen::VectorXd before = test::randomState(first + term.numMultipliers(), 2e-3, 7);
    static_cast<void>(test::forceOf(term, 0.0, before));
    term.accept();
    x = before + test::randomState(before.size(), 3e-3, 11);
    x.tail(term.numMultipliers()) = test::randomState(term.numMultipliers(), 0.2, 3);
  }
};

Rubbed<2> rubbedBlock(const FrictionCase& c) {
  const Patch<2> shape = rectangle({0.0, 0.0}, {1.0, 0.5});
  Body<2> body =
      c.family == BasisFamily::BSpline
          ? makeBody(refined(shape, {KnotVector::uniform(c.degree, 6), KnotVector::uniform(c.degree, 2)}))
          : makeBody(lagrangeInterpolant(shape, c.degree,
                                         {KnotVector::uniform(1, 6).breakpoints(), {0.0, 0.5, 1.0}}));
  body.axisymmetric = c.axisymmetric;
  return {std::move(body), faceFromName<2>("top"),
          Tool{"disc", Cylinder{{0.4, 0.5 + 0.24, 0.0}, Eigen::Vector3d::UnitZ(), 0.3}}, c};
}

Rubbed<3> rubbedBox(const FrictionCase& c) {
  return {
      makeBody(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}),
                       {KnotVector::uniform(2, 3), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)})),
      faceFromName<3>("front"), Tool{"ball", Sphere{{0.45, 0.55, 0.5 + 0.7}, 0.8}}, c};
}

class Friction : public testing::TestWithParam<FrictionCase> {};

TEST_P(Friction, TangentAgreesWithCentralDifferences) {
  Rubbed rubbed = rubbedBlock(GetParam());
  EXPECT_FALSE(rubbed.term.hasSymmetricTangent());
  EXPECT_LT(test::tangentError(rubbed.term, 1.0, rubbed.x, 1e-6), 1e-6);
  const ContactState& state = rubbed.term.state();
  EXPECT_GT(state.frictionForce, 0.0);
  const auto count = [&](int kind) { return std::count(state.sliding.begin(), state.sliding.end(), kind); };
  EXPECT_GT(count(GetParam().sticks() ? 1 : 2), 0);
  EXPECT_GT(count(0), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, Friction,
    testing::Values(FrictionCase{}, FrictionCase{.mu = 0.1}, FrictionCase{.mu = 5.0},
                    FrictionCase{.mu = 0.1, .degree = 3},
                    FrictionCase{.mu = 0.1, .family = BasisFamily::Lagrange},
                    FrictionCase{.mu = 0.1, .axisymmetric = true}, FrictionCase{.axisymmetric = true},
                    FrictionCase{.mu = 0.1, .isFree = true}, FrictionCase{.isFree = true},
                    FrictionCase{.mu = 0.1, .shearLimit = 0.05},
                    FrictionCase{.mu = 0.1, .law = "0.01 + 0.05*exp(-p) + 0.02*X*t"},
                    FrictionCase{.mu = 0.1, .axisymmetric = true, .law = "0.02*p^(-1/3)"}));

/// Stick, slip, rings, free tools and laws of methods that average gaps, and of penalties.
std::vector<FrictionCase> casesOf(Enforcement method) {
  std::vector<FrictionCase> cases{FrictionCase{},
                                  FrictionCase{.mu = 0.1},
                                  FrictionCase{.mu = 5.0},
                                  FrictionCase{.mu = 0.1, .axisymmetric = true},
                                  FrictionCase{.mu = 0.02, .isFree = true},
                                  FrictionCase{.isFree = true},
                                  FrictionCase{.mu = 0.1, .shearLimit = 0.05},
                                  FrictionCase{.mu = 0.1, .law = "0.01 + 0.05*exp(-p) + 0.02*X*t"}};
  for (FrictionCase& c : cases) c.method = method;
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Mortar, Friction, testing::ValuesIn(casesOf(Enforcement::AugmentedLagrangian)));
INSTANTIATE_TEST_SUITE_P(MortarPenalty, Friction, testing::ValuesIn(casesOf(Enforcement::MortarPenalty)));
INSTANTIATE_TEST_SUITE_P(PointwisePenalty, Friction,
                         testing::ValuesIn(casesOf(Enforcement::PointwisePenalty)));

class FrictionInSpace : public testing::TestWithParam<FrictionCase> {};

TEST_P(FrictionInSpace, TangentAgreesWithCentralDifferences) {
  Rubbed rubbed = rubbedBox(GetParam());
  // About the normal, so that slip has all directions: else the tangent is another one, on purpose.
  if (GetParam().spins) rubbed.x(3 * rubbed.body.numNodes + 5) += 0.5 * rubbed.tool.turnLength;
  EXPECT_LT(test::tangentError(rubbed.term, 1.0, rubbed.x, 1e-6), 1e-6);
  EXPECT_GT(rubbed.term.state().frictionForce, 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, FrictionInSpace,
                         testing::Values(FrictionCase{}, FrictionCase{.mu = 0.1},
                                         FrictionCase{.mu = 0.1, .isFree = true},
                                         FrictionCase{.isFree = true},
                                         FrictionCase{.mu = 0.1, .law = "0.1*p/(1 + p)"}));
INSTANTIATE_TEST_SUITE_P(Mortar, FrictionInSpace,
                         testing::ValuesIn(casesOf(Enforcement::AugmentedLagrangian)));
INSTANTIATE_TEST_SUITE_P(MortarPenalty, FrictionInSpace,
                         testing::ValuesIn(casesOf(Enforcement::MortarPenalty)));
INSTANTIATE_TEST_SUITE_P(PointwisePenalty, FrictionInSpace,
                         testing::ValuesIn(casesOf(Enforcement::PointwisePenalty)));

/// A ball that spins, of the method.
std::vector<FrictionCase> spinning() {
  std::vector<FrictionCase> cases;
  for (const auto& [name, method] : kNamesOf<Enforcement>)
    for (const double mu : {0.0, 0.1, 5.0}) cases.push_back({.mu = mu, .method = method, .spins = true});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Spinning, FrictionInSpace, testing::ValuesIn(spinning()));

/// A tool that follows a surface, of the method.
std::vector<FrictionCase> following() {
  std::vector<FrictionCase> cases;
  for (const auto& [name, method] : kNamesOf<Enforcement>)
    for (const double mu : {0.0, 0.1}) cases.push_back({.mu = mu, .method = method, .follows = true});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Following, Friction, testing::ValuesIn(following()));
INSTANTIATE_TEST_SUITE_P(Following, FrictionInSpace, testing::ValuesIn(following()));

TEST(FrictionOnAToolThatFollows, ItsEquationsAreItsForceAlongTheNormalAndItsMoment) {
  for (const FrictionCase& c : following()) {
    Rubbed rubbed = rubbedBox(c);
    const Eigen::VectorXd force = test::forceOf(rubbed.term, 1.0, rubbed.x);
    const ContactState& state = rubbed.term.state();
    const int unknown = 3 * rubbed.body.numNodes;
    EXPECT_NEAR(force(unknown), -state.reaction.dot(rubbed.tool.normal(1.0)), 1e-14);
    EXPECT_NEAR(force(unknown + 1), -state.moment.dot(rubbed.tool.axis) / rubbed.tool.turnLength, 1e-14);
    EXPECT_GT(state.frictionForce, 0.0);
  }
}

/// The consistent tangent would turn it by many radians, as friction keeps its size whatever the turn is.
TEST(FrictionOnASpinningBall, ThatAllOfItsContactTurnsOneWayFindsTheTurnThatEndsIt) {
  for (const Enforcement method :
       {Enforcement::IntegralAugmentedLagrangian, Enforcement::AugmentedLagrangian}) {
    Rubbed rubbed = rubbedBox({.mu = 0.02, .method = method, .spins = true});
    const int spins = 3 * rubbed.body.numNodes + 3;
    rubbed.x.tail(rubbed.term.numMultipliers()).setZero();
    rubbed.x(spins) += 0.1 * rubbed.tool.turnLength;
    std::vector<int> solved{spins, spins + 1, spins + 2};  // and components of friction
    const int numTangential = rubbed.term.numMultipliers() * 2 / 3;
    for (int k = 0; k < numTangential; ++k)
      solved.push_back(static_cast<int>(rubbed.x.size()) - numTangential + k);
    const auto moment = [&] {
      static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
      return rubbed.term.state().moment.norm();
    };
    const double before = moment();
    const auto& sliding = rubbed.term.state().sliding;
    if (method == Enforcement::IntegralAugmentedLagrangian) {
      EXPECT_EQ(std::ranges::count(sliding, 1), 0) << "all slips";
    }
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Eigen::VectorXd force = test::forceOf(rubbed.term, 1.0, rubbed.x);
      const Eigen::MatrixXd K = test::tangentOf(rubbed.term, 1.0, rubbed.x);
      rubbed.x(solved) -= K(solved, solved).fullPivLu().solve(force(solved));
      EXPECT_LT(rubbed.x.segment<3>(spins).norm(), 0.2 * rubbed.tool.turnLength) << iteration;
    }
    EXPECT_LT(moment(), 1e-3 * before);
  }
}

TEST(FrictionOnASpinningBall, ItsEquationsAreItsMoments) {
  for (const FrictionCase& c : spinning()) {
    Rubbed rubbed = rubbedBox(c);
    const Eigen::VectorXd force = test::forceOf(rubbed.term, 1.0, rubbed.x);
    const ContactState& state = rubbed.term.state();
    const int unknown = 3 * rubbed.body.numNodes;
    EXPECT_NEAR((force.segment<3>(unknown) + state.reaction).norm(), 0.0, 1e-14);
    EXPECT_NEAR((force.segment<3>(unknown + 3) + state.moment / rubbed.tool.turnLength).norm(), 0.0, 1e-14);
    EXPECT_GT(state.moment.norm(), 1e-6);
  }
}

/// Body and ball that turn together by a large angle do not slip, and the ball turns as its spin says.
TEST(FrictionOnASpinningBall, IsIndifferentToRigidMotions) {
  Rubbed rubbed = rubbedBox({.mu = 0.1, .spins = true});
  static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
  rubbed.term.accept();
  const Eigen::Vector3d reaction = rubbed.term.state().reaction;
  const Eigen::Vector3d theta(0.5, -0.3, 0.8), shift(0.2, -0.4, 0.1);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix();
  const int unknown = 3 * rubbed.body.numNodes;
  const Eigen::Vector3d center = rubbed.tool.pivot + rubbed.x.segment<3>(unknown);
  Eigen::VectorXd x = rubbed.x;
  for (int a = 0; a < rubbed.body.numNodes; ++a) {
    const Eigen::Vector3d X = rubbed.body.nodePositions().col(a), was = X + x.segment<3>(3 * a);
    x.segment<3>(3 * a) = R * (was - center) + center + shift - X;
  }
  x.segment<3>(unknown) += shift;
  x.segment<3>(unknown + 3) += theta * rubbed.tool.turnLength;
  static_cast<void>(test::forceOf(rubbed.term, 1.0, x));
  EXPECT_NEAR(rubbed.term.state().slip.norm(), 0.0, 1e-13);
  EXPECT_GT(reaction.norm(), 1e-4);
}

TEST(FrictionLaw, IsAskedWithTruePressureSlipTimeAndPlace) {
  ContactOptions options;
  options.friction = FormulaText{"a*p + 100*slip + 1000*t + X"};
  const FrictionLaw law(options, {{"a", {"2"}}});
  EXPECT_TRUE(law.needsStretch());
  const FrictionBound bound = law.at({{0.5, 0.0, 0.0}, 0.25, 0.125, 4.0}, 6.0);
  EXPECT_DOUBLE_EQ(bound.mu, 2.0 * 1.5 + 12.5 + 250.0 + 0.5);
  EXPECT_NEAR(bound.muByPressure, 2.0 / 4.0, 1e-9);
  EXPECT_EQ(bound.limit, std::numeric_limits<double>::infinity());
  options.shearLimit = 3.0;
  options.friction = FormulaText{"0.3"};
  const FrictionBound limited =
      FrictionLaw(options, {}).at({.X = Eigen::Vector3d::Zero(), .stretch = 2.0}, 1.0);
  EXPECT_EQ(limited.mu, 0.3);
  EXPECT_EQ(limited.limit, 6.0);
  options.friction = FormulaText{"0.1 - t"};
  EXPECT_THROW(static_cast<void>(FrictionLaw(options, {}).at({.X = Eigen::Vector3d::Zero(), .t = 1.0}, 1.0)),
               FormulaError);
  options.friction = FormulaText{"0.1*v"};
  EXPECT_THROW(FrictionLaw(options, {}), Error);
}

TEST(FrictionLaw, SlipIsAddedUpUnderPressure) {
  Rubbed rubbed = rubbedBlock({.mu = 0.1});
  static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
  const Eigen::VectorXd first = rubbed.term.state().slipped;
  EXPECT_GT(first.maxCoeff(), 0.0);
  for (Eigen::Index q = 0; q < first.size(); ++q)
    EXPECT_NEAR(first(q),
                rubbed.term.state().pressure(q) > 0.0 ? rubbed.term.state().slip.col(q).norm() : 0.0, 1e-16);
  rubbed.term.accept();
  static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
  EXPECT_NEAR(rubbed.term.state().slipped.maxCoeff(), first.maxCoeff(), 0.5 * first.maxCoeff());
}

/// Reaction and moment, those of friction included, are what a free tool's equations say.
TEST(FrictionOnAFreeTool, ReactionAndMomentAreTheForcesOnIt) {
  for (const auto& [name, method] : kNamesOf<Enforcement>) {
    Rubbed rubbed = rubbedBlock({.mu = 0.1, .isFree = true, .method = method});
    const Eigen::VectorXd force = test::forceOf(rubbed.term, 1.0, rubbed.x);
    const ContactState& state = rubbed.term.state();
    const int unknown = 2 * rubbed.body.numNodes;
    EXPECT_NEAR((force.segment<3>(unknown) + state.reaction).norm(), 0.0, 1e-15) << name;
    EXPECT_NEAR(force(unknown + 3), -state.moment.z() / rubbed.tool.turnLength, 1e-15) << name;
  }
}

/// A rigid motion of body and tool together is no slip and does no work, and turns forces.
TEST(FrictionOnAFreeTool, IsIndifferentToRigidMotions) {
  Rubbed rubbed = rubbedBlock({.mu = 0.1, .isFree = true});
  static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
  rubbed.term.accept();
  const double before = rubbed.term.state().frictionWork;
  const double angle = 0.7;
  const Eigen::Vector2d shift(0.2, -0.4), pivot = rubbed.tool.pivot.head<2>();
  const Eigen::Rotation2Dd R(angle);
  Eigen::VectorXd x = rubbed.x;
  const int unknown = 2 * rubbed.body.numNodes;
  const Eigen::Vector2d toolWas = x.segment<2>(unknown);
  const Eigen::Vector2d center = pivot + toolWas;
  for (int a = 0; a < rubbed.body.numNodes; ++a) {
    const Eigen::Vector2d X = rubbed.body.nodePositions().col(a), was = X + x.segment<2>(2 * a);
    x.segment<2>(2 * a) = R * (was - center) + center + shift - X;
  }
  x.segment<2>(unknown) += shift;
  x(unknown + 3) += angle * rubbed.tool.turnLength;
  const Eigen::Vector2d reaction = [&] {
    static_cast<void>(test::forceOf(rubbed.term, 1.0, rubbed.x));
    return Eigen::Vector2d(rubbed.term.state().reaction.head<2>());
  }();
  static_cast<void>(test::forceOf(rubbed.term, 1.0, x));
  const ContactState& state = rubbed.term.state();
  EXPECT_NEAR(state.slip.norm(), 0.0, 1e-14);
  EXPECT_NEAR((state.reaction.head<2>() - R * reaction).norm(), 0.0, 1e-14);
  EXPECT_GT(state.frictionForce, 1e-4);
  EXPECT_GT(std::abs(before), 1e-8);
}

}  // namespace
}  // namespace burnish
