#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/core/error.h"
#include "engine/material/j2_plasticity.h"
#include "engine/material/neo_hookean.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/rezoning/grid_interpolation.h"
#include "engine/rezoning/state_transfer.h"
#include "engine/solid/bulk_term.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

/// A body of one patch on a slab, with knot spans that are not even, and whose inside is skewed.
struct Slab {
  explicit Slab(int degree, int spans, double skew = 0.05, double power = 1.3)
      : patch(make(degree, spans, skew, power)), body(makeBody(patch)), quadrature(body) {}

  static Patch<2> make(int degree, int spans, double skew, double power) {
    std::vector<double> inner;
    for (int k = 1; k < spans; ++k) inner.push_back(std::pow(static_cast<double>(k) / spans, power));
    const KnotVector knots = withKnots(KnotVector::uniform(degree, 1), inner);
    const Patch<2> slab = refined(rectangle({0.0, 0.0}, {1.0, 1.0}), {knots, knots});
    Eigen::MatrixXd points = slab.points();
    for (Eigen::Index a = 0; a < points.cols(); ++a) {
      const double bubble = points(0, a) * (1.0 - points(0, a)) * points(1, a) * (1.0 - points(1, a));
      points(0, a) += 4.0 * skew * bubble;
      points(1, a) -= 3.0 * skew * bubble;
    }
    return {slab.basis(), points, slab.weights()};
  }

  Patch<2> patch;
  Body<2> body;
  SpanQuadrature<2> quadrature;
};

Eigen::Matrix3d elasticStretch(const Eigen::Vector2d& X) {
  const double a = 0.02 * std::sin(3.0 * X(0)) * std::exp(X(1)), b = 0.01 * std::cos(2.0 * X(0) + X(1));
  Eigen::Matrix3d V;
  V << 1.0 + a, b, 0.0, b, 1.0 - a, 0.0, 0.0, 0.0, 1.0 + 0.5 * b;
  return V * V;
}

double plasticStrain(const Eigen::Vector2d& X) {
  return std::exp(-4.0 * (1.0 - X(1))) * (1.2 + std::sin(4.0 * X(0)));
}

PointStates statesOf(const Slab& slab) {
  const Eigen::Matrix2Xd positions = pointPositions(slab.quadrature, slab.patch);
  PointStates states{{}, {{"e_p", 0.0}}, Eigen::MatrixXd(1, positions.cols())};
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    states.b_e.push_back(elasticStretch(positions.col(k)));
    states.numbers(0, k) = plasticStrain(positions.col(k));
  }
  return states;
}

PointStates transferred(const Slab& from, const PointStates& states, const Slab& to) {
  return interpolated(from.quadrature, from.patch.basis(), states,
                      parametersIn(InverseMap(from.patch), pointPositions(to.quadrature, to.patch), 1e-9));
}

double integral(const Slab& slab, const Eigen::VectorXd& values) {
  double sum = 0.0;
  for (const auto& span : slab.quadrature.spans())
    for (Eigen::Index q = 0; q < span.weights.size(); ++q)
      sum += span.weights(q) * values(span.firstPoint + q);
  return sum;
}

TEST(GridInterpolation, IsExactForMonotoneCubicsAndLinearBeyondTheGrid) {
  const std::array<std::vector<double>, 2> grid{{{0.0, 0.3, 0.5, 0.9, 1.0}, {0.1, 0.2, 0.5, 0.7, 1.0}}};
  const auto cubic = [](double x, double y) { return (1.0 + x * x * x) * (2.0 + y + y * y * y); };
  Eigen::MatrixXd values(1, 25);
  for (Eigen::Index j = 0; j < 5; ++j)
    for (Eigen::Index i = 0; i < 5; ++i)
      values(0, 5 * j + i) =
          cubic(grid[0][static_cast<std::size_t>(i)], grid[1][static_cast<std::size_t>(j)]);
  const GridInterpolation<2> interpolation(grid, values);
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(0.1, 0.15), Eigen::Vector2d(0.55, 0.9), Eigen::Vector2d(1.0, 0.3)})
    EXPECT_NEAR(interpolation(p)(0), cubic(p(0), p(1)), 1e-13);
  const double inside = interpolation({0.3, 0.7})(0), edge = interpolation({0.3, 1.0})(0);
  EXPECT_NEAR(interpolation({0.3, 1.1})(0), edge + (edge - inside) / 3.0, 1e-12);
}

TEST(GridInterpolation, DoesNotOvershootAStep) {
  const std::vector<double> line{0.0, 0.2, 0.4, 0.6, 0.8, 1.0};
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(1, 36);
  for (Eigen::Index k = 0; k < 36; ++k) values(0, k) = k % 6 >= 3 ? 1.0 : 0.0;
  const GridInterpolation<2> interpolation({line, line}, values);
  for (double x = 0.0; x <= 1.0; x += 0.01) {
    EXPECT_GE(interpolation({x, 0.5})(0), 0.0);
    EXPECT_LE(interpolation({x, 0.5})(0), 1.0);
  }
}

