#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/chart/chart_difference.h"
#include "postproc/draw/chart/chart_layout.h"
#include "postproc/draw/chart/chart_scale.h"
#include "postproc/draw/chart/chart_sketch.h"
#include "postproc/study/evidence/expression.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void expectError(const std::function<void()>& action, const std::vector<std::string>& parts) {
  try {
    action();
    ADD_FAILURE() << "no error; expected: " << parts.front();
  } catch (const Error& error) {
    for (const std::string& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

Chart chartOf(std::vector<double> x, std::vector<double> y) {
  Chart chart;
  chart.x.title = "x";
  chart.y.title = "y";
  chart.curves = {{"curve", std::move(x), std::move(y), {}}};
  return chart;
}

ChartScale scaleOf(const ChartAxis& axis, const std::array<double, 2>& data) {
  return makeChartScale(axis, data, false, [](const ChartScale&) { return true; });
}

TEST(ChartScale, ReachesToRoundValuesAroundTheData) {
  const ChartScale scale = scaleOf({}, {0.013, 1.93});
  EXPECT_EQ(scale.range, (std::array{0.0, 2.0}));
  EXPECT_THAT(scale.labels, ElementsAre("0.0", "0.5", "1.0", "1.5", "2.0"));
  EXPECT_EQ(scale.factor, "");
  EXPECT_DOUBLE_EQ(scale.share(0.5), 0.25);
}

TEST(ChartScale, GivesDataThatHardlyCrossZeroNoInterval) {
  const ChartScale scale = scaleOf({}, {-0.004, 0.58});
  EXPECT_THAT(scale.range, ElementsAre(DoubleNear(-0.005, 1e-12), DoubleNear(0.6, 1e-12)));
  EXPECT_THAT(scale.labels, ElementsAre("0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6"));
  EXPECT_THAT(scaleOf({}, {-0.58, 0.004}).range,
              ElementsAre(DoubleNear(-0.6, 1e-12), DoubleNear(0.005, 1e-12)));
  EXPECT_THAT(scaleOf({}, {-0.006, 0.58}).range,
              ElementsAre(DoubleNear(-0.1, 1e-12), DoubleNear(0.6, 1e-12)));
}

TEST(ChartScale, TakesAPowerOfTenOutOfSmallAndLargeValues) {
  const ChartScale small = scaleOf({}, {0.0017, 0.00184});
  EXPECT_EQ(small.factor, "×10⁻³");
  EXPECT_THAT(small.labels, ElementsAre("1.700", "1.725", "1.750", "1.775", "1.800", "1.825", "1.850"));
  EXPECT_NEAR(small.ticks[1], 0.001725, 1e-15);
  EXPECT_EQ(scaleOf({}, {0.0, 2.9e7}).factor, "×10⁶");
}

TEST(ChartScale, LabelsDifferHoweverLittleTheDataVary) {
  for (const double magnitude : {0.0, 1e-12, 1.0, 1e6})
    for (const double variation : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 0.1}) {
      const ChartScale scale = scaleOf({}, {magnitude, magnitude * (1.0 + variation)});
      const std::set<std::string> different(scale.labels.begin(), scale.labels.end());
      EXPECT_EQ(different.size(), scale.labels.size()) << magnitude << " " << variation;
      EXPECT_GE(scale.labels.size(), 3U) << magnitude << " " << variation;
      EXPECT_GE(scale.share(magnitude), -1e-6);  // within the range up to round-off
      EXPECT_LE(scale.share(magnitude * (1.0 + variation)), 1.0 + 1e-6);
    }
}

TEST(ChartScale, LeavesWhatCannotBeSeenBeyondATick) {
  for (const double excess : {1e-12, 1e-9, 1e-6}) {
    const ChartScale scale = scaleOf({}, {-excess, 1.0 + excess});
    EXPECT_THAT(scale.labels, ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0")) << excess;
    EXPECT_EQ(scale.range, (std::array{-excess, 1.0 + excess})) << "all points are in the plot";
  }
  EXPECT_EQ(scaleOf({}, {0.0, 1.001}).labels.back(), "1.2");
}

/// As of time stamps; a constant that is rounded stays flat.
TEST(ChartScale, LabelsOfNarrowRangesCountFromANumberNearThem) {
  const ChartScale times = scaleOf({}, {1600000003.0, 1600000008.0});
  EXPECT_EQ(times.factor, "+ 1.6×10⁹");
  EXPECT_THAT(times.labels, ElementsAre("3", "4", "5", "6", "7", "8"));
  EXPECT_DOUBLE_EQ(times.ticks[1], 1600000004.0);
  EXPECT_EQ(times.range, (std::array{1600000003.0, 1600000008.0}));
  const ChartScale wave = scaleOf({}, {1.0 - 1e-9, 1.0 + 1e-9});
  EXPECT_EQ(wave.factor, "×10⁻⁹ + 1");
  EXPECT_THAT(wave.labels, ElementsAre("−1.0", "−0.5", "0.0", "0.5", "1.0"));
  EXPECT_NEAR(wave.share(1.0), 0.5, 1e-6);
  EXPECT_EQ(scaleOf({}, {-1.0 - 1e-9, -1.0 + 1e-9}).factor, "×10⁻⁹ − 1");
  EXPECT_EQ(scaleOf({.title = "", .logarithmic = false, .range = {{1e6, 1e6 + 1.0}}}, {0.0, 1.0}).factor,
            "+ 1×10⁶");
  const ChartScale rounded = scaleOf({}, {1.0 - 1e-13, 1.0 + 1e-12});
  EXPECT_EQ(rounded.factor, "");
  EXPECT_NEAR(rounded.range[1] - rounded.range[0], 0.2, 0.05);
}

TEST(ChartLayout, UnitsOfLongTitlesStay) {
  Chart chart = chartOf({0, 1}, {0, 1});
  chart.x.title = "Distance along a line which has such a long name that there is no room for all of it [mm]";
  chart.y.title = "A quantity which has such a long name that there is no room for all of it in N/mm";
  const ChartLayout layout = layOutChart(chart);
  const auto textOf = [](const FittedText& title) {
    std::string text;
    for (const TextRun& run : title.text) text += run.text;
    return text;
  };
  EXPECT_THAT(textOf(layout.xTitle),
              testing::AllOf(testing::StartsWith("Distance along"), testing::EndsWith("… [mm]")));
  EXPECT_THAT(textOf(layout.yTitle),
              testing::AllOf(testing::StartsWith("A quantity"), testing::EndsWith("… in N/mm")));
  EXPECT_LE(textWidth(layout.yTitle.text, layout.yTitle.style), chart.size[1]);
}

TEST(ChartScale, LogarithmicScaleHasDecadesOrRoundValues) {
  const ChartAxis axis{.title = "", .logarithmic = true, .range = {}};
  const ChartScale decades = scaleOf(axis, {3e-5, 0.04});
  EXPECT_DOUBLE_EQ(decades.range[0], 2e-5);
  EXPECT_DOUBLE_EQ(decades.range[1], 5e-2);
  EXPECT_THAT(decades.labels, ElementsAre("10⁻⁴", "10⁻³", "10⁻²"));
  EXPECT_NEAR(decades.share(1e-3), std::log10(50.0) / std::log10(2500.0), 1e-12);
  const ChartScale narrow = scaleOf(axis, {0.0625, 0.25});
  EXPECT_THAT(narrow.labels, ElementsAre("0.05", "0.1", "0.2", "0.5"));
  const ChartScale small = scaleOf(axis, {3e-4, 4e-3});
  EXPECT_THAT(small.labels, ElementsAre("0.2", "0.5", "1", "2", "5"));
  EXPECT_EQ(small.factor, "×10⁻³");
}

TEST(ChartScale, ReachesAcrossAllThatCanBeDrawn) {
  for (const auto& data : std::vector<std::array<double, 2>>{
           {-1e300, 1e300}, {0.0, 1e300}, {0.0, 5e-324}, {1e-300, 1e-290}, {-1e-289, 2e-289}}) {
    const ChartScale scale = scaleOf({}, data);
    EXPECT_GE(scale.ticks.size(), 2U) << data[0];
    EXPECT_LE(scale.range[0], data[0] * (data[0] < 0.0 ? 1.0 - 1e-8 : 1.0));
    EXPECT_GE(scale.range[1], data[1] * (1.0 - 1e-8));
  }
  const ChartScale decades = scaleOf({.title = "", .logarithmic = true, .range = {}}, {1e-290, 1e300});
  EXPECT_NEAR(decades.share(1e-290), 0.0, 1e-12);
  EXPECT_NEAR(decades.share(1e300), 1.0, 1e-12);
  EXPECT_NEAR(decades.share(1e5), 0.5, 1e-12);
}

TEST(ChartScale, KeepsAGivenRange) {
  const ChartScale scale = scaleOf({.title = "", .logarithmic = false, .range = {{-0.3, 0.7}}}, {0.0, 5.0});
  EXPECT_EQ(scale.range, (std::array{-0.3, 0.7}));
  EXPECT_THAT(scale.labels, ElementsAre("−0.2", "0.0", "0.2", "0.4", "0.6"));
}

TEST(ChartScale, LeavesOutLabelsThatDoNotFit) {
  const auto scale =
      makeChartScale({}, {0.0, 1.0}, false, [](const ChartScale& s) { return s.labels.size() <= 3; });
  EXPECT_THAT(scale.labels, ElementsAre("0.0", "0.5", "1.0"));
}

/// Whether a point of a curve or of a segment between two points lies in the box; by samples, to be
/// independent of the code under test.
bool covered(const PixelRect& box, const PlottedCurve& curve) {
  const auto inside = [&](const Eigen::Vector2d& p) {
    return p.x() > box.x && p.x() < box.right() && p.y() > box.y && p.y() < box.top();
  };
  for (const Polyline& piece : curve.pieces)
    for (std::size_t k = 1; k < piece.size(); ++k)
      for (int i = 0; i <= 200; ++i)
        if (inside(piece[k - 1] + i / 200.0 * (piece[k] - piece[k - 1]))) return true;
  return std::any_of(curve.markers.begin(), curve.markers.end(), inside);
}

TEST(ChartLegend, CoversNoCurve) {
  // A stroke across each corner in turn; the last chart has all of them.
  const std::vector<std::vector<double>> xs{{0.7, 1}, {0, 0.3}, {0.7, 1}, {0, 0.3}};
  const std::vector<std::vector<double>> ys{{1, 0.7}, {0.7, 1}, {0, 0.3}, {0.3, 0}};
  Chart chart = chartOf({0, 1}, {0.5, 0.5});
  chart.x.range = chart.y.range = {{0.0, 1.0}};
  for (std::size_t k = 0; k < xs.size(); ++k) {
    chart.curves.push_back({"", xs[k], ys[k], {}});
    const ChartLayout layout = layOutChart(chart);
    EXPECT_TRUE(layout.legendInside);
    for (const PlottedCurve& curve : layout.curves) EXPECT_FALSE(covered(layout.legendBox, curve)) << k;
  }
}

TEST(ChartLegend, StandsBelowThePlotIfNoPlaceInItIsFree) {
  Chart chart;
  chart.x.title = "x";
  for (int c = 0; c < 4; ++c) {
    ChartCurve curve{.label = "a curve", .x = {}, .y = {}, .style = {}};
    for (int k = 0; k <= 200; ++k) {
      curve.x.push_back(k / 200.0);
      curve.y.push_back(k % 2 == 0 ? 1.0 : -1.0);
    }
    chart.curves.push_back(curve);
  }
  const ChartLayout layout = layOutChart(chart);
  EXPECT_FALSE(layout.legendInside);
  EXPECT_LT(layout.legendBox.top(), layout.xTitleAt.y());
  EXPECT_GE(layout.legendBox.y, 0.0);
}

/// Runs that fill the plot from corner to corner.
Chart filledPlot(bool halfOnRight) {
  Chart chart;
  chart.x.title = "time";
  chart.y.title = chart.y2.title = "force";
  for (int c = 0; c < 10; ++c) {
    ChartCurve curve{.label = "run " + std::to_string(c), .x = {}, .y = {}, .style = {}};
    curve.onRight = halfOnRight && c % 2 == 1;
    for (int k = 0; k <= 300; ++k) {
      curve.x.push_back(k / 300.0);
      curve.y.push_back((curve.onRight ? 1e-5 : 1.0) * (c + std::sin(0.05 * (c + 1) * k)));
    }
    chart.curves.push_back(curve);
  }
  return chart;
}

TEST(ChartLegend, LeavesAFullPlotAndAllTexts) {
  for (const bool halfOnRight : {false, true}) {
    for (const std::array<int, 2> size :
         {std::array{1200, 900}, std::array{600, 600}, std::array{900, 500}}) {
      Chart chart = filledPlot(halfOnRight);
      chart.size = size;
      const ChartLayout layout = layOutChart(chart);
      EXPECT_EQ(layout.legend.entries().size(), 10U);
      for (const PlottedCurve& curve : layout.curves) EXPECT_FALSE(covered(layout.legendBox, curve));
      EXPECT_FALSE(layout.legendInside);
      EXPECT_LT(layout.legendBox.top(), layout.xTitleAt.y() - 0.4 * layout.textSize);
      EXPECT_GE(layout.legendBox.x, 0.0);
      EXPECT_GE(layout.legendBox.y, 0.0);
      EXPECT_LE(layout.legendBox.right(), size[0]);
    }
  }
}

TEST(ChartLegend, TellsWhichCurvesBelongToTheRight) {
  Chart chart = chartOf({0, 1}, {0, 1});
  chart.curves.push_back({"a name " + std::string(200, 'x'), {0, 1}, {1, 0}, {}, true});
  const ChartLegend legend(chart, 20.0, 400.0);
  ASSERT_EQ(legend.entries().size(), 2U);
  EXPECT_EQ(legend.entries()[0].label.text.size(), 1U);
  const FittedText& right = legend.entries()[1].label;
  EXPECT_EQ(right.text.back().text, " (right)");
  EXPECT_LE(textWidth(right.text, right.style), 401.0);
}

TEST(ChartRightAxis, HasAScaleOfItsOwn) {
  Chart chart = chartOf({0, 1}, {0, 4});
  chart.curves.push_back({"right", {0, 1, 2}, {1e-6, 1e-4, 1e-2}, {}, true});
  chart.y2 = {.title = "y2", .logarithmic = true, .range = {}};
  const ChartLayout layout = layOutChart(chart);
  ASSERT_TRUE(layout.y2);
  EXPECT_THAT(layout.y2->labels, ElementsAre("10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"));
  EXPECT_THAT(layout.y.labels, ElementsAre("0", "1", "2", "3", "4", "5"));
  const Polyline& piece = layout.curves[1].pieces.front();
  EXPECT_NEAR(piece[1].y(), layout.plot.y + layout.y2->share(1e-4) * layout.plot.height, 1e-9);
  EXPECT_NEAR(piece[1].x(), layout.plot.center().x(), 1e-9);  // x is one axis for all
  EXPECT_LT(layout.plot.right(), layout.y2LabelsStart);
  const double widest = textWidth({{layout.y2->labels.front()}}, {.size = layout.textSize});
  EXPECT_LT(layout.y2LabelsStart + widest, layout.y2TitleAt.x());
  chart.curves.pop_back();
  EXPECT_FALSE(layOutChart(chart).y2);
}

TEST(ChartRightAxis, KeepsItsRange) {
  Chart chart = chartOf({0, 1}, {0, 4});
  chart.curves.push_back({"right", {0, 1}, {0, 100}, {}, true});
  chart.y2.range = {{0.0, 50.0}};
  const ChartLayout layout = layOutChart(chart);
  EXPECT_EQ(layout.y2->range, (std::array{0.0, 50.0}));
  EXPECT_LT((layout.curves[1].pieces.front().back() - layout.pixel(0.5, 50.0, true)).norm(), 1e-6);
}

TEST(ChartLayout, TicksNeverOverlap) {
  for (const std::array<int, 2> size : {std::array{200, 150}, std::array{400, 300}, std::array{300, 1200},
                                        std::array{1200, 900}, std::array{4000, 500}})
    for (const double high : {1.0, 1.0001, 123456.0, 2e-7, 9e12}) {
      Chart chart = chartOf({high == 1.0001 ? 1.0 : 0.0, high}, {high == 1.0001 ? 1.0 : 0.0, high});
      chart.curves[0].label.clear();
      chart.size = size;
      const ChartLayout layout = layOutChart(chart);
      const double text = layout.textSize;
      for (std::size_t k = 1; k < layout.x.ticks.size(); ++k) {
        const auto widthOf = [&](std::size_t i) { return textWidth({{layout.x.labels[i]}}, {.size = text}); };
        const double between =
            layout.pixel(layout.x.ticks[k], high).x() - layout.pixel(layout.x.ticks[k - 1], high).x();
        EXPECT_GT(between, (widthOf(k) + widthOf(k - 1)) / 2) << size[0] << " " << high;
      }
      for (std::size_t k = 1; k < layout.y.ticks.size(); ++k)
        EXPECT_GT(layout.pixel(high, layout.y.ticks[k]).y() - layout.pixel(high, layout.y.ticks[k - 1]).y(),
                  text);
    }
}

TEST(ChartCurves, PointsThatAreNotFiniteInterruptACurve) {
  const ChartLayout layout = layOutChart(chartOf({0, 1, 2, 3, 4, 5}, {0, 1, kNone, 3, kNone, 5}));
  const auto& pieces = layout.curves[0].pieces;
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[0].size(), 2U);
  EXPECT_EQ(pieces[1].size(), 1U);
  EXPECT_LT((pieces[1][0] - layout.pixel(3, 3)).norm(), 1e-9);
}

TEST(ChartCurves, EndAtTheFrameOfAGivenRange) {
  Chart chart = chartOf({0, 4}, {0, 4});
  chart.x.range = {{1.0, 2.0}};
  chart.y.range = {{0.0, 4.0}};
  const ChartLayout layout = layOutChart(chart);
  ASSERT_EQ(layout.curves[0].pieces.size(), 1U);
  EXPECT_LT((layout.curves[0].pieces[0].front() - layout.pixel(1, 1)).norm(), 1e-6);
  EXPECT_LT((layout.curves[0].pieces[0].back() - layout.pixel(2, 2)).norm(), 1e-6);
  EXPECT_TRUE(layout.curves[0].markers.empty());
}

TEST(ChartCurves, ManyPointsGetFewMarkersThatDoNotHideEachOther) {
  Chart chart;
  for (int c = 0; c < 6; ++c) {
    ChartCurve curve{.label = "c", .x = {}, .y = {}, .style = {}};
    for (int k = 0; k < 5000; ++k) {
      curve.x.push_back(k / 5000.0);
      curve.y.push_back(std::sin(k / 5000.0));
    }
    chart.curves.push_back(curve);
  }
  const ChartLayout layout = layOutChart(chart);
  Polyline all;
  for (const PlottedCurve& curve : layout.curves) {
    EXPECT_GE(curve.markers.size(), 8U);
    EXPECT_LE(curve.markers.size(), 12U);
    all.insert(all.end(), curve.markers.begin(), curve.markers.end());
  }
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT((all[a] - all[b]).norm(), 0.48 * layout.textSize);
}

TEST(ChartCurves, ManyPointsAreThinnedOutToThoseThatMakeThePicture) {
  constexpr int count = 200000;
  Chart chart = chartOf({}, {});
  for (int k = 0; k < count; ++k) {
    chart.curves[0].x.push_back(k);
    chart.curves[0].y.push_back(std::sin(1e-4 * k) + (k % 7 == 0 ? 0.5 : -0.25) * std::sin(12.9898 * k));
  }
  chart.curves[0].y[77777] = 9.0;
  const ChartLayout layout = layOutChart(chart);
  ASSERT_EQ(layout.curves[0].pieces.size(), 1U);
  const Polyline& kept = layout.curves[0].pieces[0];
  EXPECT_LE(kept.size(), 4 * (layout.plot.width + 1));
  std::map<double, std::array<double, 2>> drawn;  // extremes by column
  for (const Eigen::Vector2d& p : kept) {
    const auto [entry, isNew] = drawn.try_emplace(std::floor(p.x()), std::array{p.y(), p.y()});
    entry->second = {std::min(entry->second[0], p.y()), std::max(entry->second[1], p.y())};
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d p = layout.pixel(chart.curves[0].x[k], chart.curves[0].y[k]);
    const auto [low, high] = drawn.at(std::floor(p.x()));
    ASSERT_GE(p.y(), low - 0.25);
    ASSERT_LE(p.y(), high + 0.25);
  }
  EXPECT_EQ(kept.front(), layout.pixel(0, chart.curves[0].y[0]));
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), layout.pixel(77777, 9.0)) != kept.end());
}

