#include "engine/material/neo_hookean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "tests/engine/material/material_checks.h"

namespace burnish {
namespace {

using test::evaluate;
using Volumetric = NeoHookean::Volumetric;

constexpr double kE = 3.0;
constexpr double kNu = 0.3;
constexpr double kMu = kE / (2.0 * (1.0 + kNu));
constexpr double kLambda = kE * kNu / ((1.0 + kNu) * (1.0 - 2.0 * kNu));

template <class D>
struct NeoHookeanTest : testing::Test {};
template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(NeoHookeanTest, Dimensions);

const Volumetric kForms[] = {Volumetric::Log, Volumetric::Simo};

TYPED_TEST(NeoHookeanTest, IsFreeOfStressWhenUndeformed) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms) {
    const auto response = evaluate<Dim>(NeoHookean({kE, kNu, form}), Eigen::Matrix3d::Identity()).response;
    EXPECT_EQ(response.tau.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(response.strainEnergy, 0.0);
    EXPECT_EQ(response.plasticWork, 0.0);
    EXPECT_NEAR(response.c(0, 0), kLambda + 2.0 * kMu, 1e-14);
    EXPECT_NEAR(response.c(0, 1), kLambda, 1e-14);
    EXPECT_NEAR(response.c(3, 3), kMu, 1e-14);
  }
}

TYPED_TEST(NeoHookeanTest, StressIsThatOfTheFirstPiolaKirchhoffFormula) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms) {
    const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
    const double J = F.determinant();
    const double JU = form == Volumetric::Log ? kLambda * std::log(J) : 0.5 * kLambda * (J * J - 1.0);
    const Eigen::Matrix3d F_invT = F.inverse().transpose();
    const Eigen::Matrix3d P = kMu * (F - F_invT) + JU * F_invT;
    const auto tau = fullTensor<Dim>(evaluate<Dim>(NeoHookean({kE, kNu, form}), F).response.tau);
    EXPECT_LT((tau - P * F.transpose()).cwiseAbs().maxCoeff(), 1e-14 * kE);
  }
}

TYPED_TEST(NeoHookeanTest, EnergyIsThatOfTheFormula) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms) {
    const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
    const double J = F.determinant();
    const double logJ = std::log(J);
    const double U =
        form == Volumetric::Log ? 0.5 * kLambda * logJ * logJ : 0.25 * kLambda * (J * J - 1.0 - 2.0 * logJ);
    const double W = 0.5 * kMu * (F.squaredNorm() - 3.0) - kMu * logJ + U;
    EXPECT_NEAR(evaluate<Dim>(NeoHookean({kE, kNu, form}), F).response.strainEnergy, W, 1e-14 * kE);
  }
}

TYPED_TEST(NeoHookeanTest, StressIsTheDerivativeOfTheEnergy) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms)
    for (const double amount : {0.0, 1e-5, 0.05, 0.4})
      EXPECT_LT(test::stressError<Dim>(NeoHookean({kE, kNu, form}), test::skewed<Dim>(amount), {}, 1e-3, kE),
                1e-10);
}

TYPED_TEST(NeoHookeanTest, TangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms)
    for (const Eigen::Matrix3d& F :
         {Eigen::Matrix3d::Identity().eval(), (1.3 * Eigen::Matrix3d::Identity()).eval(),
          test::skewed<Dim>(0.05), test::skewed<Dim>(0.4), test::stretched<Dim>(0.3, 2.0, 1.1)})
      EXPECT_LT(test::tangentError<Dim>(NeoHookean({kE, kNu, form}), F, {}, 1e-3), 1e-9);
}

TYPED_TEST(NeoHookeanTest, RotatesWithTheBody) {
  constexpr int Dim = TypeParam::value;
  const NeoHookean law({kE, kNu});
  const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
  const Eigen::Matrix3d Q = test::rotation<Dim>(1.9);
  const auto still = evaluate<Dim>(law, F).response;
  const auto turned = evaluate<Dim>(law, Q * F).response;
  const Eigen::Matrix3d expected = Q * fullTensor<Dim>(still.tau) * Q.transpose();
  EXPECT_LT((fullTensor<Dim>(turned.tau) - expected).cwiseAbs().maxCoeff(), 1e-14 * kE);
  EXPECT_NEAR(turned.strainEnergy, still.strainEnergy, 1e-14 * kE);
}

/// At a strain of 1e-8 the energy is 1e-16 E: terms of first order must not cancel in round-off.
TYPED_TEST(NeoHookeanTest, KeepsItsDigitsAtSmallStrains) {
  constexpr int Dim = TypeParam::value;
  constexpr double amount = 0x1p-26;
  const Eigen::Matrix3d F = test::skewed<Dim>(amount);
  const Eigen::Matrix3d H = F - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d strain = 0.5 * (H + H.transpose());
  const double linear = 0.5 * kLambda * std::pow(strain.trace(), 2) + kMu * strain.squaredNorm();
  const Eigen::Matrix3d stress = kLambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * kMu * strain;
  const auto response = evaluate<Dim>(NeoHookean({kE, kNu}), F).response;
  EXPECT_NEAR(response.strainEnergy / linear, 1.0, 1e-6);
  EXPECT_LT((fullTensor<Dim>(response.tau) - stress).norm() / stress.norm(), 1e-7);
}

TYPED_TEST(NeoHookeanTest, IsElasticAndRemembersNothing) {
  constexpr int Dim = TypeParam::value;
  const Eigen::Matrix3d F = test::skewed<Dim>(0.1);
  EXPECT_TRUE(std::is_empty_v<NeoHookean::State>);
  EXPECT_LT((NeoHookean({kE, kNu}).elasticDeformation(F, {}) - F * F.transpose()).norm(), 1e-15);
}

TYPED_TEST(NeoHookeanTest, RefusesWhatIsNotADeformation) {
  constexpr int Dim = TypeParam::value;
  const NeoHookean law({kE, kNu});
  NeoHookean::State next;
  MaterialResponse<Dim> out;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (const double entry : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e200}) {
    F(0, 0) = entry;
    EXPECT_FALSE(law.evaluate<Dim>(F, {}, next, out)) << "F_11 = " << entry;
  }
}

TEST(NeoHookean, InPlaneStrainIsTheSpatialLaw) {
  for (const Volumetric form : kForms) {
    const NeoHookean law({kE, kNu, form});
    const Eigen::Matrix3d F = test::skewed<2>(0.4);
    const auto plane = evaluate<2>(law, F).response;
    const auto space = evaluate<3>(law, F).response;
    EXPECT_LT((plane.tau - space.tau.head<4>()).cwiseAbs().maxCoeff(), 1e-15 * kE);
    EXPECT_LT((plane.c - space.c.topLeftCorner<4, 4>()).norm(), 1e-15 * kE);
    EXPECT_DOUBLE_EQ(plane.strainEnergy, space.strainEnergy);
  }
}

TEST(NeoHookean, RefusesImpossibleModuli) {
  EXPECT_THROW(NeoHookean({0.0, 0.3}), Error);
  EXPECT_THROW(NeoHookean({-1.0, 0.3}), Error);
  EXPECT_THROW(NeoHookean({1.0, 0.5}), Error);
  EXPECT_THROW(NeoHookean({1.0, -1.0}), Error);
  EXPECT_THROW(NeoHookean({std::numeric_limits<double>::quiet_NaN(), 0.3}), Error);
}

}  // namespace
}  // namespace burnish