TEST(StateTransfer, KeepsAUniformState) {
  const Slab from(2, 6), to(3, 9, -0.03, 1.0);
  PointStates states = statesOf(from);
  states.b_e.assign(states.b_e.size(), elasticStretch({0.4, 0.7}));
  states.numbers.setConstant(0.37);
  const PointStates result = transferred(from, states, to);
  for (std::size_t k = 0; k < result.b_e.size(); ++k) {
    EXPECT_LT((result.b_e[k] - states.b_e[0]).cwiseAbs().maxCoeff(), 1e-14);
  }
  EXPECT_LT((result.numbers.array() - 0.37).abs().maxCoeff(), 1e-15);
}

TEST(StateTransfer, ConvergesWithTheFourthOrder) {
  const Slab to(2, 13, -0.04, 1.0);
  const PointStates exact = statesOf(to);
  const auto errorFrom = [&](int spans) {
    const Slab from(2, spans);
    const PointStates result = transferred(from, statesOf(from), to);
    Eigen::VectorXd squares = (result.numbers - exact.numbers).row(0).cwiseAbs2();
    for (std::size_t k = 0; k < exact.b_e.size(); ++k)
      squares(static_cast<Eigen::Index>(k)) += (result.b_e[k] - exact.b_e[k]).squaredNorm();
    return std::sqrt(integral(to, squares));
  };
  const double coarse = errorFrom(10), fine = errorFrom(20);
  EXPECT_LT(fine, 1e-5);
  EXPECT_GT(std::log2(coarse / fine), 2.7);  // four inside, two beyond the outermost points
}