TEST(ChartCurves, StretchesThatPassNoNewPixelAreLeftOut) {
  constexpr int count = 100000;
  Chart cloud = chartOf({}, {}), circle = chartOf({}, {});
  for (int k = 0; k < count; ++k) {
    cloud.curves[0].x.push_back(std::fmod(0.6180339887 * k, 1.0));
    cloud.curves[0].y.push_back(std::fmod(0.7548776662 * k, 1.0));
    circle.curves[0].x.push_back(std::cos(2e-3 * k));  // some thirty times
    circle.curves[0].y.push_back(std::sin(2e-3 * k));
  }
  const auto drawn = [](const Chart& chart) {
    const ChartLayout layout = layOutChart(chart);
    std::size_t points = 0;
    for (const Polyline& piece : layout.curves[0].pieces) points += piece.size();
    return points;
  };
  EXPECT_LT(drawn(cloud), count / 4);
  EXPECT_GT(drawn(cloud), 1000U);
  EXPECT_LT(drawn(circle), count / 4);
  EXPECT_GT(layOutChart(circle).curves[0].pieces[0].size(), 2000U) << "the first round is whole";
}

TEST(ChartCurves, ManyLonePointsAndMarkersAreDrawnOnceAtAPlace) {
  constexpr int count = 30000;
  Chart chart = chartOf({}, {});
  for (int k = 0; k < count; ++k) {
    chart.curves[0].x.insert(chart.curves[0].x.end(), {std::fmod(0.1 * k, 10.0), kNone});
    chart.curves[0].y.insert(chart.curves[0].y.end(), {static_cast<double>(k % 3), kNone});
  }
  chart.markers = ChartMarkers::All;
  const PlottedCurve curve = layOutChart(chart).curves[0];
  EXPECT_LE(curve.pieces.size(), 600U);
  EXPECT_GE(curve.pieces.size(), 300U);
  EXPECT_LE(curve.markers.size(), 600U);
  EXPECT_GE(curve.markers.size(), 300U);
}

