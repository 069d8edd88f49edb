#include "postproc/draw/contour/contour_series.h"

#include <fmt/format.h>
#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Range = std::array<double, 2>;

FieldRange rangesOf(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                    const ContourOptions& options) {
  return fieldRanges(model, frame, field, subdivisionOf(model, options), options.clip);
}

Range joined(const std::optional<Range>& a, const Range& b) {
  return a ? Range{std::min((*a)[0], b[0]), std::max((*a)[1], b[1])} : b;
}

}  // namespace

bool mayHaveNote(const ContourOptions& options) {
  return !options.note.empty() || options.warp != 1.0 || options.arrows != ArrowField::None ||
         options.slice || options.markExtremes || options.threshold || options.isosurfaces;
}

void FrameView::show(ContourParts parts, int dim, const std::optional<Eye>& eye) {
  parts.eye = eye;
  content = contentOf(parts, dim);
  nearest = nearestOf(parts);
}

ContourOptions contourOptions(const PictureOptions& picture, const ResultReader& result,
                              const FrameRecord& frame) {
  ContourOptions options(picture);
  if (options.field.empty())
    options.field =
        withShownModel(result.model(), frame, options,
                       [](const ModelRecord&, const FrameRecord& shown) { return fieldToShow(shown); });
  if (options.doubtMarks) options.doubt = doubtMarkOf(result.file().parent_path());
  options.largest = largestInRun(result, frame, options.field);
  return options;
}

double largestInRun(const ResultReader& result, const FrameRecord& frame, const std::string& field) {
  constexpr double kUnmoved = 1e-9;  // of its size
  Eigen::AlignedBox3d box;
  for (const PatchRecord& patch : result.model().mesh.patches) {
    const Eigen::Matrix3Xd points = inSpace(patch.points);
    box.extend(Eigen::Vector3d(points.rowwise().minCoeff()));
    box.extend(Eigen::Vector3d(points.rowwise().maxCoeff()));
  }
  if (frame.displacement.cwiseAbs().maxCoeff() > kUnmoved * box.diagonal().norm()) return 0.0;
  const double own = magnitudeOf(chooseField(result.model(), frame, field));
  if (own == 0.0) return 0.0;
  constexpr int kMost = 16;  // frames that are read
  const int last = result.numFrames() - 1, step = 1 + last / kMost;
  for (int k = last; k >= 0; k -= step) {
    const FrameRecord record = result.frame(k);
    const std::vector<std::string> names = fieldNames(record);
    if (std::ranges::find(names, field) == names.end()) continue;
    const double other = magnitudeOf(chooseField(result.model(), record, field));
    if (own < kRounding * other) return other;
  }
  return 0.0;
}

FieldRange shownRanges(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options) {
  return withShownModel(model, frame, options, [&](const ModelRecord& wholeModel, const FrameRecord& whole) {
    return rangesOf(wholeModel, whole, chooseField(wholeModel, whole, options.field), options);
  });
}

void requireSameUnit(const char* key, const std::string& one, const std::string& other, const char* remedy) {
  const auto words = [](const std::string& unit) { return unit.empty() ? "without a unit" : "in " + unit; };
  if (one != other)
    throw Error(fmt::format("{}: found values {} and {}, which cannot have one range of colours; {}", key,
                            words(one), words(other), remedy));
}

