#include "postproc/study/figures/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "engine/core/error.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/picture.h"
#include "tests/postproc/study/study_samples.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class StudyFigures : public testing::Test {
 protected:
  /// Draws a figure and returns the names of its files below DIR/figures, all of which exist.
  std::vector<std::string> draw(const std::string& name, decltype(FigureSpec::what) what) {
    study_.spec.figures.push_back({name, "", std::move(what)});
    std::vector<std::string> names;
    for (const fs::path& file : drawFigure(study_, study_.spec.figures.back(), directory_.path())) {
      EXPECT_TRUE(fs::exists(file)) << file;
      names.push_back(file.lexically_relative(figures()).generic_string());
    }
    return names;
  }

  fs::path figures() const { return directory_.path() / "figures"; }
  std::string text(const std::string& name) const { return readText(figures() / name); }

  ScratchDirectory directory_;
  Study study_ = madeUpStudy(directory_.path());
};

HistoryFigure valueChart() {
  HistoryFigure spec;
  spec.runs = {"*-fine"};
  spec.y = "value";
  spec.where = "time >= 1";
  return spec;
}

RefinementFigure lastValueRefined() {
  RefinementFigure spec;
  spec.runs = {"*"};
  spec.refine = "mesh";
  HistoryMeasure last;
  last.y = "value";
  spec.measure = {"last", "last value", last};
  return spec;
}

SheetFigure sheetOfFine() {
  SheetFigure spec;
  spec.runs = {"*-fine"};
  spec.times = {1.0, 2.0};
  spec.panel.field = "plastic_strain";
  spec.panel.size = {320, 200};
  return spec;
}

/// Whether the left part of a picture, with the body but not the colour scale, shows the colour of the
/// largest values of viridis.
bool bodyIsBright(const fs::path& png) {
  const Picture picture = readPicture(png);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width * 6 / 10; ++x)
      if (difference(picture.at({x + 0.5, y + 0.5}), {253, 231, 37}) < 25) return true;
  return false;
}

TEST_F(StudyFigures, SheetsMarkDoubtfulRunsAndShowImages) {
  SheetFigure spec = sheetOfFine();
  draw("sound", spec);  // the other run has stopped: all panels leave room for a mark
  spec.panel.doubtMarks = false;
  draw("bare", spec);
  spec.panel.doubtMarks = true;
  spec.panel.mirror = {{0, 0.0}};
  draw("whole", spec);
  const fs::path run = directory_.path() / "runs/nurbs-fine";
  RunAccount summary = readSummary(run);
  summary.doubts.push_back({.what = "smallest J", .firstTime = 0.5, .steps = 3});
  writeSummary(run, summary);
  draw("marked_whole", spec);
  spec.panel.mirror.clear();
  draw("marked", spec);
  spec.panel.doubtMarks = false;
  draw("unmarked", spec);
  EXPECT_EQ(text("unmarked_a.png"), text("bare_a.png"));
  EXPECT_NE(text("marked_a.png"), text("sound_a.png"));
  EXPECT_EQ(text("marked_b.png"), text("sound_b.png")) << "another run";
  EXPECT_NE(text("whole_a.png"), text("sound_a.png"));
  EXPECT_NE(text("marked_whole_a.png"), text("whole_a.png"));
}

TEST_F(StudyFigures, HistoryChartHasItsDataBesideIt) {
  EXPECT_THAT(draw("value", valueChart()), ElementsAre("value.png", "value.csv"));
  EXPECT_THAT(text("value.csv"), HasSubstr("Lagrange, fine (stopped at t = 1.4) x"));
  EXPECT_THAT(text("value.csv"), HasSubstr("\n1,0.5078125,1,0.5078125\n"));  // the first row at t = 1
}

