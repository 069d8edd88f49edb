#include "postproc/text/plain_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace burnish {
namespace {

TEST(PlainTime, SumsOfStepsAreWhatWasWritten) {
  EXPECT_NE(3 * 0.1, 0.3);
  EXPECT_EQ(plainTime(3 * 0.1), 0.3);
  double sum = 0.0;
  for (int k = 1; k <= 20; ++k) {
    sum += 0.05;
    EXPECT_EQ(plainTime(sum), k / 20.0);
    EXPECT_EQ(plainTime(1e6 * sum), 50000.0 * k);
  }
}

TEST(PlainTime, OtherNumbersStayAsTheyAre) {
  for (const double time : {0.0, 1.0 / 3.0, std::sqrt(2.0), 1.0 + 1e-12, 1e-300, -0.7, 0.123456789012,
                            std::numeric_limits<double>::infinity()})
    EXPECT_EQ(plainTime(time), time);
}

}  // namespace
}  // namespace burnish
