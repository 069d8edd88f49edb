#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/analysis/build_model.h"
#include "engine/analysis/frames.h"
#include "engine/core/error.h"
#include "engine/results/result_writer.h"
#include "engine/scene/reader.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/draw/setup/setup_figure.h"
#include "tests/engine/scene/scene_samples.h"
#include "tests/postproc/picture.h"
#include "tests/postproc/sample_records.h"

/// Sheets, clipped colours and set-up drawings. A run with BURNISH_WRITE_BASELINES=1 in the environment
/// writes the baselines anew; look at them before they are committed.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;

constexpr Color kPaper{255, 255, 255};

constexpr const char* kIroning = R"(
title: Ironing
units: {length: mm, stress: MPa}
degree: 2
geometry: {shape: rectangle, size: [3.0, 1.0], spans: [6, 3]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {face: bottom, fix: [x, y]}
tools:
  - name: cylinder
    shape: cylinder
    center: [0.5, 1.5]
    radius: 0.5
    motion: {times: [0, 1, 2], x: [0, 0, 2], y: [0, -0.075, -0.075]}
contact:
  - {tool: cylinder, face: top}
steps:
  - {until: 2, count: 20}
)";

constexpr const char* kRing = R"(
title: Ring
degree: 2
geometry: {shape: annulus, inner_radius: 6, outer_radius: 10, opening_angle: 90, spans: [2, 8]}
material: {law: neo-hookean, E: 2.0, nu: 0.4}
supports:
  - {face: bottom, symmetry: true}
  - {face: top, symmetry: true}
loads:
  - {face: left, traction: [0, -0.5]}
tools:
  - name: plate
    shape: plane
    origin: [0, 10]
    normal: [0, -1]
    motion: {times: [0, 1], y: [0, -2]}
contact:
  - {tool: plate, face: right}
steps:
  - {until: 1, count: 20}
)";

constexpr const char* kTwoPatches = R"(
title: Shaft with a collar
kinematics: axisymmetric
degree: 2
units: {length: mm, stress: MPa}
geometry:
  shape: patches
  patches:
    - {name: lower, shape: rectangle, size: [3, 2], spans: [2, 2]}
    - {name: upper, shape: rectangle, origin: [0, 2], size: [3, 1], spans: [2, 2]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports:
  - {patch: lower, face: left, symmetry: true}
  - {patch: upper, face: left, symmetry: true}
  - {patch: lower, face: bottom, symmetry: true}
  - {patch: upper, face: top, part: [0, 0.5], move: {times: [0, 1], y: [0, -0.1]}}
loads:
  - {patch: lower, face: right, pressure: 1 + Y}
  - {patch: lower, body_force: [0, -2]}
steps: [{until: 1, count: 1}]
)";

constexpr const char* kTools = R"(
title: Wheel, punch and support
degree: 2
units: {length: mm, stress: MPa}
geometry: {shape: rectangle, size: [4, 1.6], spans: [4, 2]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports:
  - {face: left, fix: [x, y]}
tools:
  - {name: wheel, shape: cylinder, center: [1, 2.3], radius: 0.7, carry: {y: -3}, motion: {times: [0, 1], angle: [0, -90]}}
  - {name: punch, shape: cylinder, center: [3, 2.1], radius: 0.5, motion: {times: [0, 1], y: [0, -0.4]}}
  - {name: support, shape: cylinder, center: [2, -0.5], radius: 0.5}
contact:
  - {tool: wheel, face: top}
  - {tool: punch, face: top}
  - {tool: support, face: bottom}
steps: [{until: 1, count: 1}]
)";

/// Lines from point to point.
SurfaceMesh polyline(const Eigen::Matrix2Xd& points, bool closed) {
  const auto count = static_cast<int>(points.cols());
  SurfaceMesh mesh;
  mesh.closed = closed;
  mesh.points = Eigen::Matrix3Xd::Zero(3, count);
  mesh.points.topRows<2>() = points;
  mesh.cells.resize(2, closed ? count : count - 1);
  for (int k = 0; k < mesh.cells.cols(); ++k) mesh.cells.col(k) << k, (k + 1) % count;
  return mesh;
}

