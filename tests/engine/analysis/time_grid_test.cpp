#include "engine/analysis/time_grid.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(TimeGrid, LandsOnStepsOutputsWantedFramesAndCorners) {
  Scene scene;
  scene.steps = {{1.0, 4}, {2.0, 2}};
  scene.output.every = 0.3;
  scene.wanted.frames = {1.25};
  const auto grid = timeGrid(scene, {0.0, 0.6, 1.0, 5.0});

  std::vector<double> times, frames, corners;
  for (const TimePoint& point : grid) {
    times.push_back(point.time);
    if (point.frame) frames.push_back(point.time);
    if (point.corner) corners.push_back(point.time);
    EXPECT_DOUBLE_EQ(point.nominalStep, point.time <= 1.0 ? 0.25 : 0.5);
  }
  const std::vector<double> wanted{0.25, 0.3, 0.5, 0.6, 0.75, 0.9, 1.0, 1.2, 1.25, 1.5, 1.8, 2.0};
  ASSERT_EQ(times.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(times[k], wanted[k], 1e-14);
  EXPECT_EQ(frames.size(), 8u) << "six of `every`, one wanted, the end";
  EXPECT_EQ(corners, (std::vector<double>{0.6, 1.0}));
}

TEST(TimeGrid, TimesThatDifferByRoundingAreOne) {
  Scene scene;
  scene.steps = {{1.0, 10}};
  scene.output.every = 0.1;
  const auto grid = timeGrid(scene, {0.1 + 0.2});
  ASSERT_EQ(grid.size(), 10u);
  EXPECT_EQ(grid[2].time, 0.1 + 0.2) << "the schedule's own value is kept";
  EXPECT_TRUE(grid[2].frame && grid[2].corner);
  EXPECT_EQ(grid.back().time, 1.0);
}

TEST(TimeGrid, FramesAreKnownBeforeARun) {
  Scene scene;
  scene.steps = {{1.0, 4}, {2.0, 2}};
  scene.output.times = {0.3};
  scene.wanted.frames = {1.25};
  EXPECT_EQ(frameTimes(scene), (std::vector<double>{0.0, 0.3, 1.25, 2.0}));
}

}  // namespace
}  // namespace burnish
