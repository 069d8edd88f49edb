#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <vtkImageData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/material/material.h"
#include "postproc/compare/lab.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_layout.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/place_marks.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/page/color_name.h"
#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/draw/page/font.h"
#include "postproc/draw/page/glyph_picture.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/draw/page/theme.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/text/ticks.h"
#include "tests/message_of.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
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

TEST(ColorScale, RefusesARangeThatNumbersCannotSpan) {
  for (const std::array<double, 2>& range :
       {std::array{-1e308, 1e308}, std::array{0.0, 5e-324}, std::array{1e301, 2e301}})
    EXPECT_THAT(messageOf([&] { ColorScale("viridis", range, 0); }), HasSubstr("at least 1e-290 apart"));
  EXPECT_EQ(widened({0.0, 5e-324}), (std::array{0.0, 1.0}));
}

TEST(ColorScale, PerceptualMapsOnlyGetLighter) {
  for (const char* map : {"viridis", "cividis", "batlow", "grey"}) {
    const std::vector<Color> colors = ColorScale(map, {0.0, 1.0}, 64).colors();
    for (std::size_t k = 1; k < colors.size(); ++k)
      EXPECT_GT(toLab(colors[k])[0], toLab(colors[k - 1])[0]) << map << " " << k;
    EXPECT_GT(toLab(colors.back())[0] - toLab(colors.front())[0], 65.0F) << map;
  }
}

