#include "cli/picture_options.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "postproc/draw/color_range.h"
#include "postproc/draw/contour_layout.h"
#include "postproc/draw/contour_series.h"
#include "postproc/draw/contour_view.h"
#include "postproc/draw/field_choice.h"

namespace burnish {
namespace {

constexpr std::array kArrowFields{std::pair{"none", ArrowField::None},
                                  std::pair{"displacement", ArrowField::Displacement},
                                  std::pair{"traction", ArrowField::Traction}};

/// As `drawContour` has it, which knows what there is.
std::string fieldName(const PictureOptions& options, const FrameRecord& frame) {
  const std::string field = options.field.empty() ? fieldToShow(frame) : options.field;
  const bool whole = options.component.empty() || options.component == "magnitude";
  return whole ? field : field + "." + options.component;
}

void setSize(const PictureOptions& options, ContourOptions& contour) {
  if (!options.size.empty()) contour.size = sizeFromText(options.size);
  contour.textSize = options.textSize;
  if (options.scale == 1.0) return;
  if (!(options.scale >= 0.25 && options.scale <= 10.0))
    throw Error(fmt::format("--scale: found {}; expected 0.25 to 10", options.scale));
  contour.textSize =
      options.scale * contour.textSize.value_or(contour.theme.textSize * textSizeFor(contour.size));
  for (int& side : contour.size) side = static_cast<int>(std::lround(options.scale * side));
}

void setColors(const PictureOptions& options, ContourOptions& contour) {
  contour.colormap = options.colormap;
  contour.bands = bandsFromText(options.bands);
  contour.theme = themeNamed(options.theme);
  contour.transparent = options.transparent;
  if (options.background.empty()) return;
  if (options.transparent) throw Error("--background and --transparent exclude each other");
  contour.theme.paper = colorFromText("--background", options.background);
}

void setView(const PictureOptions& options, int dim, ContourOptions& contour) {
  const auto direction = directionFromText(options.view);
  if (direction && dim == 2)
    throw Error(
        fmt::format("--view: found {}; a plane body is only seen in its plane: auto or xy", options.view));
  contour.axes = direction ? viewFrom(*direction) : viewNamed(options.view, dim);
  if (!options.zoom.empty()) contour.window = windowFromText(options.zoom);
}

void setRange(const PictureOptions& options, const ResultReader& result, const std::vector<int>& frames,
              ContourOptions& contour) {
  if (options.clip && !(*options.clip > 50.0 && *options.clip <= 100.0))
    throw Error(fmt::format("--clip: found {}; expected a percentile above 50, up to 100", *options.clip));
  contour.clip = options.clip;
  const bool ofRun = options.range == "run";
  if (options.range == "frame" || (options.range == "auto" && frames.size() == 1)) return;
  if (ofRun || options.range == "auto") {
    std::vector<int> all(static_cast<std::size_t>(result.numFrames()));
    std::iota(all.begin(), all.end(), 0);
    contour.range = commonRange(result, ofRun ? all : frames, contour);
    if (contour.clip) contour.note = clipNote(*contour.clip, result.model().dim);
    contour.clip.reset();
    return;
  }
  if (options.clip) throw Error("--clip and --range both say where the colours end; give one of them");
  contour.range = rangeFromText(options.range);
}

}  // namespace

ContourOptions contourOptions(const PictureOptions& options, const ResultReader& result,
                              const std::vector<int>& frames) {
  ContourOptions contour;
  setColors(options, contour);
  setSize(options, contour);
  setView(options, result.model().dim, contour);
  contour.isolines = options.isolines;
  contour.knots = options.knots;
  contour.controlNet = options.controlNet;
  contour.undeformed = isOn("--undeformed", options.undeformed);
  contour.tools = isOn("--tools", options.tools);
  contour.arrows = chosen("--vectors", options.vectors, kArrowFields);
  contour.warp = options.warp;
  contour.title = options.title;
  if (options.subdivision > 0) contour.subdivision = options.subdivision;
  contour.field = fieldName(options, result.frame(frames.front()));
  setRange(options, result, frames, contour);
  if (frames.size() > 1 && !contour.window) contour.window = commonWindow(result, frames, contour);
  return contour;
}

}  // namespace burnish
