#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/contact/face_partner.h"
#include "engine/contact/mortar_contact_term.h"
#include "engine/contact/partner_contact.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

/// A ring around a flat hole, open on its right, around the place `at`: two jaws that
/// face each other across the hole. Rational.
Body<2> jaws(int degree, BasisFamily family, const Eigen::Vector2d& at = {3.0, 0.0}) {
  const Patch<2> sheet = rectangle({1.0, 0.5}, {0.5, 5.3});  // radii and angles
  const KnotVector across = KnotVector::uniform(degree, 2), around = KnotVector::uniform(degree, 12);
  const Patch<2> polar =
      family == BasisFamily::BSpline
          ? refined(sheet, {across, around})
          : lagrangeInterpolant(sheet, degree,
                                {across.breakpoints(), KnotVector::uniform(1, 12).breakpoints()});
  Eigen::MatrixXd points = polar.points();
  for (auto point : points.colwise())
    point = at + point(0) * Eigen::Vector2d(std::cos(point(1)), 0.2 * std::sin(point(1)));
  Eigen::VectorXd weights = polar.weights();
  for (Eigen::Index a = 0; a < weights.size(); ++a)
    weights(a) += 0.1 * std::sin(3.0 * static_cast<double>(a));
  return makeBody(Patch<2>(polar.basis(), std::move(points), std::move(weights)));
}

using test::kInner;

/// Contact of a face of the body's only patch with itself; multipliers follow the displacements.
MortarContactTerm<2> selfContact(const Body<2>& body, FaceId face, ContactOptions options = {}) {
  const Patch<2>& patch = body.patches.front();
  options.parameter = 10.0;
  const auto makePartner = [&](const FaceQuadrature<2>& slave) {
    return std::make_unique<FacePartner<2>>(slave, tracePatch(patch, face), outwardSign(patch, face),
                                            MasterSurface<2>(body, {{0, face}}), selfContactRules(0.6, 0));
  };
  return {body, 0, face, makePartner, options, 2 * body.numNodes};
}

struct SelfContactCase {
  BasisFamily family;
  int degree;
  bool axisymmetric = false;
  Eigen::Vector2d at = {3.0, 0.0};
  std::optional<double> gapLimit = std::nullopt;
  double friction = 0.0;

  ContactOptions options() const {
    ContactOptions options;
    options.gapLimit = gapLimit;
    if (friction > 0.0) options.friction = FormulaText{fmt::format("{}", friction)};
    return options;
  }
};

/// The jaws in a random state near the reference, with multipliers that press wherever there are partners.
struct PressedTogether {
  Body<2> body;
  MortarContactTerm<2> term;
  Eigen::VectorXd x;

  explicit PressedTogether(const SelfContactCase& c)
      : body([&] {
          Body<2> made = jaws(c.degree, c.family, c.at);
          made.axisymmetric = c.axisymmetric;
          return made;
        }()),
        term(selfContact(body, kInner, c.options())),
        x(test::randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 11)) {
    const int functions = term.face().numFunctions();
    x.segment(2 * body.numNodes, functions).array() -= 8.0;
    if (c.friction == 0.0) return;
    // A step in which the parts slide along each other, before which friction held some of them.
    static_cast<void>(test::forceOf(term, 0.0, x));
    term.accept();
    x.tail(functions) = test::randomState(functions, 4.0, 12);
    x.head(2 * body.numNodes) += test::randomState(2 * body.numNodes, 2e-2, 13);
  }
};

/// Most gaps count in part.
const SelfContactCase kLimited{BasisFamily::BSpline, 2, false, {3.0, 0.0}, 0.7};

const std::vector<SelfContactCase> kFrictionless{{BasisFamily::BSpline, 2},
                                                 {BasisFamily::BSpline, 3},
                                                 {BasisFamily::BSpline, 4},
                                                 {BasisFamily::Lagrange, 1},
                                                 {BasisFamily::Lagrange, 2},
                                                 {BasisFamily::BSpline, 2, true},
                                                 {BasisFamily::Lagrange, 2, true},
                                                 kLimited,
                                                 {BasisFamily::Lagrange, 2, true, {3.0, 0.0}, 0.7}};

class SelfContact : public testing::TestWithParam<SelfContactCase> {};
class FrictionlessSelfContact : public testing::TestWithParam<SelfContactCase> {};