TEST(ColorScale, HasTheMiddleOfTheMapAtAValue) {
  const ColorScale whole("coolwarm", {-3.0, 3.0}, 0), part("coolwarm", {-1.0, 3.0}, 0, 0.0);
  for (const double value : {-0.9, -0.5, 0.0, 0.7, 2.9})
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(whole.color(value)[c], part.color(value)[c], 3) << value;
  EXPECT_EQ(part.colors().back(), whole.colors().back());
  const Color zero = part.color(0.0);
  EXPECT_LT(std::max({zero[0], zero[1], zero[2]}) - std::min({zero[0], zero[1], zero[2]}), 8);
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

/// A bar that is shorter than the picture has other labels, and may need more room.
TEST(FieldNames, WhatCannotBeNegativeIsDrawnFromZeroOn) {
  ModelRecord model;
  FrameRecord frame;
  frame.displacement = Eigen::MatrixXd::Zero(2, 3);
  const Eigen::MatrixXd values{{-0.5, 0.25, 1.0}};
  for (const char* name : {"plastic_strain", "von_mises", "pressure"}) frame.fields[name] = {{}, "", values};
  EXPECT_EQ(chooseField(model, frame, "plastic_strain").drawnScalars(values),
            Eigen::Vector3d(0.0, 0.25, 1.0));
  EXPECT_EQ(chooseField(model, frame, "von_mises").drawnScalars(values), Eigen::Vector3d(0.0, 0.25, 1.0));
  EXPECT_EQ(chooseField(model, frame, "pressure").drawnScalars(values), Eigen::Vector3d(-0.5, 0.25, 1.0));
}

TEST(Ticks, OfBandsAreAtTheirBorders) {
  Ticks ticks = makeTicksOfBands({0.0, 0.0976}, 8, 11);
  EXPECT_THAT(ticks.labels, ElementsAre("0.0000", "0.0122", "0.0244", "0.0366", "0.0488", "0.0610", "0.0732",
                                        "0.0854", "0.0976"));
  ticks = makeTicksOfBands({-1.0, 1.0}, 12, 7);
  EXPECT_THAT(ticks.values,
              Pointwise(testing::DoubleNear(1e-15), {-1.0, -2.0 / 3, -1.0 / 3, 0.0, 1.0 / 3, 2.0 / 3, 1.0}));
  EXPECT_THAT(ticks.labels, ElementsAre("−1.000", "−0.667", "−0.333", "0.000", "0.333", "0.667", "1.000"));
  ticks = makeTicksOfBands({0.0, 7e5}, 7, 4);  // every third border, and so none at the upper end
  EXPECT_EQ(ticks.exponent, 3);
  EXPECT_THAT(ticks.labels, ElementsAre("0", "300", "600"));
  EXPECT_EQ(makeTicksOfBands({0.0, 1.0}, 1, 2).values.size(), 2U);
}

ScalarBar barOf(const std::array<double, 2>& range, int bands, bool constant, double value) {
  return {ColorScale("viridis", range, bands),
          {.title = {{"field"}},
           .unit = "",
           .smallest = value,
           .largest = value,
           .bands = bands,
           .constant = constant},
          12.0,
          Theme{}};
}

TEST(ScalarBars, OfAFieldWithOneValueHaveThatValueAlone) {
  const ScalarBar zero = barOf({0.0, 1.0}, 0, true, 0.0);
  EXPECT_THAT(zero.marks().labels, ElementsAre("0"));
  EXPECT_EQ(zero.smallest().front().text, "0 everywhere");
  EXPECT_TRUE(zero.largest().empty()) << "which would stand at another colour";
  EXPECT_THAT(barOf({0.9, 1.1}, 0, true, 1.0).marks().labels, ElementsAre("1"));
  const ScalarBar given = barOf({0.0, 1.0}, 0, false, 0.0);
  EXPECT_GT(given.marks().labels.size(), 5U);
  EXPECT_EQ(given.largest().front().text, "max 0");
  EXPECT_THAT(barOf({0.0, 1.0}, 4, false, 0.0).marks().labels,
              ElementsAre("0.00", "0.25", "0.50", "0.75", "1.00"));
}

/// Room for the numbers of other ranges is that for their numbers, not for these in the power of ten of one's own.
TEST(ScalarBars, OtherRangesHaveTheirOwnPowersOfTen) {
  const auto depth = [](const std::vector<std::array<double, 2>>& together) {
    return ScalarBar(ColorScale("viridis", {0.0, 1e-19}, 0),
                     {.title = {{"field"}},
                      .unit = "",
                      .smallest = 0.0,
                      .largest = 1e-19,
                      .together = together,
                      .even = true},
                     12.0, Theme{})
        .depth(Overlay::Direction::Up, 200.0);
  };
  EXPECT_EQ(depth({{0.0, 1e-19}, {0.0, 0.1314}, {0.2, 0.2}, {0.0, 0.0}}), depth({}));
}

/// A given end that no value is at is no value: its number stands there, instead of a mark next to it.
TEST(ScalarBars, EndsThatNoValueIsAtHaveTheirNumbers) {
  const auto labels = [](const std::array<double, 2>& range, double largest,
                         const std::vector<std::array<double, 2>>& together) {
    return ScalarBar(
               ColorScale("viridis", range, 0),
               {.title = {{"field"}}, .unit = "", .smallest = 0.0, .largest = largest, .together = together},
               12.0, Theme{})
        .marks()
        .labels;
  };
  EXPECT_EQ(labels({0.0, 0.2298}, 0.1314, {}).back(), "0.2298");
  EXPECT_THAT(labels({0.0, 0.2298}, 0.1314, {}), testing::Not(testing::Contains("0.225")));
  EXPECT_EQ(labels({0.0, 0.2298}, 0.2298, {}).back(), "0.225") << "max tells it";
  EXPECT_EQ(labels({0.0, 0.2298}, 0.2298, {{0.0, 0.1314}}).back(), "0.2298") << "as in the others";
  EXPECT_EQ(labels({0.0, 0.2298}, 0.3, {}).back(), "0.225") << "the arrow tells it";
  EXPECT_EQ(labels({0.0, 3.0}, 0.4, {}), labels({0.0, 3.0}, 3.0, {}));
}

/// With as many digits as tell them from one another.
TEST(ScalarBars, EndsOfNarrowRangesAreTold) {
  const auto ends = [](double smallest, double largest) {
    const ScalarBar bar(ColorScale("viridis", widened({smallest, largest}), 0),
                        {{{"field"}}, "", smallest, largest}, 12.0, Theme{});
    return bar.smallest().front().text + ", " + bar.largest().front().text;
  };
  EXPECT_EQ(ends(300.01, 300.05), "min 300.01, max 300.05");
  EXPECT_EQ(ends(1000000.0, 1000003.0), "min 1, max 1.000003");
  EXPECT_EQ(ends(-20.125, -20.0), "min −20.125, max −20");
  EXPECT_EQ(ends(0.0, 0.65923), "min 0, max 0.6592");
  EXPECT_EQ(ends(1.7821e-4, 1.07612e-3), "min 1.782×10⁻⁴, max 0.001076");
  EXPECT_EQ(ends(0.75, 0.75 + 1e-13), "min 0.75, max 0.75") << "one value but for rounding";
  EXPECT_EQ(ends(300.0, 411.26), "min 300, max 411.3");
}

/// Other results of a sheet have stresses in another unit, or in none.
TEST(SharedViews, RangesOfOtherUnitsAreRefused) {
  const auto message = [](const std::string& one, const std::string& other) {
    ContourOptions options;
    return messageOf([&] {
      shareView(options, {0, 1}, {0, 1}, [&](int k, bool, bool) {
        FrameView view{std::array{0.0, 1.0}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}};
        view.unit = k == 0 ? one : other;
        return view;
      });
    });
  };
  EXPECT_EQ(message("MPa", "MPa"), "");
  EXPECT_EQ(message("MPa", "kPa"),
            "range: found values in MPa and in kPa, which cannot have one range of colours; "
            "take frame, which gives each its own");
  EXPECT_THAT(message("", "kPa"), HasSubstr("found values without a unit and in kPa"));
}

