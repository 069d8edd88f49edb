#include "engine/material/j2_plasticity.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include "engine/material/material.h"
#include "tests/engine/material/material_checks.h"

namespace burnish {
namespace {

using test::evaluate;

constexpr double kE = 70000.0;
constexpr double kNu = 0.3;
constexpr double kMu = kE / (2.0 * (1.0 + kNu));
using State = J2Plasticity::State;

const VoceHardening kVoce{79.66, 171.26, 17.8};

J2Plasticity makeLaw(ElasticLaw elastic, const HardeningParameters& hardening = kVoce) {
  return J2Plasticity({kE, kNu, elastic, hardening});
}

double yieldStress(const Hardening& hardening, double e) {
  return std::visit([e](const auto& law) { return law.sigma_y(e); }, hardening);
}

/// The von Mises norm √(3/2) ‖dev τ‖.
template <int Dim>
double vonMises(const MaterialResponse<Dim>& response) {
  const Eigen::Matrix3d tau = fullTensor<Dim>(response.tau);
  return std::sqrt(1.5) * (tau - tau.trace() / 3.0 * Eigen::Matrix3d::Identity()).norm();
}

Eigen::Matrix3d squareRoot(const Eigen::Matrix3d& T) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(T).operatorSqrt();
}

/// A history whose principal axes have nothing to do with those of the steps that follow.
template <int Dim>
State flowedState(const J2Plasticity& law) {
  return evaluate<Dim>(law, test::skewed<Dim>(0.15)).state;
}

/// A deformation gradient whose trial tensor F Cp^{-1} F^T has the principal stretches a, b, c.
template <int Dim>
Eigen::Matrix3d withTrialStretches(const State& old, double a, double b, double c) {
  return test::stretched<Dim>(a, b, c) * squareRoot(old.Cp_inv()).inverse();
}

template <class P>
class J2Test : public testing::Test {
 protected:
  static constexpr int kDim = std::tuple_element_t<0, P>::value;
  static constexpr ElasticLaw kElastic = std::tuple_element_t<1, P>::value;
  const J2Plasticity law_ = makeLaw(kElastic);
};

template <int Dim, ElasticLaw law>
using Combination = std::tuple<std::integral_constant<int, Dim>, std::integral_constant<ElasticLaw, law>>;
using Combinations =
    testing::Types<Combination<2, ElasticLaw::NeoHookean>, Combination<3, ElasticLaw::NeoHookean>,
                   Combination<2, ElasticLaw::Hencky>, Combination<3, ElasticLaw::Hencky>>;
TYPED_TEST_SUITE(J2Test, Combinations);

constexpr double kRatios[] = {0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1};

TYPED_TEST(J2Test, IsFreeOfStressAtTheStart) {
  constexpr int Dim = TestFixture::kDim;
  const auto response = evaluate<Dim>(this->law_, Eigen::Matrix3d::Identity()).response;
  EXPECT_EQ(response.tau.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(response.strainEnergy, 0.0);
  const double lambda = kE * kNu / ((1.0 + kNu) * (1.0 - 2.0 * kNu));
  EXPECT_NEAR(response.c(0, 0), lambda + 2.0 * kMu, 1e-14 * kE);
  EXPECT_NEAR(response.c(1, 2), lambda, 1e-14 * kE);
  EXPECT_NEAR(response.c(3, 3), kMu, 1e-14 * kE);
}

TYPED_TEST(J2Test, ElasticStressIsTheDerivativeOfTheEnergy) {
  constexpr int Dim = TestFixture::kDim;
  const J2Plasticity strong = makeLaw(TestFixture::kElastic, LinearHardening{1e9, 0.0});
  for (const double amount : {0.0, 1e-4, 0.05, 0.3})
    EXPECT_LT(test::stressError<Dim>(strong, test::skewed<Dim>(amount), {}, 1e-3, kE), 1e-10) << amount;
}

TYPED_TEST(J2Test, ElasticTangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TestFixture::kDim;
  const J2Plasticity strong = makeLaw(TestFixture::kElastic, LinearHardening{1e9, 0.0});
  const State flowed = flowedState<Dim>(this->law_);
  for (const State& old : {State{}, flowed})
    for (const double ratio : kRatios) {
      const Eigen::Matrix3d F = withTrialStretches<Dim>(old, 1.2 * (1.0 + ratio), 1.2, 0.9);
      EXPECT_LT(test::tangentError<Dim>(strong, F, old, 3e-4), 1e-9) << "stretches at 1 + " << ratio;
    }
}

TYPED_TEST(J2Test, PlasticTangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TestFixture::kDim;
  const State flowed = flowedState<Dim>(this->law_);
  for (const State& old : {State{}, flowed})
    for (const double third : {0.995, 0.9, 0.4})
      for (const double ratio : kRatios) {
        const Eigen::Matrix3d F = withTrialStretches<Dim>(old, 1.02 * (1.0 + ratio), 1.02, third);
        EXPECT_GT(evaluate<Dim>(this->law_, F, old).state.e_p, old.e_p);
        EXPECT_LT(test::tangentError<Dim>(this->law_, F, old, 2e-6), 1e-8)
            << "third stretch " << third << ", others at 1 + " << ratio << ", e_p,n " << old.e_p;
      }
}

/// Large elastic strains, where the direction of flow turns during the return.
TYPED_TEST(J2Test, PlasticTangentHoldsAtLargeElasticStrains) {
  constexpr int Dim = TestFixture::kDim;
  for (const double strength : {0.05, 0.3, 1.0}) {
    const J2Plasticity soft = makeLaw(TestFixture::kElastic, LinearHardening{strength * kMu, 0.1 * kMu});
    for (const double ratio : kRatios) {
      const Eigen::Matrix3d F = test::stretched<Dim>(2.0 * (1.0 + ratio), 2.0, 0.5);
      EXPECT_GT(evaluate<Dim>(soft, F).state.e_p, 0.0);
      EXPECT_LT(test::tangentError<Dim>(soft, F, {}, 1e-4), 1e-8)
          << "strength " << strength << ", ratio " << ratio;
    }
  }
}

TYPED_TEST(J2Test, TangentJoinsAtTheLimitOfEqualStretches) {
  constexpr int Dim = TestFixture::kDim;
  for (const double third : {0.9995, 0.99, 0.5}) {  // the first is elastic
    const auto tangentAt = [&](double squaredDifference) {
      const double a = std::sqrt(1.0 - squaredDifference);
      return evaluate<Dim>(this->law_, test::stretched<Dim>(a, 1.0, third)).response.c;
    };
    const auto inside = tangentAt(0.999999e-6);
    const auto outside = tangentAt(1.000001e-6);
    EXPECT_LT((inside - outside).norm() / inside.norm(), 2e-9) << third;
  }
}

TYPED_TEST(J2Test, TangentIsSymmetric) {
  constexpr int Dim = TestFixture::kDim;
  const auto response =
      evaluate<Dim>(this->law_, test::skewed<Dim>(0.2), flowedState<Dim>(this->law_)).response;
  EXPECT_LT((response.c - response.c.transpose()).norm(), 1e-14 * response.c.norm());
}

TYPED_TEST(J2Test, RotatesWithTheBody) {
  constexpr int Dim = TestFixture::kDim;
  const Eigen::Matrix3d Q = test::rotation<Dim>(2.3);
  for (const double amount : {1e-4, 0.3}) {
    const State old = flowedState<Dim>(this->law_);
    const Eigen::Matrix3d F = test::skewed<Dim>(amount) * squareRoot(old.Cp_inv()).inverse();
    const auto still = evaluate<Dim>(this->law_, F, old);
    const auto turned = evaluate<Dim>(this->law_, Q * F, old);
    const Eigen::Matrix3d expected = Q * fullTensor<Dim>(still.response.tau) * Q.transpose();
    EXPECT_LT((fullTensor<Dim>(turned.response.tau) - expected).norm(), 1e-14 * kE);
    EXPECT_LT((turned.state.Cp_inv() - still.state.Cp_inv()).norm(), 1e-12);
    EXPECT_NEAR(turned.state.e_p, still.state.e_p, 1e-13);
  }
}

TYPED_TEST(J2Test, MeetsTheYieldConditionAfterSmallAndLargeSteps) {
  constexpr int Dim = TestFixture::kDim;
  const State yielded = evaluate<Dim>(this->law_, test::stretched<Dim>(1.01, 0.99, 1.0)).state;
  for (const double increment : {1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 3.0}) {
    const double a = std::exp(increment);
    const Eigen::Matrix3d F = test::stretched<Dim>(1.01 * a, 0.99 / a, 1.0);
    const auto step = evaluate<Dim>(this->law_, F, yielded);
    EXPECT_GT(step.state.e_p, yielded.e_p) << increment;
    const double sigma_y = kVoce.sigma_y(step.state.e_p);
    EXPECT_NEAR(vonMises(step.response), sigma_y, 1e-12 * sigma_y) << increment;
  }
}

TYPED_TEST(J2Test, FlowIsIsochoricOverManySteps) {
  constexpr int Dim = TestFixture::kDim;
  State state;
  for (int step = 1; step <= 500; ++step) {
    const double t = 0.02 * step;
    const Eigen::Matrix3d F =
        test::rotation<Dim>(t) * test::skewed<Dim>(0.3 * std::sin(3.0 * t)) * test::rotation<Dim>(0.7 * t);
    state = evaluate<Dim>(this->law_, F, state).state;
    EXPECT_EQ(state.b_e, state.b_e.transpose());
  }
  EXPECT_GT(state.e_p, 2.0);
  EXPECT_NEAR(state.Cp_inv().determinant(), 1.0, 1e-12);
}

/// A path with constant volume and axes: σ_y(e_p) = q(ln λ − e_p) with q(ε) = 3με (Hencky) or μ (e^{2ε} −
/// e^{−ε}) (neo-Hookean), however many steps are taken.
TYPED_TEST(J2Test, FollowsTheAnalyticTensionPath) {
  if constexpr (TestFixture::kDim == 3) {
    for (const double strain : {0.01, 0.3, 1.5}) {
      const auto excess = [&](double e_p) {
        const double e = strain - e_p;
        const bool hencky = TestFixture::kElastic == ElasticLaw::Hencky;
        return (hencky ? 3.0 * kMu * e : kMu * (std::exp(2.0 * e) - std::exp(-e))) - kVoce.sigma_y(e_p);
      };
      double low = 0.0;
      double high = strain;
      for (int k = 0; k < 60; ++k) (excess(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
      for (const int steps : {1, 7, 100}) {
        State state;
        for (int k = 1; k <= steps; ++k) {
          const double e = strain * k / steps;
          state = evaluate<3>(this->law_,
                              test::stretched<3>(std::exp(e), std::exp(-0.5 * e), std::exp(-0.5 * e)), state)
                      .state;
        }
        EXPECT_NEAR(state.e_p, low, 1e-13) << "strain " << strain << ", steps " << steps;
      }
    }
  }
}

TYPED_TEST(J2Test, PlasticWorkIsTheHardeningIntegral) {
  constexpr int Dim = TestFixture::kDim;
  State state;
  double sum = 0.0;
  for (int step = 1; step <= 10; ++step) {
    const auto next = evaluate<Dim>(this->law_, test::skewed<Dim>(0.03 * step), state);
    EXPECT_GT(next.response.plasticWork, 0.0);
    sum += next.response.plasticWork;
    state = next.state;
  }
  EXPECT_NEAR(sum, kVoce.work(state.e_p), 1e-13 * sum);
}

/// What the stress does along a fine path is stored or dissipated.
TYPED_TEST(J2Test, WorkOfTheStressIsEnergyPlusPlasticWork) {
  constexpr int Dim = TestFixture::kDim;
  constexpr int kSteps = 400;
  State state;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  double external = 0.0;
  double dissipated = 0.0;
  double stored = 0.0;
  for (int step = 1; step <= kSteps; ++step) {
    const Eigen::Matrix3d F_next = test::skewed<Dim>(0.3 * step / kSteps);
    const auto next = evaluate<Dim>(this->law_, F_next, state);
    const Eigen::Matrix3d P_next = fullTensor<Dim>(next.response.tau) * F_next.inverse().transpose();
    external += 0.5 * (P + P_next).cwiseProduct(F_next - F).sum();
    dissipated += next.response.plasticWork;
    stored = next.response.strainEnergy;
    state = next.state;
    F = F_next;
    P = P_next;
  }
  EXPECT_NEAR(external / (stored + dissipated), 1.0, 2e-4);
}

TYPED_TEST(J2Test, UnloadsElastically) {
  constexpr int Dim = TestFixture::kDim;
  const State loaded = evaluate<Dim>(this->law_, test::stretched<Dim>(1.2, 0.85, 1.0)).state;
  const Eigen::Matrix3d F = test::stretched<Dim>(1.1995, 0.8504, 1.0);
  const auto unloaded = evaluate<Dim>(this->law_, F, loaded);
  EXPECT_EQ(unloaded.state.e_p, loaded.e_p);
  EXPECT_EQ(unloaded.state.Cp_inv(), loaded.Cp_inv());
  EXPECT_EQ(unloaded.response.plasticWork, 0.0);
  EXPECT_LT(vonMises(unloaded.response), 0.9 * kVoce.sigma_y(loaded.e_p));
  const J2Plasticity strong = makeLaw(TestFixture::kElastic, LinearHardening{1e9, 0.0});
  EXPECT_EQ(unloaded.response.tau, evaluate<Dim>(strong, F, loaded).response.tau);
  EXPECT_EQ(unloaded.response.c, evaluate<Dim>(strong, F, loaded).response.c);
}

TYPED_TEST(J2Test, StaysElasticWhenAFinishedStepIsEvaluatedAgain) {
  constexpr int Dim = TestFixture::kDim;
  const Eigen::Matrix3d F = test::skewed<Dim>(0.2);
  const auto step = evaluate<Dim>(this->law_, F);
  const auto again = evaluate<Dim>(this->law_, F, step.state);
  EXPECT_EQ(again.state.e_p, step.state.e_p);
  EXPECT_EQ(again.state.Cp_inv(), step.state.Cp_inv());
  EXPECT_LT((again.response.tau - step.response.tau).norm(), 1e-11 * step.response.tau.norm());
  EXPECT_NEAR(again.response.strainEnergy, step.response.strainEnergy, 1e-11 * step.response.strainEnergy);
}

/// Tension followed by shear in turning axes: halving the step halves the error (backward Euler).
TYPED_TEST(J2Test, ConvergesWithFirstOrder) {
  constexpr int Dim = TestFixture::kDim;
  const auto finalState = [&](int steps) {
    State state;
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      Eigen::Matrix3d U = Eigen::Vector3d(1.0 + 0.3 * t, 1.0 - 0.15 * t, 1.0).asDiagonal();
      U(0, 1) = 0.5 * t * t;
      state = evaluate<Dim>(this->law_, test::rotation<Dim>(2.0 * t) * U, state).state;
    }
    return state;
  };
  const State exact = finalState(4096);
  const auto error = [&](int steps) { return (finalState(steps).Cp_inv() - exact.Cp_inv()).norm(); };
  const double coarse = error(32);
  const double middle = error(64);
  const double fine = error(128);
  EXPECT_GT(coarse, 1e-5);
  EXPECT_NEAR(coarse / middle, 2.0, 0.2);
  EXPECT_NEAR(middle / fine, 2.0, 0.1);
}

TYPED_TEST(J2Test, RefusesWhatIsNotADeformation) {
  constexpr int Dim = TestFixture::kDim;
  State next;
  MaterialResponse<Dim> out;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (const double entry : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e200}) {
    F(0, 0) = entry;
    EXPECT_FALSE(this->law_.template evaluate<Dim>(F, {}, next, out)) << "F_11 = " << entry;
  }
}

TYPED_TEST(J2Test, RefusesAYieldStressThatVanishes) {
  constexpr int Dim = TestFixture::kDim;
  const J2Plasticity softening =
      makeLaw(TestFixture::kElastic, FormulaHardening::Parameters{"100*(1 - 2*ep)"});
  State next;
  MaterialResponse<Dim> out;
  EXPECT_TRUE(softening.evaluate<Dim>(test::stretched<Dim>(1.2, 1.0 / 1.2, 1.0), {}, next, out));
  EXPECT_FALSE(softening.evaluate<Dim>(test::stretched<Dim>(3.0, 1.0 / 3.0, 1.0), {}, next, out));
}

TYPED_TEST(J2Test, FormulaAndClosedFormAgree) {
  constexpr int Dim = TestFixture::kDim;
  const FormulaHardening::Parameters formula{"79.66 + 91.6*(1 - exp(-17.8*ep))"};
  const State old = flowedState<Dim>(this->law_);
  const Eigen::Matrix3d F = test::skewed<Dim>(0.3);
  const auto closed = evaluate<Dim>(this->law_, F, old);
  const auto read = evaluate<Dim>(makeLaw(TestFixture::kElastic, formula), F, old);
  EXPECT_NEAR(read.state.e_p, closed.state.e_p, 1e-14);
  EXPECT_LT((read.response.tau - closed.response.tau).norm(), 1e-12 * closed.response.tau.norm());
  EXPECT_LT((read.response.c - closed.response.c).norm(), 1e-11 * closed.response.c.norm());
  EXPECT_NEAR(read.response.plasticWork, closed.response.plasticWork, 1e-12 * closed.response.plasticWork);
}

/// With a linear law the Hencky return is one linear equation.
TEST(J2Hencky, ReturnsInClosedFormWithLinearHardening) {
  const LinearHardening linear{100.0, 500.0};
  const J2Plasticity law = makeLaw(ElasticLaw::Hencky, linear);
  const Eigen::Vector3d logs(0.2, -0.05, 0.1);
  State old;
  old.e_p = 0.1;
  const auto step =
      evaluate<3>(law, test::stretched<3>(std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2])), old);
  const double root = std::sqrt(2.0 / 3.0);
  const double trialNorm = 2.0 * kMu * (logs.array() - logs.mean()).matrix().norm();
  const double deltaGamma =
      (trialNorm - root * linear.sigma_y(old.e_p)) / (2.0 * kMu + 2.0 / 3.0 * linear.modulus);
  EXPECT_NEAR(step.state.e_p, old.e_p + root * deltaGamma, 1e-14);
  EXPECT_NEAR(fullTensor<3>(step.response.tau).trace() / 3.0, kE / (3.0 * (1.0 - 2.0 * kNu)) * logs.sum(),
              1e-9);
}

