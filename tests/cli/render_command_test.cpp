#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/text/text_file.h"
#include "tests/cli/shell.h"
#include "tests/postproc/picture.h"
#include "tests/postproc/sample_records.h"

/// `burnish render`, `sheet` and `animate` as the user meets them. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::vector<double> kTimes{0.0, 0.25, 0.5, 0.75, 1.0};

void expectError(const std::function<void()>& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(FrameIndices, AreOneARangeOrAll) {
  EXPECT_THAT(frameIndices("2", kTimes), ElementsAre(2));
  EXPECT_THAT(frameIndices("1-3", kTimes), ElementsAre(1, 2, 3));
  EXPECT_THAT(frameIndices("3-last", kTimes), ElementsAre(3, 4));
  EXPECT_THAT(frameIndices("all", kTimes), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(frameIndices("time=7.5e-1", kTimes), ElementsAre(3));
  EXPECT_THAT(frameIndices("0,2", kTimes), ElementsAre(0, 2));
  EXPECT_THAT(frameIndices("0-1,time=7.5e-1,last", kTimes), ElementsAre(0, 1, 3, 4));
  for (const char* text : {"2,0", "1,1", "0-2,1"})
    expectError([&] { frameIndices(text, kTimes); }, "every frame once, in the order of their times");
  for (const char* text : {"1,", ",1", "1,,2"})
    expectError([&] { frameIndices(text, kTimes); }, "a list with commas");
  expectError([] { frameIndices("3-1", kTimes); }, "the smaller number first");
  expectError([] { frameIndices("1-5", kTimes); }, "there is no frame 5");
  expectError([] { frameIndices("al", kTimes); }, "Did you mean \"all\"?");
  for (const char* text : {"-1", "1-", "1-2-3", "-"}) EXPECT_THROW(frameIndices(text, kTimes), Error) << text;
}

TEST(PictureNames, HoldFrameAndTime) {
  EXPECT_THAT(pictureNames("a/f_{frame:04}.png", {3, 12}, std::vector<double>(13)),
              ElementsAre("a/f_0003.png", "a/f_0012.png"));
  EXPECT_THAT(pictureNames("t{time:.2f}.png", {1, 2}, kTimes), ElementsAre("t0.25.png", "t0.50.png"));
  EXPECT_THAT(pictureNames("plain.png", {1}, kTimes), ElementsAre("plain.png"));
  expectError([] { pictureNames("plain.png", {1, 2}, kTimes); }, "the number of the frame");
  expectError([] { pictureNames("{frane}.png", {1}, kTimes); }, "frame_{frame:04}.png");
  expectError([] { pictureNames("{frame", {1}, kTimes); }, "frame_{frame:04}.png");
}

/// Five frames of the slab, whose plastic strain grows in proportion to their numbers.
class RenderCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(dir());
    samples::Sample sample = samples::slab();
    ResultWriter result(dir() / "run", sample.model);
    const Eigen::MatrixXd strain = sample.frame.fields["plastic_strain"].values;
    for (int k = 0; k < 5; ++k) {
      sample.frame.index = k;
      sample.frame.time = kTimes[static_cast<std::size_t>(k)];
      sample.frame.fields["plastic_strain"].values = 0.25 * k * strain;
      result.append(sample.frame);
    }
  }
  static void TearDownTestSuite() { fs::remove_all(dir()); }

  static fs::path dir() {
    return fs::temp_directory_path() / ("burnish_render_command_" + std::to_string(::getpid()));
  }

  static Outcome burnish(const std::string& arguments, const std::string& environment = "") {
    return shell(dir(), environment + " " BURNISH_COMMAND " " + arguments);
  }

  static void render(const std::string& options, const std::string& name) {
    const Outcome outcome = burnish("render run --size 400,300 " + options + " -o " + name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }

  static void expectRefused(const std::string& arguments, const std::string& part) {
    const Outcome outcome = burnish(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("burnish: "), HasSubstr(part)));
    EXPECT_EQ(outcome.out, "") << arguments;
  }

  /// Whether at most 1 of 1000 pixels are clearly different: ticks may jump by a pixel where a range has
  /// rounding errors. below: a share of the height that does not count.
  static bool alike(const std::string& a, const std::string& b, double below = 0.0) {
    const Picture first = readPicture(dir() / a), second = readPicture(dir() / b);
    if (first.pixels.size() != second.pixels.size()) return false;
    std::size_t count = 0;
    for (int y = static_cast<int>(below * first.height); y < first.height; ++y)
      for (int x = 0; x < first.width; ++x)
        if (difference(first.at({x + 0.5, y + 0.5}), second.at({x + 0.5, y + 0.5})) > 8) ++count;
    return 1000 * count <= first.pixels.size();
  }
};