ModelRecord modelOf(const char* yaml) {
  const Scene scene = parseScene(yaml, "test");
  return makeModelRecord(scene, *buildModel<2>(scene));
}

std::string bytesOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Share of pixels in a rectangle, given by its lower left and upper right corner, that are not white.
double inkIn(const Picture& picture, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  double ink = 0.0, all = 0.0;
  for (double y = low.y() + 0.5; y < high.y(); ++y)
    for (double x = low.x() + 0.5; x < high.x(); ++x, ++all)
      if (picture.at({x, y}) != kPaper) ++ink;
  return ink / all;
}

class SheetImage : public testing::Test {
 protected:
  void SetUp() override {
    dir = fs::temp_directory_path() / ("burnish_sheet_image_" + std::to_string(::getpid()));
    fs::create_directories(dir);
  }
  void TearDown() override { fs::remove_all(dir); }

  static ContourOptions panelOptions(const std::array<int, 2>& size) {
    ContourOptions options;
    options.field = "plastic_strain";
    options.size = size;
    options.title = "";
    options.time = false;
    options.textSize = sheetTextSize(size[0], 7.0);
    return options;
  }

  fs::path contour(const Sample& sample, const ContourOptions& options, const std::string& name) const {
    drawContour(sample.model, sample.frame, options, dir / name);
    return dir / name;
  }

  fs::path dir;
};

/// The slab with a spike of plastic strain at a corner.
Sample spikedSlab() {
  Sample sample = samples::slab();
  sample.frame.fields["plastic_strain"].values(0, 0) = 20.0;
  return sample;
}

TEST_F(SheetImage, TwoPanelsWithCaptions) {
  const int panel = sheetPanelWidth(2, 800);
  ContourOptions options = panelOptions({panel, 220});
  const fs::path left = contour(samples::slab(), options, "left.png");
  options.clip = 98.0;
  const fs::path right = contour(spikedSlab(), options, "right.png");
  drawSheet({{left, "a) as it is, u = 0"},
             {right, "b) colours clipped, under a spike of plastic strain in the corner, in two lines"}},
            2, 800, dir / "sheet.png");
  expectBaseline(dir / "sheet.png", "sheet_clipped");
}

TEST_F(SheetImage, PanelsOfTheRightWidthAreCopied) {
  const int panel = sheetPanelWidth(2, 800);
  const fs::path file = contour(samples::slab(), panelOptions({panel, 200}), "panel.png");
  drawSheet({{file, ""}, {file, ""}, {file, ""}}, 2, 800, dir / "sheet.png");
  const Picture sheet = readPicture(dir / "sheet.png"), one = readPicture(file);
  ASSERT_EQ(sheet.width, 800);
  const int gutter = 400 - panel;
  EXPECT_EQ(sheet.height, 2 * 200 + gutter + 2 * (gutter / 2));
  for (const int column : {0, 1})
    for (int j = 0; j < one.height; ++j)
      for (int i = 0; i < one.width; ++i) {
        const Eigen::Vector2d at(i + 0.5, j + 0.5);
        const Eigen::Vector2d corner(400.0 * column + gutter / 2, sheet.height - gutter / 2 - 200.0);
        ASSERT_EQ(sheet.at(corner + at), one.at(at)) << "column " << column << ", pixel " << at.transpose();
      }
  EXPECT_EQ(inkIn(sheet, {400, 0}, {800, 200}), 0.0) << "the empty place of the fourth panel";
}

TEST_F(SheetImage, OtherPicturesKeepTheirProportionsAndColours) {
  const Sample sample = samples::slab();
  const View view = drawContour(sample.model, sample.frame, panelOptions({1560, 900}), dir / "large.png");
  drawSheet({{dir / "large.png", ""}}, 1, 400, dir / "sheet.png");
  const Picture sheet = readPicture(dir / "sheet.png"), large = readPicture(dir / "large.png");
  const int panel = sheetPanelWidth(1, 400), margin = (400 - panel) / 2;
  EXPECT_NEAR(sheet.height - 2 * margin, 900.0 * panel / 1560.0, 1.0);
  for (const double x : {0.6, 1.2, 2.3}) {
    const Eigen::Vector2d at = view.pixel(Eigen::Vector2d(x, 0.4));
    const Eigen::Vector2d inSheet = at * panel / 1560.0 + Eigen::Vector2d::Constant(margin);
    EXPECT_LE(difference(sheet.at(inSheet), large.at(at)), 6) << "x = " << x;
  }
}

