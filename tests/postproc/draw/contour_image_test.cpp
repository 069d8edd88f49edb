#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "engine/results/result_writer.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/shown_model.h"
#include "tests/cli/shell.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Contour pictures against pictures that were looked at (images/baseline) and, since a baseline may be wrong
/// too, against colours that follow from the fields. A run with BURNISH_WRITE_BASELINES=1 in the environment
/// writes the baselines anew; look at them before they are committed.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;

std::string bytesOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

Eigen::Vector2d deformedSlab(double s, double t) {
  return {3.0 * s, t - 0.6 * s * (1.0 - s) * t};
}

TEST_F(ContourPictures, SlabUnderADiscHasTheColoursOfItsField) {
  const Picture picture = expectBaseline(samples::slab(), small("plastic_strain"), "slab");
  const ColorScale scale("viridis", {0.0, 1.0}, 0);
  for (const double s : {0.07, 0.21, 0.36, 0.5, 0.83})
    for (const double t : {0.11, 0.52, 0.93})
      expectColor(picture, deformedSlab(s, t), scale.color(4.0 * s * (1.0 - s) * t * t));
  expectColor(picture, Eigen::Vector2d(1.5, 1.35), {222, 222, 222});  // the middle of the disc
  expectColor(picture, Eigen::Vector2d(0.4, 1.35), {255, 255, 255});
}

TEST_F(ContourPictures, BandsOfARingAreCrispCircles) {
  ContourOptions options = small("von_mises");
  options.bands = 5;
  options.knots = true;
  expectBaseline(samples::ring(), options, "ring_bands");

  options.knots = false;
  options.size = {800, 600};
  const Picture picture = drawn(samples::ring(), options);
  const ColorScale scale("viridis", {0.0, 100.0}, 5);
  const double pixel = 1.0 / view.pixelsPerLength;
  for (const double angle : {0.2, 0.7, 1.3}) {
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    for (int band = 1; band < 5; ++band) {
      const double edge = 1.0 + 0.2 * band;
      expectColor(picture, (edge - 1.5 * pixel) * direction,
                  scale.colors()[static_cast<std::size_t>(band - 1)]);
      expectColor(picture, (edge + 1.5 * pixel) * direction, scale.colors()[static_cast<std::size_t>(band)]);
    }
  }
}

/// Largest difference of two pictures of one size, of what `inside` says of pixels.
int worstDifference(const Picture& a, const Picture& b,
                    const std::function<bool(const Eigen::Vector2d&)>& inside,
                    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& place) {
  int worst = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
      if (inside(pixel)) worst = std::max(worst, difference(a.at(pixel), b.at(place(pixel))));
    }
  return worst;
}

TEST_F(ContourPictures, OfAMirroredProblemAreMirrored) {
  std::ofstream(dir / "press.yaml") << R"(geometry: {shape: rectangle, size: [2, 1], functions: [25, 13]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 10}]
)";
  const Outcome run =
      shell(dir, BURNISH_COMMAND " run press.yaml -o press --set basis=lagrange --set degree=3");
  ASSERT_EQ(run.code, 0) << run.err;
  const ResultReader result(dir / "press");
  ContourOptions options = small("von_mises");
  options.size = {1600, 900};
  const auto worstOf = [&](const ContourOptions& given) {
    const Picture picture = drawn({result.model(), result.frame(result.numFrames() - 1)}, given);
    const Eigen::Vector2d low = view.pixel(Eigen::Vector2d(0.02, 0.02)),
                          high = view.pixel(Eigen::Vector2d(1.98, 0.92));
    const double middle = view.pixel(Eigen::Vector2d(1.0, 0.0)).x();
    const auto isInside = [&](const Eigen::Vector2d& pixel) {
      return (pixel.array() > low.array()).all() && (pixel.array() < high.array()).all();
    };
    return worstDifference(picture, picture, isInside, [&](const Eigen::Vector2d& pixel) {
      return Eigen::Vector2d(2.0 * middle - pixel.x(), pixel.y());
    });
  };
  EXPECT_LE(worstOf(options), 1);
  options.isolines = 7;
  EXPECT_LE(worstOf(options), 1) << "isolines";
  options.isolines = 0;
  options.knots = true;
  EXPECT_LE(worstOf(options), 1) << "knot lines";
  options.knots = false;
  options.arrows = ArrowField::Displacement;
  EXPECT_LE(worstOf(options), 1) << "arrows";
}

