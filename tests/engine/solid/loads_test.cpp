#include <gtest/gtest.h>

#include <numbers>

#include "engine/core/error.h"
#include "engine/core/formula.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/dead_load.h"
#include "engine/solid/follower_load.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

constexpr double kPi = std::numbers::pi;

Body<2> quarterRing() {
  return makeBody(refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 0.5 * kPi),
                          {KnotVector::uniform(2, 2), KnotVector::uniform(2, 3)}));
}

Body<3> quarterShell() {
  return makeBody(refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}),
                          {KnotVector::uniform(1, 1), KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)}));
}

template <int Dim>
FollowerLoad<Dim> follower(const Body<Dim>& body, const std::string& face, const std::string& intensity,
                           typename FollowerLoad<Dim>::Direction direction, int points = 0) {
  const FaceId side = faceFromName<Dim>(face);
  return {
      body, 0, side, FaceQuadrature<Dim>(body, 0, side, points), direction, Formula(FormulaText{intensity}),
      {}};
}

/// Sum of the nodal forces at a state.
template <int Dim>
Eigen::Vector<double, Dim> resultant(LoadTerm& load, const Eigen::VectorXd& x) {
  static_cast<void>(test::forceOf(load, 1.0, x));
  Eigen::Vector<double, Dim> sum = Eigen::Vector<double, Dim>::Zero();
  for (Eigen::Index i = 0; i < load.nodalForces().size(); ++i) sum(i % Dim) += load.nodalForces()(i);
  return sum;
}

TEST(Formula, KnowsCoordinatesTimeAndDefinitions) {
  const std::vector<DefinitionSpec> definitions{{"a", {"2 + t"}}, {"b", {"a * X"}}};
  const Formula formula(FormulaText{"b + Y^2 - Z"}, definitions);
  EXPECT_DOUBLE_EQ(formula({3.0, 2.0, 1.0}, 1.0), 9.0 + 4.0 - 1.0);
  EXPECT_TRUE(formula.dependsOn("t"));
  EXPECT_TRUE(formula.dependsOn("X"));
  EXPECT_FALSE(Formula(FormulaText{"1"}, definitions).dependsOn("t"));
  EXPECT_THROW(Formula(FormulaText{"c + 1"}, definitions), Error);
  EXPECT_THROW(Formula(FormulaText{"1 +"}), Error);
  EXPECT_THROW(Formula(FormulaText{"b"}, {{"b", {"c"}}, {"c", {"1"}}}), Error)
      << "definitions use earlier ones only";
  EXPECT_THROW(static_cast<void>(Formula(FormulaText{"ln(X)"})(Eigen::Vector3d::Zero(), 0.0)), Error);
}

TEST(Formula, RefusesWhatMuparserWouldTakeSilently) {
  EXPECT_THROW(Formula(FormulaText{"0,5"}), Error);
  EXPECT_THROW(Formula(FormulaText{"X = 3"}), Error);
  EXPECT_DOUBLE_EQ(Formula(FormulaText{"min(3, 2) + (t >= 0) + (t == 0)"}).constant(), 4.0);
}

TEST(DeadLoad, StaysWhatItIsAtTheStartWhileToolsComeDown) {
  const Body<2> body = quarterRing();
  const FaceQuadrature<2> face(body, 0, faceFromName<2>("right"), 0);
  DeadLoad<2> load(body, face, {Formula(FormulaText{"sqrt(t)"}), Formula(FormulaText{"2"})}, {});
  static_cast<void>(test::forceOf(load, -0.5, Eigen::VectorXd::Zero(2 * body.numNodes)));
  EXPECT_EQ(load.nodalForces()(0), 0.0);
}

TEST(DeadLoad, SumsToTractionTimesLengthAndSchedule) {
  const Body<2> body = quarterRing();
  const FaceQuadrature<2> face(body, 0, faceFromName<2>("right"), 8);
  DeadLoad<2> load(body, face, {Formula(FormulaText{"3"}), Formula(FormulaText{"-2 * t"})},
                   {{0.0, 2.0}, {0.0, 1.0}});
  const Eigen::Vector2d sum = resultant<2>(load, Eigen::VectorXd::Zero(2 * body.numNodes));
  const double arc = 2.0 * 0.5 * kPi;
  EXPECT_NEAR(sum(0), 0.5 * 3.0 * arc, 1e-11);
  EXPECT_NEAR(sum(1), -0.5 * 2.0 * arc, 1e-11);
}