TEST(SharedViews, ValuesThatAreRoundingBesideOthersAreZero) {
  ContourOptions options;
  shareView(options, {0, 1}, {0, 1}, [&](int k, bool, bool) {
    FrameView view{std::array{0.0, 0.5}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}};
    view.extremes = k == 0 ? std::array{-1e-16, 3e-16} : std::array{0.0, 0.5};
    return view;
  });
  EXPECT_EQ(options.largest, 0.5);
  EXPECT_EQ(options.room->extremes.front(), (std::array{0.0, 0.0}));
  FieldChoice noise;
  noise.coefficients = Eigen::MatrixXd::Constant(1, 4, 3e-16);
  FieldChoice small = noise;
  small.coefficients *= 1e4;
  dropRounding(noise, options.largest);
  dropRounding(small, options.largest);
  EXPECT_EQ(magnitudeOf(noise), 0.0);
  EXPECT_DOUBLE_EQ(magnitudeOf(small), 3e-12);
}

TEST(BreakLines, StandWhereToolsAreCutOff) {
  View view;
  view.axes << 1, 0, 0, 0, 1, 0;
  view.pixelsPerLength = 10.0;
  view.area = {100.0, 50.0, 200.0, 100.0};  // shows x from -10 to 10, y from -5 to 5
  const auto linesOf = [&](const Eigen::Matrix3Xd& corners,
                           const std::vector<std::vector<vtkIdType>>& cells) {
    PolyBuilder builder;
    builder.addPoints(corners);
    for (const std::vector<vtkIdType>& cell : cells) builder.addPolygon(cell);
    return breakLines({ToolDrawing{builder.finish(), nullptr, nullptr}}, view, 10.0);
  };
  Eigen::Matrix3Xd corners = Eigen::Matrix3Xd::Zero(3, 4);
  corners.row(0) << -2, 8, 8, -2;
  corners.row(1) << 1, 1, 9, 9;
  for (const auto& cells : {std::vector<std::vector<vtkIdType>>{{0, 1, 2, 3}}, {{0, 1, 2}, {0, 2, 3}}}) {
    const auto lines = linesOf(corners, cells);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines.front().front().isApprox(Eigen::Vector2d(180.0, 150.0)));
    EXPECT_TRUE(lines.front().back().isApprox(Eigen::Vector2d(280.0, 150.0)));
    EXPECT_EQ(lines.front().size(), 6U) << "a zigzag in the middle";
  }
  corners.row(0) << -12, -8, -8, -12;  // in a corner: along two sides
  EXPECT_EQ(linesOf(corners, {{0, 1, 2, 3}}).size(), 2U);
  corners.row(1) << 1, 1, 4, 4;
  corners.row(0) << -2, 8, 8, -2;
  EXPECT_TRUE(linesOf(corners, {{0, 1, 2, 3}}).empty());
}

TEST(PlaceMarks, MoveToTheFirstImageThatIsSeen) {
  const Eigen::Vector3d place(1.0, 2.0, 3.0);
  const auto moved = [&](const std::function<bool(const Eigen::Vector3d&)>& isSeen) {
    ExtremePlaces places{{place, place}, {place, place}};
    moveToSeen(places, {{0, 0.0}, {2, 5.0}}, isSeen);
    EXPECT_EQ(places.positions, places.drawn);
    return places.positions[1];
  };
  EXPECT_EQ(moved([](const auto&) { return true; }), place);
  EXPECT_EQ(moved([](const auto&) { return false; }), place);
  EXPECT_EQ(moved([](const Eigen::Vector3d& x) { return x.x() < 0.0; }), Eigen::Vector3d(-1.0, 2.0, 3.0));
  EXPECT_EQ(moved([](const Eigen::Vector3d& x) { return x.x() < 0.0 && x.z() > 5.0; }),
            Eigen::Vector3d(-1.0, 2.0, 7.0));
}

TEST(ContourLayout, SaysWhetherTextsLeaveRoom) {
  const auto hasRoom = [](double text) {
    const ScalarBar bar(ColorScale("viridis", {0.0, 1.0}, 0), {{{"field"}}, "", 0.0, 1.0}, text, Theme{});
    return layOutContour({400, 225}, text, {Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 1)},
                         ViewAxes::Identity(), {"Title", "t = 2", ""}, &bar, Theme{})
        .hasRoom;
  };
  EXPECT_TRUE(hasRoom(textSizeFor({400, 225})));
  EXPECT_TRUE(hasRoom(14.0));
  EXPECT_FALSE(hasRoom(40.0));
  EXPECT_FALSE(hasRoom(200.0));
}

