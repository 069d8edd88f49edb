#include "cli/commands/picture_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_picture.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

PictureSource sourceOfRun(const PictureArguments& arguments) {
  const auto result = std::make_shared<const ResultReader>(arguments.result);
  return {result->times(),
          [result, &arguments](const std::vector<int>& frames) {
            const ContourOptions options = contourOptions(arguments, *result, frames);
            return PictureSource::Series{options.transparent, [=](const std::vector<fs::path>& names) {
                                           drawSeries(*result, frames, options, names);
                                         }};
          },
          [result, &arguments](int first) {
            const ContourOptions own = ownOptions(arguments, *result, first);
            return PictureSource::Single{
                own, own.clip ? clipNote(*own.clip, result->model().dim) : "",
                [=](int frame, const ContourOptions& options, bool inRange, bool inWindow) {
                  return frameView(result->model(), result->frame(frame), options, inRange, inWindow);
                },
                [=](int frame, const ContourOptions& options) {
                  return contourImage(result->model(), result->frame(frame), options);
                },
                [=](int frame, const ContourOptions& options) {
                  return contourPage(result->model(), result->frame(frame), options);
                }};
          }};
}

/// Components of other programs have numbers, too.
std::string drawnField(const PictureArguments& arguments, const ForeignFile& file, int instant) {
  const std::string usual = foreignFieldToShow(file, instant);
  const std::vector<ForeignField> fields = foreignFieldsOf(file.blocks(static_cast<std::size_t>(instant)));
  const std::string numbered =
      fmt::format("{}.{}", arguments.field.empty() ? usual : arguments.field, arguments.component);
  if (!arguments.component.empty() && findForeignField(fields, numbered)) return numbered;
  return drawnField(arguments, usual, foreignFieldNames(fields));
}

/// Acts; what is wrong with a field that nobody asked for says how one is asked for.
template <class Act>
auto withChosenField(const PictureArguments& arguments, const Act& act) {
  constexpr std::string_view kField = "field: ";
  try {
    return act();
  } catch (const Error& error) {
    const std::string text = error.what();
    if (!arguments.field.empty() || !text.starts_with(kField)) throw;
    throw Error(fmt::format(
        "--field: left out, and the usual field is not in all that is drawn: {} Give one that is.",
        text.substr(kField.size())));
  }
}

/// How an instant is drawn if it shares nothing with others.
ForeignOptions ownForeignOptions(const PictureArguments& arguments, const ForeignFile& file, int instant) {
  PictureOptions picture;
  picture.warp = 0.0;  // as it stands in the file, unless something is to be added
  picture.toolOpacity = std::nan("");
  picture.range = rangeOf(arguments);
  picture.ofOthers = true;
  readPicture(arguments, picture, std::nullopt);
  if (!std::isnan(picture.toolOpacity))
    throw Error(fmt::format("--tool-opacity: only runs of burnish have tools; draw {} without it",
                            file.file().string()));
  ForeignOptions options(picture);
  options.toolOpacity = PictureOptions().toolOpacity;
  options.addedWarp = std::exchange(options.warp, 1.0);
  options.field = drawnField(arguments, file, instant);
  return options;
}

/// How these instants are drawn.
ForeignOptions foreignOptions(const PictureArguments& arguments, const ForeignFile& file,
                              const std::vector<int>& frames) {
  if (!arguments.field.empty() && file.times().size() > 1)
    requireForeignFields(file, frames, arguments.field);
  const std::vector<int> ofWindow = frames.size() > 1 ? frames : std::vector<int>();
  const ForeignOptions own = ownForeignOptions(arguments, file, frames.front());
  ForeignOptions shared = withCommonView(
      own, file, framesOfRange(arguments.range, frames, static_cast<int>(instantsOf(file).size())), ofWindow);
  if (own.clip && shared.range) shared.note = clipNote(*own.clip, std::nullopt);
  return shared;
}

PictureSource sourceOfForeign(const PictureArguments& arguments) {
  const auto file = std::make_shared<const ForeignFile>(arguments.result);
  return {instantsOf(*file),
          [file, &arguments](const std::vector<int>& frames) {
            const ForeignOptions options =
                withChosenField(arguments, [&] { return foreignOptions(arguments, *file, frames); });
            return PictureSource::Series{
                options.transparent, [=, &arguments](const std::vector<fs::path>& names) {
                  withChosenField(arguments, [&] { drawForeign(*file, frames, options, names); });
                }};
          },
          [file, &arguments](int first) {
            const ForeignOptions own = ownForeignOptions(arguments, *file, first);
            const auto with = [own](const ContourOptions& options) {
              ForeignOptions changed(own);
              static_cast<ContourOptions&>(changed) = options;
              return changed;
            };
            return PictureSource::Single{
                own, own.clip ? clipNote(*own.clip, std::nullopt) : "",
                [=, &arguments](int instant, const ContourOptions& options, bool, bool) {
                  return withChosenField(arguments,
                                         [&] { return foreignView(*file, instant, with(options)); });
                },
                [=](int instant, const ContourOptions& options) {
                  return foreignImage(*file, instant, with(options));
                },
                [=](int instant, const ContourOptions& options) {
                  return foreignPage(*file, instant, with(options));
                }};
          }};
}

}  // namespace

PictureSource pictureSource(const PictureArguments& arguments) {
  std::error_code status;
  if (fs::is_directory(arguments.result, status)) return sourceOfRun(arguments);
  if (!foreignKind(arguments.result).empty()) return sourceOfForeign(arguments);
  const fs::path file = arguments.result;
  if (fs::is_regular_file(file, status) && file.extension() != ".h5")
    throw Error(fmt::format(
        "{}: found a file with the ending \"{}\"; expected the directory of a run, its .h5 file, or a "
        "file of another program: {}",
        file.string(), file.extension().string(), fmt::join(foreignEndings(), ", ")));
  return sourceOfRun(arguments);
}

}  // namespace burnish
