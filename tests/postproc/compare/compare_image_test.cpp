#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/results/result_writer.h"
#include "postproc/compare/comparison.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/sample_records.h"
#include "tests/postproc/spoiled_pictures.h"

/// The default threshold on pictures of the project: what nobody sees stays below half of it, what a
/// picture must not lose or change is above twice of it. docs/image-regression.md has the numbers.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;

double value(const Picture& actual, const Picture& baseline) {
  EXPECT_EQ(actual.width, baseline.width);
  EXPECT_EQ(actual.height, baseline.height);
  return metricValue(Metric::Ssim, differenceOf(actual, baseline));
}

void expectOverlooked(const Picture& actual, const Picture& baseline, const std::string& what) {
  EXPECT_LT(value(actual, baseline), PictureRule{}.threshold / 2.0) << what;
}

void expectNoticed(const Picture& actual, const Picture& baseline, const std::string& what) {
  EXPECT_GT(value(actual, baseline), PictureRule{}.threshold * 2.0) << what;
}

TEST(Baselines, NoiseIsOverlookedAndAMarkIsNoticed) {
  int count = 0;
  for (const auto& file : fs::directory_iterator(fs::path(BURNISH_SOURCE_DIR) / "images" / "baseline")) {
    const Picture baseline = readPicture(file.path());
    const std::string name = file.path().filename().string();
    EXPECT_EQ(value(baseline, baseline), 0.0) << name;
    expectOverlooked(withNoise(baseline), baseline, name);
    const int i = baseline.width / 2, j = baseline.height / 2;
    expectNoticed(withMark(baseline, i, j, {40, 40, 40}), baseline, name);
    const Color black{0, 0, 0};
    expectNoticed(withLine(baseline, i + 4, black), withLine(baseline, i, black), name + ", a moved line");
    ++count;
  }
  EXPECT_GE(count, 10);
}

class ContourPairs : public testing::TestWithParam<std::array<int, 3>> {
 protected:
  void SetUp() override {
    options.field = "plastic_strain";
    options.size = {GetParam()[0], GetParam()[1]};
    options.bands = GetParam()[2];
    fs::create_directories(dir);
  }
  void TearDown() override { fs::remove_all(dir); }

  Picture drawn(const Sample& sample, const ContourOptions& chosen) const {
    drawContour(sample.model, sample.frame, chosen, dir / "drawn.png");
    return readPicture(dir / "drawn.png");
  }

  ContourOptions options;
  fs::path dir = fs::temp_directory_path() / ("burnish_pairs_" + std::to_string(::getpid()));
};

TEST_P(ContourPairs, NothingButNoiseIsOverlooked) {
  const Sample sample = samples::slab();
  const Picture right = drawn(sample, options);
  EXPECT_EQ(value(drawn(sample, options), right), 0.0);
  expectOverlooked(withNoise(right), right, "noise");
}

/// Smallest and largest value stay, so that nothing but the colours in between changes.
TEST_P(ContourPairs, FieldShiftedByTwoPercentIsNoticed) {
  Sample sample = samples::slab();
  const Picture right = drawn(sample, options);
  auto values = sample.frame.fields["plastic_strain"].values.array();
  values += 4.0 * 0.02 * values * (1.0 - values);
  expectNoticed(drawn(sample, options), right, "shifted");
}

TEST_P(ContourPairs, OtherColoursAndMissingPartsAreNoticed) {
  const Sample sample = samples::slab();
  const Picture right = drawn(sample, options);
  expectNoticed(withMark(right, right.width / 2, right.height / 2, {40, 40, 40}), right, "mark");
  for (const std::string colormap : {"coolwarm", "rainbow", "grey"}) {
    ContourOptions other = options;
    other.colormap = colormap;
    expectNoticed(drawn(sample, other), right, colormap);
  }
  Sample withoutTool = sample;
  withoutTool.model.tools.clear();
  expectNoticed(drawn(withoutTool, options), right, "without tool");
  ContourOptions withoutOutline = options, withoutTitle = options, withoutTime = options;
  withoutOutline.undeformed = false;
  expectNoticed(drawn(sample, withoutOutline), right, "without outline");
  withoutTitle.title = " ";
  expectNoticed(drawn(sample, withoutTitle), right, "without title");
  withoutTime.time = false;
  expectNoticed(drawn(sample, withoutTime), right, "without time");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ContourPairs,
                         testing::Values(std::array{400, 300, 0}, std::array{400, 300, 8},
                                         std::array{1600, 900, 0}, std::array{1600, 900, 8}));

TEST(Determinism, SameBytesWithAnyNumberOfThreads) {
  const fs::path dir = fs::temp_directory_path() / ("burnish_threads_" + std::to_string(::getpid()));
  for (const bool threeDimensions : {false, true}) {
    const Sample sample = threeDimensions ? samples::cube() : samples::slab();
    const std::string field = threeDimensions ? "pressure" : "plastic_strain";
    ResultWriter(dir / field, sample.model).append(sample.frame);
    std::vector<std::string> bytes;
    for (const std::string threads :
         {"LP_NUM_THREADS=0 OMP_NUM_THREADS=1 VTK_SMP_MAX_THREADS=1", "LP_NUM_THREADS=1 OMP_NUM_THREADS=2",
          "LP_NUM_THREADS=5 OMP_NUM_THREADS=7"}) {
      const fs::path picture = dir / "drawn.png";
      const std::string line = threads + " " BURNISH_COMMAND " render " + (dir / field).string() +
                               " --field " + field + " --size 640,480 -o " + picture.string();
      ASSERT_EQ(std::system(line.c_str()), 0) << line;
      bytes.push_back(readText(picture));
      EXPECT_EQ(bytes.back(), bytes.front()) << threads;
    }
  }
  fs::remove_all(dir);
}

}  // namespace
}  // namespace burnish