TEST_F(ContourPictures, OfABodyFarFromTheOriginAreTheSame) {
  Sample sample = samples::slab();
  const Picture near = drawn(sample, small("plastic_strain"));
  constexpr double kFar = 1024.0;
  sample.model.mesh.patches.front().points.row(0).array() += kFar;
  std::get<Cylinder>(sample.model.tools.front().shape).center.x() += kFar;
  sample.model.tools.front().pivot.x() += kFar;
  const Picture far = drawn(sample, small("plastic_strain"));
  EXPECT_LE(worstDifference(
                near, far, [](const Eigen::Vector2d&) { return true; },
                [](const Eigen::Vector2d& pixel) { return pixel; }),
            1);
}

/// Whatever is written beside them: the largest values 0, 1.23e-5 and 1, arrows or none of them, values beyond the ends of
/// the colours or none of them.
TEST_F(ContourPictures, OfASeriesHaveBodyAndScaleInOnePlace) {
  const Sample sample = samples::slab();
  std::vector<FrameRecord> frames(3, sample.frame);
  frames[0].displacement *= 0.0;
  frames[0].fields["plastic_strain"].values *= 0.0;
  frames[1].fields["plastic_strain"].values *= 1.23e-5;
  for (const std::array<int, 2>& size : {std::array{400, 300}, {400, 800}}) {
    ContourOptions options = small("plastic_strain");
    options.size = size;
    options.time = false;
    options.arrows = ArrowField::Displacement;
    const auto shared = [&](ContourOptions given) {
      shareView(given, {0, 1, 2}, {0, 1, 2}, [&](int k, bool inRange, bool inWindow) {
        return frameView(sample.model, frames[static_cast<std::size_t>(k)], given, inRange, inWindow);
      });
      return given;
    };
    ContourOptions passed = options;
    passed.range = {0.0, 0.5};
    for (const ContourOptions& series : {shared(options), shared(passed)}) {
      std::vector<View> views;
      std::vector<Picture> pictures;
      for (const FrameRecord& frame : frames) {
        pictures.push_back(drawn({sample.model, frame}, series));
        views.push_back(view);
      }
      const auto isColored = [](const Color& color) {
        return std::ranges::max(color) - std::ranges::min(color) > 60;
      };
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(views[k].area, views[2].area) << k;
        EXPECT_EQ(views[k].pixelsPerLength, views[2].pixelsPerLength) << k;
        // Beside the body, or below it, the scale alone is coloured.
        int moved = 0;
        for (int y = 0; y < size[1]; ++y)
          for (int x = 0; x < size[0]; ++x) {
            const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
            if (size[1] < size[0] ? x < view.area.right() + 2.0 : y > view.area.y - 2.0) continue;
            if (isColored(pictures[k].at(pixel)) && isColored(pictures[2].at(pixel))) continue;
            moved += isColored(pictures[k].at(pixel)) != isColored(pictures[2].at(pixel)) ? 1 : 0;
          }
        EXPECT_LE(moved, series.range == passed.range ? 400 : 0) << k << ": more than an arrow";
      }
    }
  }
}

TEST_F(ContourPictures, HaveTheExactColourInEveryPixelAtAnyZoom) {
  Sample sample = samples::slab({2, 1});
  sample.frame.displacement.setZero();
  const ColorScale scale("viridis", {0.0, 1.0}, 0);
  ContourOptions options = small("plastic_strain");
  options.tools = false;
  for (const double size : {1.0, 0.1, 0.01}) {
    const Eigen::Vector2d corner(1.3 - 1.3 * size, 0.9 - 0.9 * size);
    options.window = {corner, corner + size * Eigen::Vector2d(3.0, 1.0)};
    const Picture picture = drawn(sample, options);
    int worst = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
        const Eigen::Vector2d at =
            options.window->center() + (pixel - view.area.center()) / view.pixelsPerLength;
        const double margin = 3.0 / view.pixelsPerLength;
        if (at.x() < margin || at.x() > 3.0 - margin || at.y() < margin || at.y() > 1.0 - margin) continue;
        if ((pixel - view.area.center()).cwiseAbs().x() > view.area.width / 2 - 3) continue;
        if ((pixel - view.area.center()).cwiseAbs().y() > view.area.height / 2 - 3) continue;
        worst = std::max(
            worst, difference(picture.at(pixel),
                              scale.color(4.0 * at.x() / 3.0 * (1.0 - at.x() / 3.0) * at.y() * at.y())));
      }
    EXPECT_LE(worst, 4) << size;  // a step of the colours is up to 3 of 255
  }
}

