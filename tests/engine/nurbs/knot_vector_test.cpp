#include "engine/nurbs/knot_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"

namespace burnish {
namespace {

std::string messageOf(int degree, const std::vector<double>& knots) {
  try {
    KnotVector(degree, knots);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(KnotVector, CountsFunctionsSpansAndBreakpoints) {
  const KnotVector knots(2, {0, 0, 0, 0.25, 0.5, 0.5, 1, 1, 1});
  EXPECT_EQ(knots.numFunctions(), 6);
  EXPECT_EQ(knots.numSpans(), 3);
  EXPECT_EQ(knots.breakpoints(), (std::vector<double>{0, 0.25, 0.5, 1}));
  EXPECT_EQ(knots.intervalOfSpan(0), 2);
  EXPECT_EQ(knots.intervalOfSpan(1), 3);
  EXPECT_EQ(knots.intervalOfSpan(2), 5);
}

TEST(KnotVector, GrevilleAbscissaeReproduceTheParameter) {
  const KnotVector knots(3, {0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(knots.greville(0), 0.0);
  EXPECT_DOUBLE_EQ(knots.greville(2), (0.0 + 0.3 + 0.7) / 3.0);
  EXPECT_DOUBLE_EQ(knots.greville(knots.numFunctions() - 1), 1.0);
}

TEST(KnotVector, RefusesWhatIsNotAnOpenKnotVector) {
  EXPECT_NE(messageOf(0, {0, 1}).find("degree 0"), std::string::npos);
  EXPECT_NE(messageOf(2, {0, 0, 1, 1}).find("needs at least 6"), std::string::npos);
  EXPECT_NE(messageOf(1, {0, 0, 0.6, 0.4, 1, 1}).find("must not decrease"), std::string::npos);
  EXPECT_NE(messageOf(2, {0, 0, 0.5, 1, 1, 1}).find("open knot vector"), std::string::npos);
  EXPECT_NE(messageOf(2, {0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1}).find("at most 2"), std::string::npos);
  EXPECT_NE(messageOf(1, {0, 0, 0, 0}).find("all knots are equal"), std::string::npos);
  EXPECT_NE(messageOf(1, {0, 0, std::nan(""), 1, 1}).find("not a finite number"), std::string::npos);
  EXPECT_TRUE(messageOf(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}).empty());
}

}  // namespace
}  // namespace burnish