TEST_F(RenderCommand, SeveralFramesShareTheirRangeUnlessToldOtherwise) {
  const Outcome outcome =
      burnish("render run --size 400,300 --frame 1-3 --tools off -o 'shared/{frame:02}.png'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "3 pictures, shared/01.png to shared/03.png\n");
  EXPECT_FALSE(fs::exists(dir() / "shared/00.png") || fs::exists(dir() / "shared/04.png"));
  render("--frame 1-3 --tools off --range 0,0.75", "'given_{frame}.png'");
  EXPECT_TRUE(alike("shared/02.png", "given_2.png"));

  constexpr double kScale = 0.5;  // with its numbers
  EXPECT_FALSE(alike("shared/01.png", "shared/03.png", kScale));
  render("--frame 1-3 --tools off --range frame", "'own_{frame}.png'");
  EXPECT_TRUE(alike("own_1.png", "own_3.png", kScale)) << "values in proportion have the same colours";
  EXPECT_FALSE(alike("own_2.png", "shared/02.png", kScale));

  render("--frame 2 --tools off --range run", "run.png");
  render("--frame 2 --tools off --range 0,1", "whole.png");
  EXPECT_TRUE(alike("run.png", "whole.png"));
}

TEST_F(RenderCommand, ComponentsAreChosenByName) {
  render("--field displacement --component y", "component.png");
  render("--field displacement.y", "whole_name.png");
  EXPECT_EQ(readText(dir() / "component.png"), readText(dir() / "whole_name.png"));
  expectRefused("render run --field displacement --component z -o a.png",
                "--component: found \"z\"; displacement has magnitude, x, y.");
  expectRefused("render run --field displacement --component magnitud -o a.png",
                "Did you mean \"magnitude\"?");
  expectRefused("render run --field plastic_strain --component xx -o a.png",
                "--component: found \"xx\"; plastic_strain is one number");
  expectRefused("render run --field displacment --component x -o a.png", "Did you mean \"displacement\"?");
}

TEST_F(RenderCommand, ScaleMagnifiesAllThatIsDrawn) {
  EXPECT_EQ(burnish("render run --size 300,200 --text-size 12 --scale 3 -o scaled.png").code, 0);
  EXPECT_EQ(burnish("render run --size 900,600 --text-size 36 -o large.png").code, 0);
  EXPECT_EQ(readText(dir() / "scaled.png"), readText(dir() / "large.png"));
}

TEST_F(RenderCommand, TextsOfOlderResultsAreShownEscapedOrAsBoxes) {
  samples::Sample sample = samples::slab();
  sample.model.title = "a\x1B[31m\xFF";
  ResultWriter(dir() / "old", sample.model).append(sample.frame);
  EXPECT_THAT(burnish("info old").out, HasSubstr("title       a\\x1B[31m\\xFF\n"));
  const Outcome outcome = burnish("render old --size 400,300 -o old.png");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(
      outcome.err,
      "warning: neither the font DejaVu Sans nor another one has U+001B; \"a\\x1B[31m\\xFF\" is drawn with a box for it\n");
}

TEST_F(RenderCommand, DoubtfulResultsAreMarkedUnlessToldOtherwise) {
  render("--background white", "sound.png");
  RunAccount summary;
  summary.program = "p";
  summary.completed = true;
  writeSummary(dir() / "run", summary);
  render("--background white", "no_doubt.png");
  summary.doubts.push_back({.what = "smallest J", .firstTime = 0.5, .steps = 3});
  writeSummary(dir() / "run", summary);
  render("--background white", "marked.png");
  render("--background white --no-doubts", "unmarked.png");
  writeText("base: paper\npicture: {doubt_marks: false}\n", dir() / "trusting.yaml");
  render("--background white --theme trusting.yaml", "trusting.png");
  EXPECT_EQ(readText(dir() / "no_doubt.png"), readText(dir() / "sound.png"));
  EXPECT_EQ(readText(dir() / "unmarked.png"), readText(dir() / "sound.png"));
  EXPECT_EQ(readText(dir() / "trusting.png"), readText(dir() / "sound.png"));
  const Picture marked = readPicture(dir() / "marked.png"), sound = readPicture(dir() / "sound.png");
  const auto ink = [](const Picture& picture) {  // in the lower left corner
    int count = 0;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 160; ++x)
        count += difference(picture.at({x + 0.5, y + 0.5}), {255, 255, 255}) > 60 ? 1 : 0;
    return count;
  };
  EXPECT_EQ(ink(sound), 0);
  EXPECT_GT(ink(marked), 100);
  removeSummary(dir() / "run");
}

