// The projected formulation (F-bar) beside the displacement formulation: tangents, energies, the space of J̄,
// and what it is for, a nearly incompressible body that does not lock.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/dead_load.h"
#include "engine/solid/dilatation_projection.h"
#include "engine/solid/joined_body.h"
#include "engine/solver/newton.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

Body<2> lagrangeRing(int degree) {
  return makeBody(lagrangeInterpolant(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0), degree,
                                      {{0.0, 0.4, 1.0}, {0.0, 0.5, 1.0}}));
}

Body<3> shell(int degree) {
  return makeBody(
      refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}),
              {KnotVector::uniform(degree, 2), KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)}));
}

template <int Dim>
Body<Dim> axisymmetric(Body<Dim> body) {
  body.axisymmetric = true;
  return body;
}

Material rubber() {
  return NeoHookean({1.0, 0.3});
}
Material metal() {
  return J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, VoceHardening{0.5, 1.0, 10.0}});
}

Material metalWithBackStresses() {
  Chaboche::Parameters parameters;
  parameters.E = 100.0;
  parameters.nu = 0.3;
  parameters.hardening = VoceHardening{0.5, 1.0, 10.0};
  parameters.backStresses = {{20.0, 30.0}, {2.0, 0.0}};
  return Chaboche(parameters);
}

/// A stretch along the first axis with a disturbance, far beyond yield for the metal.
template <int Dim>
Eigen::VectorXd stretched(const Body<Dim>& body, double stretch, double disturbance) {
  Eigen::VectorXd x = test::randomState(Dim * body.numNodes, disturbance, 4);
  for (int a = 0; a < body.numNodes; ++a) x(Dim * a) += stretch * body.patches[0].points()(0, a);
  return x;
}

/// Largest error of the tangent, and its largest deviation from symmetry, over both laws.
template <int Dim>
void expectConsistentTangent(const Body<Dim>& body, Formulation formulation) {
  const SpanQuadrature<Dim> quadrature(body);
  const auto elastic = makeBulkTerm(body, quadrature, rubber(), formulation);
  const Eigen::VectorXd x = test::randomState(Dim * body.numNodes, 0.03, 1);
  EXPECT_LT(test::tangentError(*elastic, 0.0, x, 1e-6), 1e-7);
  EXPECT_LT(test::asymmetry(test::tangentOf(*elastic, 0.0, x)), 1e-13);

  const auto plastic = makeBulkTerm(body, quadrature, metal(), formulation);
  const Eigen::VectorXd y = stretched(body, 0.08, 0.004);
  ASSERT_TRUE(test::forceOf(*plastic, 0.0, y).allFinite());
  plastic->accept();
  ASSERT_GT(plastic->points().field("plastic_strain").maxCoeff(), 0.03);
  EXPECT_LT(test::tangentError(*plastic, 0.0, 1.3 * y, 1e-6), 1e-6);
  EXPECT_LT(test::asymmetry(test::tangentOf(*plastic, 0.0, 1.3 * y)), 1e-12);
}

/// The same of a law whose tangent is not symmetric where the direction of flow turns.
template <int Dim>
void expectConsistentTangentOfATurn(const Body<Dim>& body, Formulation formulation) {
  const SpanQuadrature<Dim> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, metalWithBackStresses(), formulation);
  EXPECT_FALSE(term->hasSymmetricTangent());
  const Eigen::VectorXd x = stretched(body, 0.08, 0.004);
  ASSERT_TRUE(test::forceOf(*term, 0.0, x).allFinite());
  term->accept();
  Eigen::VectorXd y = x + test::randomState(x.size(), 0.004, 9);
  for (int a = 0; a < body.numNodes; ++a) y(Dim * a + 1) += 0.1 * body.patches[0].points()(0, a);
  EXPECT_LT(test::tangentError(*term, 0.0, y, 1e-6), 1e-6);
  EXPECT_GT(test::asymmetry(test::tangentOf(*term, 0.0, y)), 1e-4);
}

/// Derivative of the stored energy along a direction, by central differences.
double energySlope(BulkTerm<2>& term, const Eigen::VectorXd& x, const Eigen::VectorXd& direction) {
  const auto energy = [&](double s) {
    static_cast<void>(test::forceOf(term, 0.0, x + s * direction));
    return term.summary().strainEnergy;
  };
  const double h = 1e-5;
  return (energy(h) - energy(-h)) / (2.0 * h);
}

