#include "engine/material/chaboche.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/material/j2_plasticity.h"
#include "engine/material/logarithmic_strain.h"
#include "tests/engine/material/material_checks.h"

namespace burnish::chaboche_test {
namespace {

using test::evaluate;
using State = Chaboche::State;

constexpr double kE = 200000.0;
constexpr double kNu = 0.3;
constexpr double kMu = kE / (2.0 * (1.0 + kNu));

/// The law with a step of a given length.
struct WithStep {
  using State = Chaboche::State;
  Chaboche law;
  double dt = 1.0;

  template <int Dim>
  bool evaluate(const Eigen::Matrix3d& F, const State& old, State& next, MaterialResponse<Dim>& out) const {
    return law.evaluate<Dim>(F, dt, old, next, out);
  }
};

Chaboche::Parameters perfect() {
  Chaboche::Parameters parameters;
  parameters.E = kE;
  parameters.nu = kNu;
  parameters.hardening = LinearHardening{200.0, 0.0};
  return parameters;
}

/// The metal with three back stresses that most of the tests are about.
Chaboche::Parameters metal() {
  Chaboche::Parameters p = perfect();
  p.backStresses = {{100000.0, 1000.0}, {20000.0, 200.0}, {2000.0, 10.0}};
  return p;
}

Chaboche::Parameters hardeningMetal() {
  Chaboche::Parameters p = metal();
  p.hardening = VoceHardening{200.0, 300.0, 20.0};
  return p;
}

/// The same with recoveries after Ohno and Wang, but for the last one.
Chaboche::Parameters ohnoWangMetal() {
  Chaboche::Parameters p = hardeningMetal();
  p.backStresses[0].exponent = 5.0;
  p.backStresses[1].exponent = 100.0;
  return p;
}

HillYield sheet(double angle = 0.0) {
  return {1.8, 1.2, 2.2, {std::cos(angle), -std::sin(angle), 0.0}, {std::sin(angle), std::cos(angle), 0.0}};
}

/// A material point under uniaxial stress, whose stress T = τ and logarithmic strain are prescribed by turns.
class Bar {
 public:
  explicit Bar(const Chaboche::Parameters& parameters, double dt = 1.0) : law_{Chaboche(parameters), dt} {}

  void stretchTo(double strain) {
    solve([=](double, double e) { return e - strain; }, 0.0, 1.0);
  }
  void pullTo(double stress) {
    solve([=](double tau, double) { return tau - stress; }, 1.0, 0.0);
  }
  void hold() { stretchTo(axial_); }

  /// The same bar, whose steps take another time from now on.
  Bar withStep(double dt) const {
    Bar bar = *this;
    bar.law_.dt = dt;
    return bar;
  }

  double stress() const { return stress_; }
  double plasticStrain() const { return axial_ - stress_ / kE; }
  double energy() const { return energy_; }
  double plasticWork() const { return plasticWork_; }
  const State& state() const { return state_; }

 private:
  template <class Residual>
  void solve(const Residual& residual, double byStress, double byStrain) {
    double axial = axial_, lateral = lateral_;
    for (int k = 0; k < 100; ++k) {
      const Eigen::Matrix3d F =
          Eigen::Vector3d(std::exp(axial), std::exp(lateral), std::exp(lateral)).asDiagonal();
      const auto [response, state] = evaluate<3>(law_, F, state_);
      const auto& c = response.c;
      const Eigen::Vector2d r(residual(response.tau[0], axial), response.tau[1]);
      if (k > 0 && r.norm() < 2e-9) {
        axial_ = axial, lateral_ = lateral, stress_ = response.tau[0], state_ = state;
        energy_ = response.strainEnergy, plasticWork_ += response.plasticWork;
        return;
      }
      Eigen::Matrix2d J;
      J << byStrain + byStress * (c(0, 0) + 2.0 * response.tau[0]), byStress * 2.0 * c(0, 1),  //
          c(1, 0), c(1, 1) + 2.0 * response.tau[1] + c(1, 2);
      const Eigen::Vector2d step = J.partialPivLu().solve(r);
      axial -= step[0], lateral -= step[1];
    }
    throw std::runtime_error("the bar finds no equilibrium");
  }