TEST_F(RenderCommand, PagesForPrintAreAsLargeAsAPrintedPageUnlessToldOtherwise) {
  EXPECT_EQ(burnish("render run --dpi 150 --frame all -o 'p{frame}.pdf'").out,
            "5 pictures, p0.pdf to p4.pdf\n");
  EXPECT_THAT(shell(dir(), "pdfinfo p4.pdf").out, HasSubstr("482 x 271 pts"));
  EXPECT_THAT(shell(dir(), "pdftotext p0.pdf -").out, HasSubstr("max 0\n")) << "of the range of all";
  EXPECT_EQ(burnish("render run --dpi 150 --frame 0 -o zero.pdf").code, 0);
  EXPECT_THAT(shell(dir(), "pdftotext zero.pdf -").out, HasSubstr("0 everywhere\n"));
  EXPECT_THAT(shell(dir(), "pdftotext p4.pdf -").out, HasSubstr("max 1\n"));
  EXPECT_EQ(burnish("render run --size 300,200 -o p.svg").code, 0);
  EXPECT_THAT(readText(dir() / "p.svg"),
              HasSubstr("width=\"300pt\" height=\"200pt\" viewBox=\"0 0 300 200\""));
  expectRefused("render run --dpi 300 -o refused.png", "--dpi: found beside a PNG, which has pixels");
  expectRefused("render run --size 1600,900 -o refused.pdf", "dpi up to 360, or a smaller size");
  expectRefused("render run -o refused.eps", "ends in .png, .pdf or .svg");
}

TEST_F(RenderCommand, AnswersWithTheNearestValidValue) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--range rnu", "Did you mean \"run\"?"},
      {"--colormap virids", "Did you mean \"viridis\"?"},
      {"--bands smoth", "Did you mean \"smooth\"?"},
      {"--theme drak", "Did you mean \"dark\"?"},
      {"--theme drak.yaml", "drak.yaml: cannot be read"},
      {"--font 'DejaVu San'", "Did you mean \"DejaVu Sans\"?"},
      {"--font run/result.h5", "is not a font"},
      {"--font absent.ttf", "absent.ttf\"; there is no such file"},
      {"--frame lats", "Did you mean \"last\"?"},
      {"--frame tim=1", "Did you mean \"time=\"?"},
      {"--vectors displacements", "Did you mean \"displacement\"?"},
      {"--tools offf", "Did you mean \"off\"?"},
      {"--background blck", "Did you mean \"black\"?"},
      {"--view isso", "Did you mean \"iso\"?"},
      {"--view iso", "a plane body is only seen in its plane"},
      {"--view 1,1,1", "a plane body is only seen in its plane"},
      {"--range=-1e308,1e308", "--range: found \"-1e308,1e308\"; expected LO,HI: two numbers up to 1e300"},
      {"--range=0,1e-310", "at least 1e-290 apart"},
      {"--zoom=-1e308,-1e308,1e308,1e308", "two corners of a window"},
      {"--zoom 1,1,1,2", "two corners of a window"},
      {"--zoom 1,2,3", "two corners of a window"},
      {"--bands 257", "--bands: found \"257\""},
      {"--scale 0", "--scale: found \"0\"; expected a number from 0.25 to 10"},
      {"--size 160,160", "--size: found 160 x 160 pixels; expected 200 x 150 to 8000 x 8000"},
      {"--size 160x160", "--size: found \"160x160\"; expected W,H: pixels from 200 x 150 to 8000 x 8000."},
      {"--size 9000,160", "--size: found \"9000,160\"; expected W,H: pixels from 200 x 150 to 8000 x 8000."},
      {"--scale 9", "--scale: found 9, which makes 14400 x 8100 pixels; expected 200 x 150 to 8000 x 8000"},
      {"--vectors traction --warp 2", "without a warp"},
      {"--background white --transparent", "exclude each other"},
      {"--clip 99 --range 0,1", "give one of them"},
      {"--framme 1", "Did you mean \"--frame\"?"}};
  for (const auto& [options, part] : cases) expectRefused("render run " + options + " -o refused.png", part);
  EXPECT_FALSE(fs::exists(dir() / "refused.png"));
}