class BulkTangent : public testing::TestWithParam<Formulation> {};

TEST_P(BulkTangent, AgreesWithCentralDifferencesInThePlane) {
  for (int degree = 1; degree <= 3; ++degree) expectConsistentTangent(test::ring(degree), GetParam());
  expectConsistentTangent(lagrangeRing(2), GetParam());
}

TEST_P(BulkTangent, AgreesWithCentralDifferencesInAxisymmetry) {
  for (int degree = 1; degree <= 3; ++degree)
    expectConsistentTangent(axisymmetric(test::ring(degree)), GetParam());
  expectConsistentTangent(axisymmetric(lagrangeRing(2)), GetParam());
}

TEST_P(BulkTangent, AgreesWithCentralDifferencesInThreeDimensions) {
  expectConsistentTangent(shell(1), GetParam());
  expectConsistentTangent(shell(2), GetParam());
}

TEST_P(BulkTangent, NeedNotBeSymmetric) {
  for (int degree = 1; degree <= 2; ++degree) {
    expectConsistentTangentOfATurn(test::ring(degree), GetParam());
    expectConsistentTangentOfATurn(axisymmetric(test::ring(degree)), GetParam());
    expectConsistentTangentOfATurn(shell(degree), GetParam());
  }
}

TEST_P(BulkTangent, ForceIsTheDerivativeOfTheStoredEnergy) {
  for (const Body<2>& body : {test::ring(2), axisymmetric(test::ring(3))}) {
    const SpanQuadrature<2> quadrature(body);
    const auto term = makeBulkTerm(body, quadrature, rubber(), GetParam());
    const Eigen::VectorXd x = test::randomState(2 * body.numNodes, 0.03, 5),
                          direction = test::randomState(x.size(), 1.0, 6);
    const double slope = energySlope(*term, x, direction);
    EXPECT_NEAR(slope, test::forceOf(*term, 0.0, x).dot(direction), 1e-7 * std::abs(slope));
  }
}

TEST_P(BulkTangent, HasTheSameBitsWithAnyNumberOfThreads) {
  const Body<2> body = test::ring(3);
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, rubber(), GetParam());
  const Eigen::VectorXd x = test::randomState(2 * body.numNodes, 0.03, 9);
  const Eigen::MatrixXd several = test::tangentOf(*term, 0.0, x);
  const Eigen::VectorXd force = test::forceOf(*term, 0.0, x);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(test::tangentOf(*term, 0.0, x), several);
  EXPECT_EQ(test::forceOf(*term, 0.0, x), force);
}

INSTANTIATE_TEST_SUITE_P(Formulations, BulkTangent,
                         testing::Values(Formulation::Displacement, Formulation::ProjectedDilatation),
                         [](const auto& formulation) {
                           return formulation.param == Formulation::Displacement ? "Displacement"
                                                                                 : "Projected";
                         });

