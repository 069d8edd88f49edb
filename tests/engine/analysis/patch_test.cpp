// The patch test: an affine displacement prescribed on the whole boundary of a distorted patch must be found
// exactly inside, with a uniform stress, for every basis and degree. With polynomial bases p+1 Gauss points
// integrate it exactly; rational integrands are not polynomials, so there the error is that of the quadrature
// and falls exponentially with the number of points.
#include <gtest/gtest.h>

#include <random>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/joined_body.h"
#include "engine/solver/newton.h"

namespace burnish {
namespace {

/// A ring segment with its inner control points moved about and its weights disturbed.
template <int Dim>
Body<Dim> distorted(const Patch<Dim>& patch, double amplitude, bool rational) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd points = patch.points();
  Eigen::VectorXd weights = rational ? patch.weights() : Eigen::VectorXd::Ones(patch.weights().size());
  for (int a = 0; a < patch.basis().numFunctions(); ++a) {
    for (int d = 0; d < Dim; ++d) points(d, a) += amplitude * uniform(generator);
    if (rational) weights(a) *= 1.0 + 0.2 * uniform(generator);
  }
  return makeBody(Patch<Dim>(patch.basis(), points, weights));
}

struct PatchError {
  double displacement;  ///< largest difference to the affine field
  double stress;        ///< largest difference between two points, over E
};

template <int Dim>
PatchError solvePatch(const Body<Dim>& body, const Material& material, double strain,
                      int pointsPerDirection = 0, Formulation formulation = Formulation::Displacement) {
  const SpanQuadrature<Dim> quadrature(body, pointsPerDirection);
  const auto bulk = makeBulkTerm(body, quadrature, material, formulation);
  const int size = Dim * body.numNodes;
  std::vector<bool> prescribed(static_cast<std::size_t>(size), false);
  const auto& patch = body.patches.front();
  for (int face = 0; face < 2 * Dim; ++face)
    for (const int a : faceFunctions(patch.basis(), face)) {
      const int node = body.nodes.front()[static_cast<std::size_t>(a)];
      for (int d = 0; d < Dim; ++d) prescribed[static_cast<std::size_t>(Dim * node + d)] = true;
    }

  Eigen::Matrix<double, Dim, Dim> H = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) H(i, j) = strain * (1.0 + i - 0.7 * j);
  Eigen::VectorXd exact(size);
  const Eigen::MatrixXd positions = body.nodePositions();
  for (int a = 0; a < body.numNodes; ++a) exact.segment<Dim>(Dim * a) = H * positions.col(a);

  Newton newton({bulk.get()}, prescribed, {size, 1e-12, Eigen::VectorXd::Zero(size), {}},
                {.tolerance = 1e-12});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  EXPECT_EQ(newton.solve(0.0, exact, x).outcome, NewtonOutcome::Converged);
  double spread = 0.0;
  for (const auto& tau : bulk->kirchhoffStress())
    spread = std::max(spread, (tau - bulk->kirchhoffStress().front()).cwiseAbs().maxCoeff());
  EXPECT_GT(bulk->kirchhoffStress().front().norm() / youngsModulus(material), 1e-4);
  return {(x - exact).cwiseAbs().maxCoeff(), spread / youngsModulus(material)};
}

void expectExact(const PatchError& error) {
  EXPECT_LT(error.displacement, 1e-11);
  EXPECT_LT(error.stress, 1e-11);
}

const Material kRubber = NeoHookean({1.0, 0.3});
const Material kMetal = J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, LinearHardening{0.5, 5.0}});

template <class Check>
void forEachDegree(bool rational, const Check& check) {
  for (int degree = 2; degree <= 4; ++degree) {
    const auto ring = refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.5),
                              {KnotVector::uniform(degree, 3), KnotVector::uniform(degree, 4)});
    const Body<2> body = distorted(ring, 0.03, rational);
    check(body, kRubber, 0.1);
    check(body, kMetal, 0.01);
  }
}