TEST_F(RenderCommand, ThemeFileSaysHowPicturesLook) {
  std::ofstream(dir() / "own.yaml") << "base: dark\n"
                                       "paper: '#203040'\n"
                                       "font: DejaVu Serif\n"
                                       "picture: {colormap: turbo, bands: 6, knots: true, tools: false}\n";
  render("--theme own.yaml", "themed.png");
  render(
      "--theme dark --background '#203040' --font 'DejaVu Serif' --colormap turbo --bands 6 --knots --tools "
      "off",
      "spelt_out.png");
  EXPECT_EQ(readText(dir() / "themed.png"), readText(dir() / "spelt_out.png"));
  EXPECT_EQ(readPicture(dir() / "themed.png").at({0.5, 0.5}), (Color{0x20, 0x30, 0x40}));

  render(
      "--theme own.yaml --font 'DejaVu Sans' --colormap viridis --bands smooth --no-knots --tools on "
      "--background black",
      "overruled.png");
  render("--theme dark --background black", "dark.png");
  EXPECT_EQ(readText(dir() / "overruled.png"), readText(dir() / "dark.png"));

  std::ofstream(dir() / "wrong.yaml") << "base: dark\ncolourmap: turbo\npicture: {band: 3}\n";
  expectRefused("render run --theme wrong.yaml -o a.png", "wrong.yaml:2:1: colourmap: found an unknown key");
  expectRefused("render run --theme wrong.yaml -o a.png", "Did you mean \"bands\"?");
}

TEST_F(RenderCommand, FontIsAFamilyOrItsFile) {
  render("", "sans.png");
  render("--font 'DejaVu Serif'", "serif.png");
  EXPECT_FALSE(alike("sans.png", "serif.png"));
  fs::copy_file(fontNamed("DejaVu Serif").file, dir() / "letters.ttf");
  render("--font letters.ttf", "file.png");
  EXPECT_EQ(readText(dir() / "file.png"), readText(dir() / "serif.png"));
}

TEST_F(RenderCommand, SheetHasItsPaperAndLetters) {
  render("", "for_dark.png");
  EXPECT_EQ(burnish("sheet for_dark.png --caption letters --theme dark -o dark_sheet.png").code, 0);
  EXPECT_EQ(readPicture(dir() / "dark_sheet.png").at({0.5, 0.5}), themeNamed("dark").paper);
  EXPECT_EQ(
      burnish("sheet for_dark.png --caption letters --theme dark --font 'DejaVu Serif' -o serif_sheet.png")
          .code,
      0);
  EXPECT_NE(readText(dir() / "dark_sheet.png"), readText(dir() / "serif_sheet.png"));
  expectRefused("sheet for_dark.png --theme drak -o a.png", "Did you mean \"dark\"?");
}

TEST_F(RenderCommand, SheetHasItsCaptionsAndColumns) {
  render("--frame 1-3", "'panel_{frame}.png'");
  EXPECT_EQ(
      burnish("sheet panel_1.png panel_2.png panel_3.png --columns 3 --caption a --caption b --caption c "
              "--width 900 -o sheets/three.png")
          .code,
      0);
  const Picture sheet = readPicture(dir() / "sheets/three.png");
  EXPECT_EQ(sheet.width, 900);
  EXPECT_LT(sheet.height, 300);
  expectRefused("sheet panel_1.png panel_2.png --caption a -o no.png", "--caption: found 1 for 2 pictures");
  expectRefused("sheet absent.png -o no.png", "absent.png");
}