/// A body whose first nodes are held, under a term that keeps products and one that does not.
template <int Dim>
void expectTheSameTangentByProducts(const Body<Dim>& body) {
  const SpanQuadrature<Dim> quadrature(body);
  const auto wide = makeBulkTerm(body, quadrature, metal(), Formulation::ProjectedDilatation);
  const auto narrow = makeBulkTerm(body, quadrature, metal(), Formulation::ProjectedDilatation);
  narrow->keepProducts();
  const Eigen::VectorXd x = stretched(body, 0.08, 0.004);
  std::vector<bool> held(static_cast<std::size_t>(x.size()), false);
  std::fill_n(held.begin(), 5, true);
  SparseSystem entries(held, {wide->couplings()}), products(held, {narrow->couplings()});
  const auto assemble = [&](BulkTerm<Dim>& term, SparseSystem& system, const Eigen::VectorXd& state) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
    Assembly out{force, &system, 0};
    ASSERT_TRUE(term.evaluate(0.0, state, out));
  };
  assemble(*wide, entries, x);
  for (int times = 0; times < 2; ++times) {
    products.setZero();
    assemble(*narrow, products, x);
  }
  const Eigen::MatrixXd expected = entries.whole();
  const double scale = expected.cwiseAbs().maxCoeff();
  EXPECT_LT((Eigen::MatrixXd(products.whole()) - expected).cwiseAbs().maxCoeff(), 1e-13 * scale);

  const Eigen::VectorXd direction = test::randomState(expected.cols(), 1.0, 10);
  Eigen::VectorXd product = products.leading() * direction;
  EXPECT_GT((product - expected * direction).norm(), 1e-3 * scale);  // the entries alone are another matrix
  products.addProducts(direction, product, Precision::Full);
  EXPECT_LT((product - expected * direction).norm(), 1e-12 * scale);
  const auto roughly = [&](const Eigen::VectorXd& of) {
    Eigen::VectorXd result = products.leading() * of;
    products.addProducts(of, result, Precision::Rough);
    return result;
  };
  const Eigen::VectorXd rough = roughly(direction);
  EXPECT_LT((rough - product).norm(), 1e-4 * product.norm());
  EXPECT_GT((rough - product).norm(), 1e-9 * product.norm());
  const Eigen::VectorXd other = test::randomState(expected.cols(), 1.0, 12);
  EXPECT_LT((roughly(direction + 0.3 * other) - rough - 0.3 * roughly(other)).norm(), 1e-6 * product.norm());
  EXPECT_LT(std::abs(other.dot(rough) - direction.dot(roughly(other))), 1e-5 * other.norm() * product.norm());
  const Eigen::VectorXd increments = test::randomState(x.size(), 1.0, 11);
  products.setZero();
  assemble(*narrow, products, stretched(body, 0.05, 0.003));  // of another state are others
  Eigen::VectorXd full = products.leading() * direction;
  products.addProducts(direction, full, Precision::Full);
  EXPECT_GT((full - product).norm(), 1e-3 * product.norm());
  EXPECT_LT((roughly(direction) - full).norm(), 1e-4 * full.norm());
  products.setZero();
  assemble(*narrow, products, x);
  const std::vector<int>& free = products.freeUnknowns();
  EXPECT_LT((products.timesPrescribed(increments) - entries.timesPrescribed(increments))(free).norm(),
            1e-12 * scale);
  EXPECT_LT(products.nonZeros(), entries.nonZeros());
}

TEST(DilatationProduct, IsTheTangentWithoutItsEntries) {
  expectTheSameTangentByProducts(test::ring(3));
  expectTheSameTangentByProducts(axisymmetric(test::ring(2)));
  expectTheSameTangentByProducts(
      makeBody(refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}),
                       {KnotVector::uniform(2, 3), KnotVector::uniform(2, 4), KnotVector::uniform(2, 3)})));
}

TEST(DilatationProduct, AddsNothingWhereOneSpanHasTheWholeBody) {
  const Body<3> body = makeBody(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}));
  const SpanQuadrature<3> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, rubber(), Formulation::ProjectedDilatation);
  term->keepProducts();
  const Eigen::VectorXd x = test::randomState(3 * body.numNodes, 0.03, 12);
  SparseSystem system(std::vector<bool>(static_cast<std::size_t>(x.size()), false), {term->couplings()});
  Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size()), product = force;
  Assembly out{force, &system, 0};
  ASSERT_TRUE(term->evaluate(0.0, x, out));
  ASSERT_TRUE(system.hasProducts());
  system.addProducts(x, product, Precision::Full);
  EXPECT_LT(product.norm(), 1e-13 * (system.leading() * x).norm());
}

/// Smallest and largest eigenvalue of the whole tangent against its entries without products, where the first quarter of
/// the unknowns is held.
std::array<double, 2> eigenvaluesAgainstEntries(const Body<3>& body, double nu) {
  const SpanQuadrature<3> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, NeoHookean({1.0, nu}), Formulation::ProjectedDilatation);
  term->keepProducts();
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(3 * body.numNodes);
  std::vector<bool> held(static_cast<std::size_t>(x.size()), false);
  std::fill_n(held.begin(), x.size() / 4, true);
  SparseSystem system(held, {term->couplings()});
  Eigen::VectorXd force = x;
  Assembly out{force, &system, 0};
  EXPECT_TRUE(term->evaluate(0.0, x, out));
  const Eigen::VectorXd eigenvalues =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
          Eigen::MatrixXd(system.whole()), Eigen::MatrixXd(system.leading()), Eigen::EigenvaluesOnly)
          .eigenvalues();
  return {eigenvalues.minCoeff(), eigenvalues.maxCoeff()};
}

