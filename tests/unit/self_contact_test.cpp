#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/self_contact_term.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "tests/unit/term_check.h"

namespace burnish {
namespace {

/// A ring around a flat hole, open on its right: two jaws that face each other across the hole. Rational.
Body<2> jaws(int degree, BasisFamily family) {
  const Patch<2> sheet = rectangle({1.0, 0.5}, {0.5, 5.3});  // radii and angles
  const KnotVector across = KnotVector::uniform(degree, 2), around = KnotVector::uniform(degree, 12);
  const Patch<2> polar =
      family == BasisFamily::BSpline
          ? refined(sheet, {across, around})
          : lagrangeInterpolant(sheet, degree,
                                {across.breakpoints(), KnotVector::uniform(1, 12).breakpoints()});
  Eigen::MatrixXd points = polar.points();
  for (auto point : points.colwise())
    point = point(0) * Eigen::Vector2d(std::cos(point(1)), 0.2 * std::sin(point(1)));
  Eigen::VectorXd weights = polar.weights();
  for (Eigen::Index a = 0; a < weights.size(); ++a)
    weights(a) += 0.1 * std::sin(3.0 * static_cast<double>(a));
  return makeBody(Patch<2>(polar.basis(), std::move(points), std::move(weights)));
}

constexpr FaceId kInner = 0;

struct Case {
  BasisFamily family;
  int degree;
};

/// The jaws in a random state near the reference, with multipliers that press wherever there are partners.
struct Pressed {
  Body<2> body;
  SelfContactTerm term;
  Eigen::VectorXd x;

  explicit Pressed(const Case& c, bool axisymmetric = false)
      : body([&] {
          Body<2> made = jaws(c.degree, c.family);
          made.axisymmetric = axisymmetric;
          return made;
        }()),
        term(body, 0, kInner, {10.0, 0.6, 0}, 2 * body.numNodes),
        x(test::randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 11)) {
    x.tail(term.numMultipliers()).array() -= 8.0;
  }
};

class SelfContact : public testing::TestWithParam<Case> {};

TEST_P(SelfContact, TangentAgreesWithCentralDifferencesAndIsSymmetric) {
  Pressed pressed(GetParam());
  EXPECT_LT(test::tangentError(pressed.term, 0.0, pressed.x, 1e-6), 1e-6);
  EXPECT_LT(test::asymmetry(test::tangentOf(pressed.term, 0.0, pressed.x)), 1e-12);
  EXPECT_GT(pressed.term.state().numActive(), 3);
}

TEST_P(SelfContact, ForcesAreInBalance) {
  Pressed pressed(GetParam());
  const Eigen::VectorXd force = test::forceOf(pressed.term, 0.0, pressed.x);
  const Eigen::Index n = pressed.body.numNodes;
  const Eigen::Matrix2Xd forces = force.head(2 * n).reshaped(2, n);
  const Eigen::Matrix2Xd places = pressed.body.nodePositions() + pressed.x.head(2 * n).reshaped(2, n);
  const double scale = forces.norm();
  ASSERT_GT(scale, 1.0);
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12 * scale);
  EXPECT_LT(std::abs(places.row(0).dot(forces.row(1)) - places.row(1).dot(forces.row(0))), 1e-12 * scale);
  EXPECT_GT(pressed.term.state().force.norm(), 1.0);
}

TEST_P(SelfContact, ForcesAreTheDerivativeOfTheAveragedGaps) {
  Pressed pressed(GetParam());
  const auto energy = [&](const Eigen::VectorXd& x) {
    static_cast<void>(test::forceOf(pressed.term, 0.0, x));
    const SelfContactState& state = pressed.term.state();
    double work = 0.0;
    const Eigen::VectorXd force = test::forceOf(pressed.term, 0.0, x);
    for (int A = 0; A < pressed.term.numMultipliers(); ++A) {
      if (!state.active[static_cast<std::size_t>(A)]) continue;
      const double G = force(pressed.term.firstMultiplier() + A), g = state.averageGap(A);
      work += x(pressed.term.firstMultiplier() + A) * G + 0.5 * 10.0 * g * G;
    }
    return work;
  };
  const Eigen::VectorXd direction = test::randomState(2 * pressed.body.numNodes, 1.0, 5);
  constexpr double h = 1e-6;
  Eigen::VectorXd forward = pressed.x, backward = pressed.x;
  forward.head(direction.size()) += h * direction;
  backward.head(direction.size()) -= h * direction;
  const double difference = (energy(forward) - energy(backward)) / (2.0 * h);
  const double force = test::forceOf(pressed.term, 0.0, pressed.x).head(direction.size()).dot(direction);
  EXPECT_NEAR(force, difference, 1e-7 * std::abs(force));
}

INSTANTIATE_TEST_SUITE_P(Bases, SelfContact,
                         testing::Values(Case{BasisFamily::BSpline, 2}, Case{BasisFamily::BSpline, 3},
                                         Case{BasisFamily::BSpline, 4}, Case{BasisFamily::Lagrange, 2}));

TEST(SelfContactPartners, OuterFaceHasNone) {
  const Body<2> body = jaws(2, BasisFamily::BSpline);
  SelfContactTerm term(body, 0, 1, {10.0, 0.6, 0}, 2 * body.numNodes);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  EXPECT_TRUE((term.state().gap.array() > 1e300).all());
}

TEST(SelfContactPartners, GapIsTheWidthOfTheHole) {
  const Body<2> body = jaws(3, BasisFamily::BSpline);
  SelfContactTerm term(body, 0, kInner, {10.0, 0.6, 0}, 2 * body.numNodes);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  const auto trace = tracePatch(body.patches.front(), kInner);
  const Eigen::Matrix2Xd places = term.positionsApart(0.0);
  Eigen::Index top = 0;
  const double height = places.row(1).maxCoeff(&top);
  double nearest = 1.0;
  for (int k = 0; k <= 20000; ++k) {
    const Eigen::Vector2d place = trace.position(Eigen::Vector<double, 1>(k / 20000.0));
    if (place(1) < -0.5 * height) nearest = std::min(nearest, (place - places.col(top)).norm());
  }
  EXPECT_NEAR(term.state().gap(top), nearest, 1e-6);
}

TEST(SelfContactPartners, SidesOfAThinTipAreNone) {
  const Body<2> body = jaws(2, BasisFamily::BSpline);
  Eigen::MatrixXd points = body.patches.front().points();
  points.row(1) *= 0.1;
  const Body<2> needle =
      makeBody(Patch<2>(body.patches.front().basis(), points, body.patches.front().weights()));
  SelfContactTerm term(needle, 0, 1, {10.0, 0.6, 0}, 2 * needle.numNodes);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * needle.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  EXPECT_TRUE((term.state().gap.array() > 1e300).all());
}

}  // namespace
}  // namespace burnish
