#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/draw/setup/setup_loads.h"
#include "postproc/draw/setup/setup_motion.h"
#include "postproc/export/video.h"
#include "tests/message_of.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Linear elements on [0, 1]^Dim, ten narrow ones below 0.1 and a wide one in every direction, with the field
/// `x`, its first coordinate.
template <int Dim>
struct PanelSample {
  ModelRecord model;
  FrameRecord frame;

  explicit PanelSample(const Patch<Dim>& shape) {
    std::vector<double> breakpoints{0.0};
    for (int k = 1; k <= 10; ++k) breakpoints.push_back(0.01 * k);
    breakpoints.push_back(1.0);
    const auto patch = lagrangeInterpolant(shape, 1, std::vector<std::vector<double>>(Dim, breakpoints));
    PatchRecord record;
    for (int d = 0; d < Dim; ++d) record.directions.push_back({BasisFamily::Lagrange, 1, breakpoints});
    record.points = patch.points();
    record.weights = patch.weights();
    for (int a = 0; a < patch.points().cols(); ++a) record.nodes.push_back(a);
    model.dim = Dim;
    model.mesh.numNodes = static_cast<int>(patch.points().cols());
    model.mesh.patches = {record};
    frame.displacement = Eigen::MatrixXd::Zero(Dim, model.mesh.numNodes);
    frame.fields["x"] = {{}, "", patch.points().row(0)};
  }
};

TEST(FieldRange, WithoutClipIsTheSmallestAndTheLargestValue) {
  const PanelSample<2> sample(rectangle({0, 0}, {1, 1}));
  EXPECT_THAT(fieldRange(sample.model, sample.frame, "x", 1), ElementsAre(0.0, 1.0));
  EXPECT_THAT(fieldRange(sample.model, sample.frame, "x", 1, 100.0), ElementsAre(0.0, 1.0));
}

TEST(FieldRange, PercentilesAreThoseOfTheAreaAndNotOfThePoints) {
  const PanelSample<2> sample(rectangle({0, 0}, {1, 1}));
  constexpr int subdivision = 32;
  constexpr double cell = 0.9 / subdivision;
  for (const double percentile : {70.0, 90.0, 99.0}) {
    const auto range = fieldRange(sample.model, sample.frame, "x", subdivision, percentile);
    EXPECT_NEAR(range[1], percentile / 100.0, cell) << percentile;
    EXPECT_NEAR(range[0], 1.0 - percentile / 100.0, cell) << percentile;
  }
}

TEST(FieldRange, PercentilesAreThoseOfTheVolume) {
  const PanelSample<3> sample(box({0, 0, 0}, {1, 1, 1}));
  const auto range = fieldRange(sample.model, sample.frame, "x", 8, 80.0);
  EXPECT_NEAR(range[0], 0.2, 0.9 / 8);
  EXPECT_NEAR(range[1], 0.8, 0.9 / 8);
}

TEST(FieldRange, IsOfTheUndeformedBody) {
  PanelSample<2> sample(rectangle({0, 0}, {1, 1}));
  const auto before = fieldRange(sample.model, sample.frame, "x", 8, 90.0);
  sample.frame.displacement.row(0) = 5.0 * sample.model.mesh.patches.front().points.row(0).cwiseAbs2();
  EXPECT_EQ(fieldRange(sample.model, sample.frame, "x", 8, 90.0), before);
}

TEST(FieldRange, IsTheWholeOneWhereThePercentilesAreTheSame) {
  PanelSample<2> sample(rectangle({0, 0}, {1, 1}));
  sample.frame.fields["x"].values.setZero();
  sample.frame.fields["x"].values(0, 14) = 7.0;  // a node amid the narrow elements
  EXPECT_THAT(fieldRange(sample.model, sample.frame, "x", 1, 99.0), ElementsAre(0.0, 7.0));
}