TEST(ContourLayout, HasRoomForTheTextsOfTheBarAtEverySize) {
  const Theme theme;
  for (const std::array<int, 2> size :
       {std::array{200, 150}, {240, 160}, {240, 200}, {400, 300}, {400, 800}, {3000, 400}})
    for (const double largest : {0.1318, 0.2146, 56.27, 7.1e4})
      for (int k = 2; k <= 24; ++k) {
        const double height = 0.05 * k;
        const double text = textSizeFor(size);
        const ScalarBar bar(ColorScale("viridis", {0.0, largest}, 0),
                            {{{"von Mises stress σ"}, {"v", Script::Sub}}, "", 0.0, largest}, text, theme);
        const ContourLayout layout =
            layOutContour(size, text, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, height)},
                          ViewAxes::Identity(), {"Title", "t = 2", ""}, &bar, theme);
        const bool up = layout.barDirection == Overlay::Direction::Up;
        const double needed = bar.depth(layout.barDirection, up ? layout.bar.height : layout.bar.width);
        EXPECT_LE(needed, (up ? layout.bar.width : layout.bar.height) + 1e-9)
            << size[0] << " x " << size[1] << ", up to " << largest << ", height " << height;
        EXPECT_LE(layout.bar.right(), size[0]);
        EXPECT_GE(std::min(layout.view.area.x, layout.bar.y), 0.0);
      }
}

/// In letters of 10 pixels it has less than a third of the height.
TEST(ContourLayout, BarOfTheSmallestPictureIsReadable) {
  const std::array<int, 2> size{200, 150};
  const double text = textSizeFor(size);
  EXPECT_EQ(text, 7.0);
  EXPECT_EQ(textSizeFor({300, 200}), 10.0);
  const ScalarBar bar(ColorScale("viridis", {0.0, 0.1318}, 0), {{{"von Mises stress"}}, "MPa", 0.0, 0.1318},
                      text, Theme{});
  const ContourLayout layout = layOutContour(size, text, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)},
                                             ViewAxes::Identity(), {"Title", "t = 2", ""}, &bar, Theme{});
  ASSERT_EQ(layout.barDirection, Overlay::Direction::Up);
  EXPECT_GT(layout.bar.height, 0.65 * size[1]);
  EXPECT_GT(layout.view.area.height, 0.65 * size[1]);
}

TEST(ContourLayout, MarkOfDoubtHasALineOfItsOwn) {
  const std::array<int, 2> size{800, 450};
  const double text = textSizeFor(size);
  const ScalarBar bar(ColorScale("viridis", {0.0, 1.0}, 0), {{{"field"}}, "", 0.0, 1.0}, text, Theme{});
  const auto layOut = [&](const ContourCaption& caption) {
    return layOutContour(size, text, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}, ViewAxes::Identity(),
                         caption, &bar, Theme{});
  };
  const std::string note(150, 'n');
  const ContourLayout plain = layOut({"Title", "t = 2", note});
  const ContourLayout marked = layOut({"Title", "t = 2", note, kDoubtMark});
  ASSERT_EQ(marked.note.size(), 1U);
  EXPECT_EQ(marked.note[0].style.size, plain.note[0].style.size);
  EXPECT_EQ(marked.note[0].text[0].text, plain.note[0].text[0].text);
  EXPECT_GT(marked.noteAt.y(), marked.doubtAt.y() + capitalHeight(marked.doubt.style));
  EXPECT_EQ(marked.doubt.text[0].text, kDoubtMark);
}

TEST(ContourLayout, NotesThatAreTooLongForALineHaveTwo) {
  const Theme theme;
  const ScalarBar bar(ColorScale("viridis", {0.0, 1.0}, 0), {{{"field"}}, "", 0.0, 1.0}, 10.0, theme);
  const auto layOut = [&](const std::string& note) {
    return layOutContour({300, 300}, 10.0, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)},
                         ViewAxes::Identity(), {"Title", "t = 2", note, kDoubtMark}, &bar, theme);
  };
  EXPECT_EQ(layOut("a short one").note.size(), 1U);
  const std::string note =
      "smallest value at (0.123, 4.567, 8.901), largest value at (2.345, 6.789, 0.123); section z = 0.25";
  const ContourLayout layout = layOut(note);
  ASSERT_EQ(layout.note.size(), 2U);
  EXPECT_EQ(layout.note[0].text[0].text + " " + layout.note[1].text[0].text, note);
  const std::string& first = layout.note[0].text[0].text;
  EXPECT_EQ(std::ranges::count(first, '('), std::ranges::count(first, ')')) << first;
  const TextStyle& style = layout.note[0].style;
  EXPECT_EQ(style.size, layout.note[1].style.size);
  EXPECT_GT(layout.noteLine, capitalHeight(style));
  EXPECT_GT(layout.noteAt.y() - layout.noteLine, layout.doubtAt.y() + capitalHeight(layout.doubt.style));
  EXPECT_LT(layout.noteAt.y() + capitalHeight(style), std::min(layout.view.area.y, layout.bar.y));
}

