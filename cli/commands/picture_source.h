#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "cli/commands/picture_options.h"
#include "postproc/draw/contour/contour_series.h"

namespace burnish {

/// What `render`, `animate` and `sheet` draw: a run, or a file of another program.
struct PictureSource {
  std::vector<double> times;  ///< of the frames

  /// Frames as they are drawn together.
  struct Series {
    bool isTransparent = false;
    std::function<void(const std::vector<std::filesystem::path>& names)> draw;
  };
  /// Throws `Error` that names the option.
  std::function<Series(const std::vector<int>& frames)> series;

  /// Frames that are drawn one by one, with options that are these or have more in common with other pictures.
  struct Single {
    ContourOptions options;
    std::string clipNote;  ///< of colours that end at percentiles together with others; may be empty
    std::function<FrameView(int frame, const ContourOptions& options, bool inRange, bool inWindow)> look;
    std::function<ContourImage(int frame, const ContourOptions& options)> image;
    std::function<PrintPage(int frame, const ContourOptions& options)> page;
  };
  /// first: of the frames. Throws `Error` that names the option.
  std::function<Single(int first)> single;
};

/// The arguments must outlive the source. Throws `Error` for what cannot be read.
PictureSource pictureSource(const PictureArguments& arguments);

}  // namespace burnish