/// A part of a large picture, and a small picture of this part alone at the same scale.
TEST_F(ContourPictures, ZoomedAreTheSameAsPartsOfLargerOnes) {
  ContourOptions options = small("plastic_strain");
  options.title = "";
  options.time = options.colorScale = options.tools = options.undeformed = false;
  options.knots = true;
  options.textSize = 12.0;
  options.range = {0.0, 1.0};
  options.size = {3200, 1600};
  const Picture whole = drawn(samples::slab({2, 1}), options);
  const View wholeView = view;
  const double margin = options.size[0] - 3.0 * view.pixelsPerLength;  // it is as wide as the body

  options.size = {600, 400};
  const Eigen::Vector2d half((options.size[0] - margin) / (2.0 * view.pixelsPerLength), 0.1);
  const auto shiftAt = [&](const Eigen::Vector2d& middle) {  // from a pixel of the part to that of the whole
    options.window = {middle - half, middle + half};
    drawn(samples::slab({2, 1}), options);
    return Eigen::Vector2d(wholeView.pixel(middle) - view.pixel(middle));
  };
  Eigen::Vector2d middle(0.9, 0.5);
  const Eigen::Vector2d shift = shiftAt(middle).array().floor();
  middle += (shift - shiftAt(middle)) / wholeView.pixelsPerLength;
  ASSERT_LT((shiftAt(middle) - shift).norm(), 1e-6);
  ASSERT_NEAR(view.pixelsPerLength, wholeView.pixelsPerLength, 1e-9);
  const Picture part = drawn(samples::slab({2, 1}), options);
  const auto isWithin = [&](const Eigen::Vector2d& pixel) {
    return ((pixel - view.area.center()).cwiseAbs().array() <
            Eigen::Array2d(view.area.width, view.area.height) / 2.0 - 2.0)
        .all();
  };
  // A step of the colours is up to 3 of 255, and the steps may lie a pixel aside.
  EXPECT_LE(worstDifference(part, whole, isWithin,
                            [&](const Eigen::Vector2d& pixel) { return Eigen::Vector2d(pixel + shift); }),
            3);
}

TEST_F(ContourPictures, ShearedSquareOfLagrangeElementsUnderAPlate) {
  ContourOptions options = small("pressure");
  options.colormap = "coolwarm";
  options.range = {-1e-5, 1e-5};
  const Picture picture = expectBaseline(samples::square(), options, "square_plate");
  const ColorScale scale("coolwarm", *options.range, 0);
  for (const double x : {0.15, 0.6, 0.9})
    for (const double y : {0.1, 0.45, 0.85})
      expectColor(picture, Eigen::Vector2d(x + 0.2 * y, y), scale.color(1e-5 * (x * x * x - y)));
}

TEST_F(ContourPictures, ComponentOfATensorIsDrawnByName) {
  const Picture picture = drawn(samples::square(), small("stress.xx"));
  const ColorScale scale("viridis", {-1e5, 0.0}, 0);
  expectColor(picture, Eigen::Vector2d(0.3 + 0.2 * 0.4, 0.4), scale.color(-0.3e5));
}

TEST_F(ContourPictures, FieldOfBothSignsHasTheMiddleOfItsColoursAtZero) {
  Sample sample = samples::square();
  sample.frame.fields["stress"].values.array() += 0.25e5;  // xx from -0.75e5 to 0.25e5
  const Picture picture = drawn(sample, small("stress.xx"));
  const ColorScale symmetric("coolwarm", {-0.75e5, 0.75e5}, 0);
  for (const double x : {0.1, 0.25, 0.5, 0.9})
    expectColor(picture, Eigen::Vector2d(x + 0.2 * 0.4, 0.4), symmetric.color(0.25e5 - 1e5 * x));
}

