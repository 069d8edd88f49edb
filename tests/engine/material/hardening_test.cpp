#include "engine/material/hardening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr double kSigma0 = 79.66;
constexpr double kSigmaInf = 171.26;
constexpr double kBeta = 17.8;

double sigma_y(const Hardening& hardening, double e) {
  return std::visit([e](const auto& law) { return law.sigma_y(e); }, hardening);
}
double slope(const Hardening& hardening, double e) {
  return std::visit([e](const auto& law) { return law.slope(e); }, hardening);
}
double work(const Hardening& hardening, double e) {
  return std::visit([e](const auto& law) { return law.work(e); }, hardening);
}

/// ∫ σ_y over [0, e] by three-point Gauss quadrature on many intervals of s, e s⁴, as some laws are steep at zero.
double quadrature(const Hardening& hardening, double e) {
  constexpr int kIntervals = 4000;
  const double half = 0.5 / kIntervals;
  const auto integrand = [&](double s) {
    return sigma_y(hardening, e * s * s * s * s) * 4.0 * e * s * s * s;
  };
  double sum = 0.0;
  for (int k = 0; k < kIntervals; ++k) {
    const double mid = (2 * k + 1) * half;
    const double offset = std::sqrt(0.6) * half;
    sum +=
        half * (5.0 * integrand(mid - offset) + 8.0 * integrand(mid) + 5.0 * integrand(mid + offset)) / 9.0;
  }
  return sum;
}

struct Case {
  std::string name;
  Hardening hardening;
  double initial;    ///< σ_y(0)
  double saturated;  ///< σ_y(0.9)
};

std::vector<Case> cases() {
  const auto voce = [](double q, double beta, double e) { return q * (1.0 - std::exp(-beta * e)); };
  return {
      {"voce", VoceHardening{kSigma0, kSigmaInf, kBeta}, kSigma0,
       kSigma0 + voce(kSigmaInf - kSigma0, kBeta, 0.9)},
      {"two_term_voce", TwoTermVoceHardening{80.0, {30.0, 55.0}, {60.0, 6.0}}, 80.0,
       80.0 + voce(30.0, 55.0, 0.9) + voce(60.0, 6.0, 0.9)},
      {"linear", LinearHardening{100.0, 250.0}, 100.0, 325.0},
      {"voce_linear", VoceLinearHardening{{450.0, 715.0, 16.93}, 129.24}, 450.0,
       450.0 + voce(265.0, 16.93, 0.9) + 0.9 * 129.24},
      {"table", TableHardening({{0.0, 0.05, 0.2, 0.5}, {100.0, 140.0, 155.0, 160.0}}), 100.0, 160.0},
      {"formula", FormulaHardening({"300*(0.01+ep)^0.2"}), 300.0 * std::pow(0.01, 0.2),
       300.0 * std::pow(0.91, 0.2)},
      {"ludwik", LudwikHardening{100.0, {400.0, 0.3}}, 100.0 + 400.0 * std::pow(1e-8, 0.3),
       100.0 + 400.0 * std::pow(0.90000001, 0.3)},
      {"swift", SwiftHardening{{500.0, 0.2, 0.002}}, 500.0 * std::pow(0.002, 0.2),
       500.0 * std::pow(0.902, 0.2)},
      {"hockett_sherby", HockettSherbyHardening{120.0, 400.0, 5.0, 0.6},
       400.0 - 280.0 * std::exp(-std::pow(5e-8, 0.6)), 400.0 - 280.0 * std::exp(-std::pow(4.50000005, 0.6))},
  };
}

TEST(Hardening, TakesItsValuesAtBothEnds) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_NEAR(sigma_y(c.hardening, 0.0), c.initial, 1e-12 * c.initial);
    EXPECT_NEAR(sigma_y(c.hardening, 0.9), c.saturated, 1e-12 * c.saturated);
  }
}

TEST(Hardening, SlopeIsTheDerivative) {
  constexpr double h = 1e-4;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (const double e : {0.01, 0.03, 0.12, 0.41, 0.87, 2.3}) {
      const auto at = [&](double s) { return sigma_y(c.hardening, e + s); };
      const double expected = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
      EXPECT_NEAR(slope(c.hardening, e), expected, 1e-8 * std::abs(expected) + 1e-8) << "at " << e;
    }
  }
}

TEST(Hardening, WorkIsTheIntegral) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_NEAR(work(c.hardening, 0.0), 0.0, 1e-15);
    for (const double e : {1e-6, 0.01, 0.3, 1.6}) {
      const double expected = quadrature(c.hardening, e);
      const double tolerance = c.name == "table" ? 1e-8 : 1e-12;  // the quadrature does not see its corners
      EXPECT_NEAR(work(c.hardening, e), expected, tolerance * expected) << "at " << e;
    }
  }
}

