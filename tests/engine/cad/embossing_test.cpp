// The example with a stamp from CAD, coarser and not as deep.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

TEST(Embossing, ACrossPressesAlikeAlongItsTwoBars) {
  const Scene scene = readScene(
      fmt::format("{}/scenes/examples/embossing.yaml", BURNISH_SOURCE_DIR),
      {"geometry.spans=[8, 2, 8]", "steps=[{until: 0.4, count: 3}]", "output.times=[]", "pictures=[]"});
  const auto outcome = test::run(scene, "embossing");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  const double down = outcome.history.column("stamp.fy").back();
  EXPECT_GT(down, 30.0);
  EXPECT_NEAR(outcome.history.column("stamp.fx").back(), outcome.history.column("stamp.fz").back(),
              1e-4 * down);
  EXPECT_NEAR(outcome.history.column("stamp.mx").back(), -outcome.history.column("stamp.mz").back(),
              1e-4 * down);
  // Between a quarter of the cross's flat, 1.4 x 0.2 twice, and a quarter of the whole cross, 1.8 x 0.6 twice.
  const double area = outcome.history.column("stamp.contact_area").back();
  EXPECT_GT(area, 0.13);
  EXPECT_LT(area, 0.45);
  const auto& end = outcome.summary.end;
  EXPECT_NEAR(end.externalWork, end.strainEnergy + end.contactEnergy + end.plasticWork,
              0.05 * end.externalWork);
}

}  // namespace
}  // namespace burnish
