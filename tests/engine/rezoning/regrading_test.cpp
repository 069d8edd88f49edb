#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/material/chaboche.h"
#include "engine/material/j2_plasticity.h"
#include "engine/material/neo_hookean.h"
#include "engine/nurbs/collocation.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/solid/bulk_term.h"
#include "engine/solid/deformation_gradients.h"
#include "tests/engine/solid/term_check.h"

/// Boxes whose knots change while their reference stays.
namespace burnish {
namespace {

/// A unit box; the spans of all directions are k/n to a power.
struct Block {
  Block(int degree, int spans, double power = 1.0)
      : patch(make(degree, spans, power)), body(makeBody(patch)), quadrature(body) {}

  static Patch<3> make(int degree, int spans, double power) {
    std::vector<double> inner;
    for (int k = 1; k < spans; ++k) inner.push_back(std::pow(static_cast<double>(k) / spans, power));
    const KnotVector knots = withKnots(KnotVector::uniform(degree, 1), inner);
    return refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots});
  }

  const TensorBasis<3>& basis() const { return patch.basis(); }

  /// Places of the quadrature points, 3 x points.
  Eigen::Matrix3Xd points() const {
    Eigen::Matrix3Xd places(3, quadrature.numPoints());
    for (const auto& span : quadrature.spans())
      places.middleCols(span.firstPoint, span.xi.cols()) = span.xi;  // the parameters of a unit box
    return places;
  }

  double integral(const Eigen::VectorXd& values) const {
    double sum = 0.0;
    for (const auto& span : quadrature.spans())
      sum += span.weights.dot(values.segment(span.firstPoint, span.weights.size()));
    return sum;
  }

  Patch<3> patch;
  Body<3> body;
  SpanQuadrature<3> quadrature;
};

Eigen::Vector3d displacementAt(const Eigen::Vector3d& X) {
  return {0.03 * std::sin(2.0 * X(0)) * X(1), 0.02 * std::cos(X(0) + 2.0 * X(2)),
          0.04 * std::exp(X(2)) * std::sin(X(0) - X(1))};
}

Eigen::Matrix3d elasticAt(const Eigen::Vector3d& X) {
  const double a = 0.02 * std::sin(3.0 * X(0)) * std::exp(X(1)), b = 0.01 * std::cos(2.0 * X(2) + X(1));
  Eigen::Matrix3d V;
  V << 1.0 + a, b, 0.3 * a, b, 1.0 - a, 0.2 * b, 0.3 * a, 0.2 * b, 1.0 + 0.5 * b;
  return V * V;
}

double flowAt(const Eigen::Vector3d& X) {
  return std::exp(-3.0 * (1.0 - X(2))) * (1.2 + std::sin(3.0 * X(0)) * std::cos(X(1)));
}

/// The displacement with the values of `displacementAt` at the anchors, 3 x functions.
Eigen::MatrixXd displacementOn(const Block& block) {
  const TensorBasis<3>& basis = block.basis();
  Eigen::MatrixXd values(3, basis.numFunctions());
  for (int a = 0; a < basis.numFunctions(); ++a) values.col(a) = displacementAt(basis.anchor(a));
  // Nodes of a fine basis of the first degree are its anchors: what has these values is found on the other one.
  std::vector<UnivariateBasis> nodal;
  for (int d = 0; d < 3; ++d) {
    std::vector<double> places;
    for (int a = 0; a < basis.direction(d).numFunctions(); ++a)
      places.push_back(basis.direction(d).anchor(a));
    nodal.push_back(UnivariateBasis::lagrange(1, places));
  }
  return interpolatedOn(basis, TensorBasis<3>(nodal), values);
}

PointStates statesOf(const Block& block) {
  const Eigen::Matrix3Xd X = block.points();
  PointStates states{{}, {{"e_p", 0.0}}, Eigen::MatrixXd(1, X.cols())};
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    states.b_e.push_back(elasticAt(X.col(k)));
    states.numbers(0, k) = flowAt(X.col(k));
  }
  return states;
}

std::vector<Eigen::Matrix3d> still(const Block& block) {
  return std::vector<Eigen::Matrix3d>(static_cast<std::size_t>(block.quadrature.numPoints()),
                                      Eigen::Matrix3d::Identity());
}

PointStates regradedTo(const Block& to, const Block& from, const PointStates& states) {
  return regraded(from.quadrature, from.basis(), states, to.quadrature, still(to));
}

