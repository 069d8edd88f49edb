#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "postproc/draw/chart/chart.h"
#include "postproc/draw/chart/chart_layout.h"
#include "tests/postproc/picture.h"

/// Charts against pictures that were looked at (images/baseline), and points of curves against the pixels
/// where the axes have them. BURNISH_WRITE_BASELINES=1 in the environment writes the baselines anew.
namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr Color kFrame{60, 60, 60};
constexpr int kColorTolerance = 8;

class ChartImage : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(dir); }
  void TearDown() override { fs::remove_all(dir); }

  Picture drawn(const Chart& chart) const {
    drawChart(chart, dir / "drawn.png");
    return readPicture(dir / "drawn.png");
  }

  void expectBaseline(const Chart& chart, const std::string& name) const {
    drawChart(chart, dir / "drawn.png");
    burnish::expectBaseline(dir / "drawn.png", name);
  }

  std::string bytes(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(dir / name, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path dir = fs::temp_directory_path() / ("burnish_chart_image_" + std::to_string(::getpid()));
};

/// Six curves that nearly coincide, in three colours and two kinds of dashes.
Chart energies() {
  Chart chart;
  chart.x.title = "displacement u in mm";
  chart.y.title = "strain energy ψ̄ in N";
  chart.size = {400, 300};
  for (int c = 0; c < 6; ++c) {
    ChartCurve curve{.label = "degree " + std::to_string(2 + c % 3) + (c < 3 ? ", Lagrange" : ", NURBS"),
                     .x = {},
                     .y = {},
                     .style = CurveStyle{c % 3, c / 3, c}};
    for (int k = 0; k <= 400; ++k) {
      const double u = k / 400.0;
      curve.x.push_back(u);
      curve.y.push_back((1.7 + 0.6 * u * (1 - u) + 0.003 * c + 0.003 * std::sin(120 * u)) * 1e-3);
    }
    chart.curves.push_back(curve);
  }
  return chart;
}

Chart errors() {
  Chart chart;
  chart.x = {.title = "element size h in mm", .logarithmic = true, .range = {}};
  chart.y = {.title = "relative error", .logarithmic = true, .range = {}};
  chart.size = {400, 300};
  chart.curves = {{"degree 2", {0.25, 0.125, 0.0625}, {3e-2, 4e-3, 5e-4}, {}},
                  {"degree 3", {0.25, 0.125, 0.0625}, {1e-2, 6e-4, 4e-5}, {}}};
  return chart;
}

/// Letters of Devanagari, which join, level and upwards.
TEST_F(ChartImage, LettersThatJoin) {
  Chart chart = energies();
  chart.title = "विकृति ऊर्जा";
  chart.y.title = "ऊर्जा ψ̄ [N]";
  for (ChartCurve& curve : chart.curves) curve.label = "क्रम " + curve.label;
  expectBaseline(chart, "chart_devanagari");
}

TEST_F(ChartImage, SixCurvesThatNearlyCoincide) {
  expectBaseline(energies(), "chart_energies");
}

TEST_F(ChartImage, FewPointsOnLogarithmicAxes) {
  expectBaseline(errors(), "chart_errors");
}

TEST_F(ChartImage, TwoAxesOnDarkPaper) {
  Chart chart = errors();
  chart.x.logarithmic = false;
  chart.y2 = {.title = "iterations", .logarithmic = false, .range = {{0.0, 10.0}}};
  chart.curves.push_back({"degree 2", {0.25, 0.125, 0.0625}, {4, 5, 7}, {}, true});
  chart.theme = themeNamed("dark");
  expectBaseline(chart, "chart_two_axes");
}

/// Draws lone points and looks for them where the ticks of the axes, as they are drawn, say that they are:
/// the position follows from ticks found in the picture, not from the layout.
class ChartPositions : public ChartImage {
 protected:
  /// Pixels where ticks stand on the lower (or left) side of the frame, middle of their width, ascending.
  static std::vector<double> ticksOnFrame(const Picture& picture, const ChartLayout& layout, bool along_x) {
    const PixelRect& plot = layout.plot;
    const double inside = 0.24 * layout.textSize;  // longer than a minor tick
    std::vector<double> middles;
    const int length = static_cast<int>(along_x ? plot.width : plot.height);
    int start = -1;
    for (int k = -2; k <= length + 2; ++k) {
      const Eigen::Vector2d at = along_x ? Eigen::Vector2d(plot.x + k + 0.5, plot.y + inside)
                                         : Eigen::Vector2d(plot.x + inside, plot.y + k + 0.5);
      const bool dark = picture.at(at)[0] < 200;
      if (dark && start < 0) start = k;
      if (!dark && start >= 0) {
        middles.push_back((along_x ? plot.x : plot.y) + (start + k) / 2.0);
        start = -1;
      }
    }
    return middles;
  }

  void expectPoint(const Chart& chart, const std::array<double, 2>& share) const {
    const Picture picture = drawn(chart);
    const ChartLayout layout = layOutChart(chart);
    const auto xs = ticksOnFrame(picture, layout, true), ys = ticksOnFrame(picture, layout, false);
    ASSERT_GE(xs.size(), 2U);
    ASSERT_GE(ys.size(), 2U);
    const Eigen::Vector2d at(xs.front() + share[0] * (xs.back() - xs.front()),
                             ys.front() + share[1] * (ys.back() - ys.front()));
    const Color expected = curveColor({.color = 0});
    EXPECT_LE(difference(picture.at(at), expected), kColorTolerance);
    // The middle of what is drawn in this colour lies there too.
    Eigen::Vector2d sum(0, 0);
    int count = 0;
    for (int j = 0; j < picture.height; ++j)
      for (int i = 0; i < picture.width; ++i)
        if (difference(picture.at({i + 0.5, j + 0.5}), expected) <= kColorTolerance) {
          sum += Eigen::Vector2d(i + 0.5, j + 0.5);
          ++count;
        }
    ASSERT_GT(count, 10);
    EXPECT_LT((sum / count - at).norm(), 1.0)
        << "found at " << (sum / count).transpose() << ", expected " << at.transpose();
  }
};

TEST_F(ChartPositions, LinearAxes) {
  Chart chart;
  chart.curves = {{"", {3.2}, {-70.0}, CurveStyle{0, 0, 0}}};
  chart.x.range = {{0.0, 10.0}};
  chart.y.range = {{-100.0, 100.0}};
  for (const std::array<int, 2> size : {std::array{400, 300}, std::array{1200, 900}}) {
    chart.size = size;
    expectPoint(chart, {0.32, 0.15});
  }
}

TEST_F(ChartPositions, LogarithmicAxes) {
  Chart chart;
  chart.curves = {{"", {3e-3}, {20.0}, CurveStyle{0, 0, 0}}};
  chart.x = {.title = "", .logarithmic = true, .range = {{1e-4, 1.0}}};
  chart.y = {.title = "", .logarithmic = true, .range = {{1e-2, 1e3}}};
  expectPoint(chart, {std::log10(30.0) / 4.0, std::log10(2000.0) / 5.0});
}

TEST_F(ChartImage, LargePictureDrawnInStripsIsTheSmallOneMagnified) {
  Chart chart = errors();
  chart.size = {1600, 1200};
  const Picture large = drawn(chart);
  const ChartLayout layout = layOutChart(chart);
  for (int k = 0; k <= 100; ++k)  // a strip that is shifted would interrupt the frame
    EXPECT_LE(
        difference(large.at({layout.plot.x + 0.5, layout.plot.y + k / 100.0 * layout.plot.height}), kFrame),
        kColorTolerance);
}

TEST_F(ChartImage, SameBytesEveryTime) {
  for (const std::string ending : {".png", ".svg", ".pdf"}) {
    drawChart(energies(), dir / ("first" + ending));
    drawChart(errors(), dir / ("between" + ending));
    drawChart(energies(), dir / ("second" + ending));
    EXPECT_GT(bytes("first" + ending).size(), 5000U);
    EXPECT_EQ(bytes("first" + ending), bytes("second" + ending));
  }
}

TEST_F(ChartImage, NothingIsCutOff) {
  for (const std::array<int, 2> size : {std::array{200, 150}, std::array{300, 1000}, std::array{1500, 300}}) {
    Chart chart = energies();
    for (ChartCurve& curve : chart.curves) curve.label.clear();
    chart.title = "A title that is much too long for one line of a small picture and has to end somewhere";
    chart.y.title = "A title of the y axis that is much too long for a low picture";
    chart.size = size;
    const Picture picture = drawn(chart);
    for (int i = 0; i < size[0]; ++i)
      for (const int j : {0, 1, size[1] - 2, size[1] - 1})
        ASSERT_EQ(picture.at({i + 0.5, j + 0.5}), (Color{255, 255, 255})) << i << " " << j;
    for (int j = 0; j < size[1]; ++j)
      for (const int i : {0, 1, size[0] - 2, size[0] - 1})
        ASSERT_EQ(picture.at({i + 0.5, j + 0.5}), (Color{255, 255, 255})) << i << " " << j;
  }
}

}  // namespace
}  // namespace burnish
