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

constexpr double kYoung = 3.0;
constexpr double kPoisson = 0.3;
constexpr double kShear = kYoung / (2.0 * (1.0 + kPoisson));
constexpr double kLame = kYoung * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));

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
    const auto response =
        evaluate<Dim>(NeoHookean({kYoung, kPoisson, form}), Eigen::Matrix3d::Identity()).response;
    EXPECT_EQ(response.tau.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(response.strainEnergy, 0.0);
    EXPECT_EQ(response.plasticWork, 0.0);
    EXPECT_NEAR(response.c(0, 0), kLame + 2.0 * kShear, 1e-14);
    EXPECT_NEAR(response.c(0, 1), kLame, 1e-14);
    EXPECT_NEAR(response.c(3, 3), kShear, 1e-14);
  }
}

TYPED_TEST(NeoHookeanTest, StressIsThatOfTheFirstPiolaKirchhoffFormula) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms) {
    const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
    const double J = F.determinant();
    const double JU = form == Volumetric::Log ? kLame * std::log(J) : 0.5 * kLame * (J * J - 1.0);
    const Eigen::Matrix3d F_invT = F.inverse().transpose();
    const Eigen::Matrix3d P = kShear * (F - F_invT) + JU * F_invT;
    const auto tau = fullTensor<Dim>(evaluate<Dim>(NeoHookean({kYoung, kPoisson, form}), F).response.tau);
    EXPECT_LT((tau - P * F.transpose()).cwiseAbs().maxCoeff(), 1e-14 * kYoung);
  }
}

TYPED_TEST(NeoHookeanTest, EnergyIsThatOfTheFormula) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms) {
    const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
    const double J = F.determinant();
    const double logJ = std::log(J);
    const double U =
        form == Volumetric::Log ? 0.5 * kLame * logJ * logJ : 0.25 * kLame * (J * J - 1.0 - 2.0 * logJ);
    const double W = 0.5 * kShear * (F.squaredNorm() - 3.0) - kShear * logJ + U;
    EXPECT_NEAR(evaluate<Dim>(NeoHookean({kYoung, kPoisson, form}), F).response.strainEnergy, W,
                1e-14 * kYoung);
  }
}

TYPED_TEST(NeoHookeanTest, StressIsTheDerivativeOfTheEnergy) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms)
    for (const double amount : {0.0, 1e-5, 0.05, 0.4})
      EXPECT_LT(test::stressError<Dim>(NeoHookean({kYoung, kPoisson, form}), test::skewed<Dim>(amount), {},
                                       1e-3, kYoung),
                1e-10);
}

TYPED_TEST(NeoHookeanTest, TangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TypeParam::value;
  for (const Volumetric form : kForms)
    for (const Eigen::Matrix3d& F :
         {Eigen::Matrix3d::Identity().eval(), (1.3 * Eigen::Matrix3d::Identity()).eval(),
          test::skewed<Dim>(0.05), test::skewed<Dim>(0.4), test::stretched<Dim>(0.3, 2.0, 1.1)})
      EXPECT_LT(test::tangentError<Dim>(NeoHookean({kYoung, kPoisson, form}), F, {}, 1e-3), 1e-9);
}

TYPED_TEST(NeoHookeanTest, RotatesWithTheBody) {
  constexpr int Dim = TypeParam::value;
  const NeoHookean law({kYoung, kPoisson});
  const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
  const Eigen::Matrix3d Q = test::rotation<Dim>(1.9);
  const auto still = evaluate<Dim>(law, F).response;
  const auto turned = evaluate<Dim>(law, Q * F).response;
  const Eigen::Matrix3d expected = Q * fullTensor<Dim>(still.tau) * Q.transpose();
  EXPECT_LT((fullTensor<Dim>(turned.tau) - expected).cwiseAbs().maxCoeff(), 1e-14 * kYoung);
  EXPECT_NEAR(turned.strainEnergy, still.strainEnergy, 1e-14 * kYoung);
}

/// At a strain of 1e-8 the energy is 1e-16 E: terms of first order must not cancel in round-off.
TYPED_TEST(NeoHookeanTest, KeepsItsDigitsAtSmallStrains) {
  constexpr int Dim = TypeParam::value;
  constexpr double amount = 0x1p-26;
  const Eigen::Matrix3d F = test::skewed<Dim>(amount);
  const Eigen::Matrix3d H = F - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d strain = 0.5 * (H + H.transpose());
  const double linear = 0.5 * kLame * std::pow(strain.trace(), 2) + kShear * strain.squaredNorm();
  const Eigen::Matrix3d stress = kLame * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * kShear * strain;
  const auto response = evaluate<Dim>(NeoHookean({kYoung, kPoisson}), F).response;
  EXPECT_NEAR(response.strainEnergy / linear, 1.0, 1e-6);
  EXPECT_LT((fullTensor<Dim>(response.tau) - stress).norm() / stress.norm(), 1e-7);
}

TYPED_TEST(NeoHookeanTest, IsElasticAndRemembersNothing) {
  constexpr int Dim = TypeParam::value;
  const Eigen::Matrix3d F = test::skewed<Dim>(0.1);
  EXPECT_TRUE(std::is_empty_v<NeoHookean::State>);
  EXPECT_LT((NeoHookean({kYoung, kPoisson}).elasticDeformation(F, {}) - F * F.transpose()).norm(), 1e-15);
}

TYPED_TEST(NeoHookeanTest, RefusesWhatIsNotADeformation) {
  constexpr int Dim = TypeParam::value;
  const NeoHookean law({kYoung, kPoisson});
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
    const NeoHookean law({kYoung, kPoisson, form});
    const Eigen::Matrix3d F = test::skewed<2>(0.4);
    const auto plane = evaluate<2>(law, F).response;
    const auto space = evaluate<3>(law, F).response;
    EXPECT_LT((plane.tau - space.tau.head<4>()).cwiseAbs().maxCoeff(), 1e-15 * kYoung);
    EXPECT_LT((plane.c - space.c.topLeftCorner<4, 4>()).norm(), 1e-15 * kYoung);
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