TEST_F(StudyFigures, ReferenceIsPointsOrAPictureBeside) {
  writeText("x,y\n1.5,0.7\n", directory_.path() / "paper.csv");
  HistoryFigure spec = valueChart();
  spec.reference = "paper.csv";
  draw("points", spec);
  EXPECT_THAT(text("points.csv"), HasSubstr("reference x"));
  EXPECT_THAT(text("points.csv"), HasSubstr("1.5,0.7"));

  fs::copy_file(figures() / "points.png", directory_.path() / "paper.png");
  spec.reference = "paper.png";
  EXPECT_THAT(draw("beside", spec), ElementsAre("beside.png", "beside_ours.png", "beside.csv"));
  EXPECT_GT(readPicture(figures() / "beside.png").width, 2 * 1000);
}

TEST_F(StudyFigures, SurfaceChartShowsTheContactAtEachTime) {
  SurfaceFigure spec;
  spec.runs = {"nurbs-fine", "lagrange-fine"};
  spec.times = {1.0, 2.0};
  EXPECT_THAT(draw("pressure", spec), ElementsAre("pressure.png", "pressure_t1.png", "pressure_t1.csv",
                                                  "pressure_t2.png", "pressure_t2.csv"));
  const std::string second = text("pressure_t2.csv");
  EXPECT_THAT(second, HasSubstr("Lagrange, fine (stopped at t = 1.4)"));
  // Pressure from 1 to 2: the window reaches from about 0.5 to 2.5, the slab from 0 to 3.
  const auto lines = std::count(second.begin(), second.end(), '\n');
  EXPECT_GT(lines, 40 * 2 / 3 - 3);
  EXPECT_LT(lines, 40 * 2 / 3 + 4);
}

TEST_F(StudyFigures, RoughnessHasTheProfileOfEachRunAndTime) {
  RoughnessFigure spec;
  spec.runs = {"nurbs-fine"};
  spec.times = {1.0, 2.0};
  spec.timeLabels = {"before", "after"};
  spec.face.face = "top";
  EXPECT_THAT(draw("r", spec), ElementsAre("r.png", "r.csv"));
  const std::string table = text("r.csv");
  EXPECT_THAT(table, HasSubstr("NURBS, fine, before"));
  EXPECT_THAT(table, HasSubstr("NURBS, fine, after"));
  // A parabola 0.15 deep begins 0.1 above its mean line.
  EXPECT_NEAR(std::stod(table.substr(table.find("\n0,") + 3)), 0.1, 1e-4);
}

TEST_F(StudyFigures, ProbeHasACurveForEachRunAndTime) {
  ProbeFigure spec;
  spec.runs = {"nurbs-fine", "lagrange-fine"};
  spec.times = {1.0, 2.0};
  spec.probe.line = "1.5,0:1.5,0.5";
  spec.probe.points = 2;
  spec.probe.reference = true;
  EXPECT_THAT(draw("strain", spec), ElementsAre("strain.png", "strain.csv"));
  const std::string table = text("strain.csv");
  for (const char* name : {"NURBS, fine, t = 1 distance [mm]", "NURBS, fine, t = 2 plastic_strain",
                           "Lagrange, fine, t = 2 (stopped at t = 1.4) plastic_strain"})
    EXPECT_THAT(table, HasSubstr(name));
  // The strain is the time times y²: a quarter at half the height, twice that at t = 2.
  const std::string last = table.substr(table.rfind("\n0.5,") + 1);
  EXPECT_THAT(last, HasSubstr(",0.5,0.25,0.5,"));
  EXPECT_THAT(last, HasSubstr(",0.5,0.5,0.5,"));
  EXPECT_THAT(last, EndsWith(",0.5,0.35\n"));

  spec.times.clear();
  spec.probe = ProbeSpec();
  spec.probe.point = "1.5,0.5";
  EXPECT_THAT(draw("history", spec), ElementsAre("history.png", "history.csv"));
  EXPECT_THAT(text("history.csv"), AllOf(HasSubstr("\n2,"), EndsWith(",0.5,0.35\n")));
}