TEST(PatchTest, DistortedBSplinePatchesAreExactWithTheUsualQuadrature) {
  forEachDegree(false, [](const Body<2>& body, const Material& material, double strain) {
    expectExact(solvePatch(body, material, strain));
  });
}

TEST(PatchTest, DistortedRationalPatchesAreExactUpToQuadrature) {
  forEachDegree(true, [](const Body<2>& body, const Material& material, double strain) {
    const PatchError usual = solvePatch(body, material, strain), more = solvePatch(body, material, strain, 8);
    EXPECT_LT(usual.displacement, 5e-4);
    EXPECT_LT(more.displacement, 0.01 * usual.displacement);
    expectExact(solvePatch(body, material, strain, 18));
  });
}

TEST(PatchTest, DistortedLagrangePatchesAreExactWithTheUsualQuadrature) {
  for (int degree = 1; degree <= 4; ++degree) {
    const auto ring = lagrangeInterpolant(
        annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.5), degree,
        {KnotVector::uniform(1, 3).breakpoints(), KnotVector::uniform(1, 4).breakpoints()});
    const Body<2> body = distorted(ring, 0.01, false);
    expectExact(solvePatch(body, kRubber, 0.1));
    expectExact(solvePatch(body, kMetal, 0.01));
  }
}

TEST(PatchTest, DistortedPatchesInThreeDimensions) {
  const auto shell =
      refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.6, {0.0, 1.0}, {-0.3, 0.8}),
              {KnotVector::uniform(2, 2), KnotVector::uniform(2, 2), KnotVector::uniform(2, 2)});
  // Trilinear-times-quadratic maps: the integrand has degree 3p-1 in each direction.
  expectExact(solvePatch(distorted(shell, 0.02, false), kRubber, 0.05, 4));
  expectExact(solvePatch(distorted(shell, 0.02, false), kMetal, 0.01, 4));
  expectExact(solvePatch(distorted(shell, 0.02, true), kRubber, 0.05, 16));
}

TEST(PatchTest, DistortedPatchesAreExactWithTheProjectedDilatation) {
  const auto solve = [](const auto& body, const Material& material, double strain, int points = 0) {
    expectExact(solvePatch(body, material, strain, points, Formulation::ProjectedDilatation));
  };
  forEachDegree(false, [&](const Body<2>& body, const Material& material, double strain) {
    solve(body, material, strain);
  });
  for (int degree = 1; degree <= 3; ++degree) {
    const auto ring = lagrangeInterpolant(
        annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.5), degree,
        {KnotVector::uniform(1, 3).breakpoints(), KnotVector::uniform(1, 4).breakpoints()});
    solve(distorted(ring, 0.01, false), kRubber, 0.1);
  }
  const auto shell =
      refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.6, {0.0, 1.0}, {-0.3, 0.8}),
              {KnotVector::uniform(2, 2), KnotVector::uniform(2, 2), KnotVector::uniform(2, 2)});
  solve(distorted(shell, 0.02, false), kRubber, 0.05, 4);
}

TEST(PatchTest, RoundBodiesAreExactInBothFormulations) {
  const Patch<2> section = discSector({0.0, 0.0}, 1.0, 0.3, 2.0);
  const std::vector<Patch<3>> shapes{
      swept(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.5), {0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, 1.0),
      swept(disc({0.0, 0.0}, 1.0, 0.3), {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.0),
      swept(section, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0),
      ballOctant({0.0, 0.0, 0.0}, 1.0, {0.0, 0.0, -1.0})};
  const KnotVector knots = KnotVector::uniform(2, 2);
  for (const Patch<3>& shape : shapes) {
    const Body<3> body = joinedBody<3>({refined(shape, {knots, knots, knots})}, {""});
    for (const auto formulation : {Formulation::Displacement, Formulation::ProjectedDilatation}) {
      expectExact(solvePatch(body, kRubber, 0.05, 10, formulation));
      expectExact(solvePatch(body, kMetal, 0.01, 10, formulation));
    }
  }
}

}  // namespace
}  // namespace burnish