TEST(ChartCurves, DashesFollowThePattern) {
  const auto parts = dashes({{0, 0}, {4, 0}, {4, 6}}, {3, 2}, 1.0);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_THAT(parts[0], ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 0)));
  EXPECT_THAT(parts[1], ElementsAre(Eigen::Vector2d(4, 0), Eigen::Vector2d(4, 3)));
  EXPECT_THAT(parts[2], ElementsAre(Eigen::Vector2d(4, 5), Eigen::Vector2d(4, 6)));
}

TEST(ChartCurves, TwelveDifferWithoutColours) {
  Chart chart;
  std::set<std::pair<std::vector<double>, int>> looks;
  for (int c = 0; c < 12; ++c) chart.curves.push_back({"", {0, 1}, {0, 1}, {}});
  for (std::size_t c = 0; c < 12; ++c) {
    const CurveStyle style = defaultStyle(chart, c);
    looks.emplace(dashPattern(style), style.marker % 6);
  }
  EXPECT_EQ(looks.size(), 12U);
}

TEST(ChartCurves, MarkersStandWhereTheyAreWanted) {
  Chart chart = chartOf({}, {});
  for (int k = 0; k < 50; ++k) {
    chart.curves[0].x.push_back(k);
    chart.curves[0].y.push_back(k);
  }
  const auto count = [&](ChartMarkers markers) {
    chart.markers = markers;
    return layOutChart(chart).curves[0].markers.size();
  };
  EXPECT_EQ(count(ChartMarkers::Some), 0U);  // a lone curve needs none to be told apart
  EXPECT_EQ(count(ChartMarkers::All), 50U);
  chart.curves.push_back({"other", {0, 1}, {1, 0}, {}});
  EXPECT_EQ(count(ChartMarkers::Some), 9U);
  EXPECT_EQ(count(ChartMarkers::None), 0U);
}

