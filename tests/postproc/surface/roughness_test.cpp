#include "postproc/surface/roughness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/message_of.h"

/// Roughness of waves whose numbers are known in closed form.
namespace burnish {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

/// So many waves of length 1, 400 heights on each.
Profile waves(const std::function<double(double)>& wave, int count = 20) {
  constexpr int kPerWave = 400;
  Profile profile{0.0, 1.0 / kPerWave, Eigen::VectorXd(count * kPerWave + 1)};
  for (Eigen::Index k = 0; k < profile.heights.size(); ++k) {
    const double x = static_cast<double>(k) / kPerWave;
    profile.heights(k) = wave(x - std::floor(x));
  }
  return profile;
}

double sine(double x) {
  return std::sin(kTau * x);
}
double triangle(double x) {
  return 1.0 - 4.0 * std::abs(x - 0.5);
}
/// Of a tool with a round nose: height 1 between valleys.
double turned(double x) {
  return 4.0 * (x - 0.5) * (x - 0.5);
}

void expectRoughness(const ProfileRoughness& found, double a, double q, double z, double tolerance) {
  EXPECT_NEAR(found.a, a, tolerance);
  EXPECT_NEAR(found.q, q, tolerance);
  EXPECT_NEAR(found.z, z, tolerance);
}

TEST(Roughness, OfWholeWavesIsKnown) {
  expectRoughness(roughnessOf(waves(triangle), {}), 0.5, 1.0 / std::sqrt(3.0), 2.0, 1e-12);
  // Chords between 400 heights of a wave.
  expectRoughness(roughnessOf(waves(turned), {}), 4.0 / (9.0 * std::sqrt(3.0)), 2.0 / (3.0 * std::sqrt(5.0)),
                  1.0, 2e-5);
  // A sine that does not end where it is symmetric tilts its least-squares line a little.
  expectRoughness(roughnessOf(waves([](double x) { return std::cos(kTau * x); }), {}), 2.0 / std::numbers::pi,
                  std::sqrt(0.5), 2.0, 5e-5);
}

/// Two waves to the cut-off, and waves of its length, of which the filter takes half.
TEST(Roughness, OfFilteredWavesIsKnown) {
  expectRoughness(roughnessOf(waves(sine), 2.0), 0.596831, 0.662913, 1.875000, 1e-4);
  expectRoughness(roughnessOf(waves(sine), 1.0), 0.318310, 0.353553, 1.000000, 1e-4);
  expectRoughness(roughnessOf(waves(triangle), 2.0), 0.467748, 0.541805, 1.898659, 1e-4);
  expectRoughness(roughnessOf(waves(triangle), 1.0), 0.242025, 0.294846, 1.189059, 1e-4);
  expectRoughness(roughnessOf(waves(turned), 2.0), 0.240982, 0.280969, 0.949329, 1e-4);
  const ProfileRoughness five = roughnessOf(waves(sine), 2.0);
  EXPECT_EQ(five.samplingLengths, 5);
  EXPECT_NEAR(five.length, 10.0, 1e-9);
}

TEST(Roughness, DoesNotSeeSlopeNorHeight) {
  Profile tilted = waves(sine);
  const ProfileRoughness plain = roughnessOf(tilted, 1.0);
  tilted.heights += 7.0 * Eigen::VectorXd::Ones(tilted.heights.size()) +
                    Eigen::VectorXd::LinSpaced(tilted.heights.size(), 0.0, 0.5);
  const ProfileRoughness found = roughnessOf(tilted, 1.0);
  expectRoughness(found, plain.a, plain.q, plain.z, 1e-12);
}

TEST(Roughness, StylusSeesTheUpperEnvelope) {
  Eigen::Matrix2Xd overhang(2, 6);           // up, back over itself, and on
  overhang << 0.0, 2.0, 1.0, 3.0, 3.0, 4.0,  //
      0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
  const Profile profile = profileOf(overhang, 9);
  const Eigen::VectorXd expected = (Eigen::VectorXd(9) << 0, 0, 1, 1, 1, 1, 1, 0, 0).finished();
  EXPECT_LT((profile.heights - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(profile.length(), 4.0, 1e-12);
}

TEST(Roughness, OfAnAreaIsKnown) {
  constexpr int kPoints = 400;
  Eigen::Matrix3Xd points(3, kPoints * kPoints);
  for (int j = 0; j < kPoints; ++j)
    for (int i = 0; i < kPoints; ++i) {
      const double x = (i + 0.5) / kPoints, z = (j + 0.5) / kPoints;
      points.col(i + kPoints * j) << x, 0.2 * x + std::sin(kTau * 4.0 * x) * std::sin(kTau * 4.0 * z) * 1e-4,
          z;
    }
  const Eigen::VectorXd weights =
      Eigen::VectorXd::Constant(points.cols(), 1.0 / static_cast<double>(points.cols()));
  const AreaRoughness found = roughnessOf(points, weights, {0.0, 1.0, 0.0});
  const double tilt = 1e-4 / std::sqrt(1.04);
  EXPECT_NEAR(found.a, tilt * 4.0 / (std::numbers::pi * std::numbers::pi), 2e-8);  // 100 points to a wave
  EXPECT_NEAR(found.q, tilt * 0.5, 1e-8);
  EXPECT_NEAR(found.z, tilt * 2.0, 2e-7);
}

TEST(Roughness, RefusesALongCutOff) {
  EXPECT_THAT(messageOf([] { roughnessOf(waves(sine), 8.0); }),
              testing::HasSubstr(
                  "cutoff: found 8; the profile is 20 long and loses one cut-off at both ends, expected "
                  "at most 6.66667"));
}

}  // namespace
}  // namespace burnish