TEST(ContourLayout, WithoutAColourScaleTheBodyHasAllOfTheRoom) {
  const ContourLayout layout = layOutContour({400, 300}, 10.0, {Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 5)},
                                             ViewAxes::Identity(), {"", "", ""}, nullptr, Theme{});
  EXPECT_EQ(layout.view.center, Eigen::Vector2d(3.0, 3.5));
  EXPECT_NEAR(layout.view.area.center().x(), 200.0, 1.0);
  EXPECT_NEAR(layout.view.area.center().y(), 150.0, 1.0);
  EXPECT_GT(layout.view.pixelsPerLength, 0.95 * 300.0 / 3.0);
}

TEST(ColorNames, AreDigitsOrThoseOfCss) {
  EXPECT_EQ(colorNamed("#1e90FF"), (Color{30, 144, 255}));
  EXPECT_EQ(colorNamed("grey"), (Color{128, 128, 128}));
  EXPECT_EQ(colorNamed("white"), (Color{255, 255, 255}));
  EXPECT_EQ(colorNamed("orange"), (Color{255, 165, 0}));
  for (const char* text : {"", "#fff", "#12345g", "#1234567", "whit"})
    EXPECT_EQ(colorNamed(text), std::nullopt) << text;
}

/// A theme file with this text, and what is read from it.
class ThemeFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(file.parent_path()); }
  void TearDown() override { fs::remove_all(file.parent_path()); }

  Theme read(const std::string& yaml) const {
    std::ofstream(file) << yaml;
    return readTheme(file);
  }
  std::string mistake(const std::string& yaml) const {
    return messageOf([&] { read(yaml); });
  }

  fs::path file = fs::temp_directory_path() / ("burnish_theme_" + std::to_string(::getpid())) / "own.yaml";
};

TEST_F(ThemeFile, StatesWhatDiffersFromItsBase) {
  const Theme theme = read("base: dark\nink: '#ff0080'\npaper: navy\ntext_size: 1.2\npicture: {bands: 7}\n");
  Theme expected = themeNamed("dark");
  expected.ink = {255, 0, 128};
  expected.paper = {0, 0, 128};
  expected.textSize = 1.2;
  expected.picture.bands = 7;
  EXPECT_EQ(theme, expected);
  EXPECT_EQ(themeFrom(file.string()), expected);
  EXPECT_EQ(read("font: DejaVu Serif\n").font, "DejaVu Serif");
  EXPECT_EQ(read("picture: {knots: true}\n").ink, Theme{}.ink);
}

TEST_F(ThemeFile, FontFileIsRelativeToTheTheme) {
  fs::copy_file(fontNamed("DejaVu Serif").file, file.parent_path() / "journal.ttf");
  const Theme theme = read("font: journal.ttf\n");
  EXPECT_EQ(theme.font, (file.parent_path() / "journal.ttf").string());
  EXPECT_EQ(fontNamed(theme.font).capitals, fontNamed("DejaVu Serif").capitals);
}

TEST_F(ThemeFile, MistakesAreToldWithTheirPlaceAndTheNearestWord) {
  EXPECT_THAT(
      mistake("base: paper\ninc: black\n"),
      AllOf(HasSubstr("own.yaml:2:1: inc: found an unknown key"), HasSubstr("Did you mean \"ink\"?")));
  EXPECT_THAT(mistake("base: drak\n"),
              AllOf(HasSubstr("own.yaml:1:7: base: found drak"), HasSubstr("Did you mean \"dark\"?")));
  EXPECT_THAT(mistake("ink: blak\n"),
              AllOf(HasSubstr("own.yaml:1:6: ink: found \"blak\""), HasSubstr("Did you mean \"black\"?")));
  EXPECT_THAT(mistake("ink: #000000\n"), AllOf(HasSubstr("own.yaml:1:"), HasSubstr("stands in quotes")));
  EXPECT_THAT(mistake("picture: {colormap: virids}\n"),
              AllOf(HasSubstr("picture.colormap"), HasSubstr("Did you mean \"viridis\"?")));
  EXPECT_THAT(mistake("text_size: 9\n"), HasSubstr("allowed: a number from 0.25 to 4"));
  EXPECT_THAT(mistake("font: DejaVu Serf\n"),
              AllOf(HasSubstr("own.yaml:1:7: font: found"), HasSubstr("Did you mean \"DejaVu Serif\"?")));
  EXPECT_THAT(mistake("font: absent.ttf\n"), HasSubstr("there is no such file"));
  EXPECT_THAT(messageOf([&] { readTheme(file.parent_path() / "absent.yaml"); }), HasSubstr("absent.yaml"));
}