TEST(Regrading, KeepsAUniformStateExactly) {
  const Block from(2, 4), to(2, 5, 1.4);
  const Eigen::Matrix3d H{{0.1, 0.03, 0.0}, {-0.02, -0.06, 0.01}, {0.05, 0.0, 0.02}};
  const Eigen::MatrixXd u = interpolatedOn(to.basis(), from.basis(), H * from.patch.points());
  EXPECT_LT((u - H * to.patch.points()).cwiseAbs().maxCoeff(), 1e-15);
  PointStates states = statesOf(from);
  states.b_e.assign(states.b_e.size(), elasticAt({0.4, 0.7, 0.1}));
  states.numbers.setConstant(0.37);
  const auto gradients = deformationGradients<3>(to.quadrature, u.reshaped());
  const PointStates result = regraded(from.quadrature, from.basis(), states, to.quadrature, gradients);
  for (std::size_t k = 0; k < result.b_e.size(); ++k) {
    EXPECT_LT((gradients[k] - Eigen::Matrix3d::Identity() - H).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((result.b_e[k] - states.b_e[0]).cwiseAbs().maxCoeff(), 1e-13);
  }
  EXPECT_LT((result.numbers.array() - 0.37).abs().maxCoeff(), 1e-15);
}

TEST(Regrading, KeepsDisplacementsThatLieInBothSpaces) {
  const Block coarse(3, 3), fine(3, 6);  // nested
  const Eigen::MatrixXd u = displacementOn(coarse);
  const Eigen::MatrixXd there = interpolatedOn(fine.basis(), coarse.basis(), u);
  EXPECT_LT((interpolatedOn(coarse.basis(), fine.basis(), there) - u).cwiseAbs().maxCoeff(), 1e-14);
  const auto before = deformationGradients<3>(coarse.quadrature, u.reshaped());
  EXPECT_GT((before.front() - before.back()).norm(), 0.01);
}

TEST(Regrading, CarriesASmoothStateWithItsOrder) {
  const Block to(2, 5, 1.2), samples(1, 17, 1.1);
  const PointStates exact = statesOf(to);
  struct Errors {
    double displacement, states;
  };
  const auto errorsFrom = [&](int spans) {
    const Block from(2, spans);
    const Eigen::MatrixXd u = displacementOn(from);
    const Eigen::MatrixXd way = valuesAtAnchors(from.basis(), u, samples.basis());
    double displacement = 0.0;
    for (int a = 0; a < samples.basis().numFunctions(); ++a)
      displacement += (way.col(a) - displacementAt(samples.basis().anchor(a))).squaredNorm();
    const PointStates result = regradedTo(to, from, statesOf(from));
    Eigen::VectorXd squares = (result.numbers - exact.numbers).row(0).cwiseAbs2();
    for (std::size_t k = 0; k < exact.b_e.size(); ++k)
      squares(static_cast<Eigen::Index>(k)) += (result.b_e[k] - exact.b_e[k]).squaredNorm();
    return Errors{std::sqrt(displacement), std::sqrt(to.integral(squares))};
  };
  const Errors coarse = errorsFrom(6), fine = errorsFrom(12);
  EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 2.7);
  EXPECT_GT(std::log2(coarse.states / fine.states), 2.7);  // four inside, two beyond the outermost points
  EXPECT_LT(fine.states, 1e-4);
}

TEST(Regrading, GainsNoPlasticStrainOnRoundTrips) {
  const Block one(2, 10), other(2, 10, 1.25);
  PointStates states = statesOf(one);
  const double integral = one.integral(states.numbers.row(0)), largest = states.numbers.maxCoeff();
  for (int trip = 0; trip < 3; ++trip) states = regradedTo(one, other, regradedTo(other, one, states));
  EXPECT_NEAR(one.integral(states.numbers.row(0)), integral, 3 * 5e-4 * integral);
  EXPECT_LT(states.numbers.maxCoeff(), largest * 1.005);
  EXPECT_GE(states.numbers.minCoeff(), 0.0);
}

TEST(Regrading, StaysWithinTheRangeOfASteepFlowFront) {
  const Block from(2, 8), to(2, 9, 1.3);
  PointStates states = statesOf(from);
  const Eigen::Matrix3Xd X = from.points();
  for (Eigen::Index k = 0; k < X.cols(); ++k) states.numbers(0, k) = X(0, k) > 0.45 ? 0.2 : 0.0;
  const PointStates result = regradedTo(to, from, states);
  EXPECT_GE(result.numbers.minCoeff(), 0.0);
  EXPECT_LE(result.numbers.maxCoeff(), 0.2 * (1.0 + 1e-12));
}

