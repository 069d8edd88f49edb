#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/fields/projection.h"
#include "engine/fields/span_extremes.h"
#include "engine/fields/tensor_mass.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/displacement_term.h"
#include "engine/solid/point_count.h"
#include "engine/solid/span_kernel.h"
#include "engine/solid/tensor_kernel.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

Body<3> shell() {
  return makeBody(refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}),
                          {KnotVector::uniform(1, 1), KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)}));
}

/// A block with uneven faces and another weight at every control point; a double knot in the second
/// direction, where the degree allows it, and one degree more in the third.
Body<3> uneven(int degree) {
  const KnotVector plain = KnotVector::uniform(degree, 2);
  const KnotVector kinked = degree > 1 ? withKnots(plain, {plain.breakpoints()[1]}) : plain;
  const Patch<3> block =
      refined(box({0.0, 0.0, 0.0}, {1.0, 2.0, 1.5}), {plain, kinked, KnotVector::uniform(degree + 1, 1)});
  const Eigen::Index n = block.weights().size();
  return makeBody(Patch<3>(block.basis(), block.points() + test::randomState(3 * n, 0.03, 11).reshaped(3, n),
                           Eigen::VectorXd::Ones(n) + test::randomState(n, 0.3, 12)));
}

/// Sets both kernels to the same stress, moduli and deformation at all points of a span and multiplies.
void fillAlike(SpanKernel<Kinematics::Solid>& dense, TensorKernel& factorised,
               const SpanQuadrature<3>::Span& span, unsigned seed) {
  Eigen::MatrixXd buffer;
  const Eigen::MatrixXd& gradients = span.gradients(buffer);
  dense.start(span, gradients, true);
  factorised.start(span, gradients, true);
  for (Eigen::Index q = 0; q < span.weights.size(); ++q, seed += 3) {
    const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + test::randomState(9, 0.2, seed).reshaped(3, 3);
    const TensorKernel::Stress tau = test::randomState(6, 1.0, seed + 1);
    const TensorKernel::Tangent half = test::randomState(36, 1.0, seed + 2).reshaped(6, 6);
    const auto fill = [&](auto& kernel) {
      kernel.setGradients(q, F);
      kernel.setStress(q, span.weights(q) * tau);
      kernel.setModuli(q, span.weights(q), tau, half + half.transpose(), 0.4);
    };
    fill(dense);
    fill(factorised);
  }
  dense.multiply();
  factorised.multiply();
}

Material elastic() {
  return NeoHookean({1.0, 0.3});
}
Material plastic() {
  return J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, VoceHardening{0.5, 1.0, 10.0}});
}

TEST(SpanQuadrature, MeasuresExactVolumes) {
  EXPECT_NEAR(SpanQuadrature<2>(test::ring(2), 8).volume(), 0.5 * 1.0 * 3.0, 1e-12);
  EXPECT_NEAR(SpanQuadrature<3>(shell(), 8).volume(), (1.5 * 1.5 * 1.5 - 1.0) / 3.0 * 1.0 * std::sin(1.0),
              1e-10);
}

TEST(SpanQuadrature, RefusesAFoldedMap) {
  auto patch = rectangle({0.0, 0.0}, {1.0, 1.0});
  Eigen::MatrixXd points = patch.points();
  points.col(3) = Eigen::Vector2d(-0.5, -0.5);
  EXPECT_THROW(SpanQuadrature<2>(makeBody(Patch<2>(patch.basis(), points, patch.weights()))), Error);
}

TEST(DisplacementTerm, TangentAgreesWithCentralDifferences) {
  const Body<2> plane = test::ring(2);
  const SpanQuadrature<2> planeQuadrature(plane);
  DisplacementTerm<2> rubber(planeQuadrature, elastic());
  EXPECT_LT(test::tangentError(rubber, 0.0, test::randomState(2 * plane.numNodes, 0.03, 1), 1e-6), 1e-7);

  const Body<3> solid = shell();
  const SpanQuadrature<3> solidQuadrature(solid);
  DisplacementTerm<3> rubber3(solidQuadrature, elastic());
  EXPECT_LT(test::tangentError(rubber3, 0.0, test::randomState(3 * solid.numNodes, 0.03, 2), 1e-6), 1e-7);
}