TEST(Themes, BuiltInOnesAreWhatTheirNamesSay) {
  EXPECT_THAT(themeNames(), ElementsAre("paper", "dark", "slide", "complas"));
  EXPECT_EQ(themeNamed("paper"), Theme{});
  EXPECT_LT(toLab(themeNamed("dark").paper)[0], 15.0F);
  EXPECT_GT(themeNamed("slide").textSize, 1.2);
  EXPECT_EQ(themeNamed("complas").picture.colormap, "rainbow");
  EXPECT_TRUE(themeNamed("complas").picture.knots);
  EXPECT_THAT(messageOf([] { themeNamed("slides"); }), HasSubstr("Did you mean \"slide\"?"));
}

TEST(Themes, TextsStandOutFromThePaper) {
  for (const std::string& name : themeNames()) {
    const Theme& theme = themeNamed(name);
    const float paper = toLab(theme.paper)[0];
    EXPECT_GT(std::abs(toLab(theme.ink)[0] - paper), 70.0F) << name;
    EXPECT_GT(std::abs(toLab(theme.softInk)[0] - paper), 50.0F) << name;
  }
}

/// So that a copy of it is a list of all that can be changed.
TEST(Themes, FileOfPaperStatesEveryKey) {
  const fs::path paper = fs::path(BURNISH_SOURCE_DIR) / "postproc/draw/page/themes/paper.yaml";
  std::ifstream stream(paper);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (const char* key : {"paper", "ink", "soft_ink", "outline", "undeformed", "knots", "tool", "control_net",
                          "font", "text_size", "picture", "  colormap", "  bands", "  isolines", "  knots",
                          "  undeformed", "  tools", "  doubt_marks"})
    EXPECT_THAT(text, HasSubstr("\n" + std::string(key) + ":")) << key;
  EXPECT_EQ(readTheme(paper), Theme{});
}

TEST(Fonts, AreFamiliesOrFiles) {
  const Font& font = fontNamed(kDefaultFont);
  EXPECT_EQ(fs::path(font.file).filename(), "DejaVuSans.ttf");
  EXPECT_NEAR(font.capitals, 0.729, 1e-3);
  EXPECT_NEAR(font.descent, 0.236, 1e-3);
  EXPECT_EQ(fontNamed(font.file).capitals, font.capitals);
  EXPECT_EQ(fontNamed("dejavu serif").file, fontNamed("DejaVu Serif").file);
}

TEST(Fonts, MistakesAreTold) {
  EXPECT_THAT(messageOf([] { fontNamed("DejaVu San"); }), HasSubstr("Did you mean \"DejaVu Sans\"?"));
  EXPECT_THAT(messageOf([] { fontNamed("No Such Family"); }),
              HasSubstr("expected a family that is installed"));
  EXPECT_THAT(messageOf([] { fontNamed("/nowhere/a.ttf"); }), HasSubstr("/nowhere/a.ttf"));
  EXPECT_THAT(messageOf([] { fontNamed(BURNISH_SOURCE_DIR "/README.md"); }), HasSubstr("is not a font"));
}

TEST(Fonts, LettersThatOneLacksComeFromTheDefault) {
  const Font& own = fontNamed("DejaVu Serif");
  const Font& other = fontNamed(kDefaultFont);
  const std::string circumflex = "\xCD\x82";  // U+0342, which stands over the letter before it
  const auto pieces = fontPieces("strain ε" + circumflex + "ℓ in ε", "DejaVu Serif");
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[0].text, "strain ");
  EXPECT_EQ(pieces[1].text, "ε" + circumflex + "ℓ");
  EXPECT_EQ(pieces[2].text, " in ε");
  EXPECT_EQ(pieces[0].font, &own);
  EXPECT_EQ(pieces[1].font, &other);
  EXPECT_EQ(pieces[2].font, &own);
  EXPECT_EQ(fontPieces("strain ε" + circumflex, kDefaultFont).size(), 1U);
}

