#pragma once
#include <filesystem>
#include <vector>

#include "postproc/study/study.h"

namespace burnish {

/// Runs whose results a figure shows, each once, in the order of the study; of a composite, those of its
/// parts. Throws `Error` for patterns without a run and parts that do not exist or are composites.
std::vector<const StudyRun*> runsOf(const Study& study, const FigureSpec& figure);

/// Draws a figure from the results in `studyDirectory`/runs. Returns the files made in
/// `studyDirectory`/figures: first NAME.png, then its panels NAME_*.png, data NAME*.csv and videos. Throws
/// `Error` that names the figure if results are missing or do not hold what is to be drawn, and if a file
/// cannot be written.
std::vector<std::filesystem::path> drawFigure(const Study& study, const FigureSpec& figure,
                                              const std::filesystem::path& studyDirectory);

}  // namespace burnish
