#include "engine/core/state_archive.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace burnish {
namespace {

enum class Mood { Calm, Cross };

/// A value of every kind.
struct Everything {
  bool truth = false;
  Mood mood = Mood::Calm;
  int count = 0;
  long large = 0;
  double number = 0.0;
  Eigen::Matrix3d fixed = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd dynamic, empty;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  int steps = 0;
  bool held = false;
  double worst = 0.0;

  void archive(StateArchive& a) {
    a.field("truth", truth);
    a.field("mood", mood);
    a.field("count", count);
    a.field("large", large);
    a.field("number", number);
    a.field("fixed", fixed);
    a.field("dynamic", dynamic);
    a.field("empty", empty);
    a.field("vector", vector);
    a.together("doubt", steps, held, worst);
  }
};

Everything sample() {
  Everything s{.truth = true,
               .mood = Mood::Cross,
               .count = -3,
               .large = 1L << 50,
               .number = 1.0 / 3.0,
               .fixed = Eigen::Matrix3d{{1, 2, 3}, {4, 5, 6}, {7, 8, 1.0 / 7.0}},
               .dynamic = Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}},
               .empty = Eigen::MatrixXd(2, 0),
               .steps = 7,
               .held = true,
               .worst = 0.1};
  s.vector = {1.0, 2.0, 3.0};
  return s;
}

SavedState saved(Everything& object) {
  StateArchive archive;
  archive.part("all", object);
  return archive.values();
}

TEST(StateArchive, ValuesOfAllKindsComeBackWithTheirBits) {
  Everything written = sample(), read;
  const SavedState state = saved(written);
  StateArchive archive(state);
  archive.part("all", read);
  EXPECT_EQ(read.mood, Mood::Cross);
  EXPECT_EQ(read.large, 1L << 50);
  EXPECT_EQ(read.fixed, written.fixed);
  EXPECT_EQ(read.dynamic, written.dynamic);
  EXPECT_EQ(read.empty.rows(), 2);
  EXPECT_EQ(read.vector, written.vector);
  EXPECT_TRUE(read.truth && read.held);
  EXPECT_EQ(saved(read), state);
}

TEST(StateArchive, ValuesOfAnotherSizeAreRefusedWithTheirNames) {
  Everything written = sample();
  for (const char* name : {"fixed", "dynamic", "doubt", "truth", "mood"}) {
    SavedState state = saved(written);
    Eigen::VectorXd& values = state.at(std::string("all.") + name);
    values.conservativeResize(values.size() + 1);
    values(values.size() - 1) = 0.0;
    StateArchive archive(state);
    Everything read;
    try {
      archive.part("all", read);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("all.") + name), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace burnish
