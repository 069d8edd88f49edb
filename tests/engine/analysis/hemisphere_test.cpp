// Hertz's point contact in three dimensions: an elastic hemisphere, exactly round, on a rigid plane.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

/// Radius and peak of the half ellipsoid p^2 = p_0^2 (1 - r^2/a^2) that fits the pressure best where it is
/// above a fifth of its largest value; r is the distance from the y axis.
struct HalfEllipsoid {
  double radius = 0.0, peak = 0.0;

  explicit HalfEllipsoid(const ContactRecord& contact) {
    const Eigen::VectorXd& p = contact.quadraturePressure;
    const double largest = p.maxCoeff();
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (Eigen::Index q = 0; q < p.size(); ++q) {
      if (p(q) < 0.2 * largest) continue;
      const Eigen::Vector2d row(
          1.0, std::pow(contact.quadraturePoints(0, q), 2) + std::pow(contact.quadraturePoints(2, q), 2));
      A += row * row.transpose();
      b += row * p(q) * p(q);
    }
    const Eigen::Vector2d fit = A.ldlt().solve(b);
    peak = std::sqrt(fit(0));
    radius = std::sqrt(-fit(0) / fit(1));
  }
};

TEST(Hemisphere, OnAPlaneFollowsHertz) {
  const Scene scene = readScene(std::string(BURNISH_SOURCE_DIR) + "/scenes/examples/hemisphere_press.yaml",
                                {"geometry.spans=[6, 14, 14]"});
  const auto outcome = test::run(scene, "hemisphere");
  ASSERT_TRUE(outcome.summary.completed);
  const double R = 10.0, modulus = 10.0 / (1.0 - 0.3 * 0.3);
  const double force = 4.0 * std::abs(outcome.history.column("floor.fy").back());  // a quarter is computed
  const double a = std::cbrt(3.0 * force * R / (4.0 * modulus));
  const double peak = 1.5 * force / (std::numbers::pi * a * a);
  const HalfEllipsoid fit(outcome.lastFrame.contact.front());
  EXPECT_LT(a, 0.08 * R);
  EXPECT_NEAR(fit.radius, a, 0.02 * a);
  EXPECT_NEAR(fit.peak, peak, 0.02 * peak);
}

}  // namespace
}  // namespace burnish
