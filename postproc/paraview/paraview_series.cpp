#include "postproc/paraview/paraview_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/same_time.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/field_colors.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/text_file.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

/// The picture without what a state does not have.
ContourOptions shownWhole(const PictureOptions& picture) {
  ContourOptions options(picture);
  options.cut.reset();
  options.slice.reset();
  options.mirror.clear();
  options.perspective.reset();
  options.threshold.reset();
  options.isosurfaces.reset();
  options.cutFace = CutFace::Field;
  options.arrows = ArrowField::None;
  options.warp = 1.0;
  options.controlNet = options.knots = options.markExtremes = options.undeformed = false;
  return options;
}

/// The array of the files that a field shows, and its component.
std::pair<std::string, std::string> arrayOf(const FieldChoice& field) {
  if (isContactField(field.name)) {
    const ContactArray array = arrayOfContactField(field.name);
    return {labelled(array.name, field.unit), array.isVector ? "Magnitude" : ""};
  }
  const std::size_t dot = field.name.find('.');
  const std::string array = field.name.substr(0, dot);
  std::string component = dot == std::string::npos ? "" : field.name.substr(dot + 1);
  if (array == "displacement") {
    if (component.empty()) return {labelled(array, field.unit), "Magnitude"};
    component[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(component[0])));
  }
  return {labelled(array, field.unit), component};
}

}  // namespace

ParaViewSeries::ParaViewSeries(std::filesystem::path directory, ModelRecord model, const VtuOptions& options,
                               const PictureOptions& picture, std::vector<double> times)
    : directory_(std::move(directory)),
      series_(directory_, std::move(model), options),
      options_(shownWhole(picture)),
      times_(std::move(times)),
      isCurved_(options.cells != CellKind::Linear) {
  std::error_code error;
  std::filesystem::remove(directory_ / "frames.py", error);
  if (error)
    throw Error(fmt::format("cannot remove {}: {}", (directory_ / "frames.py").string(), error.message()));
}

void ParaViewSeries::write(const FrameRecord& frame) {
  series_.write(frame);
  frames_.erase(frames_.lower_bound(frame.index), frames_.end());
  try {
    look(frame);
  } catch (const Error&) {
    // The files hold the frame as it is; a picture that cannot be drawn of it is told of where it is drawn.
  }
  writeText(textOf(script()), directory_ / "frames.py");
}

void ParaViewSeries::look(const FrameRecord& all) {
  const ModelRecord& whole = series_.model();
  withShownModel(whole, all, options_, [&](const ModelRecord& model, const FrameRecord& frame) {
    if (options_.field.empty()) options_.field = fieldToShow(frame);
    FieldChoice field = chooseField(model, frame, options_.field);
    const ContourParts parts = contourParts(model, frame, field, options_);
    const FieldRange range = fieldRanges(model, frame, field, subdivisionOf(model, options_), options_.clip);
    frames_[frame.index] = {frame.time, range.shown, contentOf(parts, model.dim), parts.box};
    axes_ = parts.axes;
    without_ = bodiesWithout(whole, all, field.name);
    field.coefficients.resize(0, 0);
    field.faces = nullptr;
    field_ = std::move(field);
  });
}

std::vector<std::string>& ParaViewSeries::listFor(const SeriesBlock& block, StateScript& script) const {
  const bool ofContact = field_ && isContactField(field_->name);
  const auto isAmong = [&](const std::vector<std::string>& bodies) {
    return block.body && std::ranges::find(bodies, series_.model().bodies[*block.body]) != bodies.end();
  };
  switch (block.kind) {
    case ExportPart::Body:
      if (!options_.bodies.empty() && !isAmong(options_.bodies)) return script.hidden;
      return field_ && !ofContact && !isAmong(without_) ? script.colored : script.plain;
    case ExportPart::Tools:
      return options_.tools ? script.tools : script.hidden;
    case ExportPart::Contact:
      return ofContact ? script.colored : script.hidden;
    case ExportPart::Knots:
      if (!options_.bodies.empty() && !isAmong(options_.bodies)) return script.hidden;
      return script.knots;
    case ExportPart::Points:
    case ExportPart::Net:
      break;
  }
  return script.hidden;
}

std::optional<double> ParaViewSeries::timeOfPicture() const {
  std::optional<double> last;
  for (const auto& [index, shown] : frames_)
    if (std::ranges::any_of(times_, [&](double time) { return isSameTime(shown.time, time); }))
      last = shown.time;
  return last;
}

StateScript ParaViewSeries::script() const {
  StateScript script;
  script.time = timeOfPicture();
  for (const SeriesBlock& block : series_.blocks()) listFor(block, script).push_back(block.name);
  if (field_) {
    std::array<double, 2> range = frames_.empty() ? std::array{0.0, 0.0} : frames_.begin()->second.range;
    for (const auto& [index, shown] : frames_)
      range = {std::min(range[0], shown.range[0]), std::max(range[1], shown.range[1])};
    ContourOptions options = options_;
    if (!options.range) options.range = widened(range);
    const auto [array, component] = arrayOf(*field_);
    script.field.emplace(array, component, withUnit(field_->words, field_->unit),
                         colorScaleOf(*field_, options, *options.range), field_->states);
  }
  for (const auto& [index, shown] : frames_) {
    script.window.extend(shown.content);
    script.box.extend(shown.box);
  }
  if (options_.window) script.window = *options_.window;
  script.axes = axes_;
  script.size = drawnSize(options_);
  script.theme = themeOf(options_);
  script.toolOpacity = options_.toolOpacity;
  script.isFlat = series_.model().dim == 2;
  script.isCurved = isCurved_;
  return script;
}

}  // namespace burnish
