#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "postproc/draw/contour/contour.h"
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

  std::filesystem::path dir;
  View view;
};

}  // namespace burnish
