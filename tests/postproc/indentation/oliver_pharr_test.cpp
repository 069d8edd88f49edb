#include "postproc/indentation/oliver_pharr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/message_of.h"

/// Evaluations of unloadings whose answers are known in closed form.
namespace burnish {
namespace {

using std::numbers::pi;

constexpr double kE = 200000.0, kNu = 0.3;
const double kReduced = kE / (1.0 - kNu * kNu);

/// P(h) from the largest depth down to 0.
IndentationCurve unloadingOf(double largest, const std::function<double(double)>& force) {
  constexpr int kSteps = 50;
  IndentationCurve curve;
  for (int k = kSteps; k >= 0; --k) {
    curve.depths.push_back(largest * k / kSteps);
    curve.forces.push_back(force(curve.depths.back()));
  }
  return curve;
}

/// P = 4/3 E* √R h^(3/2); with the area of a true sphere the modulus is 0.125 h/R too large, of which half a per cent is
/// the paraboloid's h_c = h/2.
TEST(OliverPharr, ElasticSphereHasItsModulus) {
  const double radius = 1.0, depth = 0.01;
  const auto found = oliverPharr(
      unloadingOf(depth,
                  [&](double h) { return 4.0 / 3.0 * kReduced * std::sqrt(radius) * std::pow(h, 1.5); }),
      SphereIndenter{radius}, {});
  EXPECT_NEAR(found.force, 293.040, 5e-4);
  EXPECT_NEAR(found.stiffness, 43956.0, 0.1);
  EXPECT_NEAR(found.exponent, 1.5, 1e-9);
  EXPECT_NEAR(found.finalDepth, 0.0, 1e-9 * depth);
  EXPECT_NEAR(found.contactDepth, depth / 2.0, 1e-9 * depth);
  EXPECT_NEAR(found.modulus / kReduced, 1.0 + 0.125 * depth / radius, 1e-5);
  EXPECT_LT(found.misfit, 1e-10);
  // The true contact has a² = R h.
  EXPECT_NEAR(withArea(found, pi * radius * depth, 1.0).modulus, kReduced, 1e-4);
}

/// P = 2/π E* tan α h², h_c = 2/π h: exact with ε = 2 (1 - 2/π); with 0.75 E is 1.86 and H 3.75 per cent too large.
TEST(OliverPharr, ElasticConeDependsOnEpsilon) {
  const double angle = 70.3 * pi / 180.0, depth = 0.02;
  const auto force = [&](double h) { return 2.0 / pi * kReduced * std::tan(angle) * h * h; };
  const double hardness = force(depth) / (pi * std::pow(2.0 / pi * depth * std::tan(angle), 2));
  const ConeIndenter cone{angle, 0.0};
  const auto exact = oliverPharr(unloadingOf(depth, force), cone, {.epsilon = 2.0 * (1.0 - 2.0 / pi)});
  EXPECT_NEAR(exact.modulus / kReduced, 1.0, 1e-9);
  EXPECT_NEAR(exact.hardness / hardness, 1.0, 1e-9);
  EXPECT_NEAR(exact.contactDepth, 2.0 / pi * depth, 1e-9 * depth);
  const auto usual = oliverPharr(unloadingOf(depth, force), cone, {});
  EXPECT_NEAR(usual.modulus / kReduced, 1.0186, 5e-5);
  EXPECT_NEAR(usual.hardness / hardness, 1.0375, 1e-4);
}

/// A pile-up that hides a fifth of the area: E is 12 and H 25 per cent too large.
TEST(OliverPharr, AHiddenAreaIsSeen) {
  const OliverPharr found{.force = 100.0, .stiffness = 2000.0};
  const auto seen = withArea(found, 0.8, 1.0), true_ = withArea(found, 1.0, 1.0);
  EXPECT_NEAR(seen.modulus / true_.modulus, 1.118, 1e-3);
  EXPECT_NEAR(seen.hardness / true_.hardness, 1.25, 1e-12);
}

/// A plastic dent: what stays is found, whatever the units.
TEST(OliverPharr, APowerLawIsFoundInAnyUnits) {
  for (const double length : {1.0, 1e-6, 1e3})
    for (const double stress : {1.0, 1e6}) {
      const double final = 0.0083 * length, factor = 3e5 * stress * std::pow(length, 2.0 - 1.31);
      const auto found = oliverPharr(
          unloadingOf(0.01 * length,
                      [&](double h) { return h < final ? 0.0 : factor * std::pow(h - final, 1.31); }),
          SphereIndenter{0.1 * length}, {.from = 0.2, .to = 1.0});
      EXPECT_NEAR(found.exponent, 1.31, 1e-6);
      EXPECT_NEAR(found.finalDepth / length, 0.0083, 1e-8);
      EXPECT_NEAR(found.factor / factor, 1.0, 1e-4);
      EXPECT_NEAR(found.stiffness / (factor * 1.31 * std::pow(0.0017 * length, 0.31)), 1.0, 1e-6);
    }
}

/// The rounding of the tip goes over into the cone without a step, in the area and its growth.
TEST(Indenters, RoundedConeIsSmooth) {
  const double angle = 60.0 * pi / 180.0, radius = 0.3, where = radius * (1.0 - std::sin(angle)),
               small = 1e-7;
  const ConeIndenter cone{angle, radius};
  EXPECT_NEAR(sectionArea(cone, where - 1e-12), sectionArea(cone, where + 1e-12), 1e-11);
  EXPECT_NEAR((sectionArea(cone, where) - sectionArea(cone, where - small)) / small,
              (sectionArea(cone, where + small) - sectionArea(cone, where)) / small, 1e-5);
  EXPECT_NEAR(sectionArea(cone, where), pi * std::pow(radius * std::cos(angle), 2), 1e-12);
  EXPECT_NEAR(sectionArea(ConeIndenter{angle, 0.0}, 2.0), pi * 12.0, 1e-12);
  EXPECT_NEAR(sectionArea(SphereIndenter{2.0}, 2.0), 4.0 * pi, 1e-12);
}

TEST(Indenters, BetaOfHayIsThatOfItsAuthors) {
  EXPECT_NEAR(usualBeta(ConeIndenter{70.3 * pi / 180.0, 0.0}, 0.3), 1.067065, 1e-6);
  EXPECT_EQ(usualBeta(SphereIndenter{1.0}, 0.3), 1.0);
}

TEST(OliverPharr, MistakesAreTold) {
  const SphereIndenter sphere{1.0};
  const auto refusal = [&](const IndentationCurve& curve) {
    return messageOf([&] { oliverPharr(curve, sphere, {}); });
  };
  EXPECT_THAT(
      refusal({{1.0, 0.9, 0.8}, {10.0, 8.0, 6.0}}),
      testing::HasSubstr("the unloading has 2 steps between 0.4 and 0.98 of the largest force; expected 4"));
  EXPECT_THAT(refusal({{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {10.0, 9.0, 8.0, 7.0, 6.0, 5.0}}),
              testing::HasSubstr("no power law fits the unloading"));
}

}  // namespace
}  // namespace burnish
