#include "postproc/probe/gauge_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "postproc/probe/probe.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"
#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using samples::Sample;
using testing::HasSubstr;

constexpr double kRounding = 1e-12;

template <int Dim, class Function>
double meanOver(double radius, const Function& function) {
  const GaugeRule<Dim> rule = gaugeRule<Dim>(radius);
  double sum = 0.0;
  for (Eigen::Index k = 0; k < rule.weights.size(); ++k)
    sum += rule.weights(k) * function(rule.offsets.col(k));
  return sum;
}

TEST(GaugeRule, HasTheMomentsOfDiscsAndBalls) {
  const auto one = [](const auto&) { return 1.0; };
  EXPECT_NEAR(meanOver<2>(0.3, one), 1.0, kRounding);
  EXPECT_NEAR(meanOver<3>(0.3, one), 1.0, kRounding);
  const auto linear = [](const auto& x) { return x.sum(); };
  EXPECT_NEAR(meanOver<2>(0.3, linear), 0.0, kRounding);
  EXPECT_NEAR(meanOver<3>(0.3, linear), 0.0, kRounding);
  for (int d = 0; d < 3; ++d) {
    const auto square = [&](const auto& x) { return x(d) * x(d); };
    const auto fourth = [&](const auto& x) { return std::pow(x(d), 4); };
    EXPECT_NEAR(meanOver<3>(2.0, square), 4.0 / 5.0, kRounding) << d;
    EXPECT_NEAR(meanOver<3>(2.0, fourth), 16.0 * 3.0 / 35.0, kRounding) << d;
    if (d == 2) continue;
    EXPECT_NEAR(meanOver<2>(2.0, square), 4.0 / 4.0, kRounding) << d;
    EXPECT_NEAR(meanOver<2>(2.0, fourth), 16.0 / 8.0, kRounding) << d;
  }
}

TEST(GaugeRule, HalvesAsFarFromTheMiddleAsTheyAre) {
  for (int d = 0; d < 3; ++d) {
    const auto below = [&](const auto& x) { return x(d) < 0.0 ? -2.0 * x(d) : 0.0; };
    EXPECT_NEAR(meanOver<3>(1.0, below), 3.0 / 8.0, d == 1 ? kRounding : 2e-3) << d;
    if (d == 2) continue;
    EXPECT_NEAR(meanOver<2>(1.0, below), 4.0 / (3.0 * std::numbers::pi), 1e-3) << d;
  }
}

/// The pressure is x + y + z of the undeformed cube, in the moved one too.
TEST(MaterialPoint, HasTheMeanOverABallOfMaterial) {
  Sample cube = samples::cube();
  cube.frame.displacement.row(0).setConstant(7.0);
  ProbeSpec spec;
  spec.point = "0.4,0.5,0.6";
  spec.fields = {"pressure"};
  spec.window = 0.5;
  EXPECT_TRUE(conflictsIn(spec).empty());
  const auto at = [&](const Eigen::Vector3d& place, double window) {
    return MaterialPoint(cube.model, place, window)
        .in(cube.frame, ProbedFields(cube.model, cube.frame, {"pressure"}));
  };
  const ProbePoint inside = at({0.4, 0.5, 0.6}, 0.5);
  EXPECT_NEAR(inside.values(0), 1.5, kRounding);
  EXPECT_NEAR((inside.current - Eigen::Vector3d(7.4, 0.5, 0.6)).norm(), 0.0, kRounding);
  EXPECT_NEAR((inside.reference - Eigen::Vector3d(0.4, 0.5, 0.6)).norm(), 0.0, kRounding);
  // Of a ball in the middle of a face half lies in the cube.
  EXPECT_NEAR(at({0.5, 1.0, 0.5}, 0.4).values(0), 2.0 - 3.0 / 8.0 * 0.2, 1e-9);
  EXPECT_NEAR(at({0.0, 0.5, 0.5}, 0.4).values(0), 1.0 + 3.0 / 8.0 * 0.2, 3e-4);
  EXPECT_THAT(
      messageOf([&] {
        at({0.5, 0.5, 0.5}, 100.0);
      }),
      HasSubstr(
          "window: only 0 of the 1024 points of the ball of diameter 100 about (0.5, 0.5, 0.5) lie in the body"));
  EXPECT_THAT(messageOf([&] { at({0.5, 0.5, 0.5}, 1e5); }), HasSubstr("window: found a length of 100000"));
  spec.mean = true;
  EXPECT_THAT(conflictsIn(spec).front().text, HasSubstr("expected no mean beside it"));
}

/// Plastic strain of the slab is 4 s (1 - s) t², s = X/3; over a disc the squares of both directions have the mean R²/4.
TEST(MaterialPoint, HasTheMeanOverADiscAlsoInANewMesh) {
  const Sample first = samples::slab();
  const double radius = 0.2, x = 1.2, y = 0.6;
  const MaterialPoint material(first.model, Eigen::Vector2d(x, y), 2.0 * radius);
  // E[(4/3 X - 4/9 X²) Y²] with E[dx²] = E[dy²] = R²/4 and E[dx² dy²] = R⁴/24.
  const double a = 4.0 / 3.0 * x - 4.0 / 9.0 * x * x, q = radius * radius / 4.0,
               m = std::pow(radius, 4) / 24.0;
  const double mean = a * (y * y + q) - 4.0 / 9.0 * (q * y * y + m);
  for (const Sample& sample : {first, samples::meshedAnew(first, samples::slab({7, 5}))}) {
    const ProbePoint point =
        material.in(sample.frame, ProbedFields(first.model, sample.frame, {"plastic_strain"}));
    EXPECT_NEAR(point.values(0), mean, 1e-9);
  }
}

/// A window near another body counts that of the point alone.
TEST(MaterialPoint, HasTheMeanOverItsOwnBodyAlone) {
  Sample two = samples::twoBodies();
  PatchRecord& stamp = two.model.mesh.patches[1];
  stamp.points.row(0).array() -= 0.5;  // against the block
  Eigen::MatrixXd& mises = two.frame.fields.at("von_mises").values;
  for (const int node : stamp.nodes) mises(0, node) = 1e6;
  const ProbePoint point = MaterialPoint(two.model, Eigen::Vector2d(2.9, 0.5), 0.4)
                               .in(two.frame, ProbedFields(two.model, two.frame, {"von_mises"}));
  EXPECT_LT(point.values(0), 29.0);
  EXPECT_GT(point.values(0), 28.0);
}

}  // namespace
}  // namespace burnish
