#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "postproc/study/study.h"

namespace burnish {

/// The figure of a name. Throws `Error` with the nearest name.
const FigureSpec& figureNamed(const Study& study, const std::string& name);

/// Runs whose results a figure shows, each once, in the order of the study; of a composite, those of its
/// parts. Throws `Error` for patterns without a run and parts that do not exist or are composites.
std::vector<const StudyRun*> runsOf(const Study& study, const FigureSpec& figure);

/// Names of the figures that a figure shows; none but for composites.
std::vector<std::string> partsOf(const FigureSpec& figure);

/// Files beside the study that a figure shows.
std::vector<std::filesystem::path> inputsOf(const Study& study, const FigureSpec& figure);

/// The percentile at which the colours of all pictures of a figure end, which they do not say themselves.
std::optional<double> clipOf(const FigureSpec& figure);

/// The figure for print; nothing for one that is made of pixels. Throws as `drawFigure` does.
std::optional<PrintPage> pageOf(const FigureSpec& figure, const FigureTask& task);

/// Reports what is wrong with a figure before the runs of its study are known, and what is wrong with what it
/// names. path: of the figure.
void checkFigure(const FigureSpec& figure, const std::string& path, const StudyReporter& reporter);
void checkReferencesOf(const FigureSpec& figure, const std::string& path, const RunReporter& reporter);

/// The same for what the results of the runs will not have.
void checkOutlooksOf(const FigureSpec& figure, const std::string& path, const OutlookReporter& reporter);

/// Draws a figure from the results in `studyDirectory`/runs. Returns the files made in
/// `studyDirectory`/figures: first NAME.png, then its panels NAME_*.png, data NAME*.csv, videos and NAME.pdf or NAME.svg. Throws
/// `Error` that names the figure if results are missing or do not hold what is to be drawn, and if a file
/// cannot be written.
std::vector<std::filesystem::path> drawFigure(const Study& study, const FigureSpec& figure,
                                              const std::filesystem::path& studyDirectory);

}  // namespace burnish