TEST(StateTransfer, GainsNoPlasticStrainOnRoundTripsAndKeepsVolumesAndSigns) {
  const Slab one(2, 20), other(2, 20, -0.05, 0.8);
  PointStates states = statesOf(one);
  const double before = integral(one, states.numbers.row(0));
  for (int trip = 0; trip < 5; ++trip) states = transferred(other, transferred(one, states, other), one);
  EXPECT_NEAR(integral(one, states.numbers.row(0)), before, 5 * 5e-4 * before);
  const PointStates exact = statesOf(one);
  for (std::size_t k = 0; k < states.b_e.size(); ++k) {
    EXPECT_NEAR(states.b_e[k].determinant(), exact.b_e[k].determinant(), 2e-3);
    EXPECT_GT(states.b_e[k].selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  }
  EXPECT_GE(states.numbers.minCoeff(), 0.0);
}

TEST(StateTransfer, RefusesAPointThatIsNotInTheOldMesh) {
  const Slab from(2, 6);
  const Eigen::Matrix2Xd outside{{0.5, 1.01}, {0.5, 0.5}};
  EXPECT_NO_THROW(parametersIn(InverseMap(from.patch), outside, 0.011));
  EXPECT_THROW(parametersIn(InverseMap(from.patch), outside, 0.009), Error);
}

TEST(StateTransfer, DoesNotMakePlasticStrainNegative) {
  const Slab from(2, 6), to(2, 11);
  PointStates states = statesOf(from);
  const Eigen::Matrix2Xd positions = pointPositions(from.quadrature, from.patch);
  states.numbers = (positions.row(1).array() - 0.15).max(0.0);
  EXPECT_GE(transferred(from, states, to).numbers.minCoeff(), 0.0);
}

TEST(StateTransfer, InterpolatesEveryNumberForItself) {
  const Slab from(2, 6), to(2, 11);
  PointStates states = statesOf(from);
  const Eigen::MatrixXd alone = transferred(from, states, to).numbers;
  states.kinds.insert(states.kinds.begin(), CarriedKind{"signed"});
  states.numbers =
      (Eigen::MatrixXd(2, states.numbers.cols()) << -2.0 * states.numbers, states.numbers).finished();
  const Eigen::MatrixXd both = transferred(from, states, to).numbers;
  EXPECT_LT((both.row(1) - alone.row(0)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((both.row(0) + 2.0 * alone.row(0)).cwiseAbs().maxCoeff(), 1e-14);
}

/// Energy, forces and plastic work of a body after two deformations in a row, or both with the reference
/// moved to the state between them. With F-bar the first one is uniform: then J̄ = J, and the volume that the
/// new reference knows is the one of the points.
class ReferenceStates : public testing::TestWithParam<std::tuple<Material, Formulation>> {};

TEST_P(ReferenceStates, SplitDeformationsGiveTheSameStress) {
  const Slab slab(2, 3);
  const auto n = static_cast<Eigen::Index>(slab.body.numNodes);
  const auto& [material, formulation] = GetParam();
  Eigen::VectorXd first = test::randomState(2 * n, 0.02, 5);
  if (formulation == Formulation::ProjectedDilatation)
    first.reshaped(2, n) = Eigen::Matrix2d{{0.04, 0.02}, {-0.01, -0.03}} * slab.patch.points();
  const Eigen::VectorXd second = test::randomState(2 * n, 0.02, 6);
  const auto evaluate = [](BulkTerm<2>& term, const Eigen::VectorXd& x) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
    Assembly out{force};
    EXPECT_TRUE(term.evaluate(0.0, x, out));
    return force;
  };

  const auto whole = makeBulkTerm(slab.body, slab.quadrature, material, formulation);
  evaluate(*whole, first);
  whole->accept();
  const PointStates between = whole->carried(first);
  const Eigen::VectorXd expected = evaluate(*whole, first + second);

  const Patch<2> moved(slab.patch.basis(), slab.patch.points() + first.reshaped(2, n), slab.patch.weights());
  const Body<2> movedBody = makeBody(moved);
  const SpanQuadrature<2> movedQuadrature(movedBody);
  const auto split = makeBulkTerm(movedBody, movedQuadrature, material, formulation,
                                  referenceState(movedQuadrature, between));
  const Eigen::VectorXd force = evaluate(*split, second);
  EXPECT_LT((force - expected).norm(), 1e-11 * expected.norm());
  EXPECT_NEAR(split->summary().strainEnergy, whole->summary().strainEnergy,
              1e-12 * whole->summary().strainEnergy);
  EXPECT_NEAR(split->summary().plasticWorkIncrement, whole->summary().plasticWorkIncrement,
              1e-11 * (1.0 + whole->summary().plasticWorkIncrement));
  EXPECT_NEAR(split->weights().sum(), 1.0, 1e-12);  // the stress-free volume
  EXPECT_LT(test::tangentError(*split, 0.0, second, 1e-6), 1e-6);
  if (split->hasSymmetricTangent()) {
    EXPECT_LT(test::asymmetry(test::tangentOf(*split, 0.0, second)), 1e-12);
  }
}

/// What a rezoning asks the body for is what the law has stored, whatever the formulation.
TEST_P(ReferenceStates, ElasticDeformationsAreThoseOfTheLaw) {
  const Slab slab(2, 3);
  const auto& [material, formulation] = GetParam();
  const auto term = makeBulkTerm(slab.body, slab.quadrature, material, formulation);
  const Eigen::VectorXd x = test::randomState(2 * static_cast<Eigen::Index>(slab.body.numNodes), 0.02, 5);
  static_cast<void>(test::forceOf(*term, 0.0, x));
  term->accept();
  const PointStates states = term->carried(x);
  const auto stored = [&](std::size_t k, const Eigen::Matrix3d& stretch) {
    MaterialPoints point(material, 1);
    point.begin({stretch}, states.numbers.col(static_cast<Eigen::Index>(k)));
    MaterialResponse<2> response;
    EXPECT_TRUE(point.visit([&](auto& points) { return points.template evaluate<2>(0, stretch, response); }));
    return response.strainEnergy;
  };
  double energy = 0.0, differentVolume = 0.0;
  for (std::size_t k = 0; k < states.b_e.size(); ++k) {
    const Eigen::Matrix3d stretch =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(states.b_e[k]).operatorSqrt();
    const double J = term->jacobians()[k], volume = stretch.determinant();
    const double unseen = 0.25 * shearModulus(material) * std::pow(std::log(J / volume), 4);
    energy += term->weights()(static_cast<Eigen::Index>(k)) * (stored(k, stretch) + unseen);
    differentVolume = std::max(differentVolume, std::abs(volume - J));
  }
  EXPECT_NEAR(energy, term->summary().strainEnergy, 1e-9 * energy);
  EXPECT_EQ(differentVolume > 1e-3, formulation == Formulation::ProjectedDilatation);
}

Material sheetWithBackStresses() {
  Chaboche::Parameters parameters;
  parameters.E = 100.0;
  parameters.nu = 0.3;
  parameters.hardening = VoceHardening{0.5, 1.0, 10.0};
  parameters.backStresses = {{20.0, 30.0}, {2.0, 0.0}};
  parameters.hill = HillYield{1.8, 1.2, 2.2, {0.8, 0.6, 0.0}, {0.0, 0.0, 1.0}};
  return Chaboche(parameters);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, ReferenceStates,
    testing::Combine(testing::Values(Material(NeoHookean({1.0, 0.3})),
                                     Material(J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean,
                                                            VoceHardening{0.5, 1.0, 10.0}})),
                                     Material(J2Plasticity({100.0, 0.3, ElasticLaw::Hencky,
                                                            VoceHardening{0.5, 1.0, 10.0}})),
                                     sheetWithBackStresses()),
                     testing::Values(Formulation::Displacement, Formulation::ProjectedDilatation)),
    [](const auto& test) {
      const std::string law = std::visit([]<class Law>(const Law&) { return std::string(Law::kind.key); },
                                         std::get<0>(test.param));
      const bool isProjected = std::get<1>(test.param) == Formulation::ProjectedDilatation;
      return fmt::format("{}{}{}", law == "neo-hookean" ? "NeoHookean" : law, isProjected ? "Projected" : "",
                         test.index);
    });

}  // namespace
}  // namespace burnish