TEST(Regrading, LeavesWhatHasNotFlowedAsElasticAsItsDisplacementsSay) {
  const Block from(2, 6), to(2, 7, 1.3);
  PointStates states = statesOf(from);
  const Eigen::Matrix3Xd X = from.points(), Y = to.points();
  for (Eigen::Index k = 0; k < X.cols(); ++k)
    if (X(0, k) < 0.5) states.numbers(0, k) = 0.0;
  const Eigen::MatrixXd u = displacementOn(to);
  const auto gradients = deformationGradients<3>(to.quadrature, u.reshaped());
  const PointStates result = regraded(from.quadrature, from.basis(), states, to.quadrature, gradients);
  int elastic = 0;
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    const auto q = static_cast<std::size_t>(k);
    const double error = (result.b_e[q] - gradients[q] * gradients[q].transpose()).norm();
    if (result.numbers(0, k) == 0.0) {
      EXPECT_LT(error, 1e-15);
      ++elastic;
    } else if (Y(0, k) > 0.6) {
      EXPECT_GT(error, 1e-4);
    }
  }
  EXPECT_GT(elastic, Y.cols() / 4);
}

/// A body after two deformations, and one that begins with what the first of them has left, in the same
/// reference: forces, energies, plastic work, and what is stored of the law.
class KeptReference : public testing::TestWithParam<Material> {};

TEST_P(KeptReference, GivesTheSameStress) {
  const Block block(2, 2);
  const auto n = 3 * static_cast<Eigen::Index>(block.body.numNodes);
  for (const Formulation formulation : {Formulation::Displacement, Formulation::ProjectedDilatation}) {
    Eigen::VectorXd first = test::randomState(n, 0.02, 5);
    if (formulation == Formulation::ProjectedDilatation)
      first.reshaped(3, n / 3) =
          Eigen::Matrix3d{{0.04, 0.02, 0.01}, {-0.01, -0.03, 0.0}, {0.02, 0.0, 0.01}} * block.patch.points();
    const Eigen::VectorXd both = first + test::randomState(n, 0.02, 6);
    const auto whole = makeBulkTerm(block.body, block.quadrature, GetParam(), formulation);
    static_cast<void>(test::forceOf(*whole, 0.0, first));
    whole->accept();
    const PointStates states = whole->carried(first);
    const auto next =
        makeBulkTerm(block.body, block.quadrature, GetParam(), formulation,
                     referenceState(block.quadrature, states, deformationGradients(block.quadrature, first)));
    bool admissible = false;
    const Eigen::VectorXd expected = test::forceOf(*whole, 0.0, both);
    const Eigen::VectorXd force = test::forceOf(*next, 0.0, both, &admissible);
    ASSERT_TRUE(admissible);
    EXPECT_LT((force - expected).norm(), 1e-10 * expected.norm());
    EXPECT_NEAR(next->summary().strainEnergy, whole->summary().strainEnergy,
                1e-11 * whole->summary().strainEnergy);
    EXPECT_NEAR(next->summary().plasticWorkIncrement, whole->summary().plasticWorkIncrement,
                1e-10 * (1.0 + whole->summary().plasticWorkIncrement));
    EXPECT_NEAR(next->weights().sum(), 1.0, 1e-11);
    const PointStates carriedOn = next->carried(first);
    for (std::size_t k = 0; k < states.b_e.size(); ++k)
      EXPECT_LT((carriedOn.b_e[k] - states.b_e[k]).norm(), 1e-12);
    EXPECT_LT(test::tangentError(*next, 0.0, both, 1e-6), 1e-6);
  }
}

Material withBackStresses() {
  Chaboche::Parameters parameters;
  parameters.E = 100.0;
  parameters.nu = 0.3;
  parameters.hardening = VoceHardening{0.5, 1.0, 10.0};
  parameters.backStresses = {{20.0, 30.0}, {2.0, 0.0}};
  parameters.hill = HillYield{1.8, 1.2, 2.2, {0.8, 0.6, 0.0}, {0.0, 0.0, 1.0}};
  return Chaboche(parameters);
}

INSTANTIATE_TEST_SUITE_P(Laws, KeptReference,
                         testing::Values(Material(NeoHookean({1.0, 0.3})),
                                         Material(J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean,
                                                                VoceHardening{0.5, 1.0, 10.0}})),
                                         withBackStresses()),
                         [](const auto& test) { return fmt::format("Law{}", test.index); });

}  // namespace
}  // namespace burnish
