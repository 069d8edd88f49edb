#include <gtest/gtest.h>

#include <random>

#include "engine/contact/contact_term.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "tests/unit/term_check.h"

namespace burnish {
namespace {

/// A 1 x 0.5 block of 6 x 2 spans whose top face is pressed by a tool.
Body<2> block(int degree, BasisFamily family) {
  const Patch<2> shape = rectangle({0.0, 0.0}, {1.0, 0.5});
  if (family == BasisFamily::BSpline)
    return makeBody(refined(shape, {KnotVector::uniform(degree, 6), KnotVector::uniform(degree, 2)}));
  return makeBody(
      lagrangeInterpolant(shape, degree, {KnotVector::uniform(1, 6).breakpoints(), {0.0, 0.5, 1.0}}));
}

Tool disc() {
  return {"disc", Cylinder{{0.4, 0.5 + 0.24, 0.0}, Eigen::Vector3d::UnitZ(), 0.3}, {}};
}

Eigen::VectorXd randomState(Eigen::Index size, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

struct Case {
  Enforcement enforcement;
  BasisFamily family;
  int degree;
};

class ContactTangent : public testing::TestWithParam<Case> {};

TEST_P(ContactTangent, AgreesWithCentralDifferences) {
  const auto [enforcement, family, degree] = GetParam();
  const Body<2> body = block(degree, family);
  const Tool tool = disc();
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), tool, {enforcement, 10.0, 0}, 2 * body.numNodes);
  Eigen::VectorXd x = randomState(2 * body.numNodes + term.numMultipliers(), 2e-3, 7);
  EXPECT_LT(test::tangentError(term, 0.0, x, 1e-6), 1e-6);
  EXPECT_GT(term.state().reaction(1), 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ContactTangent,
                         testing::Values(Case{Enforcement::AugmentedLagrangian, BasisFamily::BSpline, 2},
                                         Case{Enforcement::AugmentedLagrangian, BasisFamily::BSpline, 3},
                                         Case{Enforcement::AugmentedLagrangian, BasisFamily::Lagrange, 2},
                                         Case{Enforcement::MortarPenalty, BasisFamily::BSpline, 2},
                                         Case{Enforcement::MortarPenalty, BasisFamily::Lagrange, 4},
                                         Case{Enforcement::PointwisePenalty, BasisFamily::BSpline, 2}));

}  // namespace
}  // namespace burnish