  WithStep law_;
  State state_;
  double axial_ = 0.0, lateral_ = 0.0, stress_ = 0.0, energy_ = 0.0, plasticWork_ = 0.0;
};

template <class P>
class ChabocheTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ChabocheTest, Dimensions);

/// What the law can be, for facts that hold of all of them.
std::vector<Chaboche::Parameters> allKinds() {
  std::vector<Chaboche::Parameters> kinds{perfect(),        metal(),          hardeningMetal(),
                                          hardeningMetal(), hardeningMetal(), hardeningMetal(),
                                          hardeningMetal(), hardeningMetal(), ohnoWangMetal(),
                                          ohnoWangMetal(),  ohnoWangMetal()};
  kinds[3].substeps = 5;
  kinds[4].rate = NortonRate{150.0, 5.0};
  kinds[5].rate = JohnsonCookRate{0.05, 1e-3};
  kinds[6].hill = sheet(0.4);
  kinds[7] = kinds[4];
  kinds[7].hill = sheet(0.4);
  kinds[7].substeps = 3;
  kinds[9].substeps = 3;
  kinds[9].hill = sheet(0.4);
  kinds[10].rate = NortonRate{150.0, 5.0};
  kinds.push_back(hardeningMetal());
  kinds.back().rate = FormulaRate::Parameters{"sigma_y*(1 + 0.3*ep*rate) + 150*rate^0.2"};
  kinds.back().substeps = 2;
  return kinds;
}

/// A history whose axes have nothing to do with those of the steps that follow, and F there.
template <int Dim>
std::pair<State, Eigen::Matrix3d> flowed(const WithStep& law) {
  State state;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (int k = 1; k <= 6; ++k) {
    F = test::rotation<Dim>(0.1 * k) * test::skewed<Dim>(0.02 * k) *
        test::stretched<Dim>(1.0 + 0.01 * k, 1.0, 1.0 - 0.02 * k);
    state = evaluate<Dim>(law, F, state).state;
  }
  return {state, F};
}

TYPED_TEST(ChabocheTest, TangentIsTheDerivativeOfTheStress) {
  constexpr int Dim = TypeParam::value;
  const auto kinds = allKinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const WithStep law{Chaboche(kinds[k])};
    const auto [old, F] = flowed<Dim>(law);
    for (const double amount : {0.002, 0.02, 0.3}) {
      const Eigen::Matrix3d next = test::skewed<Dim>(amount) * F;
      EXPECT_GT(evaluate<Dim>(law, next, old).state.e_p, old.e_p);
      EXPECT_LT(test::tangentError<Dim>(law, next, old, 1e-6), 2e-8) << "kind " << k << ", step " << amount;
    }
  }
}

TYPED_TEST(ChabocheTest, TangentIsNotSymmetricWhereRecoveryMeetsATurn) {
  constexpr int Dim = TypeParam::value;
  const auto skewness = [](const Chaboche::Parameters& parameters) {
    const WithStep law{Chaboche(parameters)};
    const auto [old, F] = flowed<Dim>(law);
    const auto c = evaluate<Dim>(law, test::skewed<Dim>(0.01) * F, old).response.c;
    return (c - c.transpose()).cwiseAbs().maxCoeff() / c.cwiseAbs().maxCoeff();
  };
  EXPECT_GT(skewness(metal()), 1e-3);
  EXPECT_FALSE(Chaboche(metal()).hasSymmetricTangent());
  Chaboche::Parameters linear = hardeningMetal();
  for (auto& back : linear.backStresses) back.recovery = 0.0;
  linear.rate = NortonRate{150.0, 5.0};
  linear.hill = sheet();
  EXPECT_LT(skewness(linear), 1e-13);
  EXPECT_TRUE(Chaboche(linear).hasSymmetricTangent());
}

TYPED_TEST(ChabocheTest, RotatesWithTheBody) {
  constexpr int Dim = TypeParam::value;
  const Eigen::Matrix3d Q = test::rotation<Dim>(2.3);
  for (const auto& kind : allKinds()) {
    const WithStep law{Chaboche(kind)};
    const auto [old, F] = flowed<Dim>(law);
    const auto still = evaluate<Dim>(law, test::skewed<Dim>(0.05) * F, old);
    const auto turned = evaluate<Dim>(law, Q * test::skewed<Dim>(0.05) * F, old);
    const Eigen::Matrix3d expected = Q * fullTensor<Dim>(still.response.tau) * Q.transpose();
    EXPECT_LT((fullTensor<Dim>(turned.response.tau) - expected).norm(), 3e-14 * kE);
    EXPECT_NEAR(turned.state.e_p, still.state.e_p, 3e-14);
    EXPECT_LT((turned.state.X - still.state.X).norm(), 3e-14 * kE);
  }
}

/// A new reference configuration changes nothing: X in the axes of space, and those of the sheet.
TYPED_TEST(ChabocheTest, GoesOnFromANewReference) {
  constexpr int Dim = TypeParam::value;
  for (const auto& kind : allKinds()) {
    const WithStep law{Chaboche(kind)};
    const auto [old, F] = flowed<Dim>(law);
    const State inSpace = law.law.toSpace(F, old);
    const Eigen::Matrix3d b = law.law.elasticDeformation(F, old);
    const Eigen::Matrix3d stretch = exponential<3>(halfLogarithm<3>(b));
    State anew = Chaboche::begin(stretch);
    for (const auto& number : Chaboche::carried()) number.of(anew) = number.of(const_cast<State&>(inSpace));
    anew = law.law.fromSpace(anew);
    const Eigen::Matrix3d f = test::skewed<Dim>(0.05);
    const auto expected = evaluate<Dim>(law, f * F, old).response;
    const auto found = evaluate<Dim>(law, f * stretch, anew).response;
    EXPECT_LT((found.tau - expected.tau).norm(), 1e-13 * kE);
    EXPECT_LT((found.c - expected.c).norm(), 1e-12 * kE);
    EXPECT_NEAR(found.plasticWork, expected.plasticWork, 1e-13 * kE);
  }
}

