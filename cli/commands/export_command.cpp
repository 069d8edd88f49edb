#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/foreign_files.h"
#include "cli/jobs/child_process.h"
#include "cli/late_vtk.h"
#include "cli/offered_words.h"
#include "cli/output_target.h"
#include "engine/cad/cad_file.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/lower_case.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/core/unit_label.h"
#include "engine/results/result_reader.h"
#include "postproc/export/nurbs_file.h"
#include "postproc/paraview/paraview_series.h"
#include "postproc/scene/scene_document.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

struct ExportArguments {
  std::filesystem::path result;
  std::filesystem::path directory;
  std::string cells = "linear";
  std::optional<std::string> parts;
  bool controlNet = false;
  int pieces = 1;
  std::optional<std::string> format;
  std::optional<std::string> unit;
  std::string frame = "last";
  std::string ofSeries;  ///< an option that was given and belongs to the series alone, or empty
};

enum class Format { Series, G2, Json, Step, Iges };

constexpr std::array kFormats{std::pair{"vtu", Format::Series}, std::pair{"g2", Format::G2},
                              std::pair{"json", Format::Json}, std::pair{"step", Format::Step},
                              std::pair{"iges", Format::Iges}};

/// Of files of one frame; what is printed has the first one of its format.
constexpr std::array kEndings{std::pair{".g2", Format::G2},     std::pair{".json", Format::Json},
                              std::pair{".step", Format::Step}, std::pair{".stp", Format::Step},
                              std::pair{".iges", Format::Iges}, std::pair{".igs", Format::Iges}};

/// The endings of files of a format, the one that is printed first.
std::vector<std::string> endingsOf(Format format) {
  std::vector<std::string> endings;
  for (const auto& [ending, itsFormat] : kEndings)
    if (itsFormat == format) endings.emplace_back(ending);
  return endings;
}

/// That of a file's name, of letters in any case.
std::string endingOf(const std::filesystem::path& file) {
  return inLowerCase(file.extension().string());
}

/// That of --format; without, that of the file which -o names.
Format formatOf(const ExportArguments& arguments) {
  if (arguments.format) return chosen("--format", *arguments.format, kFormats);
  for (const auto& [ending, format] : kEndings)
    if (endingOf(arguments.directory) == ending) return format;
  return Format::Series;
}

constexpr std::array kCellKinds{std::pair{"linear", CellKind::Linear},
                                std::pair{"lagrange", CellKind::Lagrange},
                                std::pair{"bezier", CellKind::Bezier}};

constexpr std::array kParts{
    std::pair{"body", ExportPart::Body},       std::pair{"tools", ExportPart::Tools},
    std::pair{"contact", ExportPart::Contact}, std::pair{"points", ExportPart::Points},
    std::pair{"net", ExportPart::Net},         std::pair{"knots", ExportPart::Knots}};

VtuOptions optionsFrom(const ExportArguments& arguments) {
  VtuOptions options;
  options.pieces = arguments.pieces;
  options.cells = chosen("--cells", arguments.cells, kCellKinds);
  if (arguments.parts) {
    options.parts.clear();
    std::istringstream words(*arguments.parts + ",");
    for (std::string word; std::getline(words, word, ',');)
      options.parts.insert(chosen("--parts", word, kParts));
  }
  if (arguments.controlNet) options.parts.insert(ExportPart::Net);
  return options;
}

/// That of the scene; one without options if the scene cannot be read here, where a theme or a font may be missing.
ScenePicture firstPictureOf(const ResultReader& result) {
  try {
    return firstPicture(readResultDocument(result.file().parent_path()));
  } catch (const Error&) {
    return {};
  }
}

void requireFrames(const ResultReader& reader) {
  if (reader.numFrames() == 0)
    throw Error(
        fmt::format("{}: the result has no frames to export; is the folder 'result' beside it missing?",
                    reader.file().string()));
}

/// The unit of the lengths of a result.
LengthUnit unitOf(const ExportArguments& arguments, const ResultReader& result) {
  if (arguments.unit) return chosen("--unit", *arguments.unit, kNamesOf<LengthUnit>);
  const std::string& label = result.model().lengthUnit;
  if (label.empty()) return LengthUnit::Millimetre;
  if (const auto unit = lengthUnitOf(label)) return *unit;
  throw Error(
      fmt::format("{}: its lengths are in {} (units), which CAD does not know; allowed: {}, or say with "
                  "--unit what they are in",
                  result.file().string(), quoted(label), kLengthLabels));
}

void writeBodies(const ModelRecord& model, const FrameRecord& frame, LengthUnit unit, CadFormat format,
                 const std::filesystem::path& file) {
  const auto bodies = nurbsBodies(model, frame);
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  writeFileAtomically(
      file, [&](const std::filesystem::path& partial) { writeCad(bodies, unit, format, partial.string()); });
}

/// Throws `Error` unless what was given fits a file of one frame.
void requireOneFile(const ExportArguments& arguments, Format format) {
  const std::filesystem::path& file = arguments.directory;
  const std::vector<std::string> endings = endingsOf(format);
  if (file.empty())
    throw Error(fmt::format("-o: --format {} writes one file; name it, as in -o body.{}", *arguments.format,
                            *arguments.format));
  if (!isStandardOutput(file) && !std::ranges::count(endings, endingOf(file)))
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a file that ends in {}, or -",
                            file.string(), fmt::join(endings, " or ")));
  if (arguments.unit && format != Format::Step && format != Format::Iges)
    throw Error(fmt::format("--unit: this is of STEP and IGES; {} holds lengths as they are", file.string()));
  if (!arguments.ofSeries.empty())
    throw Error(fmt::format("{}: this is of the series of VTK files; {} holds NURBS", arguments.ofSeries,
                            file.string()));
}