TEST(TableHardening, TurnsAtItsEntriesAndIsConstantBeyondThem) {
  const TableHardening table({{0.0, 0.1, 0.3}, {100.0, 150.0, 170.0}});
  EXPECT_DOUBLE_EQ(table.sigma_y(0.1), 150.0);
  EXPECT_DOUBLE_EQ(table.slope(0.0), 500.0);
  EXPECT_DOUBLE_EQ(table.slope(0.2), 100.0);
  EXPECT_DOUBLE_EQ(table.slope(0.3), 0.0);
  EXPECT_DOUBLE_EQ(table.sigma_y(5.0), 170.0);
  EXPECT_DOUBLE_EQ(table.work(0.3), 12.5 + 32.0);
  EXPECT_DOUBLE_EQ(table.work(1.3), 12.5 + 32.0 + 170.0);
}

TEST(TableHardening, OfOneEntryIsPerfectPlasticity) {
  const TableHardening table({{0.0}, {120.0}});
  EXPECT_DOUBLE_EQ(table.sigma_y(0.7), 120.0);
  EXPECT_DOUBLE_EQ(table.slope(0.7), 0.0);
  EXPECT_DOUBLE_EQ(table.work(0.5), 60.0);
}

TEST(TableHardening, RefusesBrokenTables) {
  EXPECT_THROW(TableHardening({{}, {}}), Error);
  EXPECT_THROW(TableHardening({{0.0, 0.1}, {100.0}}), Error);
  EXPECT_THROW(TableHardening({{0.1, 0.2}, {100.0, 110.0}}), Error);
  EXPECT_THROW(TableHardening({{0.0, 0.2, 0.2}, {100.0, 110.0, 120.0}}), Error);
  EXPECT_THROW(TableHardening({{0.0, 0.2}, {100.0, 0.0}}), Error);
}

TEST(FormulaHardening, OfVoceIsVoce) {
  const VoceHardening voce{kSigma0, kSigmaInf, kBeta};
  const FormulaHardening formula({"79.66 + (171.26 - 79.66)*(1 - exp(-17.8*ep))"});
  for (double e = 0.0; e < 12.0; e = 1.2 * e + 1e-5) {
    EXPECT_NEAR(formula.sigma_y(e), voce.sigma_y(e), 1e-13 * kSigmaInf) << "at " << e;
    EXPECT_NEAR(formula.slope(e), voce.slope(e), 1e-10 * voce.slope(e) + 1e-11 * kSigma0) << "at " << e;
    EXPECT_NEAR(formula.work(e), voce.work(e), 1e-13 * voce.work(e) + 1e-15) << "at " << e;
  }
}

TEST(FormulaHardening, FollowsSteepStarts) {
  const FormulaHardening formula({"500*(1e-5+ep)^0.2"});
  for (double e = 0.0; e < 3.0; e = 1.5 * e + 1e-7) {
    EXPECT_NEAR(formula.sigma_y(e), 500.0 * std::pow(1e-5 + e, 0.2), 1e-11) << "at " << e;
    EXPECT_NEAR(formula.slope(e) / (100.0 * std::pow(1e-5 + e, -0.8)), 1.0, 1e-9) << "at " << e;
    const double expected = 500.0 / 1.2 * (std::pow(1e-5 + e, 1.2) - std::pow(1e-5, 1.2));
    EXPECT_NEAR(formula.work(e), expected, 1e-12 * expected + 1e-17) << "at " << e;
  }
}

TEST(FormulaHardening, FollowsCornersAndJumps) {
  const FormulaHardening corner({"min(100 + 200*ep, 130)"});
  const FormulaHardening jump({"ep < 0.3 ? 100 : 120"});
  for (const double e : {0.0, 0.1, 0.1499, 0.1501, 0.2999, 0.3001, 0.7, 40.0}) {
    EXPECT_NEAR(corner.sigma_y(e), std::min(100.0 + 200.0 * e, 130.0), 1e-9) << "at " << e;
    EXPECT_NEAR(corner.slope(e), e < 0.15 ? 200.0 : 0.0, 1e-7) << "at " << e;
    EXPECT_NEAR(jump.sigma_y(e), e < 0.3 ? 100.0 : 120.0, 1e-9) << "at " << e;
  }
  EXPECT_NEAR(jump.work(1.0), 30.0 + 84.0, 1e-9);
}

TEST(FormulaHardening, IsNotFiniteWhereTheFormulaIsNot) {
  const FormulaHardening formula({"100*sqrt(1 - ep)"});
  EXPECT_NEAR(formula.sigma_y(0.75), 50.0, 1e-11);
  EXPECT_FALSE(std::isfinite(formula.sigma_y(1.5)));
  EXPECT_FALSE(std::isfinite(formula.sigma_y(1e6)));
}

std::string messageOf(const std::string& formula) {
  try {
    FormulaHardening hardening({formula});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FormulaHardening, RefusesWhatItCannotUse) {
  EXPECT_NE(messageOf("100 + (ep").find("100 + (ep"), std::string::npos);
  EXPECT_NE(messageOf("100 + strain").find("strain"), std::string::npos);
  EXPECT_NE(messageOf("").find("ep"), std::string::npos);
  EXPECT_NE(messageOf("100*ep").find("must be positive"), std::string::npos);
  EXPECT_NE(messageOf("-5").find("must be positive"), std::string::npos);
  EXPECT_NE(messageOf("1/ep").find("must be positive"), std::string::npos);
  EXPECT_NE(messageOf("100 + 20*sin(1e6*ep)").find("wildly"), std::string::npos);
}

}  // namespace
}  // namespace burnish