TEST(J2Plasticity, InPlaneStrainIsTheSpatialLaw) {
  for (const ElasticLaw elastic : {ElasticLaw::NeoHookean, ElasticLaw::Hencky}) {
    const J2Plasticity law = makeLaw(elastic);
    State planeState;
    State spaceState;
    for (const double amount : {1e-4, 0.05, 0.2, 0.199}) {
      const Eigen::Matrix3d F = test::skewed<2>(amount);
      const auto plane = evaluate<2>(law, F, planeState);
      const auto space = evaluate<3>(law, F, spaceState);
      EXPECT_LT((plane.response.tau - space.response.tau.head<4>()).norm(), 1e-14 * kE);
      EXPECT_LT((plane.response.c - space.response.c.topLeftCorner<4, 4>()).norm(), 1e-10 * kE);
      EXPECT_LT(space.response.tau.tail<2>().norm(), 1e-14 * kE);
      EXPECT_NEAR(plane.state.e_p, space.state.e_p, 1e-14);
      EXPECT_LT((plane.state.Cp_inv() - space.state.Cp_inv()).norm(), 1e-14);
      EXPECT_NEAR(plane.response.strainEnergy, space.response.strainEnergy, 1e-12 * kE);
      planeState = plane.state;
      spaceState = space.state;
    }
  }
}