TEST(ChartCurves, MeasuredPointsAreMarkersWithoutALine) {
  Chart chart = chartOf({}, {});
  chart.curves[0].style = CurveStyle{0, 0, 0, false};
  for (int k = 0; k < 50; ++k) {
    chart.curves[0].x.push_back(k);
    chart.curves[0].y.push_back(k);
  }
  const PlottedCurve measured = layOutChart(chart).curves[0];
  EXPECT_EQ(measured.markers.size(), 50U);
  EXPECT_TRUE(measured.pieces.empty());
  chart.curves[0].style->line = true;
  EXPECT_EQ(layOutChart(chart).curves[0].pieces.size(), 1U);
}

TEST(ChartCurves, StandOutFromDarkPaper) {
  const Theme& dark = themeNamed("dark");
  for (int color = 0; color < 7; ++color) {
    const Color c = curveColor({.color = color}, dark);
    EXPECT_GT(0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2], 80.0) << color;
  }
  EXPECT_EQ(curveColor({.color = 2}), (Color{0, 0, 0}));
}

TEST(ChartSketch, HasTheFontOfItsTheme) {
  Chart chart;
  chart.curves = {{"a", {0.0, 1.0}, {0.0, 1.0}, {}}};
  chart.theme.font = "DejaVu Serif";
  const ChartSketch sketch = sketchChart(layOutChart(chart), chart.size, chart.theme);
  int texts = 0;
  for (const auto& shape : sketch.shapes)
    if (const auto* text = std::get_if<SketchText>(&shape)) {
      ++texts;
      EXPECT_EQ(text->style.font, "DejaVu Serif") << text->text;
    }
  EXPECT_GT(texts, 5);
}