/// What multigrid with F-bar rests on: a matrix with the pattern of the displacement formulation is near the tangent.
TEST(DilatationProduct, EntriesAreNearTheTangentAlsoNearIncompressibility) {
  const auto block = [](int degree, int spans) {
    const KnotVector knots = KnotVector::uniform(degree, spans);
    return makeBody(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots}));
  };
  for (const int spans : {3, 4, 5}) {
    const auto [least, most] = eigenvaluesAgainstEntries(block(2, spans), 0.49);
    EXPECT_GT(least, 0.25) << spans;
    EXPECT_LT(most, 3.0) << spans;
    const auto [softLeast, softMost] = eigenvaluesAgainstEntries(block(2, spans), 0.3);
    EXPECT_GT(softLeast, 0.75) << spans;
    EXPECT_LT(softMost, 1.5) << spans;
  }
  const auto [least, most] = eigenvaluesAgainstEntries(block(3, 4), 0.49);
  EXPECT_GT(least, 0.12);
  EXPECT_LT(most, 3.0);
}

/// Faces that are collapsed to a line or a point: spans beside them keep their own fits.
TEST(DilatationProduct, EntriesAreNearTheTangentOfABall) {
  const KnotVector knots = KnotVector::uniform(2, 4);
  const Body<3> body =
      makeBody(refined(ballOctant({0.0, 0.0, 0.0}, 1.0, {0.0, 0.0, 1.0}), {knots, knots, knots}));
  const auto [least, most] = eigenvaluesAgainstEntries(body, 0.3);
  EXPECT_GT(least, 0.25);
  EXPECT_LT(most, 2.0);
}

/// Control points that grade the block's parameters.
TEST(DilatationProduct, EntriesAreNearTheTangentOfAStretchedMap) {
  const KnotVector knots = KnotVector::uniform(2, 4);
  Patch<3> patch = refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots});
  const Eigen::MatrixXd points = patch.points().unaryExpr([](double x) { return 0.1 * x + 0.9 * x * x * x; });
  const auto [least, most] =
      eigenvaluesAgainstEntries(makeBody(Patch<3>(patch.basis(), points, patch.weights())), 0.49);
  EXPECT_GT(least, 0.2);
  EXPECT_LT(most, 3.5);
}

/// Polynomials of Π's space have on each span by itself the coefficients that they have; whether the shares are other ones
/// than those of the span's own fit.
template <int Dim>
bool keepPolynomialsOnSpans(const Body<Dim>& body, int pointsPerDirection = 0) {
  const SpanQuadrature<Dim> quadrature(body, pointsPerDirection);
  const DilatationProjection<Dim> projection(body, quadrature);
  bool areOthers = false;
  for (std::size_t e = 0; e < projection.spans().size(); ++e) {
    const auto& span = projection.spans()[e];
    const auto& source = quadrature.spans()[e];
    const TensorBasis<Dim>& basis = body.patches[static_cast<std::size_t>(source.patch)].basis();
    Eigen::VectorXd values = Eigen::VectorXd::Ones(source.weights.size());
    for (int d = 0; d < Dim; ++d)
      values.array() *= (0.3 - d + source.xi.row(d).transpose().array()).pow(basis.direction(d).degree() - 1);
    const Eigen::MatrixXd shares = projection.sharesByItself(e),
                          fit = span.averaged.cwiseInverse().asDiagonal() * span.L;
    EXPECT_EQ(shares.cols(), source.weights.size());
    EXPECT_LT((shares * values - fit * values).norm(), 1e-10 * fit.norm() * values.norm()) << e;
    areOthers = areOthers || (shares - fit).norm() > 1e-3 * fit.norm();
  }
  return areOthers;
}

TEST(DilatationProjection, KeepsPolynomialsOnSpansByThemselves) {
  const auto slab = [](int degree) {
    std::vector<double> added{0.1, 0.25};
    if (degree > 1) added.push_back(0.25);
    return makeBody(
        refined(rectangle({0.0, 0.0}, {1.0, 1.0}),
                {withKnots(KnotVector::uniform(degree, 3), added), KnotVector::uniform(degree, 4)}));
  };
  EXPECT_FALSE(keepPolynomialsOnSpans(slab(1)));
  for (int degree = 2; degree <= 4; ++degree) EXPECT_TRUE(keepPolynomialsOnSpans(slab(degree))) << degree;
  EXPECT_TRUE(keepPolynomialsOnSpans(slab(2), 4));
  EXPECT_FALSE(keepPolynomialsOnSpans(slab(2), 2)) << "points that tell no polynomial of the body's degree";
  EXPECT_FALSE(keepPolynomialsOnSpans(lagrangeRing(2)));
  EXPECT_TRUE(keepPolynomialsOnSpans(shell(2)));
}

