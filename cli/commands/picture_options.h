#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands/look_options.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"

namespace CLI {
class App;
}

namespace burnish {

/// What the options of `render` and `animate` were given.
struct PictureOptions {
  std::filesystem::path result;
  std::string frame = "last";
  std::string field, component;
  std::string range = "auto";
  std::optional<double> clip;
  /// What is not given is that of the theme.
  std::optional<std::string> colormap, bands, undeformed, tools;
  std::optional<int> isolines;
  std::optional<bool> knots;
  bool controlNet = false;
  std::string vectors = "none";
  double warp = 1.0;
  std::string view = "auto", zoom;
  std::string cut, slice, mirror;
  std::optional<double> toolOpacity;
  std::string size;
  double scale = 1.0;
  std::optional<double> textSize;
  int subdivision = 0;
  LookOptions look;
  std::string background;
  bool transparent = false;
  bool noDoubts = false;
  std::optional<std::string> title;
};

/// Adds the result and all of these options, with `frame` as it is for a default, to a command.
void addPictureOptions(CLI::App& command, PictureOptions& options);

/// How these frames are drawn. Several frames share a window and, unless something else is asked for, a range
/// of colours. Throws `Error` that names the option.
ContourOptions contourOptions(const PictureOptions& options, const ResultReader& result,
                              const std::vector<int>& frames);

}  // namespace burnish