TEST(ChartSketch, HasThePaperOfItsTheme) {
  const Chart chart = chartOf({0, 1}, {0, 1});
  const auto bottom = [&](const char* name) {
    const Theme& theme = themeNamed(name);
    const ChartSketch sketch = sketchChart(layOutChart(chart), chart.size, theme);
    EXPECT_EQ(sketch.paper, theme.paper);
    const auto* area = std::get_if<SketchArea>(&sketch.shapes.front());
    return area ? area->color : Color{};
  };
  EXPECT_EQ(bottom("dark"), themeNamed("dark").paper);
  EXPECT_EQ(bottom("paper"), Color{});  // none: it may lie on any paper
}

TEST(ChartDifference, IsInterpolatedWhereBothHaveAValue) {
  const ChartCurve reference{"reference", {0, 1, 2, 3}, {0, 10, 20, -40}, {}};
  const ChartCurve curve{"curve", {-1, 0.25, 1, 2.5, 3 + 1e-12, 4}, {5, 3, 10, -12, -40, 5}, {}};
  const CurveDifference absolute = differenceOf(curve, reference, DifferenceKind::Absolute);
  EXPECT_THAT(absolute.curve.x, ElementsAre(0.25, 1, 2.5, 3 + 1e-12));
  EXPECT_THAT(absolute.curve.y, ElementsAre(0.5, 0, -2, 0));
  EXPECT_EQ(absolute.largest, 2.0);
  EXPECT_EQ(absolute.largestAt, 2.5);
  EXPECT_EQ(absolute.referenceMagnitude, 40.0);
  EXPECT_THAT(differenceOf(curve, reference, DifferenceKind::Relative).curve.y,
              ElementsAre(0.0125, 0, -0.05, 0));
}

