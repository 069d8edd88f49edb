#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/declared_options.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"

namespace CLI {
class App;
}

namespace burnish {

/// What `render` and `animate` were given: which frames, which field, and the options of a picture.
struct PictureArguments {
  std::filesystem::path result;
  std::string frame = "last";
  std::string field, component;
  std::string range = "auto";
  bool isForPrint = false;  ///< becomes a PDF or SVG
  DeclaredOptions picture;
};

/// Adds the options of a picture to a command, or a part of them. fresh: has the defaults.
template <class Options>
void addPictureOptions(CLI::App& command, DeclaredOptions& picture, const Options& fresh) {
  std::map<std::string, std::string> usual;
  for (const Declaration& key : declarationsOf<PictureDefaults>()) usual[key.key] = "as the theme has it";
  picture.addTo(command, fresh, usual);
  command.get_option("--body")->type_name("BODY,...");
  picture.allow("bands", {{"smooth", "0"}});
  picture.expect("size", sizeWords());
  picture.addFlag(command, "--no-doubts", "doubt_marks", "off", "The same as --doubt-marks off");
}

/// Throws `Error` for options that cannot be together, in a body of `dim` dimensions if these are known.
void requireNoConflicts(const PictureOptions& options, std::optional<int> dim);

/// Throws `Error` for options of print that were given with a picture of pixels.
void requireNoPrintOptions(const DeclaredOptions& picture);

/// Replaces what was given. Throws `Error` that names the option.
template <class Options>
void readPicture(const DeclaredOptions& picture, Options& options, std::optional<int> dim) {
  picture.readInto(options);
  requireNoConflicts(options, dim);
}

/// Replaces what was given, of a picture for print also what these have beside others. Throws `Error` that names
/// the option.
void readPicture(const PictureArguments& arguments, PictureOptions& options, std::optional<int> dim);

/// Adds which frames and which field to a command, with `frame` as it is for a default.
void addFieldArguments(CLI::App& command, PictureArguments& arguments);

/// Adds the result and all of these options to a command.
void addPictureArguments(CLI::App& command, PictureArguments& arguments);

/// The field that is drawn, with its component: the one that was given, even if it is none of these names, or the usual one.
/// Throws `Error` for a component that the field does not have.
std::string drawnField(const PictureArguments& arguments, const std::string& usual,
                       const std::vector<std::string>& names);

/// The range that was given; nothing for one that is found. Throws `Error` that names the option.
std::optional<std::array<double, 2>> rangeOf(const PictureArguments& arguments);

/// The frames whose values the colours go through together; none: each has its own. all: their number.
std::vector<int> framesOfRange(const std::string& range, const std::vector<int>& frames, int all);

/// How a frame is drawn if it shares nothing with others. Throws `Error` that names the option.
ContourOptions ownOptions(const PictureArguments& arguments, const ResultReader& result, int frame);

/// How these frames are drawn. Several frames share a window and, unless something else is asked for, a range
/// of colours. Throws `Error` that names the option.
ContourOptions contourOptions(const PictureArguments& arguments, const ResultReader& result,
                              const std::vector<int>& frames);

}  // namespace burnish
