#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "engine/core/error.h"
#include "postproc/compare/comparison.h"
#include "postproc/compare/comparison_json.h"
#include "postproc/compare/difference_picture.h"
#include "postproc/compare/lab.h"
#include "postproc/compare/report.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/spoiled_pictures.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

Picture filled(int width, int height, const Color& color) {
  return {width, height, std::vector<Color>(static_cast<std::size_t>(width * height), color)};
}

Picture random(int width, int height, unsigned seed) {
  std::mt19937 generator(seed);
  Picture picture = filled(width, height, {});
  for (Color& color : picture.pixels)
    for (unsigned char& channel : color) channel = static_cast<unsigned char>(generator() % 256);
  return picture;
}

TEST(Lab, KnownColours) {
  const auto near = [](const Lab& found, const Lab& expected) { return deltaE(found, expected) < 0.02F; };
  EXPECT_TRUE(near(toLab(Color{0, 0, 0}), {0.0F, 0.0F, 0.0F}));
  EXPECT_TRUE(near(toLab(Color{255, 255, 255}), {100.0F, 0.0F, 0.0F}));
  EXPECT_TRUE(near(toLab(Color{119, 119, 119}), {50.034F, 0.0F, 0.0F}));
  EXPECT_TRUE(near(toLab(Color{255, 0, 0}), {53.241F, 80.092F, 67.203F}));
  EXPECT_TRUE(near(toLab(Color{0, 255, 0}), {87.735F, -86.183F, 83.179F}));
  EXPECT_TRUE(near(toLab(Color{0, 0, 255}), {32.297F, 79.188F, -107.860F}));
}

/// 1 - similarity of the window around (i, j) in one channel, straight from the definition.
double dissimilarityByDefinition(const Picture& actual, const Picture& baseline, int i, int j, int channel) {
  double count = 0.0, mx = 0.0, my = 0.0, vx = 0.0, vy = 0.0, covariance = 0.0;
  const auto overWindow = [&](const auto& visit) {
    for (int y = std::max(0, j - 6); y <= std::min(actual.height - 1, j + 6); ++y)
      for (int x = std::max(0, i - 6); x <= std::min(actual.width - 1, i + 6); ++x) {
        const double shift = channel == 0 ? 0.0 : 128.0;
        visit(toLab(actual.at({x + 0.5, y + 0.5}))[channel] + shift,
              toLab(baseline.at({x + 0.5, y + 0.5}))[channel] + shift);
      }
  };
  overWindow([&](double a, double b) { ++count, mx += a, my += b; });
  mx /= count, my /= count;
  overWindow([&](double a, double b) {
    vx += (a - mx) * (a - mx) / count;
    vy += (b - my) * (b - my) / count;
    covariance += (a - mx) * (b - my) / count;
  });
  const double range = channel == 0 ? 100.0 : 255.0, c1 = 1e-4 * range * range, c2 = 9e-4 * range * range;
  return 1.0 - (2 * mx * my + c1) * (2 * covariance + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
}

TEST(Metric, AgreesWithItsDefinition) {
  for (const std::array<int, 2> size : {std::array{40, 30}, std::array{5, 31}, std::array{9, 3}}) {
    const Picture a = random(size[0], size[1], 1);
    Picture b = random(size[0], size[1], 2);
    for (Color& color : b.pixels)  // dark, so that the small constants count
      for (unsigned char& channel : color) channel = channel / 20;
    double worst = 0.0, sum = 0.0;
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) {
        double window = 0.0;
        for (const int channel : {0, 1, 2})
          window = std::max(window, dissimilarityByDefinition(a, b, i, j, channel));
        worst = std::max(worst, window);
        sum += window;
      }
    const PictureDifference found = differenceOf(a, b);
    EXPECT_NEAR(found.dissimilarity, worst, 1e-6);
    EXPECT_NEAR(found.meanDissimilarity, sum / (size[0] * size[1]), 1e-6);
  }
}

TEST(Metric, EqualPicturesDifferByNothing) {
  const PictureDifference found = differenceOf(random(40, 30, 1), random(40, 30, 1));
  EXPECT_EQ(found.dissimilarity, 0.0);
  EXPECT_EQ(found.windowShare, 0.0);
  EXPECT_EQ(found.box.width, 0);
}