TEST(ChartDifference, TakesFallingXAndGaps) {
  const ChartCurve reference{"reference", {3, 2, 1, 0}, {30, kNone, 10, 0}, {}};
  const ChartCurve curve{"curve", {0, 0.5, 1, 1.5, 3}, {1, 5, 10, 15, kNone}, {}};
  const CurveDifference found = differenceOf(curve, reference, DifferenceKind::Absolute);
  EXPECT_THAT(found.curve.x, ElementsAre(0, 0.5, 1));
  EXPECT_THAT(found.curve.y, ElementsAre(1, 0, 0));
}

TEST(ChartDifference, RefusesWhatHasNone) {
  const ChartCurve line{"line", {0, 1, 2}, {0, 1, 2}, {}};
  const auto refuse = [&](const ChartCurve& curve, const ChartCurve& reference, DifferenceKind kind,
                          const std::vector<std::string>& parts) {
    expectError([&] { differenceOf(curve, reference, kind); }, parts);
  };
  const ChartCurve turning{"turning", {0, 2, 1}, {0, 1, 2}, {}}, twice{"twice", {0, 1, 1}, {0, 1, 2}, {}};
  refuse(turning, line, DifferenceKind::Absolute, {"turning: x goes from 2 to 1 at point 3"});
  refuse(line, turning, DifferenceKind::Absolute,
         {"turning: x goes from 2 to 1", "only grows or only falls"});
  refuse(line, twice, DifferenceKind::Absolute, {"twice: x goes from 1 to 1"});
  refuse(line, {"falling", {2, 1, 1}, {0, 1, 2}, {}}, DifferenceKind::Absolute,
         {"falling: x goes from 1 to 1"});
  refuse(line, {"far", {5, 6}, {0, 1}, {}}, DifferenceKind::Absolute,
         {"line: no x at which far has a value"});
  refuse(line, {"zero", {0, 2}, {0, 0}, {}}, DifferenceKind::Relative, {"zero: all values are 0"});
}

