#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/mirror.h"
#include "postproc/mesh/plane_section.h"

class vtkImageData;

namespace burnish {

/// What the arrows of a picture show: displacements on the body, or what tools do to its contact faces.
enum class ArrowField { None, Displacement, Traction };

/// What a contour picture shows. The names are those of the scene's `pictures`.
struct ContourOptions {
  std::string field;  ///< `plastic_strain`, `stress.xx`, …; a vector alone: magnitude
  std::optional<std::array<double, 2>> range;  ///< ends of the colour scale; smallest and largest value shown
  /// Instead of a range: the colours end at this percentile p, (50, 100], and at the (100-p)th; see
  /// `fieldRange`.
  std::optional<double> clip;
  std::array<int, 2> size{1600, 900};  ///< pixels
  int bands = 0;                       ///< number of colour bands, 0: smooth
  std::string colormap = "viridis";    ///< one of `colormapNames()`
  int isolines = 0;                    ///< number of lines at equal distances in the range, up to 100
  bool knots = false;                  ///< draw the lines between knot spans
  bool controlNet = false;             ///< draw the control points and the lines between them
  bool undeformed = true;              ///< draw the outline of the undeformed body
  bool tools = true;
  double toolOpacity = 0.3;         ///< of the tools in space, 1: hides what is behind
  std::vector<MirrorPlane> mirror;  ///< planes of symmetry, beyond which the images are drawn too
  std::optional<CutPlane> cut;      ///< in space: what is on the eye's side of it is left out
  std::optional<CutPlane> slice;    ///< in space: only the section, seen against its normal
  ArrowField arrows = ArrowField::None;
  double warp = 1.0;                 ///< factor on the displacements of body and tools; values keep theirs
  std::optional<std::string> title;  ///< instead of the model's; empty: none
  std::string note;                  ///< small text below the body; may be empty
  std::string doubt;                 ///< the same in the lower left corner; see `doubtMarkOf`
  bool time = true;                  ///< write the time of the frame
  std::optional<double> textSize;    ///< in pixels, [6, 200]; follows from the picture's size when left out
  std::optional<Eigen::AlignedBox2d> window;  ///< of the view's plane, that must be seen; see `contentOf`
  std::optional<int> subdivision;             ///< cells per knot span and direction, instead of the model's
  std::optional<ViewAxes> axes;  ///< instead of `viewNamed("auto")`, of a slice: instead of along its normal
  Theme theme;
  bool transparent = false;  ///< no paper: the picture has an alpha channel
};

/// A picture in memory, RGB or, transparent, RGBA, lowest row first.
struct ContourImage {
  vtkSmartPointer<vtkImageData> picture;
  View view;  ///< how positions became pixels
};

/// Draws as `drawContour`, into memory.
ContourImage contourImage(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options);

/// Draws a field on the deformed body, the tools, a colour scale and a caption into a PNG file, which appears
/// under its name only when it is complete. Returns how positions became pixels. Throws `Error` for an
/// unknown field, option values out of range or that exclude each other, a plane that is none of symmetry or
/// misses the body, a field that is not finite, a missing font and a file that cannot be written.
View drawContour(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                 const std::filesystem::path& png);

/// The part of the view's plane that a picture without a `window` shows: body, outline and tools. The union
/// over frames is a window in which they can be compared.
Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options);

}  // namespace burnish