TYPED_TEST(ChabocheTest, WithoutBackStressesIsJ2Plasticity) {
  constexpr int Dim = TypeParam::value;
  const VoceHardening hardening{200.0, 300.0, 20.0};
  Chaboche::Parameters parameters = perfect();
  parameters.hardening = hardening;
  const WithStep law{Chaboche(parameters)};
  const J2Plasticity j2({kE, kNu, ElasticLaw::Hencky, hardening});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-0.05, 0.05);
  for (int path = 0; path < 5; ++path) {
    State state;
    J2Plasticity::State other;
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    for (int k = 0; k < 40; ++k) {
      Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (test::isAdmissible<Dim>(i, j)) L(i, j) = number(random);
      F = (Eigen::Matrix3d::Identity() + L - L.trace() / 3.0 * Eigen::Matrix3d::Identity()) * F;
      const auto found = evaluate<Dim>(law, F, state);
      const auto expected = evaluate<Dim>(j2, F, other);
      EXPECT_LT((found.response.tau - expected.response.tau).norm(),
                2e-12 * expected.response.tau.norm() + 3e-14 * kE);
      EXPECT_LT((found.response.c - expected.response.c).norm(), 1e-10 * expected.response.c.norm());
      EXPECT_NEAR(found.state.e_p, expected.state.e_p, 1e-13 * (1.0 + expected.state.e_p));
      state = found.state;
      other = expected.state;
    }
    EXPECT_GT(state.e_p, 0.5);
  }
}

TEST(Chaboche, InPlaneStrainIsTheSpatialLaw) {
  for (const auto& kind : allKinds()) {
    const WithStep law{Chaboche(kind)};
    State plane, space;
    for (const double amount : {1e-4, 0.02, 0.1, 0.0995}) {
      const Eigen::Matrix3d F = test::skewed<2>(amount);
      const auto inPlane = evaluate<2>(law, F, plane);
      const auto inSpace = evaluate<3>(law, F, space);
      EXPECT_LT((inPlane.response.tau - inSpace.response.tau.head<4>()).norm(), 1e-13 * kE);
      EXPECT_LT((inPlane.response.c - inSpace.response.c.topLeftCorner<4, 4>()).norm(), 1e-9 * kE);
      EXPECT_LT((inPlane.state.X - inSpace.state.X).norm(), 1e-13 * kE);
      plane = inPlane.state, space = inSpace.state;
    }
  }
}

TEST(Chaboche, FollowsTheMonotonicCurve) {
  const std::vector<std::pair<double, double>> curve{
      {0.001, 285.309146}, {0.005, 381.808634}, {0.02, 467.390281}, {0.1, 612.890583}};
  for (const auto& [e_p, stress] : curve)
    for (const int steps : {1, 4}) {
      Bar bar(hardeningMetal());
      for (int k = 1; k <= steps; ++k) bar.stretchTo((e_p + stress / kE) * k / steps);
      EXPECT_NEAR(bar.stress(), stress, 1e-6);
      EXPECT_NEAR(bar.state().e_p, e_p, 1e-10);
    }
}

TEST(Chaboche, HasTheStableLoopOfItsPlasticRange) {
  const auto amplitude = [](double range) {
    double stress = 200.0;
    for (const auto& [C, gamma, exponent] : metal().backStresses)
      stress += C / gamma * std::tanh(0.5 * gamma * range);
    return stress;
  };
  EXPECT_NEAR(amplitude(0.01), 386.142011, 1e-6);
  const std::vector<std::pair<double, double>> loops{
      {0.002, 297.896881}, {0.01, 386.142011}, {0.04, 439.407994}};
  for (const auto& [range, stress] : loops) {
    Bar bar(metal());
    const double strain = 0.5 * range + stress / kE;
    for (int half = 0; half < 1200 && half * range < 12.0; ++half)
      bar.stretchTo(half % 2 == 0 ? strain : -strain);
    EXPECT_NEAR(std::abs(bar.stress()), stress, 1e-5) << range;
  }
  Bar bar(metal());
  for (int half = 0; half < 120; ++half) bar.stretchTo(half % 2 == 0 ? 0.01 : -0.01);
  EXPECT_NEAR(-bar.stress(), 407.933651, 1e-6);
}

/// Between −250 and 350 the law ratchets by the same strain in every cycle, however many steps are taken.
TEST(Chaboche, RatchetsByTheClosedForm) {
  Chaboche::Parameters parameters = perfect();
  parameters.backStresses = {{50000.0, 250.0}};
  for (const int steps : {1, 10}) {
    Bar bar(parameters);
    const auto go = [&](double to) {
      const double from = bar.stress();
      for (int k = 1; k <= steps; ++k) bar.pullTo(from + (to - from) * k / steps);
    };
    go(350.0);
    EXPECT_NEAR(bar.plasticStrain(), 0.005545177, 1e-9);
    for (int cycle = 1; cycle <= 5; ++cycle) {
      const double before = bar.plasticStrain();
      go(-250.0);
      go(350.0);
      EXPECT_NEAR(bar.plasticStrain() - before, 0.003048560, 1e-9) << cycle;
    }
  }
}

/// Plastic strain of the fifth cycle between −250 and 350, in so many steps each way.
double ratchettingPerCycle(const BackStress& back, int steps) {
  Chaboche::Parameters parameters = perfect();
  parameters.backStresses = {back};
  Bar bar(parameters);
  double before = 0.0;
  for (int cycle = 0; cycle < 5; ++cycle) {
    before = bar.plasticStrain();
    for (const double to : {-250.0, 350.0}) {
      const double from = bar.stress();
      for (int k = 1; k <= steps; ++k) bar.pullTo(from + (to - from) * k / steps);
    }
  }
  return bar.plasticStrain() - before;
}