TEST(ChartCurves, ColoursDifferInGreyPrint) {
  const auto grey = [](int color) {
    const Color c = curveColor({.color = color});
    return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
  };
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < a; ++b) EXPECT_GT(std::abs(grey(a) - grey(b)), 60.0) << a << " " << b;
}

class ChartFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(dir); }
  void TearDown() override { fs::remove_all(dir); }

  void expectRefused(const Chart& chart, const std::vector<std::string>& parts) const {
    expectError([&] { drawChart(chart, dir / "chart.png"); }, parts);
    EXPECT_TRUE(fs::is_empty(dir));
  }

  std::string contents(const fs::path& file) const {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path dir = fs::temp_directory_path() / ("burnish_chart_" + std::to_string(::getpid()));
};

TEST_F(ChartFiles, DataAreWrittenExactly) {
  Chart chart = chartOf({0.1, 1e-300}, {1.0 / 3.0, -2.0});
  chart.curves.push_back({"a \"b\", c", {7}, {8}, {}});
  chart.curves.push_back({"", {9}, {kNone}, {}});
  writeChartData(chart, dir / "data.csv");
  EXPECT_EQ(contents(dir / "data.csv"),
            "curve x,curve y,\"a \"\"b\"\", c x\",\"a \"\"b\"\", c y\",curve 3 x,curve 3 y\n"
            "0.1,0.3333333333333333,7,8,9,nan\n"
            "1e-300,-2,,,,\n");
  chart.curves = {{"left", {1}, {2}, {}}, {"right", {1}, {3}, {}, true}};
  EXPECT_EQ(chartDataText(chart), "left x,left y,right x2,right y2\n1,2,1,3\n");
}

