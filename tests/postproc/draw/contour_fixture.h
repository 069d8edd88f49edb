#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "tests/postproc/picture.h"
#include "tests/postproc/sample_records.h"

namespace burnish {

inline constexpr int kColorTolerance = 6;  // of 255: interpolation between two colours of a fine scale

/// Draws contour pictures of samples in a directory of its own, and looks at their pixels.
class ContourPictures : public testing::Test {
 protected:
  void SetUp() override {
    dir = std::filesystem::temp_directory_path() / ("burnish_image_" + std::to_string(::getpid()));
    std::filesystem::create_directories(dir);
  }
  void TearDown() override { std::filesystem::remove_all(dir); }

  static ContourOptions small(const std::string& field) {
    ContourOptions options;
    options.field = field;
    options.size = {400, 300};
    return options;
  }

  Picture drawn(const samples::Sample& sample, const ContourOptions& options) {
    view = drawContour(sample.model, sample.frame, options, dir / "drawn.png");
    return readPicture(dir / "drawn.png");
  }

  /// Draws, then compares with images/baseline/NAME.png.
  Picture expectBaseline(const samples::Sample& sample, const ContourOptions& options,
                         const std::string& name) {
    Picture picture = drawn(sample, options);
    burnish::expectBaseline(dir / "drawn.png", name);
    return picture;
  }

  void expectColor(const Picture& picture, const Eigen::VectorXd& position, const Color& expected) const {
    const Color found = picture.at(view.pixel(position));
    EXPECT_LE(difference(found, expected), kColorTolerance)
        << "at " << position.transpose() << ": found " << testing::PrintToString(found) << ", expected "
        << testing::PrintToString(expected);
  }

  /// What the error says that the picture ends with.
  static void expectRefused(const samples::Sample& sample, const ContourOptions& options,
                            const std::string& part) {
    try {
      contourImage(sample.model, sample.frame, options);
      ADD_FAILURE() << "no error that says \"" << part << "\"";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(part));
    }
  }

  /// A picture of 900 x 700 in one piece, and in strips.
  void expectStripsAlike(const samples::Sample& sample, const ContourOptions& options) {
    const Picture whole = drawn(sample, options);
    OffscreenCanvas::saveMemory();
    const Picture strips = drawn(sample, options);
    int different = 0;
    for (int x = 0; x < 900; ++x)
      for (int y = 0; y < 700; ++y)
        if (difference(whole.at({x + 0.5, y + 0.5}), strips.at({x + 0.5, y + 0.5})) > 2) ++different;
    EXPECT_LE(different, 20);
  }

  std::filesystem::path dir;
  View view;
};

}  // namespace burnish