TEST_F(StudyFigures, RefinementFindsLimitAndOrder) {
  EXPECT_THAT(draw("error", lastValueRefined()), ElementsAre("error.png", "error.csv"));
  std::vector<double> row;  // of the finest mesh: functions, value, error, order, limits
  std::string line = text("error.csv");
  line = line.substr(line.find("nurbs-fine,") + 11);
  for (std::size_t comma = 0; row.size() < 6; line = line.substr(comma + 1)) {
    row.push_back(std::stod(line));
    comma = line.find_first_of(",\n");
  }
  EXPECT_DOUBLE_EQ(row[0], 256.0);
  EXPECT_NEAR(row[2], 4.0 / 256.0, 1e-9);
  EXPECT_NEAR(row[3], 2.0, 1e-6);  // 4/N = 4 h² with N = h⁻²
  EXPECT_NEAR(row[5], 1.0, 1e-9);
  EXPECT_EQ(text("error.csv").find("lagrange"), std::string::npos);  // stopped: no value, so no point
}

TEST_F(StudyFigures, RefinementThatDoesNotSettleIsRefusedWithItsValues) {
  RefinementFigure spec = lastValueRefined();
  spec.measure.what = SummaryMeasure{"functions"};
  EXPECT_THAT(errorOf([&] { draw("error", spec); }), HasSubstr("figure error: no limit can be extrapolated"));
  EXPECT_THAT(errorOf([&] { draw("error", spec); }), HasSubstr("NURBS: 16, 64, 256"));
}

TEST_F(StudyFigures, SheetHasAPanelForEachRunAndTime) {
  EXPECT_THAT(draw("strain", sheetOfFine()),
              ElementsAre("strain.png", "strain_a.png", "strain_b.png", "strain_c.png", "strain_d.png"));
  EXPECT_EQ(readPicture(figures() / "strain.png").width, 2 * 320);
  EXPECT_EQ(readPicture(figures() / "strain_a.png").width, sheetPanelWidth(2, 2 * 320));
}

TEST_F(StudyFigures, SheetSharesColoursWhereItIsAskedTo) {
  SheetFigure spec = sheetOfFine();
  spec.runs = {"nurbs-fine"};
  draw("panel", spec);  // strains at t = 2 are twice those at t = 1
  EXPECT_TRUE(bodyIsBright(figures() / "panel_a.png"));
  spec.scale = SheetShare::Row;
  draw("row", spec);
  EXPECT_TRUE(bodyIsBright(figures() / "row_a.png"));
  spec.scale = SheetShare::Sheet;
  EXPECT_THAT(draw("sheet", spec), ElementsAre("sheet.png", "sheet_a.png", "sheet_b.png", "sheet_scale.png"));
  EXPECT_FALSE(bodyIsBright(figures() / "sheet_a.png"));
  EXPECT_TRUE(bodyIsBright(figures() / "sheet_b.png"));
}

TEST_F(StudyFigures, SheetZoomsInAtEachTime) {
  SheetFigure spec = sheetOfFine();
  spec.panel.range = {0.0, 1.0};
  draw("whole", spec);
  spec.windows = {{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)},
                  {Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 1)}};
  draw("both", spec);
  spec.windows.clear();
  for (const double left : {0.0, 1.0}) {
    spec.panel.window = {Eigen::Vector2d(left, 0), Eigen::Vector2d(left + 1, 1)};
    draw(left == 0.0 ? "first" : "second", spec);
  }
  EXPECT_EQ(text("both_a.png"), text("first_a.png"));
  EXPECT_EQ(text("both_d.png"), text("second_d.png"));
  EXPECT_NE(text("both_a.png"), text("whole_a.png"));
  EXPECT_NE(text("both_c.png"), text("first_c.png"));
}

/// First and last column of pixels that are not white, left of the colour scale.
std::array<int, 2> widthOfBody(const fs::path& png) {
  const Picture picture = readPicture(png);
  std::array<int, 2> columns{picture.width, -1};
  for (int x = 0; x < picture.width * 6 / 10; ++x)
    for (int y = 0; y < picture.height; ++y)
      if (difference(picture.at({x + 0.5, y + 0.5}), {255, 255, 255}) > 25)
        columns = {std::min(columns[0], x), std::max(columns[1], x)};
  return columns;
}