TEST_F(SheetImage, CaptionsStandUnderTheirPanels) {
  const int panel = sheetPanelWidth(2, 800);
  const fs::path file = contour(samples::slab(), panelOptions({panel, 200}), "panel.png");
  drawSheet({{file, "a)"}, {file, ""}}, 2, 800, dir / "sheet.png");
  const Picture sheet = readPicture(dir / "sheet.png");
  const double below = sheet.height - 200.0 - 0.5 * (400 - panel) - 1.0;
  EXPECT_GT(inkIn(sheet, {180, 0}, {220, below}), 0.05);
  EXPECT_EQ(inkIn(sheet, {0, 0}, {170, below}), 0.0);
  EXPECT_EQ(inkIn(sheet, {230, 0}, {800, below}), 0.0);
}

TEST_F(SheetImage, ClippedColoursShowWhatASpikeHides) {
  ContourOptions options = panelOptions({800, 400});
  const Sample sample = spikedSlab();
  const Eigen::Vector2d bright(1.5, 1.0 - 0.15);  // the highest value but for the spike
  const View whole = drawContour(sample.model, sample.frame, options, dir / "whole.png");
  options.clip = 98.0;
  const View clipped = drawContour(sample.model, sample.frame, options, dir / "clipped.png");
  const Color dark{68, 1, 84}, yellow{253, 231, 37};
  EXPECT_LT(
      difference(readPicture(dir / "whole.png").at(whole.pixel(bright - Eigen::Vector2d(0, 0.02))), dark),
      40);
  EXPECT_LT(difference(readPicture(dir / "clipped.png").at(clipped.pixel(bright - Eigen::Vector2d(0, 0.02))),
                       yellow),
            40);
}

TEST_F(SheetImage, RangeAndClipTogetherAreRefused) {
  ContourOptions options = panelOptions({800, 400});
  options.range = {0.0, 1.0};
  options.clip = 99.0;
  EXPECT_THROW(contour(samples::slab(), options, "both.png"), Error);
  EXPECT_FALSE(fs::exists(dir / "both.png"));
}

TEST_F(SheetImage, WithoutTitleAndTimeTheBodyIsLarger) {
  ContourOptions options = panelOptions({800, 400});
  const Sample sample = samples::slab();
  const double bare = drawContour(sample.model, sample.frame, options, dir / "bare.png").pixelsPerLength;
  options.time = true;
  const double timed = drawContour(sample.model, sample.frame, options, dir / "timed.png").pixelsPerLength;
  EXPECT_GT(bare, timed);
}

TEST_F(SheetImage, TenthPictureHasTheBytesOfAFreshProcess) {
  const Sample sample = samples::slab();
  ResultWriter(dir / "result", sample.model).append(sample.frame);
  const std::string fresh = (dir / "fresh.png").string();
  const std::string line = BURNISH_COMMAND " render " + (dir / "result").string() +
                           " --field plastic_strain --size 1600,900 -o " + fresh;
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  ContourOptions options;
  options.field = "plastic_strain";
  for (int k = 0; k < 9; ++k) {
    options.size = {300 + 100 * k, 700 - 50 * k};
    options.bands = k;
    contour(k % 2 == 0 ? samples::slab() : spikedSlab(), options, "other.png");
  }
  options.size = {1600, 900};
  options.bands = 0;
  EXPECT_EQ(bytesOf(contour(sample, options, "tenth.png")), bytesOf(fresh));
}

TEST_F(SheetImage, SetupOfIroning) {
  drawSetup(modelOf(kIroning), {600, 450}, dir / "setup.png");
  expectBaseline(dir / "setup.png", "setup_ironing");
}