TEST(Fonts, LettersThatNoneHasAreBoxesAndWorthAWarning) {
  takeWarnings();
  for (const char* font : {kDefaultFont, "DejaVu Serif"}) {
    const auto pieces = fontPieces(
        "a\U0010FFFC\x01"
        "b\xCC\x81\n",
        font);
    std::string drawn;
    for (const FontPiece& piece : pieces) drawn += piece.text;
    EXPECT_EQ(drawn, "a□□b\xCC\x81 ");
    EXPECT_GT(textWidth({{"漢漢漢"}}, {.size = 20.0, .font = font}), 30.0);
    noteDrawnText("a\U0010FFFD\U0010FFFC", font);
    noteDrawnText("a\U0010FFFD\U0010FFFC", font);
    noteDrawnText("abc ε̄", font);
  }
  EXPECT_THAT(
      takeWarnings(),
      ElementsAre(
          "neither the font DejaVu Sans nor another one has U+10FFFC, U+10FFFD; \"a\U0010FFFD\U0010FFFC\" is drawn with a box for "
          "each",
          "neither the font DejaVu Serif nor DejaVu Sans nor another one has U+10FFFC, U+10FFFD; "
          "\"a\U0010FFFD\U0010FFFC\" is drawn with a box for each"));
  EXPECT_THAT(takeWarnings(), testing::IsEmpty());
}

/// Marks over a letter stand where those of small letters do.
TEST(Fonts, SymbolsOfFieldsHaveNoMarksOverCapitals) {
  for (const FieldKind& field : materialFields())
    for (std::size_t k = 0; k + 1 < field.symbol.size(); ++k)
      EXPECT_FALSE(field.symbol[k] >= 'A' && field.symbol[k] <= 'Z' &&
                   (field.symbol[k + 1] == '\xCC' || field.symbol[k + 1] == '\xCD'))
          << field.name << ": " << field.symbol;
}

/// Hebrew is turned, Arabic has the forms of its letters in a word, numbers and Latin between them stay as they are.
TEST(Fonts, ScriptsFromRightToLeftAreSetAsTheyAreRead) {
  const auto drawn = [](const std::string& text) {
    std::string set, written;
    for (const FontPiece& piece : fontPieces(text, kDefaultFont)) {
      set += piece.text;
      written += piece.letters;
    }
    EXPECT_EQ(written, text);
    return set;
  };
  EXPECT_EQ(drawn("שלום"), "םולש");
  EXPECT_EQ(drawn("t = 12 (שלום)"), "t = 12 (םולש)");
  EXPECT_EQ(drawn("قوة"), "\uFE93\uFEEE\uFED7");  // of a word's end, middle and beginning, from the left
  EXPECT_EQ(drawn("Größe Ω"), "Größe Ω");
}

/// "ki": the sign of the vowel is written behind the consonant and stands before it. "kṣa": two consonants and the sign that
/// joins them are one glyph.
TEST(Fonts, LettersOfIndicScriptsJoinAndChangeTheirOrder) {
  takeWarnings();
  const auto pieces = fontPieces("F कि N", kDefaultFont);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[1].letters, "कि");
  EXPECT_EQ(pieces[1].font->family, "Lohit Devanagari");
  const auto& [glyphs, length] = pieces[1].shaped;
  ASSERT_EQ(glyphs.size(), 2U);
  const auto soloOf = [](const std::string& letter) {
    return fontPieces(letter, kDefaultFont).front().shaped;
  };
  EXPECT_EQ(glyphs[1].index, soloOf("क").glyphs.front().index);
  EXPECT_GT(glyphs[1].at.x(), 0.0);
  EXPECT_EQ(glyphs[0].letter, glyphs[1].letter);
  EXPECT_NEAR(length, glyphs[1].at.x() + soloOf("क").length, 1e-12);

  const ShapedText joined = soloOf("क्ष");
  EXPECT_EQ(joined.glyphs.size(), 1U);
  for (const auto& [size, drawn] : {std::pair{20.0, 20.0}, {15.3, 15.5}})  // in halves of pixels
    EXPECT_NEAR(textWidth({{"क्ष"}}, {.size = size}), drawn * joined.length, 1e-12);
  const std::size_t apart = soloOf("क्\u200Cष").glyphs.size();  // by a sign between them
  EXPECT_GE(apart, 3U);
  EXPECT_EQ(fontPieces("שלום क्\u200Cष", kDefaultFont).front().shaped.glyphs.size(), apart);
  for (const std::string text : {"कि", "Größe Ω שלום"}) noteDrawnText(text, kDefaultFont);
  EXPECT_THAT(takeWarnings(), testing::IsEmpty());
}