TEST_F(RenderCommand, SheetDrawsFramesWithOneRangeAndOneWindow) {
  const auto sheet = [](const std::string& arguments) {
    const Outcome outcome = burnish("sheet " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  samples::Sample wide = samples::slab();
  wide.frame.fields["plastic_strain"].values *= 3.0;
  ResultWriter(dir() / "other", wide.model).append(wide.frame);
  const std::string size = " --panel-size 400,300 --columns 2 --tools off ";
  sheet("run other --frame last" + size + "-o shared.svg");
  const std::string svg = readText(dir() / "shared.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("max 1<"), HasSubstr("max 3<")));
  EXPECT_NE(svg.find(">3.0<"), svg.rfind(">3.0<")) << "the end of both scales";
  sheet("run other" + size + "-o shared.png");
  sheet("run other --range 0,3" + size + "-o given.png");
  sheet("run other --range frame" + size + "-o own.png");
  EXPECT_TRUE(alike("shared.png", "given.png"));
  EXPECT_FALSE(alike("shared.png", "own.png"));
  EXPECT_EQ(readPicture(dir() / "shared.png").width, 800);
  sheet("run shared.png --frame 1-2 --caption a --caption b --caption c --width 900 -o mixed.pdf");
  EXPECT_EQ(shell(dir(), "pdfimages -list mixed.pdf | tail -n +3 | wc -l").out, "3\n");
  expectRefused("sheet run --frame 1-2 --caption a -o no.png", "--caption: found 1 for 2 pictures");
  expectRefused("sheet run --dpi 300 -o no.png", "--dpi: found beside a PNG, which has pixels");
  expectRefused("sheet run --dpi 9999 -o no.pdf", "--dpi");
  expectRefused("sheet run -o no.jpg", "ends in .png, .pdf or .svg");
}

/// So that lengths can be compared: a run with doubts says so in a line of its own.
TEST_F(RenderCommand, PanelsOfASheetHaveOneScaleWhateverIsWrittenBelow) {
  fs::copy(dir() / "run", dir() / "doubted", fs::copy_options::recursive);
  RunAccount summary;
  summary.program = "p";
  summary.completed = true;
  summary.doubts.push_back({.what = "smallest J", .firstTime = 0.5, .steps = 3});
  writeSummary(dir() / "doubted", summary);
  const Outcome drawn =
      burnish("sheet run doubted --frame last --columns 2 --panel-size 400,300 -o doubted.png");
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const Picture sheet = readPicture(dir() / "doubted.png");
  const auto isColored = [&](int x, int y) {
    const Color color = sheet.at({x + 0.5, y + 0.5});
    return std::ranges::max(color) - std::ranges::min(color) > 60;
  };
  int colored = 0, different = 0;
  for (int y = 0; y < sheet.height; ++y)
    for (int x = 0; x < sheet.width / 2; ++x) {
      colored += isColored(x, y) ? 1 : 0;
      different += isColored(x, y) != isColored(x + sheet.width / 2, y) ? 1 : 0;
    }
  EXPECT_GT(colored, 10000);
  EXPECT_EQ(different, 0);
}

/// A panel is filled as a picture of its size is.
TEST_F(RenderCommand, SheetInPerspectiveFillsItsPanels) {
  const samples::Sample cube = samples::cube();
  ResultWriter(dir() / "cube", cube.model).append(cube.frame);
  const auto colored = [](const fs::path& png) {
    const Picture picture = readPicture(png);
    int count = 0;
    for (int x = 0; x < picture.width * 6 / 10; ++x)  // the scale stands to the right
      for (int y = 0; y < picture.height; ++y) {
        const Color c = picture.at({x + 0.5, y + 0.5});
        count += std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 30 ? 1 : 0;
      }
    return count;
  };
  const std::string look = " --perspective 90 --tools off --text-size 12 ";
  const Outcome drawn =
      burnish("render cube --field pressure --title '' --size 400,300" + look + "-o single.png");
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_EQ(burnish("sheet cube --field pressure --panel-size 400,300" + look + "-o panel.png").code, 0);
  const double single = colored(dir() / "single.png");
  EXPECT_GT(single, 10000.0);
  const double share = colored(dir() / "panel.png") / single;
  EXPECT_GT(share, 0.8);  // scales of panels have room for other numbers
  EXPECT_LE(share, 1.0);
}

/// Types of the chunks of a PNG file in their order; of those of an animation with their numbers.
std::vector<std::string> chunksOf(const fs::path& png) {
  const std::string bytes = readText(png);
  const auto numberAt = [&](std::size_t at) {
    std::size_t number = 0;
    for (std::size_t k = 0; k < 4; ++k) number = number << 8U | static_cast<unsigned char>(bytes[at + k]);
    return number;
  };
  std::vector<std::string> types;
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + numberAt(at)) {
    types.push_back(bytes.substr(at + 4, 4));
    if (types.back() == "fcTL" || types.back() == "fdAT") types.back() += std::to_string(numberAt(at + 8));
  }
  return types;
}

TEST_F(RenderCommand, AnimationsThatNeedFfmpegAreRefusedWithoutIt) {
  writeText("precious", dir() / "films/run.png");
  for (const char* ending : {"mp4", "gif"}) {
    const Outcome outcome = burnish(std::string("animate run -o films/run.") + ending, "PATH=/nowhere");
    EXPECT_EQ(outcome.code, 2) << ending;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("burnish: -o: films/run."), HasSubstr("apt-get install ffmpeg"),
                                   HasSubstr("take films/run.png")));
    EXPECT_FALSE(fs::exists(dir() / (std::string("films/run.") + ending)));
  }
  EXPECT_EQ(readText(dir() / "films/run.png"), "precious");
}