TEST_F(SheetImage, SetupOfARingWithLoadRollersAndPlate) {
  drawSetup(modelOf(kRing), {600, 600}, dir / "setup.png", true);
  expectBaseline(dir / "setup.png", "setup_ring");
}

TEST_F(SheetImage, SetupOfAnAxisymmetricBodyOfTwoPatches) {
  drawSetup(modelOf(kTwoPatches), {620, 510}, dir / "setup.png");
  expectBaseline(dir / "setup.png", "setup_two_patches");
}

TEST_F(SheetImage, SetupOfToolsThatCarryTurnAndHaveAnyOutline) {
  ModelRecord model = modelOf(kTools);
  model.tools[1].shape =
      polyline(Eigen::Matrix<double, 2, 5>{{3.0, 3.45, 3.9, 3.9, 3.0}, {1.9, 1.6, 1.9, 3.0, 3.0}}, true);
  model.tools[2].shape =
      polyline(Eigen::Matrix<double, 2, 4>{{30.0, 4.2, -0.2, -30.0}, {2.0, -0.2, -0.2, 2.0}}, false);
  drawSetup(model, {800, 650}, dir / "setup.png");
  expectBaseline(dir / "setup.png", "setup_tools");
}

TEST_F(SheetImage, SetupShowsTheMotionOfAToolUntilItIsTakenAway) {
  const auto setupWith = [&](const std::string& motion) {
    const std::string scene = samples::replaced(
        kIroning, "motion: {times: [0, 1, 2], x: [0, 0, 2], y: [0, -0.075, -0.075]}", motion);
    drawSetup(modelOf(scene.c_str()), {600, 450}, dir / "setup.png");
    return bytesOf(dir / "setup.png");
  };
  const std::string pressed = setupWith("motion: {times: [0, 1], y: [0, -0.075]}");
  EXPECT_EQ(setupWith("motion: {times: [0, 1, 2], x: [0, 0, 6], y: [0, -0.075, 4]}\n    until: 1"), pressed);
  EXPECT_NE(setupWith("motion: {times: [0, 1, 2], x: [0, 0, 6], y: [0, -0.075, 4]}"), pressed);
}

/// Down and up again, and once more: names of the parts do not lie over one another, nor do the arrows.
TEST_F(SheetImage, SetupPutsTheLiftOfAToolBesideItsPress) {
  for (const char* motion : {"motion: {times: [0, 1, 2], y: [0, -0.075, 0.3]}",
                             "motion: {times: [0, 1, 2, 3, 4], y: [0, -0.3, 0, -0.3, 0]}",
                             "motion: {times: [0, 1, 2, 3], x: [0, 0, 2, 2], y: [0, -0.075, -0.075, 0]}"}) {
    const std::string scene = samples::replaced(
        kIroning, "motion: {times: [0, 1, 2], x: [0, 0, 2], y: [0, -0.075, -0.075]}", motion);
    const std::string longer = samples::replaced(scene, "until: 2", "until: 4");
    std::vector<PageText> names;
    for (const PageSketch::Shape& shape : setupPage(modelOf(longer.c_str()), {600, 450}).sketch.shapes)
      if (const auto* text = std::get_if<PageText>(&shape))
        if (text->text.size() == 2 && text->text.front().text == "u") names.push_back(*text);
    EXPECT_GE(names.size(), 2U);
    for (std::size_t k = 0; k < names.size(); ++k)
      for (std::size_t other = 0; other < k; ++other)
        EXPECT_GT((names[k].at - names[other].at).norm(), 1.1 * names[k].style.size)
            << motion << ": u" << other + 1 << ", u" << k + 1;
  }
}

TEST_F(SheetImage, SetupIsNotDrawnInThreeDimensions) {
  EXPECT_THROW(drawSetup(samples::cube().model, {600, 600}, dir / "setup.png"), Error);
  EXPECT_THROW(drawSetup(modelOf(kRing), {600, 100}, dir / "setup.png"), Error);
}

}  // namespace
}  // namespace burnish