/// Patches of other degrees across their common face, and so with other points on their spans.
TEST(DilatationProjection, TakesEachPatchWithItsOwnPoints) {
  const auto block = [](double origin, int degree) {
    return refined(box({origin, 0.0, 0.0}, {1.0, 1.0, 1.0}),
                   {KnotVector::uniform(degree, 3), KnotVector::uniform(2, 2), KnotVector::uniform(2, 2)});
  };
  for (const auto& [first, second] : {std::pair(2, 3), std::pair(3, 2)}) {
    const Body<3> body = joinedBody<3>({block(0.0, first), block(1.0, second)}, {"a", "b"});
    EXPECT_TRUE(keepPolynomialsOnSpans(body));
    const auto [least, most] = eigenvaluesAgainstEntries(body, 0.3);
    EXPECT_GT(least, 0.6);
    EXPECT_LT(most, 1.8);
  }
}

TEST(DilatationProjection, KeepsSplinesOfOneDegreeLessAndAllIntegrals) {
  for (const Body<2>& body :
       {test::ring(1), test::ring(2), test::ring(3), axisymmetric(test::ring(3)), lagrangeRing(3)}) {
    const SpanQuadrature<2> quadrature(body);
    const DilatationProjection<2> projection(body, quadrature);
    Eigen::VectorXd weights(quadrature.numPoints()), spline(weights.size());
    const Eigen::VectorXd coefficients = test::randomState(projection.numFunctions(), 1.0, 7);
    std::vector<int> firstPoints;
    for (std::size_t e = 0; e < projection.spans().size(); ++e) {
      const auto& span = quadrature.spans()[e];
      firstPoints.push_back(span.firstPoint);
      weights.segment(span.firstPoint, span.weights.size()) = span.weights;
      spline.segment(span.firstPoint, span.weights.size()) =
          projection.spans()[e].N.transpose() * coefficients(projection.spans()[e].functions);
    }
    EXPECT_LT((projection.project(firstPoints, spline) - spline).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::VectorXd field = test::randomState(weights.size(), 1.0, 8);
    EXPECT_NEAR(weights.dot(projection.project(firstPoints, field)), weights.dot(field), 1e-12);
    EXPECT_GT((projection.project(firstPoints, field) - field).norm(), 0.1 * field.norm());
  }
}

TEST(DilatationProjection, HasTheDerivativesOfTheBodysFunctions) {
  const auto basis = UnivariateBasis::bspline(withKnots(KnotVector::uniform(3, 4), {0.5}));
  const auto space = basis.derivativeSpace();
  EXPECT_EQ(space.degree(), 2);
  EXPECT_EQ(space.numFunctions(), basis.numFunctions() - 1);
  const auto elements = UnivariateBasis::lagrange(2, {0.0, 0.3, 1.0}).derivativeSpace();
  EXPECT_EQ(elements.degree(), 1);
  EXPECT_EQ(elements.numFunctions(), 4) << "two on each element, not joined";
  EXPECT_EQ(UnivariateBasis::lagrange(1, {0.0, 0.3, 1.0}).derivativeSpace().numFunctions(), 2);
  EXPECT_NEAR(elements.evaluate(1, 0.7, 0).sum(), 1.0, 1e-15);
}

TEST(ProjectedTerm, RefusesAStateThatIsInsideOut) {
  const Body<2> body = makeBody(rectangle({0.0, 0.0}, {1.0, 1.0}));
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, rubber(), Formulation::ProjectedDilatation);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(8);
  x(4 + 1) = x(6 + 1) = -1.5;
  bool admissible = true;
  static_cast<void>(test::forceOf(*term, 0.0, x, &admissible));
  EXPECT_FALSE(admissible);
}

/// One span of degree 2.
Body<2> unitSquare(const Eigen::Vector2d& corner) {
  return makeBody(
      refined(rectangle(corner, {1.0, 1.0}), {KnotVector::uniform(2, 1), KnotVector::uniform(2, 1)}));
}

