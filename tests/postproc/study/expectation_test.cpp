#include "postproc/study/evidence/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace burnish {
namespace {

using testing::ElementsAre;
using testing::Optional;

std::vector<Observed> numbers(const std::vector<std::optional<double>>& values) {
  std::vector<Observed> all;
  double size = 1.0;
  for (const auto& value : values) {
    all.push_back({value, size});
    size /= 2.0;
  }
  return all;
}

template <class Expected>
Verdict verdict(const Expected& expected, const std::vector<std::optional<double>>& values) {
  return judge(expected, numbers(values)).verdict;
}

TEST(Expectation, ATrendIsStrict) {
  const ExpectedTrend increasing, decreasing{ExpectedTrend::Direction::Decreasing};
  EXPECT_EQ(verdict(increasing, {1.0, 2.0, 3.0}), Verdict::Holds);
  EXPECT_EQ(verdict(increasing, {1.0, 2.0, 2.0}), Verdict::DoesNotHold);
  EXPECT_EQ(verdict(increasing, {1.0, {}, 3.0}), Verdict::CannotBeTold);
  EXPECT_EQ(verdict(increasing, {3.0, {}, 1.0}), Verdict::DoesNotHold);
  EXPECT_EQ(verdict(decreasing, {3.0, 2.0}), Verdict::Holds);
  EXPECT_EQ(verdict(decreasing, {3.0, 3.0}), Verdict::DoesNotHold);
}

TEST(Expectation, SamenessIsWithinAPartOfTheLargest) {
  EXPECT_EQ(verdict(ExpectedSameness{0.05}, {-10.0, -9.6}), Verdict::Holds);
  EXPECT_EQ(verdict(ExpectedSameness{0.05}, {-10.0, -9.4}), Verdict::DoesNotHold);
  EXPECT_EQ(verdict(ExpectedSameness{0.05}, {1.0, {}}), Verdict::CannotBeTold);
  EXPECT_EQ(verdict(ExpectedSameness{0.05}, {0.0, 0.0}), Verdict::Holds);
  EXPECT_THAT(judge(ExpectedSameness{0.05}, numbers({-10.0, -9.5})).deviation, Optional(0.05));
}

TEST(Expectation, ADifferenceIsNoSameness) {
  EXPECT_EQ(verdict(ExpectedDifference{0.05}, {-10.0, -9.6}), Verdict::DoesNotHold);
  EXPECT_EQ(verdict(ExpectedDifference{0.05}, {-10.0, -9.4}), Verdict::Holds);
  EXPECT_EQ(verdict(ExpectedDifference{0.05}, {1.0, {}}), Verdict::CannotBeTold);
}

TEST(Expectation, OneOfSeveralIsJudgedAsItself) {
  const CheckExpectation check = ExpectedTrend{};
  const ClaimExpectation claim = ExpectedDifference{0.05};
  EXPECT_EQ(verdict(check, {1.0, 2.0}), Verdict::Holds);
  EXPECT_EQ(verdict(claim, {1.0, 2.0}), Verdict::Holds);
}

TEST(Expectation, ARangeIncludesItsBounds) {
  const ExpectedRange range{FormulaText{"-1.5"}, FormulaText{"2"}};
  EXPECT_EQ(verdict(range, {-1.5, 2.0}), Verdict::Holds);
  EXPECT_EQ(verdict(range, {-1.5, {}}), Verdict::CannotBeTold);
  EXPECT_EQ(verdict(range, {std::nextafter(-1.5, -2.0), {}}), Verdict::DoesNotHold);
  EXPECT_EQ(judge(range, numbers({0.0})).expected, "−1.5 to 2");
  EXPECT_EQ(judge(ExpectedRange{{}, FormulaText{"2"}}, numbers({0.0})).expected, "≤ 2");
}

TEST(Expectation, AValueHoldsWithinItsTolerance) {
  const ExpectedValue relative{FormulaText{"-2"}, 0.1, {}}, absolute{FormulaText{"-2"}, {}, 0.1};
  EXPECT_EQ(verdict(relative, {-2.2, -1.8}), Verdict::DoesNotHold) << "2.2 is a little more than that";
  EXPECT_EQ(verdict(relative, {-2.19, -1.81}), Verdict::Holds);
  EXPECT_EQ(verdict(absolute, {-2.19}), Verdict::DoesNotHold);
  EXPECT_EQ(verdict(absolute, {-2.05, {}}), Verdict::CannotBeTold);
  const std::vector<DefinitionSpec> definitions{{"half", {"0.5"}}};
  EXPECT_EQ(judge(ExpectedValue{FormulaText{"half"}, {}, 1e-9}, {{0.5, 1.0, &definitions}}).verdict,
            Verdict::Holds);
}

TEST(Expectation, AnOrderIsThatOfTheLastNumbersAboveTheFloor) {
  const Judgement judgement = judge(ExpectedOrder{.order = 2.0, .limit = {}}, numbers({0.4, -0.1, 0.025}));
  EXPECT_EQ(judgement.verdict, Verdict::Holds);
  EXPECT_THAT(judgement.errors, ElementsAre(Optional(0.4), Optional(0.1), Optional(0.025)));
  EXPECT_THAT(judgement.orders, ElementsAre(Optional(2.0), Optional(2.0)));
  EXPECT_EQ(verdict(ExpectedOrder{.order = 2.0, .limit = {}}, {0.4, {}, 0.025}), Verdict::CannotBeTold);
}

}  // namespace
}  // namespace burnish
