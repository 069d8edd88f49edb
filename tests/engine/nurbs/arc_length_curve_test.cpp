#include "engine/nurbs/arc_length_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish {
namespace {

TEST(ArcLengthCurve, OfAQuarterOfACircle) {
  const ArcLengthCurve curve(tracePatch(refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 0.5 * std::numbers::pi),
                                                {KnotVector::uniform(2, 2), KnotVector::uniform(2, 3)}),
                                        1));
  EXPECT_NEAR(curve.length(), std::numbers::pi, 1e-10);
  for (const double s : {0.0, 0.3, 1.1, 2.9, curve.length()}) {
    EXPECT_NEAR(curve.lengthTo(curve.parameterAt(s)), s, 1e-10);
    EXPECT_NEAR((curve.at(s) - 2.0 * Eigen::Vector2d(std::cos(0.5 * s), std::sin(0.5 * s))).norm(), 0.0,
                1e-9);
    EXPECT_NEAR(curve.tangentAt(s).dot(curve.at(s)), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace burnish