void shareView(ContourOptions& options, const std::vector<int>& ofRange, const std::vector<int>& ofWindow,
               const std::function<FrameView(int frame, bool inRange, bool inWindow)>& look) {
  std::set<int> inRange, inWindow;
  if (!options.range) inRange.insert(ofRange.begin(), ofRange.end());
  const bool isGiven = options.window.has_value();
  if (!isGiven || options.perspective) inWindow.insert(ofWindow.begin(), ofWindow.end());
  const std::set<int> together(ofWindow.begin(), ofWindow.end());
  std::set<int> frames = inRange;
  frames.insert(together.begin(), together.end());
  SharedRoom room{.extremes = {}, .note = !options.note.empty(), .doubt = !options.doubt.empty()};
  std::optional<Range> range;
  std::vector<Range> seen;  // the extremes of all of them
  std::string unit;
  Eigen::AlignedBox2d window;
  double nearest = -HUGE_VAL;
  for (const int k : frames) {
    throwIfInterrupted();
    const FrameView view = look(k, inRange.contains(k), inWindow.contains(k));
    if (inRange.contains(k) && view.shown) {
      if (range) requireSameUnit("range", unit, view.unit, "take frame, which gives each its own");
      unit = view.unit;
      range = joined(range, *view.shown);
    }
    if (view.extremes) seen.push_back(*view.extremes);
    if (together.contains(k)) {
      room.note = room.note || view.hasNote;
      room.gaps = room.gaps || view.hasGaps;
      room.addArrows(view.passed);
      if (view.extremes) room.extremes.push_back(*view.extremes);
    }
    if (!inWindow.contains(k)) continue;
    window.extend(view.content);
    nearest = std::max(nearest, view.nearest);
  }
  for (const Range& extremes : seen)
    options.largest = std::max({options.largest, std::abs(extremes[0]), std::abs(extremes[1])});
  for (Range& extremes : room.extremes)
    if (std::max(std::abs(extremes[0]), std::abs(extremes[1])) < kRounding * options.largest)
      extremes = {0.0, 0.0};
  if (range) {
    options.range = widened(*range);
    options.clip.reset();  // it is in the range
  }
  room.otherRanges = !options.range;
  if (!together.empty()) options.room = room;
  if (inWindow.empty()) return;
  if (options.perspective) {
    options.eye = eyeAt(*options.perspective, window, nearest);
    window.setEmpty();  // an eye sees less of what is farther away
    for (const int k : inWindow)
      if (!isGiven) window.extend(look(k, false, true).content);
  }
  if (!isGiven) options.window = window;
}

FrameView frameView(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                    bool inRange, bool inWindow) {
  return withShownModel(model, frame, options, [&](const ModelRecord& shownModel, const FrameRecord& shown) {
    FieldChoice field = chooseField(shownModel, shown, options.field);
    dropRounding(field, options.largest);
    FrameView view;
    const FieldRange ranges = rangesOf(shownModel, shown, field, options);
    if (inRange) view.shown = ranges.shown;
    view.extremes = ranges.whole;
    view.passed = endsPassed(options.range.value_or(ranges.shown), ranges.whole);
    const bool hasOwnEnds = options.clip && !inRange && ranges.shown != ranges.whole;
    view.hasNote =
        hasOwnEnds || mayHaveNote(options) || !bodiesWithout(shownModel, shown, options.field).empty();
    view.unit = field.unit;
    if (inWindow) view.show(contourParts(shownModel, shown, field, options), shownModel.dim, options.eye);
    return view;
  });
}

ContourOptions withCommonView(ContourOptions options, const ResultReader& result,
                              const std::vector<int>& ofRange, const std::vector<int>& ofWindow) {
  shareView(options, ofRange, ofWindow, [&](int k, bool inRange, bool inWindow) {
    return frameView(result.model(), result.frame(k), options, inRange, inWindow);
  });
  return options;
}

void drawInTurn(const std::vector<std::filesystem::path>& names,
                const std::function<ContourImage(std::size_t number)>& draw) {
  vtkSmartPointer<vtkImageData> picture;  // outlives its writing
  std::future<void> writing;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const ContourImage next = draw(k);
    if (writing.valid()) writing.get();
    picture = next.picture;
    writing = std::async(std::launch::async, [&picture, &name = names[k]] { writePng(*picture, name); });
  }
  if (writing.valid()) writing.get();
}

void drawSeries(const ResultReader& result, const std::vector<int>& frames, const ContourOptions& options,
                const std::vector<std::filesystem::path>& names) {
  if (isPrintFile(names.front())) {
    for (std::size_t k = 0; k < names.size(); ++k)
      drawContour(result.model(), result.frame(frames[k]), options, names[k]);
    return;
  }
  drawInTurn(names,
             [&](std::size_t k) { return contourImage(result.model(), result.frame(frames[k]), options); });
}

}  // namespace burnish
