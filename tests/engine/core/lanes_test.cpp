#include "engine/core/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace burnish {
namespace {

TEST(Lanes, Expm1HasAllDigits) {
  for (double x = 1e-18; x < 690.0; x *= 1.37) {
    const Lanes y = expm1(Lanes{x, -x, 0.1 * x, -0.1 * x});
    const double of[kLanes] = {x, -x, 0.1 * x, -0.1 * x};
    for (int k = 0; k < kLanes; ++k)
      EXPECT_NEAR(y[k], std::expm1(of[k]), 5e-16 * std::abs(std::expm1(of[k]))) << of[k];
  }
}

TEST(Lanes, Expm1OfWhatIsNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Lanes y = expm1(Lanes{0.0, std::numeric_limits<double>::quiet_NaN(), -infinity, infinity});
  EXPECT_EQ(y[0], 0.0);
  EXPECT_TRUE(std::isnan(y[1]));
  EXPECT_EQ(y[2], -1.0);
  EXPECT_GT(y[3], 1e300);
}

}  // namespace
}  // namespace burnish
