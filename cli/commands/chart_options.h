#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/declared_options.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/page/picture_look.h"

namespace CLI {
class App;
}

/// What the commands that draw charts have in common.
namespace burnish {

/// Options of a chart. Empty texts: not given.
struct ChartArguments {
  std::string title, xTitle, yTitle;
  std::vector<std::string> labels;  ///< of the runs or of all curves
  std::vector<std::string> logarithmic;
  std::string xRange, yRange;
  std::string markers = "some", size;
  DeclaredOptions look;  ///< of a `PageLook`

  bool isLogarithmic(const char* axis) const;
};

/// The files that a chart and its data go to.
struct ChartOutputs {
  std::filesystem::path picture;
  std::string csv;  ///< a file, or - for standard output

  bool printsData() const { return csv == "-"; }
  bool printsPicture() const { return picture == "-"; }
};

/// What help says that titles of axes are without these options.
struct UsualTitles {
  const char *x, *y;
};

/// Adds titles, ranges and logarithmic axes. logarithmic: the values of --log.
void addAxisOptions(CLI::App& command, ChartArguments& arguments, const UsualTitles& usual,
                    const std::vector<std::string>& logarithmic);

/// Adds title, look and size.
void addPageOptions(CLI::App& command, ChartArguments& arguments);

/// Adds these, labels and markers. usualLabel: what help says of a label that is not given.
void addDrawingOptions(CLI::App& command, ChartArguments& arguments, const char* usualLabel);

/// The points of curves as a table, two columns of each, with its label before their titles if there are several.
std::string curvesCsv(const std::vector<ChartCurve>& curves, const std::string& xTitle,
                      const std::string& yTitle);

/// A chart without curves, whose axes have these titles unless others were given. Throws `Error` that names
/// the option.
Chart emptyChart(const ChartArguments& arguments, const std::string& xTitle, const std::string& yTitle);

/// `LO,HI`, or nothing for an empty text.
std::optional<std::array<double, 2>> axisRange(const char* option, const std::string& text);

/// Throws `Error` unless there are no labels, one for each run, or one for each curve. runs: what they are
/// called.
void checkLabels(const ChartArguments& arguments, std::size_t numRuns, std::size_t numCurves,
                 const char* runs);

/// What curves of runs are called: the labels if there is one for each, else the directories, or the files if
/// they have another name than `usual`; as they were given where several are the same. files, given: one per
/// run.
std::vector<std::string> runNames(const ChartArguments& arguments,
                                  const std::vector<std::filesystem::path>& files, const std::string& usual,
                                  const std::vector<std::filesystem::path>& given);

/// The name of the directory of a run, or of the file if it has another name than is usual.
std::string runName(const std::filesystem::path& file, const std::string& usual);

/// Draws the chart into its file, or prints it as PNG.
void writePicture(const Chart& chart, const ChartOutputs& outputs);

/// Throws `Error` if JSON would be printed beside the picture or the data.
void requirePrintedAlone(bool json, const ChartOutputs& outputs);

/// Throws `Error` if there is neither a picture nor a file of data, if both are to be printed, or if one of them is an input.
void checkOutputs(const ChartOutputs& outputs, std::vector<std::filesystem::path> inputs);

}  // namespace burnish
