#include "engine/material/hyperelastic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/material/material.h"
#include "tests/engine/material/material_checks.h"

namespace burnish {
namespace {

using test::evaluate;
using test::stretched;

constexpr double kKappa = 20.0;

/// Ogden (1972), kp/cm².
const Ogden kTreloar{{6.3, 0.012, -0.1}, {1.3, 5.0, -2.0}};
const MooneyRivlin kMooney{0.4, 0.1};
const Yeoh kYeoh{0.5, -0.02, 0.001};

template <class Energy, int N>
struct Rubber {
  using Law = Hyperelastic<Energy>;
  static constexpr int kDim = N;
};

template <class Energy>
Energy sample();
template <>
MooneyRivlin sample() {
  return kMooney;
}
template <>
Yeoh sample() {
  return kYeoh;
}
template <>
Ogden sample() {
  return kTreloar;
}

template <class Energy>
Hyperelastic<Energy> lawOf(const Energy& energy, double kappa = kKappa) {
  return Hyperelastic<Energy>({.energy = energy, .nu = {}, .kappa = kappa});
}

template <class C>
struct HyperelasticTest : testing::Test {
  template <class Energy>
  static Hyperelastic<Energy> make(std::type_identity<Hyperelastic<Energy>>) {
    return lawOf(sample<Energy>());
  }
  const typename C::Law law_ = make(std::type_identity<typename C::Law>{});
};
using Cases = testing::Types<Rubber<MooneyRivlin, 2>, Rubber<MooneyRivlin, 3>, Rubber<Yeoh, 2>,
                             Rubber<Yeoh, 3>, Rubber<Ogden, 2>, Rubber<Ogden, 3>>;
TYPED_TEST_SUITE(HyperelasticTest, Cases);

TYPED_TEST(HyperelasticTest, IsFreeOfStressWhenUndeformed) {
  constexpr int Dim = TypeParam::kDim;
  const auto response = evaluate<Dim>(this->law_, Eigen::Matrix3d::Identity()).response;
  EXPECT_EQ(response.tau.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(response.strainEnergy, 0.0);
  const double mu = this->law_.shearModulus();
  EXPECT_NEAR(response.c(0, 0), kKappa + 4.0 / 3.0 * mu, 1e-13);
  EXPECT_NEAR(response.c(0, 1), kKappa - 2.0 / 3.0 * mu, 1e-13);
  EXPECT_NEAR(response.c(3, 3), mu, 1e-14);
}

TYPED_TEST(HyperelasticTest, StressIsTheDerivativeOfTheEnergy) {
  constexpr int Dim = TypeParam::kDim;
  for (const double amount : {0.0, 1e-5, 0.05, 0.4})
    EXPECT_LT(test::stressError<Dim>(this->law_, test::skewed<Dim>(amount), {}, 1e-3, kKappa), 1e-10);
}

/// No limit of equal stretches is a case of its own.
TYPED_TEST(HyperelasticTest, TangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TypeParam::kDim;
  EXPECT_LT(
      test::tangentError<Dim>(this->law_, Eigen::Matrix3d::Identity(), {}, 1e-2, test::Differences::Eighth),
      3e-13);
  EXPECT_LT(test::tangentError<Dim>(this->law_, test::skewed<Dim>(0.05), {}, 1e-2, test::Differences::Eighth),
            3e-13);
  EXPECT_LT(test::tangentError<Dim>(this->law_, test::skewed<Dim>(0.4), {}, 1e-2, test::Differences::Eighth),
            3e-13);
  for (const double gap : {0.0, 1e-16, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.3})
    for (const double third : {1.0, 1.3 * (1.0 - gap), 0.6, 2.0})
      EXPECT_LT(test::tangentError<Dim>(this->law_, stretched<Dim>(1.3 * (1.0 + gap), 1.3, third), {}, 1e-2,
                                        test::Differences::Eighth),
                3e-13)
          << "stretches apart by " << gap << ", third " << third;
}

/// The secant over a pair of stretches is exact: it does not jump where its two parts nearly cancel.
TYPED_TEST(HyperelasticTest, TangentIsSmoothInTheGapOfTwoStretches) {
  constexpr int Dim = TypeParam::kDim;
  const auto tangentAt = [&](double gap) {
    return evaluate<Dim>(this->law_, Eigen::Vector3d(1.2 + gap, 1.2, 0.7).asDiagonal().toDenseMatrix())
        .response.c;
  };
  const auto equal = tangentAt(0.0);
  for (const double gap : {1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5})
    EXPECT_LT((tangentAt(gap) - equal).norm() / equal.norm(), 1e-15 + 5.0 * gap) << gap;
}

TYPED_TEST(HyperelasticTest, TangentIsSymmetric) {
  constexpr int Dim = TypeParam::kDim;
  const auto response = evaluate<Dim>(this->law_, test::skewed<Dim>(0.4)).response;
  EXPECT_LT((response.c - response.c.transpose()).norm(), 1e-14 * response.c.norm());
}

TYPED_TEST(HyperelasticTest, RotatesWithTheBody) {
  constexpr int Dim = TypeParam::kDim;
  const Eigen::Matrix3d F = test::skewed<Dim>(0.4);
  const Eigen::Matrix3d Q = test::rotation<Dim>(1.9);
  const auto still = evaluate<Dim>(this->law_, F).response;
  const auto turned = evaluate<Dim>(this->law_, Q * F).response;
  const Eigen::Matrix3d expected = Q * fullTensor<Dim>(still.tau) * Q.transpose();
  EXPECT_LT((fullTensor<Dim>(turned.tau) - expected).cwiseAbs().maxCoeff(), 1e-14 * kKappa);
  EXPECT_NEAR(turned.strainEnergy, still.strainEnergy, 1e-14 * kKappa);
}

TYPED_TEST(HyperelasticTest, KeepsItsDigitsAtSmallStrains) {
  constexpr int Dim = TypeParam::kDim;
  const Eigen::Matrix3d F = test::skewed<Dim>(0x1p-26);
  const Eigen::Matrix3d H = F - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d strain = 0.5 * (H + H.transpose());
  const double mu = this->law_.shearModulus();
  const double lambda = kKappa - 2.0 / 3.0 * mu;
  const Eigen::Matrix3d stress = lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * mu * strain;
  const double linear = 0.5 * lambda * std::pow(strain.trace(), 2) + mu * strain.squaredNorm();
  const auto response = evaluate<Dim>(this->law_, F).response;
  EXPECT_NEAR(response.strainEnergy / linear, 1.0, 1e-6);
  EXPECT_LT((fullTensor<Dim>(response.tau) - stress).norm() / stress.norm(), 1e-7);
}

TYPED_TEST(HyperelasticTest, RefusesWhatIsNotADeformation) {
  constexpr int Dim = TypeParam::kDim;
  typename TypeParam::Law::State next;
  MaterialResponse<Dim> out;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (const double entry : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e200}) {
    F(0, 0) = entry;
    EXPECT_FALSE(this->law_.template evaluate<Dim>(F, {}, next, out)) << "F_11 = " << entry;
  }
}

/// Mooney and Rivlin's energy is that of Ogden with the exponents 2 and -2; without C01 it is that of Yeoh, and
/// the isochoric neo-Hookean one.
TEST(Hyperelastic, EnergiesAreRelated) {
  const Eigen::Matrix3d F = test::skewed<3>(0.5);
  const auto mooney = evaluate<3>(lawOf(kMooney), F).response;
  const auto ogden = evaluate<3>(lawOf(Ogden{{0.8, -0.2}, {2.0, -2.0}}), F).response;
  EXPECT_LT((mooney.tau - ogden.tau).norm(), 1e-14);
  EXPECT_LT((mooney.c - ogden.c).norm(), 1e-13);
  EXPECT_NEAR(mooney.strainEnergy, ogden.strainEnergy, 1e-14);

  const auto neo = evaluate<3>(lawOf(MooneyRivlin{0.4, 0.0}), F).response;
  const auto yeoh = evaluate<3>(lawOf(Yeoh{0.4, 0.0, 0.0}), F).response;
  EXPECT_LT((neo.tau - yeoh.tau).norm(), 1e-14);
  const double nu = lawOf(kMooney).poissonsRatio();
  const double E = 2.0 * 0.8 * (1.0 + (3.0 * kKappa - 1.6) / (2.0 * (3.0 * kKappa + 0.8)));
  const double nuOfNeo = (3.0 * kKappa - 1.6) / (2.0 * (3.0 * kKappa + 0.8));
  const J2Plasticity elastic({E, nuOfNeo, ElasticLaw::NeoHookean, LinearHardening{1e9, 0.0}});
  const auto j2 = evaluate<3>(elastic, F).response;
  EXPECT_LT((neo.tau - j2.tau).norm(), 1e-12 * j2.tau.norm());
  EXPECT_LT((neo.c - j2.c).norm(), 1e-12 * j2.c.norm());
  EXPECT_NEAR(neo.strainEnergy, j2.strainEnergy, 1e-12 * j2.strainEnergy);
  EXPECT_LT(nu, nuOfNeo);
}

TEST(Hyperelastic, InPlaneStrainIsTheSpatialLaw) {
  const Eigen::Matrix3d F = test::skewed<2>(0.4);
  const auto plane = evaluate<2>(lawOf(kTreloar), F).response;
  const auto space = evaluate<3>(lawOf(kTreloar), F).response;
  EXPECT_LT((plane.tau - space.tau.head<4>()).cwiseAbs().maxCoeff(), 1e-14 * kKappa);
  EXPECT_LT((plane.c - space.c.topLeftCorner<4, 4>()).norm(), 1e-13 * kKappa);
  EXPECT_NEAR(plane.strainEnergy, space.strainEnergy, 1e-14 * kKappa);
}

/// Nominal stress of a block at the stretch λ, with its other faces free: the law itself, at the stretches that
/// make them so.
enum class Mode { Uniaxial, Equibiaxial, Planar };

template <class Energy>
double nominalStress(const Hyperelastic<Energy>& law, Mode mode, double stretch) {
  const auto at = [&](double free) -> Eigen::Vector3d {
    switch (mode) {
      case Mode::Uniaxial:
        return {stretch, free, free};
      case Mode::Equibiaxial:
        return {stretch, stretch, free};
      default:
        return {stretch, 1.0, free};
    }
  };
  double free = mode == Mode::Uniaxial      ? 1.0 / std::sqrt(stretch)
                : mode == Mode::Equibiaxial ? 1.0 / (stretch * stretch)
                                            : 1.0 / stretch;
  // The secant rule on the stress of the free faces.
  const auto freeStress = [&](double x) {
    return evaluate<3>(law, at(x).asDiagonal().toDenseMatrix()).response.tau[2];
  };
  double before = free * (1.0 + 1e-4);
  double stressBefore = freeStress(before);
  for (int k = 0; k < 30; ++k) {
    const double stress = freeStress(free);
    if (stress == stressBefore) break;
    const double next = free - stress * (free - before) / (stress - stressBefore);
    before = std::exchange(free, next);
    stressBefore = stress;
  }
  return evaluate<3>(law, at(free).asDiagonal().toDenseMatrix()).response.tau[0] / stretch;
}

struct Row {
  Mode mode;
  std::vector<double> stresses;
};

/// The incompressible limit, approached by κ/μ → ∞: the difference falls with μ/κ.
template <class Energy>
void expectLimit(const Energy& energy, const std::vector<double>& stretches, const std::vector<Row>& rows) {
  const double kappa = 1e6 * energy.shearModulus();
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.stresses.size(); ++k) {
      // Richardson's step from two bulk moduli
      const double coarse = nominalStress(lawOf(energy, kappa), row.mode, stretches[k]);
      const double fine = nominalStress(lawOf(energy, 2.0 * kappa), row.mode, stretches[k]);
      EXPECT_NEAR(2.0 * fine - coarse, row.stresses[k], 6e-7)
          << Energy::kind.key << ", mode " << static_cast<int>(row.mode) << ", stretch " << stretches[k];
      EXPECT_NEAR(fine / row.stresses[k], 1.0, 2e-5);
    }
}

TEST(Hyperelastic, HasTheStressesOfTheIncompressibleLimit) {
  const std::vector<double> stretches{0.8, 1.2, 2.0, 3.0};
  expectLimit(kMooney, stretches,
              {{Mode::Uniaxial, {-0.800625, 0.488704, 1.575000, 2.503704}},
               {Mode::Equibiaxial, {-2.089631, 0.868357, 3.150000, 7.789300}},
               {Mode::Planar, {-1.153125, 0.621296, 1.875000, 2.962963}}});
  expectLimit(kYeoh, stretches,
              {{Mode::Uniaxial, {-0.754050, 0.501276, 1.512000, 2.118519}},
               {Mode::Equibiaxial, {-2.128834, 0.775621, 1.474148, 3.448969}}});
  expectLimit(kTreloar, {1.2, 2.0, 3.0, 5.0},
              {{Mode::Uniaxial, {2.051579, 6.027216, 8.799261, 17.366664}},
               {Mode::Equibiaxial, {3.524338, 8.216148, 12.307049}},
               {Mode::Planar, {2.595050, 6.856225, 9.524275, 18.053843}}});
}

/// With bulk moduli of 1000 and 10,000 kp/cm², 237 and 2370 times the shear modulus, the stress at twice the
/// length is 0.28 % and 0.03 % smaller.
TEST(Hyperelastic, DiffersFromTheLimitAsMuchAsItIsCompressible) {
  EXPECT_DOUBLE_EQ(kTreloar.shearModulus(), 4.225);
  const auto deviation = [&](double kappa) {
    return nominalStress(lawOf(kTreloar, kappa), Mode::Uniaxial, 2.0) / 6.027216 - 1.0;
  };
  EXPECT_NEAR(deviation(1e3), -0.0028, 0.00005);
  EXPECT_NEAR(deviation(1e4), -0.0003, 0.00005);
}

TEST(Hyperelastic, KnowsItsModuliFromEitherKey) {
  const auto byKappa = lawOf(kMooney, 20.0);
  const Hyperelastic<MooneyRivlin> byNu({.energy = kMooney, .nu = byKappa.poissonsRatio(), .kappa = {}});
  EXPECT_EQ(byKappa.bulkModulus(), 20.0);
  EXPECT_NEAR(byNu.bulkModulus(), 20.0, 1e-12);
  EXPECT_DOUBLE_EQ(byNu.shearModulus(), 1.0);
  EXPECT_NEAR(byKappa.youngsModulus(), 9.0 * 20.0 * 1.0 / (3.0 * 20.0 + 1.0), 1e-13);
}

TEST(Hyperelastic, RefusesImpossibleConstants) {
  EXPECT_THROW(lawOf(MooneyRivlin{0.1, -0.2}), Error);
  EXPECT_THROW(lawOf(kMooney, 0.0), Error);
  EXPECT_THROW(Hyperelastic<Yeoh>({.energy = kYeoh, .nu = 0.5, .kappa = {}}), Error);
  EXPECT_THROW(Hyperelastic<Yeoh>({.energy = kYeoh, .nu = 0.49, .kappa = 10.0}), Error);
  EXPECT_THROW(Hyperelastic<Yeoh>({.energy = kYeoh, .nu = {}, .kappa = {}}), Error);
}

}  // namespace
}  // namespace burnish