/// Reference: ∫ s^(m+1)/(1 − s^(m+1)) ds r/C from 50/r to 150/r, as what recovers towards zero does so linearly.
TEST(Chaboche, RatchetsLessWithARecoveryAfterOhnoAndWang) {
  for (const auto& [m, expected] :
       {std::pair{2.0, 0.000422491}, std::pair{5.0, 0.000084582}, std::pair{10.0, 0.000010798}}) {
    const BackStress back{50000.0, 250.0, m};
    const double coarse = ratchettingPerCycle(back, 160), fine = ratchettingPerCycle(back, 320);
    EXPECT_NEAR((coarse - expected) / (fine - expected), 2.0, 0.1) << "of first order, m = " << m;
    EXPECT_NEAR(2.0 * fine - coarse, expected, 0.01 * expected);
  }
}

/// m → ∞ is the first law of Ohno and Wang, σ = σ_y + Σ min(C e_p, r), whose loops are closed.
TEST(Chaboche, OfALargeExponentHasAThresholdOfRecovery) {
  Chaboche::Parameters parameters = perfect();
  parameters.backStresses = {{100000.0, 1000.0, 1000.0}, {20000.0, 200.0, 1000.0}, {5000.0, 20.0, 1000.0}};
  Bar bar(parameters);
  for (int k = 1; k <= 40; ++k) {
    bar.stretchTo(0.0005 * k);
    const double e = bar.state().e_p;
    if (e == 0.0) continue;
    const double expected =
        200.0 + std::min(100000.0 * e, 100.0) + std::min(20000.0 * e, 100.0) + std::min(5000.0 * e, 250.0);
    EXPECT_NEAR(bar.stress(), expected, 5e-3 * expected) << e;
  }
  EXPECT_LT(std::abs(ratchettingPerCycle({50000.0, 250.0, 1000.0}, 10)), 1e-12);
}

TEST(Chaboche, WithoutAnExponentRecoversAsOneOfExponentZeroIfFlowIsProportional) {
  Chaboche::Parameters parameters = perfect(), other = perfect();
  parameters.backStresses = {{20000.0, 200.0}};
  other.backStresses = {{20000.0, 200.0, 0.0}};
  other.substeps = 100;
  Bar bar(parameters), same(other);
  for (int k = 1; k <= 20; ++k) {
    bar.stretchTo(0.001 * k);
    same.stretchTo(0.001 * k);
    EXPECT_NEAR(same.stress(), bar.stress(), 1e-3 * bar.stress());
  }
}

TEST(Chaboche, OverstressFollowsTheRate) {
  Chaboche::Parameters parameters = perfect();
  parameters.rate = NortonRate{150.0, 5.0};
  const std::vector<std::pair<double, double>> steady{{1e-3, 37.678296}, {1.0, 150.0}, {100.0, 376.782965}};
  for (const auto& [rate, overstress] : steady) {
    Bar bar(parameters, 0.01 / rate);
    for (int k = 1; k <= 30; ++k) bar.stretchTo(0.01 * k);
    EXPECT_NEAR(bar.stress(), 200.0 + overstress, 1e-6) << rate;
  }
}

/// Relaxation at a fixed strain: σ_v = (σ_v0^{1−N} + (N−1) E t/K^N)^{1/(1−N)}. In steps it is the solution of
/// σ_v + E Δt (σ_v/K)^N = σ_v,n, of first order.
TEST(Chaboche, RelaxesAtAFixedStrain) {
  Chaboche::Parameters parameters = perfect();
  parameters.rate = NortonRate{150.0, 5.0};
  Bar loaded(parameters, 10.0);  // a rate of 1e-3
  for (int k = 1; k <= 30; ++k) loaded.stretchTo(0.01 * k);
  EXPECT_NEAR(loaded.stress(), 237.678296, 1e-6);
  std::vector<double> errors;
  for (const int steps : {40, 160, 640}) {
    Bar relaxing = loaded.withStep(1.0 / steps);
    double overstress = relaxing.stress() - 200.0;
    for (int k = 0; k < steps; ++k) {
      relaxing.hold();
      const double before = overstress;
      for (int iteration = 0; iteration < 50; ++iteration) {
        const double flow = kE / steps * std::pow(overstress / 150.0, 5.0);
        overstress -= (overstress + flow - before) / (1.0 + 5.0 * flow / overstress);
      }
    }
    EXPECT_NEAR(relaxing.stress() - 200.0, overstress, 1e-7) << steps;
    errors.push_back(relaxing.stress() - 217.351809);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.2);
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.1);
}

/// One law is the same in a step without end as without rates.
TEST(Chaboche, KnowsNoRateBeforeTimeHasPassed) {
  Chaboche::Parameters parameters = hardeningMetal();
  const WithStep without{Chaboche(parameters), 1.0};
  const Eigen::Matrix3d F = test::skewed<3>(0.05);
  const auto expected = evaluate<3>(without, F).response.tau;
  parameters.rate = NortonRate{150.0, 5.0};
  EXPECT_EQ(
      evaluate<3>(WithStep{Chaboche(parameters), std::numeric_limits<double>::infinity()}, F).response.tau,
      expected);
  parameters.rate = JohnsonCookRate{0.05, 1e-3};
  EXPECT_EQ(
      evaluate<3>(WithStep{Chaboche(parameters), std::numeric_limits<double>::infinity()}, F).response.tau,
      expected);
}

TEST(Chaboche, JohnsonCookMultipliesTheYieldStress) {
  Chaboche::Parameters parameters = perfect();
  parameters.rate = JohnsonCookRate{0.05, 1e-2};
  for (const double rate : {1e-3, 1.0, 100.0}) {
    Bar bar(parameters, 0.01 / rate);
    for (int k = 1; k <= 5; ++k) bar.stretchTo(0.01 * k);
    EXPECT_NEAR(bar.stress(), 200.0 * (1.0 + 0.05 * std::log(std::max(1.0, rate / 1e-2))), 1e-8) << rate;
  }
}