TEST(FieldRange, RefusesPercentilesAndFieldsThatMeanNothing) {
  PanelSample<2> sample(rectangle({0, 0}, {1, 1}));
  for (const double clip : {50.0, 0.0, 100.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(messageOf([&] { fieldRange(sample.model, sample.frame, "x", 1, clip); }),
                HasSubstr("above 50"))
        << clip;
  sample.frame.fields["x"].values(0, 3) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(messageOf([&] { fieldRange(sample.model, sample.frame, "x", 1); }), HasSubstr("not finite"));
}

TEST(ClipNote, NamesBothPercentiles) {
  EXPECT_EQ(clipNote(99.0, 2), "colours end at the 1st and 99th percentiles of the area");
  EXPECT_EQ(clipNote(98.0, 3), "colours end at the 2nd and 98th percentiles of the volume");
  EXPECT_EQ(clipNote(97.5, 2), "colours end at the 2.5th and 97.5th percentiles of the area");
  EXPECT_EQ(clipNote(88.0, 2), "colours end at the 12th and 88th percentiles of the area");
}

TEST(ColorRange, OfAConstantFieldIsWidened) {
  EXPECT_THAT(widened({0.0, 0.0}), ElementsAre(0.0, 1.0));
  EXPECT_THAT(widened({-2.0, -2.0}), ElementsAre(-2.2, -1.8));
  EXPECT_THAT(widened({1.0, 3.0}), ElementsAre(1.0, 3.0));
}

TEST(Sheet, ColumnsAreAsWideAsTheSheetAllows) {
  for (const int columns : {1, 2, 3, 5}) {
    const int panel = sheetPanelWidth(columns, 1900);
    EXPECT_LE(columns * panel, 1900);
    EXPECT_GE(columns * panel, 1840);
  }
  EXPECT_THAT(messageOf([] { sheetPanelWidth(0, 1900); }), HasSubstr("columns: found 0"));
  EXPECT_THAT(messageOf([] { sheetPanelWidth(20, 1900); }), HasSubstr("width: found 1900 pixels for 20"));
}

TEST(Sheet, TextIsMeasuredInPointsOfAColumnPrinted80MillimetresWide) {
  EXPECT_EQ(sheetTextSize(800), 28.0);  // 8 pt = 2.82 mm, ten pixels per mm
  EXPECT_EQ(sheetTextSize(800, 6.0), 21.0);
}

TEST(Sheet, RefusesNoPanelAndPicturesThatAreNone) {
  const fs::path text = fs::temp_directory_path() / ("burnish_sheet_" + std::to_string(::getpid()) + ".png");
  std::ofstream(text) << "no picture";
  EXPECT_THAT(messageOf([&] { drawSheet({}, 2, 800, text); }), HasSubstr("found no panel"));
  EXPECT_THAT(messageOf([&] { drawSheet({{"/nowhere.png", ""}}, 2, 800, text); }), HasSubstr("/nowhere.png"));
  EXPECT_THAT(messageOf([&] { drawSheet({{text, ""}}, 2, 800, text); }), HasSubstr(text.string()));
  fs::remove(text);
}

TEST(MotionPhases, AreTheStraightPartsUntilTheEnd) {
  MotionSpec motion{{0, 1, 2, 3}, {{0, 0, 2, 2}}, {{0, -0.075, -0.075, 9}}, {}};
  const auto phases = motionPhases(motion, 2.0);
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_LT((phases[0] - Eigen::Vector2d(0, -0.075)).norm(), 1e-15);
  EXPECT_LT((phases[1] - Eigen::Vector2d(2, 0)).norm(), 1e-15);
  EXPECT_LT((motionPhases(motion, 1.5)[1] - Eigen::Vector2d(1, 0)).norm(), 1e-15);
}

TEST(MotionPhases, JoinWhatGoesTheSameWayAndLeaveOutRest) {
  const MotionSpec motion{{0, 1, 2, 3}, {}, {{0, 1, 1, 3}}, {}};
  const auto phases = motionPhases(motion, 3.0);
  ASSERT_EQ(phases.size(), 1U);
  EXPECT_LT((phases[0] - Eigen::Vector2d(0, 3)).norm(), 1e-15);
  EXPECT_TRUE(motionPhases({{0, 1}, {{4, 4}}, {}, {}}, 1.0).empty());
}

TEST(MotionPhases, OfAPrescribedSupportAreThoseOfItsFormulas) {
  SupportSpec support;
  support.prescribe = PrescribedSpec{FormulaText{"a*t*X"}, {}, {}};
  const std::vector<DefinitionSpec> definitions{{"a", {"0.5"}}};
  const auto phases = motionPhases(support, Eigen::Vector2d(3, 1), definitions, 2.0);
  ASSERT_EQ(phases.size(), 1U);
  EXPECT_LT((phases[0] - Eigen::Vector2d(3, 0)).norm(), 1e-15);
  EXPECT_TRUE(motionPhases(support, Eigen::Vector2d(0, 1), definitions, 2.0).empty());
}

/// The top of a body of width 2, at rest.
FaceLine topLine() {
  return {{{0, 1}, {1, 1}, {2, 1}}, {{0, 1}, {0, 1}, {0, 1}}, {1, 1}};
}

TEST(FaceLoad, PressurePushesAgainstTheFaceAndShearGoesAlongIt) {
  LoadSpec load;
  load.pressure = FormulaText{"3"};
  const FaceLoad pressure = faceLoad(load, topLine(), {}, 1.0);
  EXPECT_EQ(pressure.vectors[2], Eigen::Vector2d(0, -3));
  EXPECT_FALSE(pressure.varies);
  load.pressure.reset();
  load.shear = FormulaText{"-2"};
  EXPECT_EQ(faceLoad(load, topLine(), {}, 1.0).vectors[0], Eigen::Vector2d(-2, 0));
}

TEST(FaceLoad, HasItsValueInTheMiddleWhenItIsLargest) {
  LoadSpec load;
  load.traction = {{"X"}, {"0"}};
  load.schedule = Schedule{{0, 1, 2}, {0, 4, 0}};
  const FaceLoad found = faceLoad(load, topLine(), {}, 2.0);
  EXPECT_DOUBLE_EQ(found.middle, 4.0);
  EXPECT_TRUE(found.varies);
  EXPECT_EQ(found.vectors[2], Eigen::Vector2d(8, 0));
}

class Video : public testing::Test {
 protected:
  void SetUp() override {
    dir = fs::temp_directory_path() / ("burnish_video_test_" + std::to_string(::getpid()));
    fs::create_directories(dir);
    for (const char* name : {"a.png", "b.png"}) {
      frames.push_back(dir / name);
      fs::copy_file(fs::path(BURNISH_SOURCE_DIR) / "images" / "baseline" / "slab.png", frames.back());
    }
  }
  void TearDown() override {
    ::setenv("PATH", path.c_str(), 1);
    fs::remove_all(dir);
  }
  std::string path = std::getenv("PATH");
  fs::path dir;
  std::vector<fs::path> frames;
};

TEST_F(Video, IsNotMadeWithoutFfmpeg) {
  ::setenv("PATH", dir.c_str(), 1);
  EXPECT_FALSE(writeVideo(frames, 10.0, dir / "video.mp4"));
  EXPECT_FALSE(fs::exists(dir / "video.mp4"));
}

TEST_F(Video, IsAnMp4File) {
  if (!writeVideo(frames, 10.0, dir / "video.mp4")) GTEST_SKIP() << "ffmpeg is not installed";
  std::string head(8, ' ');
  std::ifstream(dir / "video.mp4", std::ios::binary).read(head.data(), 8);
  EXPECT_EQ(head.substr(4), "ftyp");
  EXPECT_FALSE(fs::exists(dir / "video.mp4.partial"));
}

TEST_F(Video, TellsWhatFfmpegSaid) {
  std::ofstream(dir / "ffmpeg") << "#!/bin/sh\n[ \"$3\" = -encoders ] || { echo it hurts >&2; exit 1; }\n";
  fs::permissions(dir / "ffmpeg", fs::perms::owner_all);
  ::setenv("PATH", dir.c_str(), 1);
  const std::string message = messageOf([&] { writeVideo(frames, 10.0, dir / "video.mp4"); });
  EXPECT_THAT(message, HasSubstr("it hurts"));
  EXPECT_THAT(message, HasSubstr((dir / "video.mp4").string()));
}

TEST_F(Video, RefusesWhatCannotBeShown) {
  EXPECT_THAT(messageOf([&] { writeVideo({}, 10.0, dir / "video.mp4"); }), HasSubstr("no picture"));
  EXPECT_THAT(messageOf([&] { writeVideo(frames, 0.0, dir / "video.mp4"); }), HasSubstr("found 0 pictures"));
  EXPECT_THAT(messageOf([&] { writeVideo({dir / "c.png"}, 10.0, dir / "video.mp4"); }), HasSubstr("c.png"));
}

}  // namespace
}  // namespace burnish
