#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/core/error.h"
#include "postproc/compare/lab.h"
#include "postproc/draw/color_scale.h"
#include "postproc/draw/contour_view.h"
#include "postproc/draw/field_choice.h"
#include "postproc/draw/ticks.h"

namespace burnish {
namespace {

using testing::ElementsAre;
using testing::Pointwise;

TEST(Ticks, AreRoundAndWithinTheRange) {
  const Ticks ticks = makeTicks({-0.0086, 0.39}, 9);
  EXPECT_THAT(ticks.labels, ElementsAre("0.00", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30", "0.35"));
  EXPECT_THAT(ticks.values, Pointwise(testing::DoubleEq(), {0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35}));
  EXPECT_EQ(ticks.exponent, 0);
}

TEST(Ticks, IncludeEndsThatAreRound) {
  EXPECT_THAT(makeTicks({-0.3, 0.3}, 7).labels,
              ElementsAre("−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"));
}

TEST(Ticks, TakeAPowerOfTenOutOfLongLabels) {
  const Ticks large = makeTicks({0.0, 71000.0}, 4);
  EXPECT_EQ(large.exponent, 3);
  EXPECT_THAT(large.labels, ElementsAre("0", "20", "40", "60"));
  const Ticks small = makeTicks({0.0, 2e-5}, 3);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_THAT(small.labels, ElementsAre("0", "10", "20"));
}

TEST(Ticks, AreNeverMoreThanAsked) {
  for (const double low : {-1.0, 0.0, 0.123})
    for (const double width : {1e-7, 0.77, 1.0, 9.99, 12345.0})
      for (int most = 2; most <= 11; ++most) {
        const Ticks ticks = makeTicks({low, low + width}, most);
        EXPECT_LE(ticks.values.size(), static_cast<std::size_t>(most));
        EXPECT_GE(ticks.values.front(), low);
        EXPECT_LE(ticks.values.back(), low + width);
        EXPECT_EQ(ticks.labels.size(), ticks.values.size());
      }
}

TEST(NumberText, IsSetAsInPrint) {
  EXPECT_EQ(numberText(0.0, 4), "0");
  EXPECT_EQ(numberText(0.48162, 4), "0.4816");
  EXPECT_EQ(numberText(-0.0021, 4), "−0.0021");
  EXPECT_EQ(numberText(1736.6, 4), "1737");
  EXPECT_EQ(numberText(9.99996, 4), "10");
  EXPECT_EQ(numberText(-1.5e-7, 4), "−1.5×10⁻⁷");
  EXPECT_EQ(numberText(2.5e12, 4), "2.5×10¹²");
}

TEST(ColorScale, SmoothScaleRunsFromEndToEndOfTheMap) {
  const ColorScale scale("viridis", {2.0, 4.0}, 0);
  EXPECT_EQ(scale.color(2.0), (Color{68, 1, 84}));
  EXPECT_EQ(scale.color(4.0), (Color{253, 231, 37}));
  EXPECT_EQ(scale.color(-7.0), scale.color(2.0));
  EXPECT_EQ(scale.color(7.0), scale.color(4.0));
  const Color middle = scale.color(3.0);  // (33, 145, 140) up to half a colour step
  EXPECT_THAT(std::vector<int>(middle.begin(), middle.end()), Pointwise(testing::Le(), {34, 146, 141}));
  EXPECT_THAT(std::vector<int>(middle.begin(), middle.end()), Pointwise(testing::Ge(), {32, 144, 139}));
}

TEST(ColorScale, BandsAreEquallyWideAndUseTheWholeMap) {
  const ColorScale scale("grey", {0.0, 1.0}, 4);
  ASSERT_EQ(scale.colors().size(), 4U);
  EXPECT_EQ(scale.color(0.249), scale.colors()[0]);
  EXPECT_EQ(scale.color(0.251), scale.colors()[1]);
  EXPECT_EQ(scale.colors().back(), (Color{240, 240, 240}));
}

TEST(ColorScale, RefusesARangeThatDoesNotIncrease) {
  EXPECT_THROW(ColorScale("viridis", {1.0, 1.0}, 0), Error);
  EXPECT_THROW(ColorScale("viridis", {0.0, std::numeric_limits<double>::infinity()}, 0), Error);
}

TEST(ColorScale, PerceptualMapsOnlyGetLighter) {
  for (const char* map : {"viridis", "cividis", "batlow", "grey"}) {
    const std::vector<Color> colors = ColorScale(map, {0.0, 1.0}, 64).colors();
    for (std::size_t k = 1; k < colors.size(); ++k)
      EXPECT_GT(toLab(colors[k])[0], toLab(colors[k - 1])[0]) << map << " " << k;
    EXPECT_GT(toLab(colors.back())[0] - toLab(colors.front())[0], 65.0F) << map;
  }
}

TEST(ColorScale, EveryNamedMapExists) {
  for (const std::string& map : colormapNames())
    EXPECT_EQ(ColorScale(map, {0.0, 1.0}, 5).colors().size(), 5U) << map;
}

TEST(Views, AreRightHandedWithTheEyeWhereTheirNamesSay) {
  const auto eye = [](const ViewAxes& axes) {
    View view;
    view.axes = axes;
    return view.towardsEye();
  };
  EXPECT_EQ(eye(viewNamed("xy", 3)), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(eye(viewNamed("xz", 3)), Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(eye(viewNamed("yz", 3)), Eigen::Vector3d(1, 0, 0));
  EXPECT_TRUE(eye(viewNamed("iso", 3)).isApprox(Eigen::Vector3d(1, 1, 1).normalized()));
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 2, 3)}) {
    const ViewAxes axes = viewFrom(direction);
    EXPECT_TRUE((axes * axes.transpose()).isIdentity(1e-12));
    EXPECT_TRUE(eye(axes).isApprox(direction.normalized()));
    EXPECT_GE(axes(1, 1), 0.0);
  }
  EXPECT_EQ(viewNamed("auto", 2), ViewAxes(ViewAxes::Identity()));
  EXPECT_THROW(viewNamed("iso", 2), Error);
  EXPECT_THROW(viewNamed("front", 3), Error);
  EXPECT_THROW(viewFrom({0, 0, 0}), Error);
}

TEST(FieldNames, AreScalarsVectorsAndComponents) {
  FrameRecord frame;
  frame.displacement = Eigen::MatrixXd::Zero(2, 4);
  frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", Eigen::MatrixXd::Zero(4, 4)};
  frame.fields["pressure"] = {{}, "MPa", Eigen::MatrixXd::Zero(1, 4)};
  EXPECT_THAT(fieldNames(frame), ElementsAre("displacement", "displacement.x", "displacement.y", "pressure",
                                             "stress.xx", "stress.yy", "stress.xy", "stress.zz"));
}

}  // namespace
}  // namespace burnish