TEST(Metric, SaysWhereAndHowMuch) {
  const Picture grey = filled(100, 80, {200, 200, 200});
  const PictureDifference found = differenceOf(withMark(grey, 30, 10, {90, 90, 90}), grey);
  EXPECT_EQ(found.box.left, 30);
  EXPECT_EQ(found.box.top, 80 - 10 - 20);
  EXPECT_EQ(found.box.width, 6);
  EXPECT_EQ(found.box.height, 20);
  EXPECT_DOUBLE_EQ(found.share, 120.0 / 8000.0);
  EXPECT_DOUBLE_EQ(found.windowShare, 6.0 * 13.0 / 169.0);
}

/// Structure does not see that a large area has another colour, colours do not see faint stripes.
TEST(Metric, SeesColoursAndStructure) {
  const Picture grey = filled(100, 80, {200, 200, 200}), bluish = filled(100, 80, {196, 200, 204});
  PictureDifference found = differenceOf(bluish, grey);
  EXPECT_LT(found.dissimilarity, 0.01);
  EXPECT_EQ(found.windowShare, 1.0);
  EXPECT_EQ(metricValue(Metric::Ssim, found), 1.0);
  EXPECT_EQ(metricValue(Metric::DeltaE, found), 1.0);

  Picture striped = grey;
  for (std::size_t k = 0; k < striped.pixels.size(); ++k)
    if (k % 10 < 5) striped.pixels[k] = {206, 206, 206};
  found = differenceOf(striped, grey);
  EXPECT_EQ(found.share, 0.0);
  EXPECT_EQ(metricValue(Metric::DeltaE, found), 0.0);
  EXPECT_GT(metricValue(Metric::Ssim, found), 0.08);
  EXPECT_THAT(found.box.width, testing::AllOf(testing::Ge(7), testing::Le(13))) << "the worst window";
}

TEST(Metric, DoesNotDependOnTheSizeOfThePicture) {
  const auto value = [](int width, int height) {
    const Picture grey = filled(width, height, {200, 200, 200});
    return metricValue(Metric::Ssim, differenceOf(withMark(grey, 30, 30, {100, 100, 100}), grey));
  };
  EXPECT_NEAR(value(80, 80), value(1600, 900), 1e-9);
}

TEST(Blank, PicturesThatShowNothing) {
  const Picture grey = filled(100, 100, {200, 200, 200});
  EXPECT_TRUE(isBlank(grey));
  EXPECT_TRUE(isBlank(withNoise(grey)));
  Picture dot = grey;
  dot.pixels.front() = {0, 0, 0};  // the corner alone must not decide
  EXPECT_TRUE(isBlank(dot));
  EXPECT_FALSE(isBlank(withMark(grey, 3, 3, {0, 0, 0})));
}

class PictureFiles : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"actual", "baseline"}) fs::create_directories(dir / name);
  }
  void TearDown() override { fs::remove_all(dir); }

  void write(const std::string& name, const Picture& picture) const {
    writeText(encodePng(picture), dir / name);
  }

  fs::path dir = fs::temp_directory_path() / ("burnish_compare_" + std::to_string(::getpid()));
};

TEST_F(PictureFiles, WhatIsWrittenIsRead) {
  const Picture picture = random(37, 21, 3);
  write("a.png", picture);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((dir / "a.png").c_str());
  reader->Update();
  EXPECT_EQ(std::memcmp(reader->GetOutput()->GetScalarPointer(), picture.pixels.data(), 37 * 21 * 3), 0)
      << "VTK, too, has the lowest row first";
  const Picture read = readPicture(dir / "a.png");
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 21);
  EXPECT_EQ(read.pixels, picture.pixels);
}

TEST_F(PictureFiles, UnusableFilesAreNamed) {
  const std::string png = encodePng(random(50, 50, 1));
  const auto expectRefused = [&](const std::string& bytes) {
    writeText(bytes, dir / "bad.png");
    try {
      readPicture(dir / "bad.png");
      ADD_FAILURE() << "no error for " << bytes.size() << " bytes";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr((dir / "bad.png").string()));
    }
  };
  expectRefused("");
  expectRefused("title: no picture");
  for (const std::size_t size : {8U, 20U, 40U, 500U}) expectRefused(png.substr(0, size));
  EXPECT_THROW(readPicture(dir / "absent.png"), Error);
  EXPECT_THROW(readPicture(dir), Error);
}