/// u_x = a X P(Y) with P of mean zero and orthogonal to linear functions: on a unit square in the plane
/// J = 1 + a P, but J̄ = 1.
Eigen::VectorXd unseenDilatation(const Body<2>& body, double a) {
  // Bernstein coefficients of Y² − Y + 1/6, and of X.
  const std::array quadratic{1.0 / 6.0, -1.0 / 3.0, 1.0 / 6.0}, linear{0.0, 0.5, 1.0};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes);
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
      x(static_cast<Eigen::Index>(2 * (3 * j + i))) = a * linear[i] * quadratic[j];
  return x;
}

TEST(ProjectedTerm, ResistsLargeChangesOfVolumeThatTheProjectionDoesNotSee) {
  const double mu = 1.0 / 2.6;  // of `rubber`
  const Body<2> body = unitSquare({0.0, 0.0});
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, rubber(), Formulation::ProjectedDilatation);
  const auto& span = quadrature.spans().front();
  for (const double a : {0.1, 3.0, 10.0}) {
    ASSERT_TRUE(test::forceOf(*term, 0.0, unseenDilatation(body, a)).allFinite());
    double expected = 0.0, lawAlone = 0.0;
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      const double X = span.xi(0, q), Y = span.xi(1, q), J = 1.0 + a * (Y * Y - Y + 1.0 / 6.0);
      EXPECT_NEAR(term->jacobians()[static_cast<std::size_t>(q)], J, 1e-14);
      const double shear = a * X * (2.0 * Y - 1.0), traceOfC = (J * J + shear * shear + 1.0) / J;
      lawAlone += span.weights(q) * mu / 2.0 * (traceOfC - 2.0);
      expected += span.weights(q) * mu / 4.0 * std::pow(std::log(J), 4);
    }
    expected += lawAlone;
    EXPECT_NEAR(term->summary().strainEnergy, expected, 1e-12 * expected) << a;
    if (a == 0.1) {
      EXPECT_LT(expected, 1.00001 * lawAlone) << "small ones are free";
    }
    if (a == 10.0) {
      EXPECT_GT(expected, 1.1 * lawAlone);
    }
  }
}

TEST(ProjectedTerm, TangentIsRightWhereTheVolumeChangesMuchWithinASpan) {
  for (const bool isAxisymmetric : {false, true}) {
    Body<2> body = unitSquare({1.0, 0.0});
    body.axisymmetric = isAxisymmetric;
    const SpanQuadrature<2> quadrature(body);
    const Eigen::VectorXd x = unseenDilatation(body, 6.0) + test::randomState(2 * body.numNodes, 0.05, 1);
    for (const Material& material : {rubber(), metal()}) {
      const auto term = makeBulkTerm(body, quadrature, material, Formulation::ProjectedDilatation);
      ASSERT_TRUE(test::forceOf(*term, 0.0, x).allFinite());
      ASSERT_LT(term->summary().minJ, 0.6);
      EXPECT_LT(test::tangentError(*term, 0.0, x, 1e-6), 1e-6);
      EXPECT_LT(test::asymmetry(test::tangentOf(*term, 0.0, x)), 1e-12);
    }
  }
}

TEST(ProjectedTerm, ForceIsTheDerivativeOfTheEnergyWhereTheVolumeChangesMuchWithinASpan) {
  const Body<2> body = unitSquare({0.0, 0.0});
  const SpanQuadrature<2> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, rubber(), Formulation::ProjectedDilatation);
  const Eigen::VectorXd x = unseenDilatation(body, 6.0) + test::randomState(2 * body.numNodes, 0.05, 1),
                        direction = test::randomState(x.size(), 1.0, 6);
  EXPECT_NEAR(energySlope(*term, x, direction), test::forceOf(*term, 0.0, x).dot(direction), 1e-7);
}