/// From hard metals to materials that are softer than any, with hardening, softening and corners, up to trial
/// strains of 20.
TEST(ReturnMap, SolvesItsEquations) {
  const std::vector<Hardening> laws = {
      LinearHardening{1.0, 0.0},
      LinearHardening{1.0, 300.0},
      VoceHardening{1.0, 3.0, 200.0},
      VoceHardening{1.0, 0.2, 50.0},
      TableHardening({{0.0, 0.02, 0.021, 0.5}, {1.0, 1.01, 2.0, 0.7}}),
      FormulaHardening({"1 + 5*ep^2"}),
      FormulaHardening({"(1e-4 + ep)^0.3"}),
  };
  for (const ElasticLaw elastic : {ElasticLaw::NeoHookean, ElasticLaw::Hencky})
    for (const double mu : {0.2, 1.0, 10.0, 1e3, 1e6})
      for (const double size : {1e-5, 1e-3, 0.1, 1.0, 4.0, 20.0})
        for (const double angle : {0.0, 0.4, 1.0, 1.8, 2.6, 3.5, 5.9})
          for (std::size_t k = 0; k < laws.size(); ++k) {
            const Eigen::Array3d e_tr =
                size * Eigen::Array3d(std::cos(angle), std::cos(angle - 2.0 * std::numbers::pi / 3.0),
                                      std::cos(angle + 2.0 * std::numbers::pi / 3.0));
            const Eigen::Array3d stretches = (2.0 * e_tr).exp();  // neo-Hookean: squared
            const Eigen::Array3d trialStress =
                mu * (elastic == ElasticLaw::Hencky ? 2.0 * e_tr : stretches - stretches.mean());
            if (trialStress.matrix().norm() <= kRootTwoThirds * yieldStress(laws[k], 0.0)) continue;
            std::optional<PrincipalState> state;
            const TrialState trial{e_tr, 0.0};
            returnMap({elastic, mu}, laws[k], std::span(&trial, 1), std::span(&state, 1));
            ASSERT_TRUE(state) << "law " << k << ", mu " << mu << ", size " << size << ", angle " << angle;
            const double norm = state->s.matrix().norm();
            const double deltaGamma = state->e_p / kRootTwoThirds;
            EXPECT_NEAR(norm / (kRootTwoThirds * yieldStress(laws[k], state->e_p)), 1.0, 1e-12)
                << "law " << k << ", mu " << mu << ", size " << size << ", angle " << angle;
            const Eigen::Array3d flow = state->e + deltaGamma * state->s / norm - e_tr;
            EXPECT_LT(flow.matrix().norm(), 1e-14 * size)
                << "law " << k << ", mu " << mu << ", size " << size << ", angle " << angle;
          }
}