TEST_F(ChartFiles, MistakesAreRefusedWithTheCurve) {
  expectRefused(Chart{}, {"no point to draw"});
  expectRefused(chartOf({kNone, 1}, {0, kNone}), {"no point to draw"});
  expectRefused(chartOf({0, 1}, {0}), {"\"curve\" has 2 values of x and 1 of y"});
  Chart chart = chartOf({1, 2}, {1, 0});
  chart.y.logarithmic = true;
  expectRefused(chart, {"point 2 of \"curve\" has y = 0", "positive"});
  expectRefused(chartOf({1, 2}, {1, -1e308}), {"point 2 of \"curve\" has y = -1e+308", "up to 1e+300"});
  chart = chartOf({1, 2}, {1, 0});
  chart.x.range = {{-1e308, 1e308}};
  expectRefused(chart, {"range -1e+308, 1e+308 of the x axis", "up to 1e300"});
  chart.x.range = {{2.0, 2.0}};
  expectRefused(chart, {"range 2, 2 of the x axis"});
  chart = chartOf({1, 2}, {1, 2});
  chart.size = {100, 900};
  expectRefused(chart, {"size of 100 x 900", "200 x 150 to 8000 x 8000"});
  chart.curves.push_back({"on the right", {1, 2}, {1, -1}, {}, true});
  chart.size = {400, 300};
  chart.y2.logarithmic = true;
  expectRefused(chart, {"point 2 of \"on the right\" has y = -1"});
  chart.y2 = {.title = "", .logarithmic = false, .range = {{3.0, 2.0}}};
  expectRefused(chart, {"range 3, 2 of the y2 axis"});
  chart.y2 = {};
  chart.size = {200, 150};
  for (int k = 0; k < 30; ++k) chart.curves.push_back({"one more", {0, 1, 0, 1}, {0, 1, 1, 0}, {}});
  expectRefused(chart, {"no room for the curves in 200 x 150"});
}

TEST_F(ChartFiles, OtherEndingsAndPlacesAreRefused) {
  const Chart chart = chartOf({1, 2}, {1, 2});
  expectError([&] { drawChart(chart, dir / "chart.jpg"); }, {"chart.jpg", ".png, .svg or .pdf"});
  for (const char* name : {"absent/chart.png", "absent/chart.svg", "absent/chart.pdf"})
    expectError([&] { drawChart(chart, dir / name); }, {(dir / name).string()});
  EXPECT_TRUE(fs::is_empty(dir));
}

HistoryTable history() {
  return {.path = "history.csv",
          .columns = {"time", "tool.fy", "odd name", "step"},
          .values = {{0.0, 0.5, 1.0}, {10.0, -20.0, 30.0}, {1.0, 2.0, 3.0}, {0.0, 1.0, 2.0}}};
}

TEST(Expression, IsAColumnOrAFormulaInColumns) {
  EXPECT_THAT(evaluate(history(), "tool.fy"), ElementsAre(10.0, -20.0, 30.0));
  EXPECT_THAT(evaluate(history(), "odd name"), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(evaluate(history(), "2.5*abs(tool.fy)-time"), ElementsAre(25.0, 49.5, 74.0));
  EXPECT_THAT(evaluate(history(), "time >= 0.5 && tool.fy > 0"), ElementsAre(0.0, 0.0, 1.0));
  EXPECT_THAT(evaluate(history(), "time != 0.5"), ElementsAre(1.0, 0.0, 1.0));
  EXPECT_THAT(evaluate(history(), "7"), ElementsAre(7.0, 7.0, 7.0));
  EXPECT_FALSE(std::isfinite(evaluate(history(), "1/time")[0]));
}

TEST(Expression, MistakesNameThePlaceAndTheColumns) {
  expectError([] { evaluate(history(), "2*tool.fz"); },
              {"history.csv: formula \"2*tool.fz\", character 3: there is no column \"tool.fz\"",
               "Did you mean \"tool.fy\"?", "The columns are time, tool.fy, odd name, step"});
  expectError([] { evaluate(history(), "time = 0.5"); }, {"character 6", "write == to compare"});
  expectError([] { evaluate(history(), "(time"); }, {"formula \"(time\"", "character 6"});
  expectError([] { evaluate(history(), "time, step"); }, {"character 5", "one value is expected"});
  expectError([] { evaluate(history(), ""); }, {"formula \"\""});
}

}  // namespace
}  // namespace burnish