TEST_F(RenderCommand, AnimatedPngNeedsNoFfmpeg) {
  const Outcome outcome = burnish("animate run --size 400,300 --frame 2-4 -o film.png", "PATH=/nowhere");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 frames in film.png"));
  EXPECT_THAT(chunksOf(dir() / "film.png"),
              ElementsAre("IHDR", "acTL", "fcTL0", "IDAT", "fcTL1", "fdAT2", "fcTL3", "fdAT4", "IEND"));
  render("--frame 2-4", "'film_{frame}.png'");
  EXPECT_TRUE(alike("film.png", "film_2.png"));
}

TEST_F(RenderCommand, AnimatedPngHoldsThePicturesOfAllFrames) {
  if (shell(dir(), "ffmpeg -version").code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  EXPECT_EQ(burnish("animate run --size 400,300 --rate 4 -o film.png").code, 0);
  render("--frame all", "'frame_{frame}.png'");
  const Outcome split =
      shell(dir(), "ffmpeg -v error -f apng -i film.png -fps_mode passthrough split_%d.png");
  EXPECT_EQ(split.code, 0);
  EXPECT_EQ(split.err, "");
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(readPicture(dir() / ("split_" + std::to_string(k + 1) + ".png")).pixels,
              readPicture(dir() / ("frame_" + std::to_string(k) + ".png")).pixels)
        << k;
}

TEST_F(RenderCommand, AnimationIsAVideoOrAGif) {
  if (shell(dir(), "ffmpeg -version").code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  EXPECT_EQ(burnish("animate run --size 400,300 -o film.mp4").out, "5 frames in film.mp4\n");
  EXPECT_EQ(readText(dir() / "film.mp4").substr(4, 4), "ftyp");
  EXPECT_EQ(burnish("animate run --size 400,300 -o film.gif").out, "5 frames in film.gif\n");
  EXPECT_THAT(readText(dir() / "film.gif"), StartsWith("GIF89a"));
  expectRefused("animate run -o film.avi", ".mp4, .png or .gif");
}

TEST_F(RenderCommand, MapsOfRoughFacesHaveAxesAndMarkDoubtfulRuns) {
  const samples::Sample cube = samples::cube();
  ResultWriter(dir() / "rough", cube.model).append(cube.frame);
  const auto mapOf = [] {
    const Outcome drawn = burnish("roughness rough --face top -o map.svg");
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    return readText(dir() / "map.svg");
  };
  EXPECT_THAT(mapOf(),
              AllOf(HasSubstr("Along the face"), HasSubstr(">Across"), Not(HasSubstr("doubtful results"))));
  RunAccount summary;
  summary.doubts.push_back({.what = "smallest J", .firstTime = 0.0, .steps = 1});
  writeSummary(dir() / "rough", summary);
  EXPECT_THAT(mapOf(), HasSubstr("doubtful results"));
}

}  // namespace
}  // namespace burnish