/// "nam": the sign is the mark over the consonant and the long vowel; the tone, which is written first, stands over the mark.
TEST(Fonts, MarksOfLaoAndThaiStandOverOneAnother) {
  const FontPiece word = fontPieces("ນ້ຳ", kDefaultFont).front();
  EXPECT_EQ(word.font->family, kDefaultFont);
  const auto& glyphs = word.shaped.glyphs;
  ASSERT_EQ(glyphs.size(), 4U);
  EXPECT_EQ(glyphs[1].index, fontPieces("ໍ", kDefaultFont).front().shaped.glyphs.back().index);
  EXPECT_EQ(glyphs[2].index, fontPieces("້", kDefaultFont).front().shaped.glyphs.back().index);
  EXPECT_NEAR(glyphs[1].at.x(), glyphs[2].at.x(), 1e-12);
  EXPECT_NEAR(glyphs[3].at.x(), fontPieces("ນ", kDefaultFont).front().shaped.length, 1e-12);
  EXPECT_EQ(fontPieces("ກ\u0E01", kDefaultFont).front().letters, "ກ") << "two scripts make two words";
}

TEST(Fonts, WordsThatNoFontHasWholeAreToldOf) {
  takeWarnings();
  noteDrawnText("क\u0358", kDefaultFont);  // a mark of Latin letters over one of Devanagari
  EXPECT_THAT(takeWarnings(), ElementsAre(HasSubstr("set one by one: no font has all of them")));
  EXPECT_EQ(fontPieces("क\u0B95", kDefaultFont).front().text, "क") << "two scripts make two words";
}

/// The same in pixels: the line that joins letters is one, without gaps.
TEST(Fonts, GlyphsArePaintedWhereTheyBelong) {
  const FontPiece word = fontPieces("किताब", kDefaultFont).front();
  const auto covered = [&](bool upwards) {
    const auto [pixels, corner] = glyphPicture(word.shaped, word.font->file, 40, {10, 20, 30}, upwards);
    const int* size = pixels->GetDimensions();
    Eigen::MatrixXd cover(size[0], size[1]);
    for (int x = 0; x < size[0]; ++x)
      for (int y = 0; y < size[1]; ++y) {
        const auto* pixel = static_cast<const unsigned char*>(pixels->GetScalarPointer(x, y, 0));
        EXPECT_EQ(pixel[2], 30);
        cover(x, y) = pixel[3] / 255.0;
      }
    return std::pair{cover, corner};
  };
  const auto [level, corner] = covered(false);
  EXPECT_NEAR(static_cast<double>(level.rows()), 40 * word.shaped.length, 8.0);
  Eigen::Index fullest = 0;
  level.colwise().sum().maxCoeff(&fullest);
  EXPECT_GT(level.col(fullest).segment(4, level.rows() - 8).minCoeff(), 0.9);

  const auto [turned, turnedCorner] = covered(true);
  ASSERT_EQ(turned.rows(), level.cols());
  EXPECT_EQ(turned, level.rowwise().reverse().transpose());
  EXPECT_EQ(turnedCorner.y(), corner.x());
  EXPECT_EQ(turnedCorner.x(), -(corner.y() + static_cast<double>(level.cols())));
}

TEST(FittedTexts, OfAnyLengthAreCutAfterTheLastLetterThatFits) {
  const TextStyle style{.size = 20.0};
  for (const std::string letter : {"x", "ε̄", "漢", "ש"}) {
    std::string line;
    for (int k = 0; k < 5000; ++k) line += letter;
    const FittedText fitted = fitText({{line}, {"after", Script::Super}}, style, 300.0, 10.0);
    ASSERT_EQ(fitted.text.size(), 2U);
    EXPECT_EQ(fitted.style.size, 10.0);
    EXPECT_EQ(fitted.text[1].text, "…");
    EXPECT_LE(textWidth(fitted.text, fitted.style), 300.0);
    RichText longer = fitted.text;
    longer[0].text += letter;
    EXPECT_GT(textWidth(longer, fitted.style), 300.0) << letter;
  }
}

TEST(Fonts, LettersThatNoneHasAndBrokenTextDoNoHarm) {
  for (const char* text : {"漢字", "قوة", "\xF0\x9F\x98\x80", "\xFF", "a\xE2\x82", "\xCC\x84"})
    for (const char* font : {kDefaultFont, "DejaVu Serif"})
      EXPECT_GE(textWidth({{text}}, {.size = 20.0, .font = font}), 0.0) << text;
}

}  // namespace
}  // namespace burnish
