#include "cli/commands/picture_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/shown_model.h"

namespace burnish {
namespace {

/// Components of a field among these names, and `magnitude` if it has one.
std::vector<std::string> componentsOf(const std::string& field, const std::vector<std::string>& names) {
  std::vector<std::string> components;
  for (const std::string& name : names) {
    if (name.starts_with(field + ".")) components.push_back(name.substr(field.size() + 1));
    if (name == field) components.emplace_back("magnitude");
  }
  return components;
}

void throwFirst(const std::vector<InputProblem>& problems) {
  if (!problems.empty())
    throw Error(fmt::format("{}: {}", optionName(problems.front().path), problems.front().text));
}

}  // namespace

std::string drawnField(const PictureArguments& arguments, const std::string& usual,
                       const std::vector<std::string>& names) {
  const std::string field = arguments.field.empty() ? usual : arguments.field;
  const std::vector<std::string> components = componentsOf(field, names);
  if (arguments.component.empty() || components.empty()) return field;
  const std::string words =
      arguments.field.empty() ? fmt::format("{}, which is drawn without --field,", field) : field;
  if (components.size() > 1 &&
      std::find(components.begin(), components.end(), arguments.component) == components.end())
    throw Error(fmt::format("--component: found \"{}\"; {} has {}.{}", arguments.component, words,
                            fmt::join(components, ", "), didYouMean(arguments.component, components)));
  if (components.size() == 1 && arguments.component != components.front())
    throw Error(fmt::format("--component: found \"{}\"; {} is one number at each place, without components",
                            arguments.component, words));
  return arguments.component == "magnitude" ? field : field + "." + arguments.component;
}

void requireNoConflicts(const PictureOptions& options, std::optional<int> dim) {
  throwFirst(conflictsIn(options, dim));
}

void requireNoPrintOptions(const DeclaredOptions& picture) {
  PrintOptions print;
  picture.readInto(print);
  throwFirst(printOptionsOfPixels(print));
}

void readPicture(const PictureArguments& arguments, PictureOptions& options, std::optional<int> dim) {
  if (arguments.isForPrint) options.size = kPrintSize;
  arguments.picture.readInto(static_cast<PrintOptions&>(options));
  readPicture(arguments.picture, options, dim);
  if (arguments.isForPrint) throwFirst(printConflictsIn(options));
}

void addPictureArguments(CLI::App& command, PictureArguments& arguments) {
  command
      .add_option(
          "RESULT", arguments.result,
          "Directory of a run or the result file in it, or a file of another program: VTK, Exodus, CGNS, ...")
      ->required();
  addFieldArguments(command, arguments);
  addPictureOptions(command, arguments.picture, PictureOptions{});
}

void addFieldArguments(CLI::App& command, PictureArguments& arguments) {
  command
      .add_option(
          "--frame", arguments.frame,
          fmt::format(
              "Number of the frame, last or end, or time=T; for several A-B, all, or a list with commas [{}]",
              arguments.frame))
      ->type_name("N|A-B|all|last|time=T");
  command
      .add_option("--field", arguments.field,
                  "displacement, plastic_strain, von_mises, stress.xx, ..., pressure, contact_pressure, ... "
                  "[plastic_strain or von_mises]")
      ->type_name("FIELD");
  command
      .add_option("--component", arguments.component,
                  "Component of the field: x, xx, ...; of a vector also magnitude")
      ->type_name("COMPONENT");
  command
      .add_option("--range", arguments.range,
                  "Values at the ends of the colour scale: those of the frame, of the whole run, or given; "
                  "auto: of all frames that are drawn [auto]")
      ->type_name("auto|frame|run|LO,HI");
}

std::optional<std::array<double, 2>> rangeOf(const PictureArguments& arguments) {
  const std::vector<std::string> words{"auto", "frame", "run"};
  if (std::find(words.begin(), words.end(), arguments.range) != words.end()) return std::nullopt;
  return rangeFromText("--range", arguments.range, words);
}

std::vector<int> framesOfRange(const std::string& range, const std::vector<int>& frames, int all) {
  if (range == "frame" || (range == "auto" && frames.size() == 1)) return {};
  if (range == "auto") return frames;
  std::vector<int> whole(static_cast<std::size_t>(all));
  std::iota(whole.begin(), whole.end(), 0);
  return whole;
}

ContourOptions ownOptions(const PictureArguments& arguments, const ResultReader& result, int frame) {
  const FrameRecord record = result.frame(frame);
  PictureOptions picture;
  picture.range = rangeOf(arguments);
  readPicture(arguments, picture, result.model().dim);
  picture.field =
      withShownModel(result.model(), record, picture, [&](const ModelRecord&, const FrameRecord& shown) {
        return drawnField(arguments, fieldToShow(shown), fieldNames(shown));
      });
  return contourOptions(picture, result, record);
}

ContourOptions contourOptions(const PictureArguments& arguments, const ResultReader& result,
                              const std::vector<int>& frames) {
  const ContourOptions own = ownOptions(arguments, result, frames.front());
  const std::vector<int> ofRange = framesOfRange(arguments.range, frames, result.numFrames());
  const std::vector<int> ofWindow = frames.size() > 1 ? frames : std::vector<int>();
  ContourOptions contour = withCommonView(own, result, ofRange, ofWindow);
  if (own.clip && contour.range) contour.note = clipNote(*own.clip, result.model().dim);
  return contour;
}

}  // namespace burnish