TEST_F(ContourPictures, StressBeforeAnythingIsLoadedHasTheColourOfZero) {
  Sample sample = samples::square();
  sample.frame.fields["stress"].values.setZero();
  expectColor(drawn(sample, small("stress.xx")), Eigen::Vector2d(0.3 + 0.2 * 0.4, 0.4),
              ColorScale("coolwarm", {-1.0, 1.0}, 0).color(0.0));
}

TEST_F(ContourPictures, ZeroInTheMiddleHoldsForAMapOfOnesOwnChoice) {
  Sample sample = samples::square();
  sample.frame.fields["stress"].values.array() += 0.25e5;
  ContourOptions options = small("stress.xx");
  options.range = {-1e5, 1e4};
  options.colormap = "coolwarm";
  const Color neutral = ColorScale("coolwarm", {-1.0, 1.0}, 0).color(0.0);
  expectColor(drawn(sample, options), Eigen::Vector2d(0.25 + 0.2 * 0.4, 0.4), neutral);
  options.colormap = "viridis";
  expectColor(drawn(sample, options), Eigen::Vector2d(0.25 + 0.2 * 0.4, 0.4),
              ColorScale("viridis", *options.range, 0).color(0.0));
}

TEST_F(ContourPictures, VectorAloneIsItsMagnitude) {
  const Picture picture = drawn(samples::square(), small("displacement"));
  const ColorScale scale("viridis", {0.0, 0.2}, 0);
  expectColor(picture, Eigen::Vector2d(0.3 + 0.2 * 0.4, 0.4), scale.color(0.08));
}

TEST_F(ContourPictures, FieldThatIsZeroEverywhere) {
  Sample sample = samples::slab();
  sample.frame.fields["plastic_strain"].values.setZero();
  const Picture picture = expectBaseline(sample, small("plastic_strain"), "zero");
  expectColor(picture, deformedSlab(0.3, 0.5), ColorScale("viridis", {0.0, 1.0}, 0).color(0.0));
}

TEST_F(ContourPictures, CubeUnderABall) {
  expectBaseline(samples::cube(), small("pressure"), "cube_ball");
}

TEST_F(ContourPictures, ValuesOutsideAGivenRangeHaveTheColoursOfItsEnds) {
  ContourOptions options = small("plastic_strain");
  options.range = {0.3, 0.6};
  const Picture picture = drawn(samples::slab(), options);
  const ColorScale scale("viridis", *options.range, 0);
  expectColor(picture, deformedSlab(0.5, 0.2), scale.colors().front());
  expectColor(picture, deformedSlab(0.5, 0.93), scale.colors().back());
}

TEST_F(ContourPictures, EveryPictureFromTinyToLargeKeepsItsTextsInside) {
  for (const std::array<int, 2> size : {std::array{200, 150}, std::array{400, 300}, std::array{2000, 300},
                                        std::array{300, 2000}, std::array{1600, 900}}) {
    ContourOptions options = small("plastic_strain");
    options.size = size;
    options.title = "A title that is much too long for one line of a small picture and has to end somewhere";
    const Picture picture = drawn(samples::slab(), options);
    ASSERT_EQ(picture.width, size[0]);
    ASSERT_EQ(picture.height, size[1]);
    const Color paper{255, 255, 255};
    for (int i = 0; i < size[0]; ++i)
      for (const int j : {0, 1, size[1] - 2, size[1] - 1}) ASSERT_EQ(picture.at({i + 0.5, j + 0.5}), paper);
    for (int j = 0; j < size[1]; ++j)
      for (const int i : {0, 1, size[0] - 2, size[0] - 1}) ASSERT_EQ(picture.at({i + 0.5, j + 0.5}), paper);
  }
}

/// Letters of Devanagari, which join.
TEST_F(ContourPictures, LettersThatJoin) {
  ContourOptions options = small("plastic_strain");
  options.title = "कठोर पिंड: विकृति (ε̄ₚ)";
  expectBaseline(samples::slab(), options, "slab_devanagari");
}

