#include "engine/core/portion.h"

#include <gtest/gtest.h>

#include "tests/engine/core/thread_team.h"

namespace burnish {
namespace {

/// Two numbers of each of five things.
const Eigen::MatrixXd kAll{{0.0, 1.0, 2.0, 3.0, 4.0}, {0.5, 1.5, 2.5, 3.5, 4.5}};

/// Things 0, 2 and 4 are those of rank 0, thing 3 that of rank 1, which keeps 2, too, and thing 1 that of rank 2,
/// which keeps 0.
Portion portionOf(const Team& team) {
  const std::vector<int> kept[] = {{0, 2, 4}, {2, 3}, {0, 1}}, own[] = {{0, 1, 2}, {1}, {1}};
  return {team, 5, kept[team.rank()], own[team.rank()]};
}

TEST(Portion, IsPutTogetherWhereItIsAskedFor) {
  test::asTeam(3, [](const Team& team) {
    const Portion portion = portionOf(team);
    const Eigen::MatrixXd part = portion.part(kAll);
    EXPECT_EQ(part.cols(), team.isFirst() ? 3 : 2);
    EXPECT_EQ(part(1, 1), team.rank() == 0 ? 2.5 : team.rank() == 1 ? 3.5 : 1.5);
    EXPECT_EQ(portion.whole(part, Receivers::All), kAll);
    const Eigen::MatrixXd onFirst = portion.whole(part, Receivers::First);
    EXPECT_EQ(onFirst.rows(), 2);
    if (team.isFirst())
      EXPECT_EQ(onFirst, kAll);
    else
      EXPECT_EQ(onFirst.cols(), 0);
  });
}

TEST(Portion, IsTakenFromTheOneThatHasAThingFirstHand) {
  test::asTeam(3, [](const Team& team) {
    Eigen::MatrixXd part = portionOf(team).part(kAll);
    if (!team.isFirst()) part.col(0).setConstant(-1.0);  // of things that are rank 0's
    EXPECT_EQ(portionOf(team).whole(part, Receivers::All), kAll);
  });
}

TEST(Portion, LeavesTheValuesThatAreKept) {
  test::asTeam(3, [](const Team& team) {
    std::vector<int> values{10, 11, 12, 13, 14};
    portionOf(team).reduce(values);
    EXPECT_EQ(values, (std::vector<std::vector<int>>{
                          {10, 12, 14}, {12, 13}, {10, 11}})[static_cast<std::size_t>(team.rank())]);
  });
}

TEST(Portion, OfAProcessAloneIsAll) {
  std::vector<int> values{1, 2};
  const Portion portion(2);
  portion.reduce(values);
  EXPECT_EQ(values.size(), 2u);
  EXPECT_EQ(portion.count(), 2);
  EXPECT_EQ(portion.part(kAll), kAll);
  EXPECT_EQ(portion.whole(kAll, Receivers::First), kAll);
}

}  // namespace
}  // namespace burnish