/// One frame as one file.
ExitCode exportNurbs(const ExportArguments& arguments, Format format) {
  requireOneFile(arguments, format);
  const ResultReader reader(arguments.result);
  requireFrames(reader);
  requireNotInput("-o", arguments.directory, {reader.file()});
  const int frame = frameIndex(arguments.frame, reader.times());
  const OutputTarget target(arguments.directory, endingsOf(format).front().c_str());
  switch (format) {
    case Format::Step:
    case Format::Iges:
      writeBodies(reader.model(), reader.frame(frame), unitOf(arguments, reader),
                  format == Format::Step ? CadFormat::Step : CadFormat::Iges, target.file());
      break;
    default:
      writeText(nurbsText(reader.model(), reader.frame(frame),
                          format == Format::G2 ? NurbsFormat::G2 : NurbsFormat::Json),
                target.file());
  }
  target.finish();
  if (!isStandardOutput(arguments.directory))
    printOut("frame {} in {}\n", frame, arguments.directory.string());
  return ExitCode::Fine;
}

/// Throws `Error` if -o names what looks like a file, for which a directory of that name would be made.
void requireNoFile(const std::filesystem::path& directory) {
  const std::string ending = endingOf(directory);  // of out/0.5 it is no word
  std::error_code status;
  if (ending.size() < 2 || std::isalpha(static_cast<unsigned char>(ending[1])) == 0 ||
      std::filesystem::is_directory(directory, status))
    return;
  std::vector<const char*> endings;
  for (const auto& [name, format] : kEndings) endings.push_back(name);
  throw Error(
      fmt::format("-o: found \"{0}\"; expected a directory for the series, which is written {0}/ if it is "
                  "new, or a file of one frame that ends in {1}",
                  directory.string(), fmt::join(endings, ", ")));
}

ExitCode exportSeries(const ExportArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  const VtuOptions options = optionsFrom(arguments);
  const ResultReader reader(arguments.result);
  const auto directory = arguments.directory.empty() ? reader.file().parent_path() : arguments.directory;
  requireFrames(reader);
  if (!isOfARun(directory) && !hasSeries(directory)) requireAbsent(seriesFiles(directory));
  const ScenePicture picture = firstPictureOf(reader);
  loadVtk();  // before an earlier series goes
  ParaViewSeries writer(directory, reader.model(), options, picture, picture.times);
  for (int i = 0; i < reader.numFrames(); ++i) {
    throwIfInterrupted();
    writer.write(reader.frame(i));
  }
  printOut("{} frames in {}\n", reader.numFrames(), (directory / "frames.pvd").string());
  return ExitCode::Fine;
}

ExitCode exportResult(const ExportArguments& arguments) {
  const Format format = formatOf(arguments);
  if (format != Format::Series) return exportNurbs(arguments, format);
  requireDirectoryName("-o", arguments.directory);
  requireNoFile(arguments.directory);
  if (arguments.unit) throw Error("--unit: this is of STEP and IGES; VTK files hold lengths as they are");
  if (arguments.frame != "last")
    throw Error(
        "--frame: a series holds all frames; give it with --format g2, json, step or iges, which hold one");
  return exportSeries(arguments);
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "export", "Write VTK files and a PVD collection for ParaView from the results, or NURBS");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("RESULT", arguments->result, "Directory of a run or the result file in it")->required();
  command
      ->add_option(
          "-o,--output", arguments->directory,
          "Directory for frames.pvd and frames/ [that of the result]; or a file of one frame that ends in .g2, .json, "
          ".step or .iges, or with --format - to print it")
      ->type_name("DIR|FILE");
  CLI::Option* cells =
      command
          ->add_option("--cells", arguments->cells,
                       "Cells of the body: linear, lagrange, or bezier, which are exact [linear]")
          ->type_name("KIND");
  offerChoices(*cells, kCellKinds);
  CLI::Option* parts =
      command
          ->add_option(
              "--parts", arguments->parts,
              "What to write, separated by commas: body, tools, contact, points (values at quadrature "
              "points), net (control net), knots (knot lines) [body,tools,contact]")
          ->type_name("PART,...");
  offerChoices(*parts, kParts);
  CLI::Option* pieces =
      command
          ->add_option(
              "--pieces", arguments->pieces,
              "About so many files for each body and frame, which a .pvtu file names: for large bodies [1]")
          ->check(CLI::Range(1, 100'000))
          ->type_name("N");
  CLI::Option* net =
      command->add_flag("--control-net", arguments->controlNet, "Add the control net to the parts");
  CLI::Option* format =
      command
          ->add_option(
              "--format", arguments->format,
              "vtu: the series; g2 (GoTools) or json (geomdl): the deformed bodies of a frame as NURBS; step or iges: "
              "their faces, for CAD [that of the file which -o names, else vtu]")
          ->type_name("vtu|g2|json|step|iges");
  offerChoices(*format, kFormats);
  const std::array ofSeries{cells, parts, pieces, net};
  for (CLI::Option* option : ofSeries) option->excludes(format);
  command
      ->add_option("--frame", arguments->frame,
                   "With formats of one frame: its number, last or end, or time=T [last]")
      ->type_name("N|last|time=T");
  CLI::Option* unit =
      command
          ->add_option(
              "--unit", arguments->unit,
              "With step and iges: what the lengths of the result are in [that of its units, else mm]")
          ->type_name("UNIT");
  offerChoices(*unit, kNamesOf<LengthUnit>);
  command->callback([&action, arguments, ofSeries] {
    for (const CLI::Option* option : ofSeries)
      if (option->count() > 0) arguments->ofSeries = option->get_name();
    action = [arguments] { return exportResult(*arguments); };
  });
}

}  // namespace burnish
