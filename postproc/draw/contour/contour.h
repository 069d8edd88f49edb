#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/draw/page/view.h"

class vtkImageData;

namespace burnish {

/// What each of the pictures that stand together leaves room for, so that body and scale have one place in all of them.
struct SharedRoom {
  std::vector<std::array<double, 2>> extremes;  ///< the smallest and the largest value of each
  bool note = false, doubt = false;             ///< whether there is such a text in one of them
  bool otherRanges = false;                     ///< whether scales may have other numbers at their ticks
  bool gaps = false;                            ///< whether one of them has places without values
  std::array<bool, 2> arrows{};  ///< whether values of one pass the lower or the upper end of its own scale

  /// Room for arrows at the ends that values of one more picture pass.
  void addArrows(const std::array<bool, 2>& passed) {
    for (std::size_t end = 0; end < 2; ++end) arrows[end] = arrows[end] || passed[end];
  }
};

/// A contour picture: its options, and what whoever draws it writes beside the body.
struct ContourOptions : PictureOptions {
  ContourOptions() = default;
  ContourOptions(const PictureOptions& options) : PictureOptions(options) {}

  std::string note;                     ///< small text below the body; may be empty
  std::string doubt;                    ///< the same in the lower left corner; see `doubtMarkOf`
  bool time = true;                     ///< write the time of the frame
  bool colorScale = true;               ///< draw the colour scale, at the right of the body or below
  bool lengthAxes = false;              ///< of a plane body, along its box
  std::optional<Eigen::Vector3d> mark;  ///< a place with a ring round it
  std::optional<Eye> eye;               ///< of perspective pictures that stand together; see `eyeOf`
  std::optional<SharedRoom> room;       ///< of pictures that stand together
  double largest = 0.0;  ///< magnitude that the field reaches in the run, if it is known; see `dropRounding`
  double pointsPerPixel = 1.0;  ///< of the paper, where a picture for print stands on a larger page
};

/// A picture in memory, RGB or, transparent, RGBA, lowest row first.
struct ContourImage {
  vtkSmartPointer<vtkImageData> picture;
  View view;  ///< how positions became pixels
};

/// Draws as `drawContour`, into memory.
ContourImage contourImage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options);

/// Draws a field on the deformed body, the tools, a colour scale and a caption into a file, which appears under
/// its name only when it is complete: PNG, or for print PDF or SVG, by its ending. For print pixels are points of
/// 1/72 inch; areas of space, and all that is drawn of a body in space, are an image of `dpi`, and the rest is
/// vectors and text. Returns how positions became pixels. Throws `Error` for an
/// unknown field, option values out of range or that exclude each other, a plane that is none of symmetry or
/// misses the body, a field that is not finite, a missing font and a file that cannot be written.
View drawContour(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                 const std::filesystem::path& file);

/// The page that `drawContour` writes for print.
PrintPage contourPage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options);

/// Draws nothing but the colour scale that pictures of a range share, across in the middle of a picture as wide
/// as `options.size` and as high as it needs. options: of one of the pictures. values: the smallest and the
/// largest one of all of them. Throws `Error` for an unknown field, a missing font and a file that cannot be
/// written.
void drawColorScale(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                    const std::array<double, 2>& values, const std::filesystem::path& png);

/// The same for print.
PrintPage colorScalePage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                         const std::array<double, 2>& values);

/// The part of the view's plane that a picture without a `window` shows: body, outline and tools. The union
/// over frames is a window in which they can be compared.
Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options);

}  // namespace burnish