/// Gives a run three frames of the slab, at times 0, 1 and 2, each of which is what `change` makes of the one before.
void giveSlab(const fs::path& run, const std::function<void(FrameRecord&)>& change) {
  const Sample sample = slab();
  FrameRecord frame = sample.frame;
  const RunAccount summary = readSummary(run);
  ResultWriter result(run, sample.model);
  for (frame.index = 0; frame.index < 3; ++frame.index) {
    frame.time = frame.index;
    change(frame);
    result.append(frame);
  }
  writeSummary(run, summary);
}

TEST_F(StudyFigures, SheetHasOneWindowAndOnePlaceForItsScales) {
  const Eigen::RowVectorXd heights = slab().model.mesh.patches.front().points.row(1);
  giveSlab(directory_.path() / "runs/nurbs-fine", [&](FrameRecord& frame) {
    frame.displacement.row(1) += 0.4 * frame.time * heights;  // grows upwards, and its numbers get longer
    frame.fields["plastic_strain"].values *= 12.34;
  });
  SheetFigure spec = sheetOfFine();
  spec.runs = {"nurbs-fine"};
  spec.panel.tools = false;
  draw("sheet", spec);
  EXPECT_EQ(widthOfBody(figures() / "sheet_a.png"), widthOfBody(figures() / "sheet_b.png"));
  spec.window = SheetShare::Panel;
  draw("panel", spec);
  EXPECT_NE(widthOfBody(figures() / "panel_a.png"), widthOfBody(figures() / "panel_b.png"));
}

/// Values pass the end of the colours in the second panel alone: the first one has room for its arrow beside a high body.
TEST_F(StudyFigures, SheetHasOnePlaceForScalesWithAndWithoutArrows) {
  const Sample sample = slab();
  giveSlab(directory_.path() / "runs/nurbs-fine", [&](FrameRecord& frame) {
    frame.displacement.row(1) = 2.0 * sample.model.mesh.patches.front().points.row(1);
    frame.fields["plastic_strain"].values *= 2.0;
  });
  SheetFigure spec = sheetOfFine();
  spec.runs = {"nurbs-fine"};
  spec.panel.tools = false;
  spec.panel.range = {0.0, 6.0 * sample.frame.fields.at("plastic_strain").values.maxCoeff()};
  for (const SheetShare scale : {SheetShare::Panel, SheetShare::Row}) {
    spec.scale = scale;
    draw("sheet", spec);
    EXPECT_EQ(widthOfBody(figures() / "sheet_a.png"), widthOfBody(figures() / "sheet_b.png"));
  }
}

TEST_F(StudyFigures, SheetTakesWordsForItsCaptionsFromTheRun) {
  SheetFigure spec = sheetOfFine();
  spec.panelCaption = "{letter}) {basis.label}, mesh {mesh}, {time}";
  draw("good", spec);
  spec.panelCaption = "{lettre}";
  EXPECT_THAT(errorOf([&] { draw("bad", spec); }), HasSubstr("lettre"));
}

TEST_F(StudyFigures, SheetsAreTheSameBytesTwice) {
  draw("first", sheetOfFine());
  draw("second", sheetOfFine());
  EXPECT_EQ(text("first.png"), text("second.png"));
}

TEST_F(StudyFigures, FramesThatARunThatCompletedDoesNotHaveAreAnError) {
  SheetFigure spec = sheetOfFine();
  spec.times = {0.7};
  EXPECT_THAT(errorOf([&] { draw("strain", spec); }),
              HasSubstr("figure strain: run nurbs-fine: there is no frame at t = 0.7"));
}