/// A pair of every verdict, named like it.
class Directories : public PictureFiles {
 protected:
  void SetUp() override {
    PictureFiles::SetUp();
    const Picture picture = random(60, 40, 1);
    const auto pair = [&](const std::string& name, const Picture& actual) {
      write("actual/" + name, actual);
      write("baseline/" + name, picture);
    };
    pair("equal.png", picture);
    pair("different.png", random(60, 40, 2));
    pair("sub/sizes-differ.png", random(40, 60, 1));
    pair("blank.png", filled(60, 40, {255, 255, 255}));
    write("baseline/blank.png", filled(60, 40, {255, 255, 255}));
    write("actual/no-baseline.png", picture);
    write("baseline/no-actual.png", picture);
    pair("unusable.png", picture);
    writeText("no picture", dir / "baseline/unusable.png");
    writeText("not compared", dir / "actual/notes.txt");
  }

  std::vector<Comparison> compared() const { return comparePictures(dir / "actual", dir / "baseline", {}); }
};

TEST_F(Directories, EveryPairHasItsVerdict) {
  const std::vector<Comparison> comparisons = compared();
  ASSERT_EQ(comparisons.size(), 7U);
  for (const Comparison& comparison : comparisons) {
    EXPECT_EQ(fs::path(comparison.name).stem().string(), verdictName(comparison.verdict));
    EXPECT_EQ(comparison.message.find('\n'), std::string::npos);
  }
  EXPECT_THAT(comparisons[1].message, testing::HasSubstr("within 60 x 40 at (0, 0)"));
}

TEST_F(Directories, ChosenPicturesBecomeBaselines) {
  std::vector<Comparison> comparisons = compared();
  EXPECT_EQ(acceptActual(comparisons, {"no-b*", "different.png", "blank.png", "unusable.png"}, {}),
            (std::vector<std::string>{"different.png", "no-baseline.png"}));
  for (const char* name : {"different.png", "no-baseline.png"})
    EXPECT_EQ(readText(dir / "actual" / name), readText(dir / "baseline" / name));
  EXPECT_NE(readText(dir / "actual/unusable.png"), readText(dir / "baseline/unusable.png"));
  std::vector<PictureVerdict> verdicts;
  for (const Comparison& comparison : comparisons) verdicts.push_back(comparison.verdict);
  EXPECT_THAT(verdicts,
              testing::ElementsAre(PictureVerdict::Blank, PictureVerdict::Equal, PictureVerdict::Equal,
                                   PictureVerdict::NoActual, PictureVerdict::Equal,
                                   PictureVerdict::SizesDiffer, PictureVerdict::Unusable));
  EXPECT_THROW(acceptActual(comparisons, {"difference.png"}, {}), Error);
}

TEST_F(Directories, WithoutPicturesNothingIsCompared) {
  fs::create_directories(dir / "none");
  EXPECT_THROW(comparePictures(dir / "none", dir / "none", {}), Error);
  EXPECT_THROW(comparePictures(dir / "absent", dir / "baseline", {}), Error);
  EXPECT_THROW(comparePictures(dir / "actual", dir / "baseline/equal.png", {}), Error);
  EXPECT_THROW(comparePictures(dir / "actual/equal.png", dir / "baseline", {}), Error);
}

TEST_F(Directories, ReportHoldsEveryPictureAndNeedsNoOtherFile) {
  write("actual/<b>&'.png", random(60, 40, 5));
  const std::string page =
      readText(writeReport(picturePage(compared(), {}, "burnish compare a b", false), dir / "report"));
  EXPECT_LT(page.find("different.png"), page.find("\"equal.png")) << "failures first";
  EXPECT_THAT(page, testing::Not(testing::ContainsRegex("https?://|src=\"|href=\"[^d]|<b>&|/\\*[a-z]*\\*/")));
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = page.find("data:image/png;base64,iVBOR", at)) != std::string::npos; ++at)
    ++pictures;
  EXPECT_EQ(pictures, 5U + 1U + 5U + 1U + 2U) << "actual, <b>, baseline, differences";
}

TEST_F(PictureFiles, DifferencePictureMarksWhatDiffers) {
  const Picture grey = filled(60, 40, {200, 200, 200});
  const Picture shown = differencePicture(withMark(grey, 10, 10, {0, 0, 0}), grey);
  EXPECT_EQ(shown.at({0.5, 0.5})[0], shown.at({0.5, 0.5})[2]) << "grey";
  EXPECT_GT(shown.at({0.5, 0.5})[0], 200);
  EXPECT_LT(shown.at({10.5, 10.5})[2], 60);
}

}  // namespace
}  // namespace burnish