TEST_P(SelfContact, TangentAgreesWithCentralDifferencesAndIsSymmetricWithoutFriction) {
  PressedTogether pressed(GetParam());
  EXPECT_LT(test::tangentError(pressed.term, 0.0, pressed.x, 1e-6), 1e-6);
  const ContactState& state = pressed.term.state();
  EXPECT_GT(state.numActive(), 3);
  if (GetParam().friction == 0.0) {
    EXPECT_LT(test::asymmetry(test::tangentOf(pressed.term, 0.0, pressed.x)), 1e-12);
    return;
  }
  EXPECT_GT(state.sticking, 0);
  EXPECT_GT(state.slipping, 0);
}

TEST_P(SelfContact, ForcesAreInBalance) {
  PressedTogether pressed(GetParam());
  const Eigen::VectorXd force = test::forceOf(pressed.term, 0.0, pressed.x);
  const Eigen::Index n = pressed.body.numNodes;
  const Eigen::Matrix2Xd forces = force.head(2 * n).reshaped(2, n);
  const Eigen::Matrix2Xd places = pressed.body.nodePositions() + pressed.x.head(2 * n).reshaped(2, n);
  const double scale = forces.norm();
  ASSERT_GT(scale, 1.0);
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12 * scale);
  EXPECT_LT(std::abs(places.row(0).dot(forces.row(1)) - places.row(1).dot(forces.row(0))),
            1e-12 * scale * places.norm());
  EXPECT_GT(pressed.term.state().reaction.norm(), 1.0);
}