/// Laws that have names of their own, told as formulas.
TEST(Chaboche, FormulaOfTheRateIsTheLawThatItTells) {
  using Told = std::pair<RateParameters, std::string>;
  for (const auto& [named, formula] :
       {Told{NortonRate{150.0, 5.0}, "sigma_y + 150*rate^(1/5)"},
        {JohnsonCookRate{0.05, 1e-2}, "sigma_y*(1 + 0.05*ln(max(1, rate/0.01)))"},
        {NortonRate{90.0, 1.0}, "200 + 100*(1 - exp(-20*ep)) + 90*rate"}})
    for (const double dt : {1e-4, 0.1, 1e3}) {
      Chaboche::Parameters expected = hardeningMetal(), parameters = hardeningMetal();
      expected.rate = named;
      parameters.rate = FormulaRate::Parameters{formula};
      const auto [old, F] = flowed<3>(WithStep{Chaboche(hardeningMetal())});
      for (const double amount : {0.003, 0.03}) {
        const Eigen::Matrix3d next = test::skewed<3>(amount) * F;
        const auto one = evaluate<3>(WithStep{Chaboche(expected), dt}, next, old).response;
        const auto other = evaluate<3>(WithStep{Chaboche(parameters), dt}, next, old).response;
        EXPECT_LT((one.tau - other.tau).norm(), 1e-10 * one.tau.norm()) << formula << " " << dt;
        EXPECT_LT((one.c - other.c).norm(), 1e-8 * one.c.norm()) << formula << " " << dt;
      }
    }
}

TEST(Chaboche, FormulaOfTheRateServesManyThreads) {
  Chaboche::Parameters parameters = hardeningMetal();
  parameters.rate = FormulaRate::Parameters{"sigma_y*(1 + ep) + 150*rate^0.2"};
  const WithStep law{Chaboche(parameters)};
  constexpr int kThreads = 4, kPoints = 200;
  const auto stressAt = [&](int k) {
    return evaluate<3>(law, test::skewed<3>(0.001 * (k + 1))).response.tau;
  };
  std::vector<decltype(stressAt(0))> expected, found(kPoints);
  for (int k = 0; k < kPoints; ++k) expected.push_back(stressAt(k));
  std::vector<std::jthread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int k = t; k < kPoints; k += kThreads) found[static_cast<std::size_t>(k)] = stressAt(k);
    });
  threads.clear();
  EXPECT_EQ(found, expected);
}

/// The flow equation has its root for rates of all orders.
TEST(Chaboche, SolvesTheFlowAtAnyRate) {
  for (const double N : {1.0, 3.0, 20.0, 500.0})
    for (const double dt : {1e-6, 1e-2, 1.0, 1e6})
      for (const double amount : {1e-5, 1e-3, 0.02, 0.1}) {
        Chaboche::Parameters parameters = hardeningMetal();
        parameters.rate = NortonRate{150.0, N};
        const WithStep law{Chaboche(parameters), dt};
        auto [old, F] = flowed<3>(WithStep{Chaboche(hardeningMetal())});
        old.e_p = 0.0;  // all digits of what follows
        const State state = evaluate<3>(law, test::skewed<3>(amount) * F, old).state;
        if (state.e_p == 0.0) continue;
        MandelVector<3> stress = 2.0 * kMu * state.E;
        stress.head<3>().array() -= stress.head<3>().mean();
        const double norm = std::sqrt(1.5) * (stress - state.X.rowwise().sum()).norm();
        const double yield = law.law.yieldStress(state.e_p) + 150.0 * std::pow(state.e_p / dt, 1.0 / N);
        EXPECT_NEAR(norm / yield, 1.0, 1e-10) << N << " " << dt << " " << amount;
      }
}

/// τ12 √3/σ_y in simple shear.
double shearStrength(const Chaboche::Parameters& parameters, double gamma, int stepsPerUnit) {
  const WithStep law{Chaboche(parameters)};
  State state;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  double tau = 0.0;
  const int steps = static_cast<int>(std::lround(gamma * stepsPerUnit));
  for (int k = 1; k <= steps; ++k) {
    F(0, 1) = gamma * k / steps;
    const auto next = evaluate<2>(law, F, state);
    state = next.state;
    tau = next.response.tau[3];
  }
  return tau * std::numbers::sqrt3 / 200.0;
}

TEST(Chaboche, KeepsItsStrengthInSimpleShear) {
  EXPECT_NEAR(shearStrength(perfect(), 3.0, 100), 1.0, 5e-5);
  EXPECT_NEAR(shearStrength(perfect(), 10.0, 100), 1.0, 5e-5);
  Chaboche::Parameters recovering = perfect(), linear = perfect();
  recovering.backStresses = {{600.0, 3.0}};
  linear.backStresses = {{200.0, 0.0}};
  const std::vector<std::array<double, 3>> table{{0.5, 1.5587, 1.2757}, {1.0, 1.7417, 1.4845},
                                                 {2.0, 1.7711, 1.5240}, {3.0, 1.7533, 1.0816},
                                                 {5.0, 1.7486, 0.4453}, {10.0, 1.7487, 0.6885}};
  for (const auto& [gamma, first, second] : table) {
    EXPECT_NEAR(shearStrength(recovering, gamma, 1000), first, 3e-4) << gamma;
    EXPECT_NEAR(shearStrength(linear, gamma, 1000), second, 3e-4) << gamma;
  }
  // of a rigid-plastic material
  EXPECT_NEAR(
      shearStrength(recovering, 20.0, 200),
      1.0 + 600.0 / (200.0 * std::numbers::sqrt3) / (3.0 / std::numbers::sqrt3 + std::numbers::sqrt3 / 3.0),
      2e-3);
}