TEST_F(StudyFigures, CompositeDrawsPartsThatAreMissing) {
  draw("value", valueChart());
  fs::remove(figures() / "value.png");
  CompositeFigure spec;
  spec.figures = {"value", "value"};
  spec.captions = {"a)", "b)"};
  EXPECT_THAT(draw("both", spec), ElementsAre("both.png"));
  EXPECT_TRUE(fs::exists(figures() / "value.png"));
  spec.figures = {"both"};
  EXPECT_THAT(errorOf([&] { draw("nested", spec); }), HasSubstr("both is a composite itself"));
}

TEST_F(StudyFigures, FiguresForPrintAreBesideTheirPictures) {
  const auto printed = [&](const std::string& name, decltype(FigureSpec::what) what) {
    study_.spec.figures.push_back({name, "", std::move(what), PictureFormat::Svg, {150}});
    const std::vector<fs::path> files = drawFigure(study_, study_.spec.figures.back(), directory_.path());
    EXPECT_EQ(files.front().filename(), name + ".png");
    EXPECT_EQ(files.back().filename(), name + ".svg");
    return text(name + ".svg");
  };
  EXPECT_THAT(printed("value", valueChart()), AllOf(HasSubstr("width=\"226.772pt\""), HasSubstr(">value<")));
  SheetFigure sheet = sheetOfFine();
  sheet.scale = SheetShare::Sheet;
  EXPECT_THAT(printed("strain", sheet),
              AllOf(HasSubstr("NURBS, fine"), HasSubstr("Equivalent plastic strain")));
  SurfaceFigure surface;
  surface.runs = {"nurbs-fine"};
  surface.times = {1.0, 2.0};
  EXPECT_THAT(printed("surface", surface), HasSubstr(">t = 2<"));
  EXPECT_THAT(printed("order", lastValueRefined()), HasSubstr("number of basis functions"));
  CompositeFigure both;
  both.figures = {"value", "strain"};
  both.captions = {"first", "second"};
  EXPECT_THAT(printed("both", both),
              AllOf(HasSubstr(">first<"), HasSubstr("NURBS, fine"), HasSubstr(">value<")));
}

TEST_F(StudyFigures, AnimationHasAPictureForEveryFrame) {
  AnimationFigure spec;
  spec.runs = {"nurbs-fine"};
  spec.picture.field = "plastic_strain";
  spec.picture.size = {320, 200};
  auto files = draw("movie", spec);
  std::erase(files, "movie_nurbs-fine.mp4");  // only where ffmpeg is installed
  EXPECT_THAT(files, ElementsAre("movie.png", "movie/nurbs-fine/frame_0001.png",
                                 "movie/nurbs-fine/frame_0002.png", "movie/nurbs-fine/frame_0003.png"));
}

TEST_F(StudyFigures, NeedTheRunsThatTheyShowAndCompareWith) {
  const auto names = [&](decltype(FigureSpec::what) what) {
    study_.spec.figures.push_back({"figure", "", std::move(what)});
    std::vector<std::string> all;
    for (const StudyRun* run : runsOf(study_, study_.spec.figures.back())) all.push_back(run->name);
    return all;
  };
  EXPECT_THAT(names(valueChart()), ElementsAre("nurbs-fine", "lagrange-fine"));
  DifferenceMeasure difference;
  difference.other = "nurbs-coarse";
  difference.y = "value";
  RefinementFigure compared = lastValueRefined();
  compared.runs = {"lagrange-*"};
  compared.measure.what = difference;
  EXPECT_THAT(names(compared), ElementsAre("nurbs-coarse", "lagrange-fine"));
  study_.spec.figures = {{"part", "", SetupFigure{"nurbs-middle"}}};
  CompositeFigure composite;
  composite.figures = {"part", "part"};
  EXPECT_THAT(names(composite), ElementsAre("nurbs-middle"));
}

TEST_F(StudyFigures, RunsWithoutResultsAreNamed) {
  fs::remove(directory_.path() / "runs/nurbs-fine/summary.yaml");
  EXPECT_THAT(errorOf([&] { draw("value", valueChart()); }),
              HasSubstr("figure value: run nurbs-fine: there are no results"));
}

}  // namespace
}  // namespace burnish