/// Elastic points, points that flow, in numbers that fill the lanes and that do not.
TEST(J2Plasticity, AnswersTheSameAtSeveralPointsAsAtEachOfThem) {
  const J2Plasticity law = makeLaw(ElasticLaw::NeoHookean);
  std::vector<Eigen::Matrix3d> F;
  for (int k = 0; k < 11; ++k) F.push_back(test::skewed<2>(k % 3 == 0 ? 1e-5 * k : 0.01 * k));
  const std::vector<State> old(F.size());
  for (std::size_t count = 1; count <= F.size(); ++count) {
    std::vector<State> next(count);
    std::vector<MaterialResponse<2>> out(count);
    ASSERT_TRUE(law.evaluateAll<2>(std::span(F).first(count), std::span(old).first(count), std::span(next),
                                   std::span(out)));
    for (std::size_t q = 0; q < count; ++q) {
      const auto alone = evaluate<2>(law, F[q]);
      EXPECT_EQ(next[q].e_p, alone.state.e_p);
      EXPECT_EQ(next[q].b_e, alone.state.b_e);
      EXPECT_EQ(out[q].tau, alone.response.tau);
      EXPECT_EQ(out[q].c, alone.response.c);
    }
  }
}

/// A point that has no answer keeps none of the others from theirs.
TEST(ReturnMap, SolvesItsEquationsBesideAPointWithoutASolution) {
  const TrialState good{{0.02, -0.01, -0.01}, 0.0}, bad{{400.0, -200.0, -200.0}, 0.0};
  const std::vector<TrialState> trials{good, bad, good};
  std::vector<std::optional<PrincipalState>> states(3);
  returnMap({ElasticLaw::NeoHookean, 1e3}, VoceHardening{1.0, 3.0, 200.0}, trials, states);
  EXPECT_FALSE(states[1]);
  ASSERT_TRUE(states[0] && states[2]);
  EXPECT_EQ(states[0]->e_p, states[2]->e_p);
  EXPECT_GT(states[0]->e_p, 0.0);
}

TEST(Material, KnowsItsYoungsModulus) {
  EXPECT_EQ(youngsModulus(Material(NeoHookean({3.0, 0.2}))), 3.0);
  EXPECT_EQ(youngsModulus(Material(makeLaw(ElasticLaw::Hencky))), kE);
}

}  // namespace
}  // namespace burnish