TEST(ProjectedTerm, StoresTheCauchyStressOfTheLaw) {
  const Body<2> body = test::ring(2);
  const SpanQuadrature<2> quadrature(body);
  const auto projected =
      makeBulkTerm(body, quadrature, NeoHookean({1.0, 0.45}), Formulation::ProjectedDilatation);
  const auto plain = makeBulkTerm(body, quadrature, NeoHookean({1.0, 0.45}), Formulation::Displacement);
  const auto largestDifference = [&](const Eigen::VectorXd& x) {
    static_cast<void>(test::forceOf(*projected, 0.0, x));
    static_cast<void>(test::forceOf(*plain, 0.0, x));
    double difference = 0.0;
    for (std::size_t q = 0; q < plain->jacobians().size(); ++q) {
      EXPECT_EQ(projected->jacobians()[q], plain->jacobians()[q]) << "the true J";
      difference =
          std::max(difference, (projected->kirchhoffStress()[q] - plain->kirchhoffStress()[q]).norm());
    }
    return difference;
  };
  Eigen::VectorXd uniform(2 * body.numNodes);
  for (int a = 0; a < body.numNodes; ++a) uniform.segment<2>(2 * a) = 0.1 * body.patches[0].points().col(a);
  EXPECT_LT(largestDifference(uniform), 1e-13) << "J is constant, so J̄ = J";
  EXPECT_GT(largestDifference(uniform + test::randomState(uniform.size(), 0.02, 3)), 0.01);
}

/// Cook's membrane, 48 x (44 … 60), clamped at the left and lightly sheared on the right: rise of its upper
/// right corner.
double cooksRise(int degree, int spans, Formulation formulation) {
  const Patch<2> square = rectangle({0.0, 0.0}, {1.0, 1.0});
  Eigen::MatrixXd corners(2, 4);
  corners << 0.0, 48.0, 0.0, 48.0, 0.0, 44.0, 44.0, 60.0;
  const Body<2> body =
      makeBody(refined(Patch<2>(square.basis(), corners, square.weights()),
                       {KnotVector::uniform(degree, spans), KnotVector::uniform(degree, spans)}));
  const SpanQuadrature<2> quadrature(body);
  const auto bulk = makeBulkTerm(body, quadrature, NeoHookean({240.565, 0.4999}), formulation);
  DeadLoad<2> load(body, FaceQuadrature<2>(body, 0, faceFromName<2>("right"), 0),
                   {Formula(FormulaText{"0"}), Formula(FormulaText{"0.0625"})}, {});
  const int size = 2 * body.numNodes;
  std::vector<bool> prescribed(static_cast<std::size_t>(size), false);
  for (const int a : faceFunctions(body.patches[0].basis(), faceFromName<2>("left")))
    prescribed[static_cast<std::size_t>(2 * a)] = prescribed[static_cast<std::size_t>(2 * a + 1)] = true;
  const Eigen::VectorXd held = Eigen::VectorXd::Zero(size);
  Newton newton({bulk.get(), &load}, prescribed, {size, 1e-9, Eigen::VectorXd::Zero(size), {}},
                {.tolerance = 1e-7});
  Eigen::VectorXd x = held;
  EXPECT_EQ(newton.solve(1.0, held, x).outcome, NewtonOutcome::Converged);
  return x(size - 1);
}

/// A node of a collapsed edge stands several times in the spans beside it.
TEST(ProjectedTerm, TangentIsRightWhereAnEdgeIsCollapsed) {
  auto sector = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
  Eigen::MatrixXd points = sector.points();
  for (const int a : faceFunctions(sector.basis(), faceFromName<2>("left"))) points.col(a).setZero();
  const Patch<2> coarse(sector.basis(), points, sector.weights());
  for (const int spans : {1, 3}) {
    const Body<2> body = joinedBody<2>(
        {refined(coarse, {KnotVector::uniform(2, spans), KnotVector::uniform(2, spans)})}, {""});
    ASSERT_LT(body.numNodes, body.patches[0].basis().numFunctions());
    const SpanQuadrature<2> quadrature(body);
    const auto term =
        makeBulkTerm(body, quadrature, NeoHookean({1.0, 0.3}), Formulation::ProjectedDilatation);
    EXPECT_LT(test::tangentError(*term, 0.0, test::randomState(2 * body.numNodes, 0.01, 5), 1e-6), 1e-6);
  }
}

TEST(ProjectedTerm, DoesNotLockInANearlyIncompressibleBody) {
  const double fine = cooksRise(3, 16, Formulation::ProjectedDilatation);
  EXPECT_NEAR(cooksRise(2, 8, Formulation::ProjectedDilatation), fine, 0.025 * fine);
  EXPECT_NEAR(cooksRise(1, 8, Formulation::ProjectedDilatation), fine, 0.05 * fine);
  EXPECT_LT(cooksRise(2, 8, Formulation::Displacement), 0.85 * fine) << "locks";
  EXPECT_LT(cooksRise(1, 8, Formulation::Displacement), 0.3 * fine) << "locks worse";
}

}  // namespace
}  // namespace burnish