Chaboche::Parameters additive(Chaboche::Parameters parameters) {
  parameters.frame = StrainFrame::Additive;
  return parameters;
}

/// The values are those of a prototype of its own.
TEST(ChabocheInTheAdditiveFrame, LosesItsStrengthInSimpleShear) {
  const std::vector<std::array<double, 2>> table{{0.5, 0.9977}, {1.0, 0.9738}, {2.0, 0.8332},
                                                 {3.0, 0.6655}, {5.0, 0.4354}, {10.0, 0.2153}};
  for (const auto& [gamma, strength] : table)
    EXPECT_NEAR(shearStrength(additive(perfect()), gamma, 1000), strength, 3e-4) << gamma;
  Chaboche::Parameters recovering = additive(perfect()), linear = recovering;
  recovering.backStresses = {{600.0, 3.0}};
  linear.backStresses = {{200.0, 0.0}};
  EXPECT_NEAR(shearStrength(recovering, 10.0, 1000), 0.4303, 3e-4);
  EXPECT_NEAR(shearStrength(linear, 10.0, 1000), 0.7384, 3e-4);
}

TEST(ChabocheInTheAdditiveFrame, IsTheOtherOneWherePrincipalAxesAreFixed) {
  const WithStep updated{Chaboche(hardeningMetal())}, off{Chaboche(additive(hardeningMetal()))};
  State one, two;
  for (int k = 1; k <= 20; ++k) {
    const Eigen::Matrix3d F =
        Eigen::Vector3d(std::exp(0.02 * k), std::exp(-0.03 * k), std::exp(0.007 * k)).asDiagonal();
    const auto first = evaluate<3>(updated, F, one), second = evaluate<3>(off, F, two);
    one = first.state;
    two = second.state;
    EXPECT_LT((first.response.tau - second.response.tau).norm(), 1e-10 * first.response.tau.norm()) << k;
    EXPECT_NEAR(one.e_p, two.e_p, 1e-13) << k;
  }
  EXPECT_GT(one.e_p, 0.1);
}

TEST(ChabocheInTheAdditiveFrame, TangentAgreesWithDifferences) {
  for (const Chaboche::Parameters& parameters : {perfect(), hardeningMetal(), ohnoWangMetal()}) {
    const WithStep law{Chaboche(additive(parameters))};
    const auto [plane, F2] = flowed<2>(law);
    EXPECT_LT(test::tangentError<2>(law, test::skewed<2>(0.02) * F2, plane, 1e-6), 2e-8);
    const auto [space, F3] = flowed<3>(law);
    EXPECT_LT(test::tangentError<3>(law, test::skewed<3>(0.02) * F3, space, 1e-6), 2e-8);
  }
}

TEST(ChabocheInTheAdditiveFrame, IsIndifferentToRotations) {
  const WithStep law{Chaboche(additive(hardeningMetal()))};
  const auto [state, F] = flowed<3>(law);
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const auto here = evaluate<3>(law, F, state), turned = evaluate<3>(law, Q * F, state);
  EXPECT_LT((turned.state.E - here.state.E).norm(), 1e-14);
  EXPECT_LT((turned.state.Fp_inv - here.state.Fp_inv).norm(), 1e-14);
  const Eigen::Matrix3d b = law.law.elasticDeformation(F, here.state);
  EXPECT_LT((law.law.elasticDeformation(Q * F, here.state) - Q * b * Q.transpose()).norm(), 1e-13 * b.norm());
  EXPECT_NEAR(halfLogarithm<3>(b).norm(), here.state.E.norm(), 1e-14) << "the elastic strain, turned";
}

/// A circle of axial strain and shear, after which the error of the stress halves with the steps.
TEST(Chaboche, IsOfFirstOrderWhereTheDirectionTurns) {
  const auto stressAfterATurn = [](int steps) {
    const WithStep law{Chaboche(metal())};
    State state;
    SymmetricTensor<3> tau;
    double lateral = 0.0;
    for (int k = 0; k <= steps; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / steps;
      for (int iteration = 0; iteration < 60; ++iteration) {
        Eigen::Matrix3d E = Eigen::Vector3d(0.01 * std::cos(angle), lateral, lateral).asDiagonal();
        E(0, 1) = E(1, 0) = 0.005 * std::numbers::sqrt3 * std::sin(angle);
        const auto next = evaluate<3>(law, exponential<3>(toMandel<3>(E)), state);
        tau = next.response.tau;
        const double mean = 0.5 * (tau[1] + tau[2]);
        const auto& c = next.response.c;
        if (std::abs(mean) < 1e-8) {
          state = next.state;
          break;
        }
        lateral -= mean / (0.5 * (c(1, 1) + c(2, 2) + c(1, 2) + c(2, 1)));
      }
    }
    return tau;
  };
  const SymmetricTensor<3> exact = stressAfterATurn(4096);
  const auto error = [&](int steps) { return (stressAfterATurn(steps) - exact).norm() / exact.norm(); };
  const double coarse = error(32), middle = error(64), fine = error(128);
  EXPECT_NEAR(coarse / middle, 2.0, 0.3);
  EXPECT_NEAR(middle / fine, 2.0, 0.2);
}