TEST_F(ContourPictures, SameBytesEveryTime) {
  const Sample sample = samples::slab();
  drawContour(sample.model, sample.frame, small("plastic_strain"), dir / "first.png");
  drawContour(sample.model, sample.frame, small("plastic_strain"), dir / "second.png");
  EXPECT_GT(fs::file_size(dir / "first.png"), 1000U);
  EXPECT_EQ(bytesOf(dir / "first.png"), bytesOf(dir / "second.png"));
}

TEST_F(ContourPictures, CommandDrawsTheSameInAnEmptyEnvironment) {
  const Sample sample = samples::slab();
  ResultWriter(dir / "result", sample.model).append(sample.frame);
  const std::string child = (dir / "child.png").string();
  const std::string line = "env -i " BURNISH_COMMAND " render " + (dir / "result").string() +
                           " --field plastic_strain --size 400,300 -o " + child;
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  drawContour(sample.model, sample.frame, small("plastic_strain"), dir / "own.png");
  EXPECT_EQ(bytesOf(child), bytesOf(dir / "own.png"));
}

TEST_F(ContourPictures, ArrowsIsolinesAndKnotsOnADarkGround) {
  ContourOptions options = small("plastic_strain");
  options.theme = {themeNamed("dark"), "dark"};
  options.bands = 6;
  options.isolines = 5;
  options.knots = true;
  options.arrows = ArrowField::Displacement;
  const Picture picture = expectBaseline(samples::slab(), options, "slab_dark");
  EXPECT_EQ(picture.at({0.5, 0.5}), options.theme.paper);
}

TEST_F(ContourPictures, ControlNetInAWindow) {
  ContourOptions options = small("von_mises");
  options.controlNet = true;
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.2, 0.8), Eigen::Vector2d(1.6, 2.1));
  const Picture picture = expectBaseline(samples::ring(), options, "ring_net");
  EXPECT_TRUE(view.center.isApprox(Eigen::Vector2d(0.9, 1.45)));
  const Eigen::MatrixXd points = samples::ring().model.mesh.patches.front().points;
  const double margin = 0.05;
  int seen = 0;
  for (const auto& point : points.colwise()) {
    if (options.window->exteriorDistance(Eigen::Vector2d(point)) > 0.0) continue;
    if ((point - options.window->min()).minCoeff() < margin ||
        (options.window->max() - point).minCoeff() < margin)
      continue;
    expectColor(picture, point, options.theme.controlNet);
    ++seen;
  }
  EXPECT_GT(seen, 3);
}

TEST_F(ContourPictures, IsolinesLieWhereTheFieldHasTheirValues) {
  ContourOptions options = small("von_mises");
  options.isolines = 3;
  options.size = {1600, 1200};
  const Picture picture = drawn(samples::ring(), options);
  const ColorScale scale("viridis", {0.0, 100.0}, 0);
  for (const double angle : {0.2, 0.7, 1.3})
    for (const double radius : {1.25, 1.5, 1.75}) {
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      const Color line = picture.at(view.pixel(radius * direction));
      EXPECT_LT(line[1], 0.7 * scale.color(100.0 * (radius - 1.0))[1]) << angle << " " << radius;
      const double beside = radius + 6.0 / view.pixelsPerLength;
      expectColor(picture, beside * direction, scale.color(100.0 * (beside - 1.0)));
    }
}

TEST_F(ContourPictures, ExtremesAreMarkedWhereTheyAre) {
  constexpr Color kWhite{255, 255, 255};
  ContourOptions options = small("plastic_strain");  // 4 s (1 - s) t²: largest at s = 1/2, t = 1
  options.size = {800, 600};
  options.tools = false;
  options.markExtremes = true;
  const Eigen::Vector2d top(1.5, 0.85);
  expectBaseline(samples::slab(), options, "extremes");
  for (const double warp : {1.0, 0.0}) {
    options.warp = warp;
    const Eigen::Vector2d place(1.5, 1.0 - 0.15 * warp);
    expectColor(drawn(samples::slab(), options), place, kWhite);
    options.markExtremes = false;
    EXPECT_GT(difference(drawn(samples::slab(), options).at(view.pixel(place - Eigen::Vector2d(0.0, 0.01))),
                         kWhite),
              40);
    options.markExtremes = true;
  }
  options.warp = 1.0;
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.45, 1.0));
  const Picture beside = drawn(samples::slab(), options);
  EXPECT_GT(difference(beside.at(view.pixel(top - Eigen::Vector2d(0.06, 0.01))), kWhite), 40);
}