/// Largest error of forces and tangent of a span in the plane, against their sums over points, functions and
/// components one by one.
template <Kinematics K>
double errorOfSums(const SpanQuadrature<2>::Span& span, SpanKernel<K>& kernel, unsigned seed) {
  constexpr int C = kColumns<K>;
  const Eigen::MatrixXd& G = span.stored.G;
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(2, G.rows()),
                  tangent = Eigen::MatrixXd::Zero(2 * G.rows(), 2 * G.rows());
  kernel.start(span, G, true);
  for (Eigen::Index q = 0; q < span.weights.size(); ++q, seed += 3) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    F.topLeftCorner<2, 2>() += test::randomState(4, 0.2, seed).reshaped(2, 2);
    if (K == Kinematics::Axisymmetric) F(2, 2) = 1.1;
    const Eigen::Vector4d tau = test::randomState(4, 1.0, seed + 1);
    const Eigen::Matrix4d half = test::randomState(16, 1.0, seed + 2).reshaped(4, 4);
    const Eigen::Matrix4d c = half + half.transpose();
    const double w = span.weights(q);
    kernel.setGradients(q, F);
    kernel.setStress(q, w * tau);
    kernel.setModuli(q, w, tau, c, 0.0);
    const Eigen::MatrixXd g = G.middleCols(C * q, C) * pushForward<K>(F);
    for (Eigen::Index a = 0; a < g.rows(); ++a)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < C; ++j) {
          if (gradientPlace<K>(i, j) >= 0) force(i, a) += w * g(a, j) * tau(gradientPlace<K>(i, j));
          for (Eigen::Index b = 0; b < g.rows(); ++b)
            for (int k = 0; k < 2; ++k)
              for (int l = 0; l < C; ++l)
                tangent(2 * a + i, 2 * b + k) += w * g(a, j) * modulus<K>(i, j, k, l, tau, c) * g(b, l);
        }
  }
  kernel.multiply();
  double error = (kernel.tangent() - tangent).cwiseAbs().maxCoeff() / tangent.cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < G.rows(); ++a)
    error = std::max(error, (kernel.force(a) - force.col(a)).norm() / force.norm());
  return error;
}

TEST(SpanKernel, SumsOverThePointsOfSpansOfAnyDegreesInTurn) {
  SpanKernel<Kinematics::Plane> plane;
  SpanKernel<Kinematics::Axisymmetric> axisymmetric;
  for (const int degree : {2, 1, 4, 3})
    for (int more = 0; more < 2; ++more) {
      Body<2> body =
          makeBody(refined(rectangle({1.0, 0.0}, {2.0, 1.5}),
                           {KnotVector::uniform(degree, 2), KnotVector::uniform(degree + more, 1)}));
      const SpanQuadrature<2> inPlane(body);
      for (const auto& span : inPlane.spans())
        EXPECT_LT(errorOfSums(span, plane, 3), 1e-13) << degree << " and " << degree + more;
      body.axisymmetric = true;
      const SpanQuadrature<2> ofRings(body);
      for (const auto& span : ofRings.spans())
        EXPECT_LT(errorOfSums(span, axisymmetric, 3), 1e-13) << degree << " and " << degree + more;
    }
}

TEST(TensorKernel, AgreesWithTheDenseProducts) {
  for (int degree = 1; degree <= 4; ++degree) {
    const Body<3> body = uneven(degree);
    const SpanQuadrature<3> quadrature(body);
    SpanKernel<Kinematics::Solid> dense;
    TensorKernel factorised;
    for (const auto& span : quadrature.spans()) {
      fillAlike(dense, factorised, span, 7);
      const Eigen::MatrixXd& tangent = dense.tangent();
      EXPECT_LT((factorised.tangent() - tangent).cwiseAbs().maxCoeff(), 1e-12 * tangent.cwiseAbs().maxCoeff())
          << "degree " << degree << ", span " << span.number;
      for (Eigen::Index a = 0; a < std::ssize(span.nodes); ++a)
        EXPECT_LT((factorised.force(a) - dense.force(a)).norm(), 1e-13) << "degree " << degree;
    }
  }
}

TEST(DisplacementTerm, PlasticTangentAgreesWithCentralDifferences) {
  const Body<2> plane = test::ring(2);
  const SpanQuadrature<2> quadrature(plane);
  DisplacementTerm<2> metal(quadrature, plastic());
  // A stretch far beyond yield everywhere, so that no point switches between elastic and plastic.
  Eigen::VectorXd x = test::randomState(2 * plane.numNodes, 0.01, 3);
  for (int a = 0; a < plane.numNodes; ++a) x(2 * a) += 0.08 * plane.patches[0].points()(0, a);
  ASSERT_TRUE(test::forceOf(metal, 0.0, x).allFinite());
  metal.accept();
  EXPECT_GT(metal.points().field("plastic_strain").maxCoeff(), 0.05);
  x *= 1.3;
  EXPECT_LT(test::tangentError(metal, 0.0, x, 1e-6), 1e-6);

  const Body<3> solid = shell();
  const SpanQuadrature<3> solidQuadrature(solid);
  DisplacementTerm<3> metal3(solidQuadrature, plastic());
  Eigen::VectorXd y = test::randomState(3 * solid.numNodes, 0.004, 4);
  for (int a = 0; a < solid.numNodes; ++a) y(3 * a) += 0.08 * solid.patches[0].points()(0, a);
  EXPECT_LT(test::tangentError(metal3, 0.0, y, 1e-6), 1e-6);
}