TEST_P(FrictionlessSelfContact, ForcesAreTheDerivativeOfTheAveragedGaps) {
  PressedTogether pressed(GetParam());
  const auto energy = [&](const Eigen::VectorXd& x) {
    static_cast<void>(test::forceOf(pressed.term, 0.0, x));
    const ContactState& state = pressed.term.state();
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

INSTANTIATE_TEST_SUITE_P(Bases, FrictionlessSelfContact, testing::ValuesIn(kFrictionless));
INSTANTIATE_TEST_SUITE_P(Bases, SelfContact, testing::ValuesIn(kFrictionless));
INSTANTIATE_TEST_SUITE_P(Friction, SelfContact,
                         testing::Values(SelfContactCase{BasisFamily::BSpline, 2, false, {3.0, 0.0}, {}, 0.3},
                                         SelfContactCase{
                                             BasisFamily::BSpline, 3, true, {3.0, 0.0}, 0.7, 0.3}));

/// The jaws as wide as they are, of two spans, in space; degree 2.
Body<3> wideJaws() {
  const Patch<3> polar =
      refined(box({1.0, 0.5, 0.0}, {0.5, 5.3, 1.0}),  // radii, angles and widths
              {KnotVector::uniform(1, 1), KnotVector::uniform(2, 9), KnotVector::uniform(2, 2)});
  Eigen::MatrixXd points = polar.points();
  for (auto point : points.colwise())
    point = Eigen::Vector3d(point(0) * std::cos(point(1)), 0.2 * point(0) * std::sin(point(1)), point(2));
  Eigen::VectorXd weights = polar.weights();
  for (Eigen::Index a = 0; a < weights.size(); ++a)
    weights(a) += 0.1 * std::sin(3.0 * static_cast<double>(a));
  return makeBody(Patch<3>(polar.basis(), std::move(points), std::move(weights)));
}

struct ByMethod {
  Enforcement method;
  double friction = 0.0;
};

/// The jaws are pressed into one another until a part of them touches, in two steps, in the second of which they
/// slide, too: tangent against central differences, sums of forces and moments.
template <int Dim>
void expectConsistencyOfClosedJaws(const Body<Dim>& body, const ByMethod& how) {
  const Patch<Dim>& patch = body.patches.front();
  const int numDisplacements = Dim * body.numNodes;
  ContactOptions options{how.method, 10.0, Dim == 3 ? 3 : 4};
  options.frictionParameter = 7.0;
  if (how.friction > 0.0) options.friction = FormulaText{fmt::format("{}", how.friction)};
  const auto term = makePartnerContact<Dim>(
      body, 0, kInner,
      [&](const FaceQuadrature<Dim>& slave) {
        return std::make_unique<FacePartner<Dim>>(
            slave, tracePatch(patch, kInner), outwardSign(patch, kInner),
            MasterSurface<Dim>(body, {{0, kInner}}), selfContactRules(0.6, 0));
      },
      options, numDisplacements, std::vector<bool>(static_cast<std::size_t>(numDisplacements), false), {});
  const auto pressed = [&](double depth, double way) {
    Eigen::VectorXd x = test::randomState(numDisplacements + term->numMultipliers(), 2e-3, 11);
    for (int a = 0; a < body.numNodes; ++a) {
      const double side = body.nodePositions()(1, a) > 0.0 ? 1.0 : -1.0;
      x(Dim * a) += side * way;
      x(Dim * a + 1) -= side * depth;
      if (Dim == 3) x(Dim * a + 2) += 0.5 * side * way;
    }
    return x;
  };
  static_cast<void>(test::forceOf(*term, 0.0, pressed(0.1, 0.0)));
  term->accept();
  const Eigen::VectorXd x = pressed(0.14, 0.02);
  const Eigen::VectorXd force = test::forceOf(*term, 0.0, x);
  const ContactState& state = term->state();
  EXPECT_GT(state.pressure.maxCoeff(), 0.1);
  EXPECT_FALSE((state.pressure.array() > 0.0).all());
  EXPECT_LT(test::tangentError(*term, 0.0, x, 1e-6), 1e-6);
  if (how.friction == 0.0) {
    EXPECT_LT(test::asymmetry(test::tangentOf(*term, 0.0, x)), 1e-12);
  } else {
    EXPECT_GT(how.friction < 1.0 ? state.slipping : state.sticking, 0);
  }

  const Eigen::Matrix<double, Dim, Eigen::Dynamic> forces =
      force.head(numDisplacements).reshaped(Dim, body.numNodes);
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> places =
      body.nodePositions() + x.head(numDisplacements).reshaped(Dim, body.numNodes);
  const Eigen::Matrix<double, Dim, Dim> moments = places * forces.transpose();
  const double scale = forces.colwise().norm().sum();
  EXPECT_GT(state.reaction.norm(), 0.1 * scale);
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12 * scale);
  EXPECT_LT((moments - moments.transpose()).norm(), 1e-12 * scale * places.colwise().norm().maxCoeff());
}

class SelfContactInSpace : public testing::TestWithParam<ByMethod> {};

TEST_P(SelfContactInSpace, TangentAgreesWithCentralDifferencesAndForcesAreInBalance) {
  expectConsistencyOfClosedJaws<3>(wideJaws(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Methods, SelfContactInSpace,
                         testing::Values(ByMethod{Enforcement::AugmentedLagrangian},
                                         ByMethod{Enforcement::AugmentedLagrangian, 0.2},
                                         ByMethod{Enforcement::IntegralAugmentedLagrangian},
                                         ByMethod{Enforcement::IntegralAugmentedLagrangian, 0.2},
                                         ByMethod{Enforcement::MortarPenalty},
                                         ByMethod{Enforcement::MortarPenalty, 0.2},
                                         ByMethod{Enforcement::MortarPenalty, 5.0},
                                         ByMethod{Enforcement::PointwisePenalty},
                                         ByMethod{Enforcement::PointwisePenalty, 0.2},
                                         ByMethod{Enforcement::PointwisePenalty, 5.0}));

TEST(SelfContactByPenalty, TangentAgreesWithCentralDifferencesAndForcesAreInBalance) {
  for (const Enforcement method : {Enforcement::MortarPenalty, Enforcement::PointwisePenalty})
    for (const bool axisymmetric : {false, true})
      for (const double friction : {0.0, 0.3}) {
        Body<2> body = jaws(2, BasisFamily::BSpline);
        body.axisymmetric = axisymmetric;
        expectConsistencyOfClosedJaws<2>(body, {method, friction});
      }
}

// Slaves above a ridge of linear elements are closest to its edge.
class SelfContactAboveAKink : public testing::TestWithParam<std::optional<double>> {};

TEST_P(SelfContactAboveAKink, TangentAgreesWithCentralDifferences) {
  const Body<2> smooth = jaws(1, BasisFamily::Lagrange);
  const Patch<2>& patch = smooth.patches.front();
  const int ridge = faceFunctions(patch.basis(), kInner)[9];
  Eigen::MatrixXd points = patch.points();
  points(1, ridge) += 0.2;  // as steep as a corner, which stays sharp
  const Body<2> body = makeBody(Patch<2>(patch.basis(), points, patch.weights()));
  ContactOptions options;
  options.gapLimit = GetParam();
  auto term = selfContact(body, kInner, options);
  Eigen::VectorXd x = test::randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 11);
  x.tail(term.numMultipliers()).array() -= 8.0;
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
  static_cast<void>(test::forceOf(term, 0.0, x));
  const Eigen::Vector2d edge = points.col(ridge) + x.segment<2>(2 * ridge);
  Eigen::Index q = 0;
  const Eigen::Matrix2Xd feet = term.face().positions(x) - term.state().normal.topRows<2>() *
                                                               term.state().gap.cwiseMin(1e3).asDiagonal();
  EXPECT_LT((feet.colwise() - edge).colwise().norm().minCoeff(&q), 1e-14);
  EXPECT_GT(term.state().pressure(q), 0.0);
}

INSTANTIATE_TEST_SUITE_P(GapLimits, SelfContactAboveAKink, testing::Values(std::nullopt, 0.4));

TEST(SelfContactPartners, DoNotDependOnTheOrigin) {
  PressedTogether here({BasisFamily::BSpline, 2}), there({BasisFamily::BSpline, 2, false, {3000.0, 1000.0}});
  static_cast<void>(test::forceOf(here.term, 0.0, here.x));
  bool admissible = false;
  static_cast<void>(test::forceOf(there.term, 0.0, there.x, &admissible));
  ASSERT_TRUE(admissible);
  EXPECT_EQ(here.term.state().active, there.term.state().active);
  for (Eigen::Index q = 0; q < here.term.state().gap.size(); ++q) {
    const double gap = here.term.state().gap(q);
    EXPECT_EQ(std::isfinite(there.term.state().gap(q)), std::isfinite(gap));
    if (!std::isfinite(gap)) continue;
    EXPECT_NEAR(there.term.state().gap(q), gap, 1e-10);
  }
}

TEST(SelfContactPartners, OpenPlacesBearNoPressure) {
  int full = 0, part = 0, open = 0;
  for (const double share : {0.7, 0.25}) {
    SelfContactCase limited = kLimited;
    limited.gapLimit = share;
    PressedTogether pressed(limited);
    static_cast<void>(test::forceOf(pressed.term, 0.0, pressed.x));
    const ContactState& state = pressed.term.state();
    for (const auto& span : pressed.term.face().spans())
      for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
        const double gap = state.gap(span.firstPoint + q), limit = share * span.size;
        const double unlimited = -span.R.col(q).dot(state.lambdaHat(span.functions));
        if (!std::isfinite(gap) || unlimited == 0.0) continue;
        (gap < limit ? full : gap < 3.0 * limit ? part : open) += 1;
        const double slope = gap < 3.0 * limit ? limitedGap(gap, limit).slope : 0.0;
        EXPECT_NEAR(state.pressure(span.firstPoint + q), slope * unlimited, 1e-12 * unlimited);
      }
  }
  EXPECT_GT(full, 0);
  EXPECT_GT(part, 0);
  EXPECT_GT(open, 0);
}

// A function over open places only would have an empty row.
TEST(SelfContactPartners, WhatIsOpenIsNotActive) {
  SelfContactCase narrow = kLimited;
  narrow.gapLimit = 1e-3;
  PressedTogether pressed(narrow);
  static_cast<void>(test::forceOf(pressed.term, 0.0, pressed.x));
  EXPECT_EQ(pressed.term.state().numActive(), 0);
}

TEST(SelfContactPartners, OuterFaceHasNone) {
  const Body<2> body = jaws(2, BasisFamily::BSpline);
  auto term = selfContact(body, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  EXPECT_TRUE((term.state().gap.array() > 1e300).all());
}

TEST(SelfContactPartners, GapIsTheWidthOfTheHole) {
  const Body<2> body = jaws(3, BasisFamily::BSpline, {0.0, 0.0});
  auto term = selfContact(body, kInner);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  const auto trace = tracePatch(body.patches.front(), kInner);
  const Eigen::Matrix2Xd places = term.face().positions(x);
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
  const Body<2> body = jaws(2, BasisFamily::BSpline, {0.0, 0.0});
  Eigen::MatrixXd points = body.patches.front().points();
  points.row(1) *= 0.1;
  const Body<2> needle =
      makeBody(Patch<2>(body.patches.front().basis(), points, body.patches.front().weights()));
  auto term = selfContact(needle, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * needle.numNodes + term.numMultipliers());
  static_cast<void>(test::forceOf(term, 0.0, x));
  EXPECT_TRUE((term.state().gap.array() > 1e300).all());
}

}  // namespace
}  // namespace burnish