TEST_F(ContourPictures, ExtremesInsideABodyInSpaceArePale) {
  ContourOptions options = small("pressure");
  options.size = {800, 600};
  options.markExtremes = true;
  expectBaseline(samples::cube(), options, "extremes_cube");
}

/// Of x + y + z in a cube and its image, where the computed half is, or the half that a cut leaves.
TEST_F(ContourPictures, ExtremesBeyondAMirrorAreMarkedWhereTheyAreSeen) {
  const Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.mirror = {{0, 1.0}};
  options.tools = false;
  options.markExtremes = true;
  const auto smallest = [&] {
    return withShownModel(sample.model, sample.frame, options,
                          [&](const ModelRecord& model, const FrameRecord& frame) {
                            return contourParts(model, frame, chooseField(model, frame, "pressure"), options)
                                .extremes->positions[0];
                          });
  };
  EXPECT_LT((smallest() - Eigen::Vector3d(0.0, 0.0, 0.0)).norm(), 1e-3);
  options.view.name = "-1,0.2,0.3";
  options.cut = CutPlane{{0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}};  // leaves x > 0.5
  EXPECT_LT((smallest() - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-3);
}

TEST_F(ContourPictures, WarpMovesTheBodyAndKeepsItsValues) {
  ContourOptions options = small("plastic_strain");
  options.warp = 3.0;
  options.tools = false;
  const Picture picture = drawn(samples::slab(), options);
  const ColorScale scale("viridis", {0.0, 1.0}, 0);
  for (const double s : {0.2, 0.45, 0.8})
    expectColor(picture, Eigen::Vector2d(3.0 * s, 0.8 - 3.0 * 0.6 * s * (1.0 - s) * 0.8),
                scale.color(4.0 * s * (1.0 - s) * 0.64));
}

TEST_F(ContourPictures, ToolsCanBeLeftOut) {
  ContourOptions options = small("plastic_strain");
  const double with = (drawn(samples::slab(), options), view.pixelsPerLength);
  options.tools = false;
  const Picture picture = drawn(samples::slab(), options);
  EXPECT_GT(view.pixelsPerLength, with);
  expectColor(picture, Eigen::Vector2d(1.5, 0.95), options.theme.paper);
}

TEST_F(ContourPictures, ToolsThatHaveBeenTakenAwayAreLeftOut) {
  const Eigen::Vector2d inTheTool(1.5, 0.95);
  const ContourOptions options = small("plastic_strain");
  Sample sample = samples::slab();
  sample.model.tools.at(0).until = 1.0;
  sample.frame.time = 1.0;
  EXPECT_GT(difference(drawn(sample, options).at(view.pixel(inTheTool)), options.theme.paper), 20);
  sample.frame.time = 1.1;
  expectColor(drawn(sample, options), inTheTool, options.theme.paper);
}

TEST_F(ContourPictures, CubeFromAGivenSide) {
  ContourOptions options = small("pressure");
  options.view.name = "xz";
  const Picture picture = drawn(samples::cube(), options);
  // The eye sees the face y = 0, on which the pressure is x + z.
  const ColorScale scale("viridis", {0.0, 3.0}, 0);
  const Color low = picture.at(view.pixel(Eigen::Vector3d(0.1, 0.0, 0.1))),
              high = picture.at(view.pixel(Eigen::Vector3d(0.9, 0.0, 0.9)));
  EXPECT_LE(difference(low, scale.color(0.2)), 12);
  EXPECT_LE(difference(high, scale.color(1.8)), 12);
}

TEST_F(ContourPictures, WithoutPaperThePictureOnWhiteIsTheSame) {
  const Sample sample = samples::slab();
  ContourOptions options = small("plastic_strain");
  const Picture opaque = drawn(sample, options);
  options.transparent = true;
  drawContour(sample.model, sample.frame, options, dir / "drawn.png");
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((dir / "drawn.png").c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  ASSERT_EQ(image.GetNumberOfScalarComponents(), 4);
  const auto* rgba = static_cast<const unsigned char*>(image.GetScalarPointer());
  for (std::size_t k = 0; k < opaque.pixels.size(); ++k, rgba += 4)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(opaque.pixels[k][c], (rgba[c] * rgba[3] + 255 * (255 - rgba[3])) / 255.0, 1.0) << k;
  EXPECT_EQ(image.GetScalarComponentAsDouble(0, 0, 0, 3), 0.0);
  const Eigen::Vector2i inside = view.pixel(deformedSlab(0.2, 0.5)).cast<int>();
  EXPECT_EQ(image.GetScalarComponentAsDouble(inside.x(), inside.y(), 0, 3), 255.0);
}

class ContourMistakes : public ContourPictures {
 protected:
  void expectRefused(const Sample& sample, const ContourOptions& options,
                     const std::vector<std::string>& parts) {
    try {
      drawContour(sample.model, sample.frame, options, file);
      ADD_FAILURE() << "no error that says \"" << parts.front() << "\"";
    } catch (const Error& error) {
      for (const std::string& part : parts) EXPECT_THAT(error.what(), testing::HasSubstr(part));
    }
    EXPECT_FALSE(fs::exists(file));
  }
  fs::path file = fs::temp_directory_path() / ("burnish_refused_" + std::to_string(::getpid()) + ".png");
};

TEST_F(ContourMistakes, UnknownFieldListsTheKnownOnesAndTheNearest) {
  expectRefused(samples::square(), small("presure"),
                {"presure", "displacement, displacement.x, displacement.y, pressure, stress.xx",
                 "Did you mean \"pressure\"?"});
  expectRefused(samples::square(), small("stress"), {"stress.xx, stress.yy, stress.xy, stress.zz"});
}

TEST_F(ContourMistakes, TextsThatLeaveNoRoom) {
  ContourOptions options = small("plastic_strain");
  options.textSize = 200.0;
  expectRefused(
      samples::slab(), options,
      {"text_size: found 200, of which a picture of 400 x 300 has no room for the body and the numbers "
       "of its scale; the largest that fits is "});
  double largest = 6.0;
  for (options.textSize = largest; largest < 200.0; options.textSize = largest + 1.0) try {
      contourImage(samples::slab().model, samples::slab().frame, options);
      largest = *options.textSize;
    } catch (const Error&) {
      break;
    }
  EXPECT_GT(largest, 15.0);
  expectRefused(samples::slab(), options, {fmt::format("the largest that fits is {}", largest)});
}

TEST_F(ContourMistakes, OptionsOutOfRange) {
  ContourOptions options = small("plastic_strain");
  options.size = {100, 300};
  expectRefused(samples::slab(), options, {"size: found 100 x 300"});
  options = small("plastic_strain");
  options.range = {1.0, 1.0};
  expectRefused(samples::slab(), options, {"range: found 1, 1"});
  options = small("plastic_strain");
  options.bands = 257;
  expectRefused(samples::slab(), options, {"bands: found 257"});
  options = small("plastic_strain");
  options.colormap = "virdis";
  expectRefused(samples::slab(), options, {"colormap: found \"virdis\"", "Did you mean \"viridis\"?"});
  options = small("plastic_strain");
  options.isolines = 101;
  expectRefused(samples::slab(), options, {"isolines: found 101"});
  options = small("plastic_strain");
  options.warp = std::numeric_limits<double>::infinity();
  expectRefused(samples::slab(), options, {"warp: found inf"});
}

TEST_F(ContourMistakes, FieldThatIsNotFinite) {
  Sample sample = samples::slab();
  sample.frame.fields["plastic_strain"].values(0, 5) = std::numeric_limits<double>::quiet_NaN();
  expectRefused(sample, small("plastic_strain"), {"plastic_strain", "not finite"});
}

TEST_F(ContourMistakes, PlaceThatCannotBeWritten) {
  file = dir / "absent" / "picture.png";
  expectRefused(samples::slab(), small("plastic_strain"), {file.string()});
}

}  // namespace
}  // namespace burnish
