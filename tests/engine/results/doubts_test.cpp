#include "engine/results/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

namespace burnish {
namespace {

using testing::HasSubstr;

TEST(Doubts, SentencesSayTheirLimits) {
  EXPECT_EQ(sentenceOf(Condition::Penetration, {}),
            "point-wise penetration above a tenth of a knot span or 1 % of the tool's radius");
  EXPECT_EQ(sentenceOf(Condition::SmallJ, {}),
            fmt::format("smallest J below {}", limitOf(Condition::SmallJ)));
  EXPECT_THAT(sentenceOf(Condition::LostContact, {}), HasSubstr("fewer than three control points"));
  EXPECT_THAT(sentenceOf(Condition::NewBoundary, {}), HasSubstr("0.5 % of the body's size"));
  EXPECT_THAT(sentenceOf(Condition::Balance, {}), HasSubstr("more than 10 % of the work"));
  EXPECT_THAT(sentenceOf(Condition::Stabilisation, {}), HasSubstr("more than 1 % of the largest force"));
  EXPECT_THAT(sentenceOf(Condition::CoarsePath, {}), HasSubstr("fewer than four knot spans"));
}

TEST(Doubts, SentencesAdviseWhatTheSceneDoesNotHaveYet) {
  EXPECT_THAT(sentenceOf(Condition::LostContact, {}), HasSubstr("`rezoning: {}` in the scene"));
  EXPECT_THAT(sentenceOf(Condition::LostContact, {.rezones = true}), HasSubstr("(rezoning.spans,"));
  EXPECT_THAT(sentenceOf(Condition::CrossesItself, {}), HasSubstr("self_contact computes it"));
  EXPECT_THAT(sentenceOf(Condition::CrossesItself, {.touchesItself = true}), HasSubstr("larger reach"));
}

TEST(Doubts, KeepTheirFirstWorstAndLastTimes) {
  Doubt doubt;
  doubt.note(0.5, 0.02);
  doubt.note(0.75, 0.04);
  doubt.note(1.0, 0.03);
  EXPECT_EQ(doubt.steps, 3);
  EXPECT_EQ(doubt.firstTime, 0.5);
  EXPECT_EQ(detailOf(Condition::Stabilisation, doubt),
            "at worst 4 % (at t = 0.75), for the last time at t = 1");
  StateArchive saving;
  saving.part("doubt", doubt);
  StateArchive restoring(saving.values());
  Doubt read;
  restoring.part("doubt", read);
  EXPECT_EQ(detailOf(Condition::Stabilisation, read), detailOf(Condition::Stabilisation, doubt));
  EXPECT_EQ(read.steps, 3);
}

TEST(Doubts, ImbalanceIsRelativeToTheLargerOfWorkAndEnergies) {
  EXPECT_DOUBLE_EQ(imbalanceOf(9.0, 10.0, 0.0), 0.1);
  EXPECT_DOUBLE_EQ(imbalanceOf(10.0, 9.0, 0.0), 0.1);
  EXPECT_EQ(imbalanceOf(0.0, 0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(imbalanceOf(0.0, 0.02, 1.0), 0.02) << "of a body that was let go of";
}

}  // namespace
}  // namespace burnish