/// In fixed axes a step that is divided into parts is as many steps.
TEST(Chaboche, PartsOfAStepAreSteps) {
  Chaboche::Parameters parameters = hardeningMetal();
  parameters.rate = NortonRate{150.0, 5.0};
  const WithStep law{Chaboche(parameters), 0.25};
  parameters.substeps = 4;
  const WithStep divided{Chaboche(parameters), 1.0};
  State one, other;
  double plasticWork = 0.0;
  const std::vector<Eigen::Vector3d> strains{
      {0.0, 0.0, 0.0}, {0.02, -0.01, -0.01}, {0.01, 0.02, -0.03}, {-0.02, 0.03, 0.01}};
  for (std::size_t k = 1; k < strains.size(); ++k) {
    const auto at = [&](double share) {
      const Eigen::Vector3d logs = strains[k - 1] + share * (strains[k] - strains[k - 1]);
      return test::stretched<3>(std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2]));
    };
    for (const double share : {0.25, 0.5, 0.75}) one = evaluate<3>(law, at(share), one).state;
    const auto expected = evaluate<3>(law, at(1.0), one);
    const auto found = evaluate<3>(divided, at(1.0), other);
    one = expected.state, other = found.state;
    EXPECT_LT((found.response.tau - expected.response.tau).norm(), 3e-14 * kE);
    EXPECT_LT((other.X - one.X).norm(), 3e-14 * kE);
    EXPECT_NEAR(other.e_p, one.e_p, 1e-13);
    plasticWork += found.response.plasticWork;
  }
  EXPECT_GT(plasticWork, 10.0);
}

/// Stresses at yield and the direction of flow of strips that are cut from a sheet, and other states: from a final
/// stress and the flow that belongs to it by Hill's formulas, written out here, the law finds both.
TEST(Chaboche, YieldsAsHillSays) {
  Chaboche::Parameters parameters = perfect();
  parameters.hill = sheet();
  const auto factors = parameters.hill->factors();
  EXPECT_NEAR(factors.F, 0.292208, 5e-7);
  EXPECT_NEAR(factors.G, 0.357143, 5e-7);
  EXPECT_NEAR(factors.H, 0.642857, 5e-7);
  EXPECT_NEAR(factors.N, 1.103896, 5e-7);
  const auto strip = [](double degrees, double stress) {
    const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
    T.topLeftCorner<2, 2>() << c * c, c * s, c * s, s * s;
    return Eigen::Matrix3d(stress * T);
  };
  const Eigen::Matrix3d equibiaxial = Eigen::Vector3d(248.193473, 248.193473, 0.0).asDiagonal();
  Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
  shear(0, 1) = shear(1, 0) = 134.601809;
  const std::vector<Eigen::Matrix3d> stresses{
      strip(0, 200.0),       strip(15, 207.130088), strip(30, 224.473936), strip(45, 236.643191),
      strip(60, 229.210195), strip(90, 206.827894), equibiaxial,           shear};
  for (const double turn : {0.0, 0.7})
    for (const Eigen::Matrix3d& inAxes : stresses) {
      parameters.hill = sheet(-turn);
      const Eigen::Matrix3d Q = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const auto& T = inAxes;
      Eigen::Matrix3d flow =
          Eigen::Vector3d(factors.G * (T(0, 0) - T(2, 2)) + factors.H * (T(0, 0) - T(1, 1)),
                          factors.F * (T(1, 1) - T(2, 2)) + factors.H * (T(1, 1) - T(0, 0)),
                          factors.F * (T(2, 2) - T(1, 1)) + factors.G * (T(2, 2) - T(0, 0)))
              .asDiagonal();
      flow(0, 1) = flow(1, 0) = factors.N * T(0, 1);
      flow /= 200.0;
      const Eigen::Matrix3d elastic =
          (1.0 + kNu) / kE * T - kNu / kE * T.trace() * Eigen::Matrix3d::Identity();
      const Eigen::Matrix3d E = Q * (elastic + 0.01 * flow) * Q.transpose();
      const auto found = evaluate<3>(WithStep{Chaboche(parameters)}, exponential<3>(toMandel<3>(E)));
      EXPECT_NEAR(found.state.e_p, 0.01, 1e-10);
      const Eigen::Matrix3d stress = 2.0 * kMu * fromMandel<3>(found.state.E);
      const Eigen::Matrix3d expected = 2.0 * kMu * Q * elastic * Q.transpose();
      EXPECT_LT((stress - expected).norm(), 1e-6);
    }
  // r of strips: strain across the width over that across the thickness
  const auto ratio = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    return (factors.H + (2.0 * factors.N - factors.F - factors.G - 4.0 * factors.H) * s * s * c * c) /
           (factors.F * s * s + factors.G * c * c);
  };
  EXPECT_NEAR(ratio(0), 1.8, 1e-12);
  EXPECT_NEAR(ratio(15), 1.642735, 5e-7);
  EXPECT_NEAR(ratio(45), 1.2, 1e-12);
  EXPECT_NEAR(ratio(90), 2.2, 1e-12);
}