TEST(DisplacementTerm, ForceIsTheDerivativeOfTheStoredEnergy) {
  const Body<2> body = test::ring(3);
  const SpanQuadrature<2> quadrature(body);
  DisplacementTerm<2> term(quadrature, elastic());
  const Eigen::VectorXd x = test::randomState(2 * body.numNodes, 0.03, 5),
                        direction = test::randomState(x.size(), 1.0, 6);
  const auto energy = [&](double s) {
    static_cast<void>(test::forceOf(term, 0.0, x + s * direction));
    return term.summary().strainEnergy;
  };
  const double h = 1e-5;
  EXPECT_NEAR((energy(h) - energy(-h)) / (2.0 * h), test::forceOf(term, 0.0, x).dot(direction), 1e-8);
}

TEST(DisplacementTerm, RigidMotionCostsNothing) {
  const Body<2> body = test::ring(2);
  const SpanQuadrature<2> quadrature(body);
  DisplacementTerm<2> term(quadrature, elastic());
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(2.0).toRotationMatrix();
  Eigen::VectorXd x(2 * body.numNodes);
  for (int a = 0; a < body.numNodes; ++a) {
    const Eigen::Vector2d X = body.patches[0].points().col(a);
    x.segment<2>(2 * a) = rotation * X + Eigen::Vector2d(3.0, -1.0) - X;
  }
  EXPECT_LT(test::forceOf(term, 0.0, x).norm(), 1e-13);
}

/// What is left of the stiffness of an undeformed block with so many points in each direction: the number of motions
/// without, and the smallest of the others.
template <int Dim>
std::pair<Eigen::Index, double> softest(const Body<Dim>& body, int points) {
  const SpanQuadrature<Dim> quadrature(body, points);
  DisplacementTerm<Dim> term(quadrature, elastic());
  const Eigen::VectorXd stiffness =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
          test::tangentOf(term, 0.0, Eigen::VectorXd::Zero(Dim * body.numNodes)), Eigen::EigenvaluesOnly)
          .eigenvalues();
  const Eigen::Index free = (stiffness.array() < 1e-10 * stiffness.maxCoeff()).count();
  return {free, stiffness(free)};
}

TEST(PointCount, AsManyAsTheDegreeHoldSmoothSplines) {
  const Patch<2> square = rectangle({0.0, 0.0}, {1.0, 1.3});
  const Patch<3> cube = box({0.0, 0.0, 0.0}, {1.0, 1.3, 0.8});
  for (const int p : {2, 3}) {
    const KnotVector one = KnotVector::uniform(p, 1), two = KnotVector::uniform(p, 2),
                     kinked = withKnots(two, {two.breakpoints()[1]});
    const Body<2> plane = makeBody(refined(square, {two, KnotVector::uniform(p, 3)}));
    const Body<3> solid = makeBody(refined(cube, {two, two, two}));
    EXPECT_TRUE(isHeldBy(p, plane) && isHeldBy(p, solid));
    EXPECT_FALSE(isHeldBy(p - 1, plane));
    EXPECT_EQ(softest(plane, p).first, 3);
    EXPECT_EQ(softest(solid, p).first, 6);
    EXPECT_GT(softest(plane, p).second, 0.25 * softest(plane, p + 1).second);
    EXPECT_GT(softest(solid, p).second, 0.25 * softest(solid, p + 1).second);
    // A single span has functions that vanish at all points.
    const Body<2> single = makeBody(refined(square, {one, one}));
    EXPECT_FALSE(isHeldBy(p, single));
    EXPECT_GT(softest(single, p).first, 3);
    EXPECT_TRUE(isHeldBy(p + 1, single));
    EXPECT_EQ(softest(single, p + 1).first, 3);
    EXPECT_FALSE(isHeldBy(p, makeBody(refined(square, {two, kinked}))));
  }
}

TEST(DisplacementTerm, RefusesAStateThatIsInsideOut) {
  const Body<2> body = makeBody(rectangle({0.0, 0.0}, {1.0, 1.0}));
  const SpanQuadrature<2> quadrature(body);
  DisplacementTerm<2> term(quadrature, elastic());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(8);
  x(4 + 1) = x(6 + 1) = -1.5;
  bool admissible = true;
  static_cast<void>(test::forceOf(term, 0.0, x, &admissible));
  EXPECT_FALSE(admissible);
}