TEST(DeadLoad, ActsOnPartOfAFace) {
  const Body<2> body = makeBody(
      refined(rectangle({0.0, 0.0}, {4.0, 1.0}), {KnotVector::uniform(2, 3), KnotVector::uniform(2, 1)}));
  // Not at knots: the quadrature ends where the part ends.
  const FaceQuadrature<2> face(body, 0, faceFromName<2>("top"), 0, {0.1, 0.45});
  DeadLoad<2> load(body, face, {Formula(FormulaText{"X"}), Formula(FormulaText{"1"})}, {});
  const Eigen::Vector2d sum = resultant<2>(load, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(sum(0), 0.5 * (1.8 * 1.8 - 0.4 * 0.4), 1e-13);
  EXPECT_NEAR(sum(1), 1.4, 1e-13);
}

TEST(DeadLoad, IntegratesABodyForceOverTheVolume) {
  const Body<2> body = quarterRing();
  const SpanQuadrature<2> quadrature(body, 8);
  DeadLoad<2> load(body, quadrature, -1, {Formula(FormulaText{"X"}), Formula(FormulaText{"1"})}, {});
  const Eigen::Vector2d sum = resultant<2>(load, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(sum(0), 7.0 / 3.0, 1e-11) << "first moment of a quarter ring, (8 - 1)/3";
  EXPECT_NEAR(sum(1), 0.25 * kPi * 3.0, 1e-11);
}

TEST(FollowerLoad, PressureOfAClosedSurfaceHasNoResultant) {
  const Body<2> body = quarterRing();
  const Eigen::VectorXd x = test::randomState(2 * body.numNodes, 0.1, 3);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const char* face : {"left", "right", "bottom", "top"}) {
    auto load = follower<2>(body, face, "1.7", FollowerLoad<2>::Direction::Pressure, 12);
    sum += resultant<2>(load, x);
  }
  EXPECT_LT(sum.norm(), 1e-12);

  const Body<3> shell = quarterShell();
  const Eigen::VectorXd y = test::randomState(3 * shell.numNodes, 0.05, 4);
  Eigen::Vector3d sum3 = Eigen::Vector3d::Zero();
  for (const char* face : {"left", "right", "bottom", "top", "back", "front"}) {
    auto load = follower<3>(shell, face, "1.7", FollowerLoad<3>::Direction::Pressure, 12);
    sum3 += resultant<3>(load, y);
  }
  EXPECT_LT(sum3.norm(), 1e-10);
}

TEST(FollowerLoad, PressesAgainstTheOutwardNormal) {
  const Body<2> body = quarterRing();
  auto inner = follower<2>(body, "left", "2", FollowerLoad<2>::Direction::Pressure, 8);
  const Eigen::Vector2d sum = resultant<2>(inner, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(sum(0), 2.0, 1e-10) << "pressure times the projected length of the inner arc, outwards";
  EXPECT_NEAR(sum(1), 2.0, 1e-10);
}

TEST(FollowerLoad, ShearIsTheChordTimesItsIntensity) {
  const Body<2> body = quarterRing();
  auto load = follower<2>(body, "right", "3", FollowerLoad<2>::Direction::Shear, 8);
  const Eigen::Vector2d sum = resultant<2>(load, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(sum(0), 3.0 * -2.0, 1e-12) << "∫ m da is the difference of the face's ends";
  EXPECT_NEAR(sum(1), 3.0 * 2.0, 1e-12);
}

TEST(FollowerLoad, TangentAgreesWithCentralDifferences) {
  Body<2> body = quarterRing();
  const Eigen::VectorXd x = test::randomState(2 * body.numNodes, 0.1, 5);
  for (const bool axisymmetric : {false, true})
    for (const auto direction : {FollowerLoad<2>::Direction::Pressure, FollowerLoad<2>::Direction::Shear}) {
      body.axisymmetric = axisymmetric;
      auto load = follower<2>(body, "right", "1 + X + 2 * Y", direction);
      EXPECT_FALSE(load.hasSymmetricTangent());
      EXPECT_LT(test::tangentError(load, 0.5, x, 1e-6), 1e-8) << axisymmetric;
    }
  const Body<3> shell = quarterShell();
  auto load = follower<3>(shell, "right", "1 + X - Z", FollowerLoad<3>::Direction::Pressure);
  EXPECT_LT(test::tangentError(load, 0.5, test::randomState(3 * shell.numNodes, 0.05, 6), 1e-6), 1e-8);
}

TEST(FollowerLoad, AxisymmetricPressureActsOnTheWholeRing) {
  Body<2> body = makeBody(
      refined(rectangle({1.0, 0.0}, {1.0, 0.5}), {KnotVector::uniform(2, 2), KnotVector::uniform(2, 1)}));
  body.axisymmetric = true;
  auto load = follower<2>(body, "top", "3", FollowerLoad<2>::Direction::Pressure);
  const Eigen::Vector2d sum = resultant<2>(load, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(sum(1), -3.0 * kPi * (4.0 - 1.0), 1e-11);
}

}  // namespace
}  // namespace burnish