/// With all r = 1 Hill's condition is that of von Mises.
TEST(Chaboche, OfASheetWithoutAnisotropyIsTheSame) {
  Chaboche::Parameters parameters = hardeningMetal();
  const WithStep mises{Chaboche(parameters)};
  parameters.hill = HillYield{};
  const WithStep hill{Chaboche(parameters)};
  const auto [old, F] = flowed<3>(mises);
  const Eigen::Matrix3d next = test::skewed<3>(0.05) * F;
  const auto expected = evaluate<3>(mises, next, old).response;
  const auto found = evaluate<3>(hill, next, old).response;
  EXPECT_LT((found.tau - expected.tau).norm(), 1e-13 * kE);
  EXPECT_LT((found.c - expected.c).norm(), 1e-12 * kE);
}

/// Work of the mean stress in a cycle is what is stored and dissipated, to second order; what back stresses store is
/// part of the plastic work, and the rest of it, dissipation, is positive.
TEST(Chaboche, BalancesItsEnergy) {
  const auto run = [](int steps) {
    const WithStep law{Chaboche(hardeningMetal())};
    State state;
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity(), P = Eigen::Matrix3d::Zero();
    double external = 0.0, plastic = 0.0, stored = 0.0;
    const auto backEnergy = [&](const State& s) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i)
        sum += 0.75 * s.X.col(i).squaredNorm() /
               hardeningMetal().backStresses[static_cast<std::size_t>(i)].modulus;
      return sum;
    };
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Matrix3d next = test::skewed<3>(0.15 * std::sin(2.5 * std::numbers::pi * k / steps));
      const auto [response, reached] = evaluate<3>(law, next, state);
      const Eigen::Matrix3d P_next = fullTensor<3>(response.tau) * next.inverse().transpose();
      external += 0.5 * (P + P_next).cwiseProduct(next - F).sum();
      plastic += response.plasticWork;
      EXPECT_GE(response.plasticWork, backEnergy(reached) - backEnergy(state) - 1e-9) << k;
      stored = response.strainEnergy;
      state = reached, F = next, P = P_next;
    }
    return external / (stored + plastic) - 1.0;
  };
  const double coarse = run(200), fine = run(400);
  EXPECT_LT(std::abs(fine), 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

TYPED_TEST(ChabocheTest, UnloadsElastically) {
  constexpr int Dim = TypeParam::value;
  const WithStep law{Chaboche(hardeningMetal())};
  const auto [old, F] = flowed<Dim>(law);
  const auto again = evaluate<Dim>(law, F, old);
  EXPECT_EQ(again.state.e_p, old.e_p);
  EXPECT_EQ(again.state.Fp_inv, old.Fp_inv);
  EXPECT_EQ(again.response.plasticWork, 0.0);
}

TYPED_TEST(ChabocheTest, RefusesWhatIsNotADeformation) {
  constexpr int Dim = TypeParam::value;
  const Chaboche law(hardeningMetal());
  State next;
  MaterialResponse<Dim> out;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (const double entry : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e200}) {
    F(0, 0) = entry;
    EXPECT_FALSE(law.evaluate<Dim>(F, 1.0, {}, next, out)) << "F_11 = " << entry;
  }
  Chaboche::Parameters softening = perfect();
  softening.hardening = FormulaHardening::Parameters{"200*(1 - 2*ep)"};
  EXPECT_TRUE(
      Chaboche(softening).evaluate<Dim>(test::stretched<Dim>(1.2, 1.0 / 1.2, 1.0), 1.0, {}, next, out));
  EXPECT_FALSE(
      Chaboche(softening).evaluate<Dim>(test::stretched<Dim>(3.0, 1.0 / 3.0, 1.0), 1.0, {}, next, out));
}

/// Interpolated back stresses are brought back within their bounds, and are deviators.
TEST(Chaboche, BoundsWhatItBeginsWith) {
  const Chaboche::Parameters parameters = metal();
  const Chaboche law(parameters);
  State state;
  state.X.setConstant(500.0);
  const State begun = law.fromSpace(state);
  for (int i = 0; i < 3; ++i) {
    const auto& [C, gamma, exponent] = parameters.backStresses[static_cast<std::size_t>(i)];
    EXPECT_NEAR(begun.X.col(i).head<3>().sum(), 0.0, 1e-10);
    EXPECT_NEAR(std::sqrt(1.5) * begun.X.col(i).norm(), C / gamma, 1e-9);
  }
}

/// Half-way between points that have turned by 10 degrees less and more.
TEST(Chaboche, AxesOfASheetAreInterpolatedAtAnyTurn) {
  Chaboche::Parameters parameters = perfect();
  parameters.hill = sheet();
  const Chaboche law(parameters);
  const auto turned = [&](double degrees) {
    return Eigen::Matrix3d(
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  };
  for (const double degrees : {0.0, 90.0, 170.0, 180.0, 190.0, 200.0, 350.0}) {
    State one = law.toSpace(turned(degrees - 10.0), {}), other = law.toSpace(turned(degrees + 10.0), {});
    State between;
    for (const auto& number : Chaboche::carried())
      number.of(between) = 0.5 * (number.of(one) + number.of(other));
    EXPECT_LT((law.fromSpace(between).Fp_inv - turned(degrees)).norm(), 1e-14) << degrees;
  }
}

/// As where a body begins with stresses alone.
TEST(Chaboche, BeginsWithoutATurnWhereNothingIsSaidOfAxes) {
  State state;
  for (const auto& number : Chaboche::carried()) number.of(state) = 0.0;
  EXPECT_EQ(Chaboche(perfect()).fromSpace(state).Fp_inv, Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace burnish::chaboche_test