template <int Dim>
void expectExactProjection(const Body<Dim>& body) {
  const SpanQuadrature<Dim> quadrature(body);
  const Projection<Dim> projection(body, quadrature);
  const Eigen::VectorXd coefficients = test::randomState(body.numNodes, 1.0, 8);
  Eigen::MatrixXd values(quadrature.numPoints(), 2);
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature.spans()) {
    const Eigen::MatrixXd& R = span.values(buffer);
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      values(span.firstPoint + q, 0) = R.col(q).dot(coefficients(span.nodes));
      values(span.firstPoint + q, 1) = std::sin(static_cast<double>(span.firstPoint + q));
    }
  }
  const Eigen::MatrixXd projected = projection.project(values);
  const Eigen::VectorXd error = projected.col(0) - coefficients;
  EXPECT_LT(error.norm(), 1e-11 * coefficients.norm()) << "rounding times the condition of the mass matrix";

  Eigen::VectorXd rest = Eigen::VectorXd::Zero(body.numNodes);
  for (const auto& span : quadrature.spans()) {
    const Eigen::MatrixXd& R = span.values(buffer);
    EXPECT_LT((R.transpose() * error(span.nodes)).cwiseAbs().maxCoeff(), 3e-14)
        << "the field is better conditioned";
    for (Eigen::Index q = 0; q < span.weights.size(); ++q)
      rest(span.nodes) += span.weights(q) * R.col(q) *
                          (R.col(q).dot(projected.col(1)(span.nodes)) - values(span.firstPoint + q, 1));
  }
  EXPECT_LT(rest.norm(), 1e-13);
}

TEST(Projection, ReproducesFieldsOfTheSpaceAndOrthogonalisesTheRest) {
  expectExactProjection(test::ring(2));
  expectExactProjection(shell());
  for (int degree = 1; degree <= 3; ++degree) expectExactProjection(uneven(degree));
}

TEST(Projection, InSpaceTakesAsManyIterationsOnAFineMeshAsOnACoarseOne) {
  const auto iterations = [](int spans) {
    const KnotVector knots = KnotVector::uniform(2, spans);
    const Body<3> body = makeBody(
        refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0}), {knots, knots, knots}));
    const SpanQuadrature<3> quadrature(body);
    Eigen::SparseMatrix<double> mass(body.numNodes, body.numNodes);
    Eigen::MatrixXd buffer;
    for (const auto& span : quadrature.spans()) {
      const Eigen::MatrixXd& R = span.values(buffer);
      const Eigen::MatrixXd own = R * span.weights.asDiagonal() * R.transpose();
      for (std::size_t b = 0; b < span.nodes.size(); ++b)
        for (std::size_t a = 0; a < span.nodes.size(); ++a)
          mass.coeffRef(span.nodes[a], span.nodes[b]) +=
              own(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
    }
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, TensorMassInverse>
        gradients;
    gradients.setTolerance(1e-10);
    gradients.preconditioner().setUp(body, 0, mass.diagonal());
    gradients.compute(mass);
    static_cast<void>(gradients.solve(test::randomState(body.numNodes, 1.0, 5)).eval());
    return gradients.iterations();
  };
  EXPECT_LE(iterations(3), 12);
  EXPECT_LE(iterations(8), 12);
}

TEST(SpanQuadrature, MakesInSpaceTheFunctionsThatThePatchHas) {
  for (int degree = 1; degree <= 4; ++degree) {
    const Body<3> body = uneven(degree);
    const SpanQuadrature<3> quadrature(body);
    Eigen::MatrixXd ofValues, ofGradients;
    for (const auto& span : quadrature.spans()) {
      const Eigen::MatrixXd &R = span.values(ofValues), &G = span.gradients(ofGradients);
      for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
        const Patch<3>& patch = body.patches.front();
        const Eigen::Vector3d xi = span.xi.col(q);
        const auto shape = patch.shape(span.number, xi);
        EXPECT_LT((R.col(q) - shape.R).norm(), 1e-14);
        EXPECT_LT((G.middleCols<3>(3 * q) * patch.jacobian(xi) - shape.dR).norm(), 1e-12 * shape.dR.norm());
      }
    }
  }
}

TEST(SpanExtremes, FindsTheExtremesOfARationalField) {
  const Body<2> body = test::ring(2);
  // The coordinate field x of the ring: cos(1) … 2.
  const Extremes extremes = SpanExtremes<2>(body)(body.patches[0].points().row(0).transpose());
  EXPECT_NEAR(extremes.max, 2.0, 1e-13);
  EXPECT_NEAR(extremes.min, std::cos(1.0), 1e-13);
}

}  // namespace
}  // namespace burnish
