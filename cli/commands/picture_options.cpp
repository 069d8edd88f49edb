#include "cli/commands/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_layout.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/page/doubt_mark.h"

namespace burnish {
namespace {

constexpr std::array kArrowFields{std::pair{"none", ArrowField::None},
                                  std::pair{"displacement", ArrowField::Displacement},
                                  std::pair{"traction", ArrowField::Traction}};

/// Components of a field of the frame, and `magnitude` if it has one.
std::vector<std::string> componentsOf(const std::string& field, const FrameRecord& frame) {
  std::vector<std::string> components;
  for (const std::string& name : fieldNames(frame)) {
    if (name.starts_with(field + ".")) components.push_back(name.substr(field.size() + 1));
    if (name == field) components.emplace_back("magnitude");
  }
  return components;
}

/// As `drawContour` has it, which knows what there is.
std::string fieldName(const PictureOptions& options, const FrameRecord& frame) {
  const std::string field = options.field.empty() ? fieldToShow(frame) : options.field;
  if (options.component.empty()) return field;
  const std::vector<std::string> components = componentsOf(field, frame);
  if (components.size() > 1 &&
      std::find(components.begin(), components.end(), options.component) == components.end())
    throw Error(fmt::format("--component: found \"{}\"; {} has {}.{}", options.component, field,
                            fmt::join(components, ", "), didYouMean(options.component, components)));
  return options.component == "magnitude" ? field : field + "." + options.component;
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

void setLook(const PictureOptions& options, ContourOptions& contour) {
  contour.theme = themeOf(options.look);
  const PictureDefaults& defaults = contour.theme.picture;
  contour.colormap = options.colormap.value_or(defaults.colormap);
  contour.bands = options.bands ? bandsFromText(*options.bands) : defaults.bands;
  contour.isolines = options.isolines.value_or(defaults.isolines);
  contour.knots = options.knots.value_or(defaults.knots);
  contour.undeformed = options.undeformed ? isOn("--undeformed", *options.undeformed) : defaults.undeformed;
  contour.tools = options.tools ? isOn("--tools", *options.tools) : defaults.tools;
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
  if (direction)
    contour.axes = viewFrom(*direction);
  else if (options.view != "auto")
    contour.axes = viewNamed(options.view, dim);
  if (!options.zoom.empty()) contour.window = windowFromText(options.zoom);
}

void setPlanes(const PictureOptions& options, ContourOptions& contour) {
  if (!options.mirror.empty()) contour.mirror = mirrorFromText(options.mirror);
  if (!options.cut.empty()) contour.cut = cutPlaneFromText("--cut", options.cut);
  if (!options.slice.empty()) contour.slice = cutPlaneFromText("--slice", options.slice);
  if (options.toolOpacity) contour.toolOpacity = *options.toolOpacity;
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
  contour.range = rangeFromText("--range", options.range, {"auto", "frame", "run"});
}

}  // namespace

ContourOptions contourOptions(const PictureOptions& options, const ResultReader& result,
                              const std::vector<int>& frames) {
  ContourOptions contour;
  setLook(options, contour);
  setSize(options, contour);
  setView(options, result.model().dim, contour);
  setPlanes(options, contour);
  contour.controlNet = options.controlNet;
  contour.arrows = chosen("--vectors", options.vectors, kArrowFields);
  contour.warp = options.warp;
  contour.title = options.title;
  if (contour.theme.picture.doubtMarks && !options.noDoubts)
    contour.doubt = doubtMarkOf(result.file().parent_path());
  if (options.subdivision > 0) contour.subdivision = options.subdivision;
  contour.field = fieldName(options, result.frame(frames.front()));
  setRange(options, result, frames, contour);
  if (frames.size() > 1 && !contour.window) contour.window = commonWindow(result, frames, contour);
  return contour;
}

}  // namespace burnish
