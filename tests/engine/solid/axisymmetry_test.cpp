// Bodies of revolution: volumes, areas, motions and states with known answers.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/contact/contact_term.h"
#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/dead_load.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

using std::numbers::pi;

Body<2> revolved(const Patch<2>& cut) {
  Body<2> body = makeBody(cut);
  body.axisymmetric = true;
  return body;
}

/// A tube of radii 1 and 2 and height 1.
Body<2> tube(int degree = 2) {
  return revolved(refined(rectangle({1.0, 0.0}, {1.0, 1.0}),
                          {KnotVector::uniform(degree, 3), KnotVector::uniform(degree, 2)}));
}

/// A disc that contains the axis.
Body<2> disc() {
  return revolved(
      refined(rectangle({0.0, 0.0}, {2.0, 1.0}), {KnotVector::uniform(2, 4), KnotVector::uniform(2, 2)}));
}

Eigen::VectorXd displacement(const Body<2>& body, double radial, double axial, double lift) {
  Eigen::VectorXd x(2 * body.numNodes);
  for (int a = 0; a < body.numNodes; ++a) {
    const Eigen::Vector2d X = body.patches[0].points().col(a);
    x.segment<2>(2 * a) = Eigen::Vector2d(radial * X(0), axial * X(1) + lift);
  }
  return x;
}

TEST(Axisymmetry, MeasuresVolumesAndAreasOfWholeRings) {
  EXPECT_NEAR(SpanQuadrature<2>(tube()).volume(), 3.0 * pi, 1e-12);
  EXPECT_NEAR(SpanQuadrature<2>(disc()).volume(), 4.0 * pi, 1e-12);
  const Body<2> sphere = revolved(annulus({0.0, 0.0}, 1.0, 2.0, -0.5, 1.0));
  EXPECT_NEAR(SpanQuadrature<2>(sphere, 12).volume(), 2.0 * pi * 7.0 / 3.0 * 2.0 * std::sin(0.5), 1e-11);

  const Body<2> body = tube();
  DeadLoad<2> load(body, FaceQuadrature<2>(body, 0, faceFromName<2>("top"), 0),
                   {Formula(FormulaText{"0"}), Formula(FormulaText{"3"})}, {});
  const Eigen::VectorXd force = test::forceOf(load, 0.0, Eigen::VectorXd::Zero(2 * body.numNodes));
  EXPECT_NEAR(-force.sum(), 3.0 * 3.0 * pi, 1e-12);
}

TEST(Axisymmetry, SizesOfFaceSpansAreThoseOfTheCut) {
  const FaceQuadrature<2> face(tube(), 0, faceFromName<2>("right"), 0);
  EXPECT_NEAR(face.spans().front().size, 0.5, 1e-14);
}

TEST(Axisymmetry, RefusesABodyAcrossTheAxis) {
  const Body<2> body = revolved(rectangle({-0.5, 0.0}, {1.0, 1.0}));
  try {
    const SpanQuadrature<2> quadrature(body);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("patch 1 crosses the axis"), std::string::npos) << error.what();
  }
}

class AxisymmetricBulk : public testing::TestWithParam<Formulation> {};

TEST_P(AxisymmetricBulk, AxialTranslationCostsNothing) {
  const Body<2> body = disc();
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, NeoHookean({1.0, 0.3}), GetParam());
  EXPECT_LT(test::forceOf(*term, 0.0, displacement(body, 0.0, 0.0, 0.7)).norm(), 1e-12);
  EXPECT_GT(test::forceOf(*term, 0.0, displacement(body, 0.01, 0.0, 0.0)).norm(), 1e-3);
}

TEST_P(AxisymmetricBulk, UniformStretchIsExact) {
  // F = diag(1.1, 0.9, 1.1): stress and energy of the law itself, and forces in equilibrium inside the body.
  const NeoHookean law({1.0, 0.3});
  NeoHookean::State state;
  MaterialResponse<2> exact;
  ASSERT_TRUE(law.evaluate<2>(Eigen::Vector3d(1.1, 0.9, 1.1).asDiagonal(), {}, state, exact));
  const Body<2> body = disc();
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, law, GetParam());
  const Eigen::VectorXd force = test::forceOf(*term, 0.0, displacement(body, 0.1, -0.1, 0.0));
  for (const auto& tau : term->kirchhoffStress()) EXPECT_LT((tau - exact.tau).norm(), 1e-13);
  for (const double J : term->jacobians()) EXPECT_NEAR(J, 1.1 * 0.9 * 1.1, 1e-14);
  EXPECT_NEAR(term->summary().strainEnergy, 4.0 * pi * exact.strainEnergy, 1e-12);

  Eigen::VectorXd inside = force;
  for (const char* face : {"right", "bottom", "top"})
    for (const int a : faceFunctions(body.patches[0].basis(), faceFromName<2>(face)))
      inside.segment<2>(2 * a).setZero();
  EXPECT_LT(inside.norm(), 1e-13) << "the axis is inside";
  double top = 0.0;
  for (const int a : faceFunctions(body.patches[0].basis(), faceFromName<2>("top"))) top += force(2 * a + 1);
  EXPECT_NEAR(top, 4.0 * pi * exact.tau(1) / 0.9, 1e-12) << "first Piola-Kirchhoff stress times the area";
}

TEST_P(AxisymmetricBulk, RefusesToPassThroughTheAxis) {
  const Body<2> body = tube();
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, NeoHookean({1.0, 0.3}), GetParam());
  bool admissible = true;
  static_cast<void>(test::forceOf(*term, 0.0, displacement(body, -2.2, 0.0, 0.0), &admissible));
  EXPECT_FALSE(admissible) << "plane and circumference are both turned inside out, J is positive";
}

INSTANTIATE_TEST_SUITE_P(Formulations, AxisymmetricBulk,
                         testing::Values(Formulation::Displacement, Formulation::ProjectedDilatation),
                         [](const auto& formulation) {
                           return formulation.param == Formulation::Displacement ? "Displacement"
                                                                                 : "Projected";
                         });

TEST(AxisymmetricContact, PressesOnWholeRings) {
  const Body<2> body = disc();
  const Tool plane{"plane", Plane{{2.5, 0.9, 0.0}, {0.6, -0.8, 0.0}}, {}};
  ContactTerm<2> term(body, 0, faceFromName<2>("top"), plane, {Enforcement::PointwisePenalty, 10.0}, 0);
  const Eigen::VectorXd force = test::forceOf(term, 0.0, Eigen::VectorXd::Zero(2 * body.numNodes));
  double radial = 0.0, axial = 0.0;
  for (int a = 0; a < body.numNodes; ++a) {
    radial += force(2 * a);
    axial += force(2 * a + 1);
  }
  EXPECT_NEAR(term.weights().sum(), 4.0 * pi, 1e-12);
  EXPECT_NE(radial, 0.0);
  EXPECT_EQ(term.state().reaction(0), 0.0) << "the ring's radial forces on the tool balance";
  EXPECT_NEAR(term.state().reaction(1), axial, 1e-12);
}

TEST(AxisymmetricContact, RefusesQuadraticElementsOnTheAxis) {
  const Body<2> body =
      revolved(lagrangeInterpolant(rectangle({0.0, 0.0}, {2.0, 1.0}), 2, {{0.0, 0.5, 1.0}, {0.0, 1.0}}));
  const Tool plane{"plane", Plane{{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}, {}};
  EXPECT_THROW(ContactTerm<2>(body, 0, faceFromName<2>("top"), plane,
                              {Enforcement::AugmentedLagrangian, 10.0}, 2 * body.numNodes),
               Error);
}

}  // namespace
}  // namespace burnish
