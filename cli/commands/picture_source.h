#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "cli/commands/picture_options.h"

namespace burnish {

/// What `render` and `animate` draw: a run, or a file of another program.
struct PictureSource {
  std::vector<double> times;  ///< of the frames

  /// Frames as they are drawn together.
  struct Series {
    bool isTransparent = false;
    std::function<void(const std::vector<std::filesystem::path>& names)> draw;
  };
  /// Throws `Error` that names the option.
  std::function<Series(const std::vector<int>& frames)> series;
};

/// The arguments must outlive the source. Throws `Error` for what cannot be read.
PictureSource pictureSource(const PictureArguments& arguments);

}  // namespace burnish
