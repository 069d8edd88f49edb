#include "postproc/study/figures/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/study/run_outlook.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// Each of the runs once, in the order of the study.
std::vector<const StudyRun*> inOrder(const Study& study, const std::vector<const StudyRun*>& wanted) {
  std::vector<const StudyRun*> runs;
  for (const StudyRun& run : study.runs)
    if (std::find(wanted.begin(), wanted.end(), &run) != wanted.end()) runs.push_back(&run);
  return runs;
}

std::string formatName(const FigureSpec& figure) {
  return enumNames<PictureFormat>()[static_cast<std::size_t>(figure.format)];
}

}  // namespace

const FigureSpec& figureNamed(const Study& study, const std::string& name) {
  std::vector<std::string> names;
  for (const FigureSpec& figure : study.spec.figures) {
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw Error(
      fmt::format("{}: there is no figure \"{}\".{}", study.file.string(), name, didYouMean(name, names)));
}

std::vector<const StudyRun*> runsOf(const Study& study, const FigureSpec& figure) {
  return inOrder(study, std::visit(
                            [&](const auto& kind) {
                              if constexpr (requires { kind.shownRuns(study); })
                                return kind.shownRuns(study);
                              else
                                return study.matching(kind.runs);
                            },
                            figure.what));
}

std::vector<std::string> partsOf(const FigureSpec& figure) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.parts(); })
          return kind.parts();
        else
          return std::vector<std::string>();
      },
      figure.what);
}

std::vector<std::filesystem::path> inputsOf(const Study& study, const FigureSpec& figure) {
  return std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.inputs(study.file); })
          return kind.inputs(study.file);
        else
          return std::vector<std::filesystem::path>();
      },
      figure.what);
}

std::optional<double> clipOf(const FigureSpec& figure) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.clipOfAll(); })
          return kind.clipOfAll();
        else
          return std::optional<double>();
      },
      figure.what);
}

std::optional<PrintPage> pageOf(const FigureSpec& figure, const FigureTask& task) {
  return std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.page(task); })
          return std::optional(kind.page(task));
        else
          return std::optional<PrintPage>();
      },
      figure.what);
}

void checkFigure(const FigureSpec& figure, const std::string& path, const StudyReporter& reporter) {
  const bool hasPage = std::visit(
      [](const auto& kind) {
        return requires(const FigureTask& task) {
          kind.page(task);
        };
      },
      figure.what);
  if (figure.isForPrint() && !hasPage)
    reporter.report(path + ".format",
                    fmt::format("found {}; allowed: png, for this kind of figure is made of pixels.",
                                formatName(figure)));
  if (!figure.isForPrint())
    for (const InputProblem& problem : printOptionsOfPixels(figure.print))
      reporter.report(path + "." + problem.path, problem.text);
  std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.check(path, reporter); }) kind.check(path, reporter);
      },
      figure.what);
}

void checkReferencesOf(const FigureSpec& figure, const std::string& path, const RunReporter& reporter) {
  std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.checkReferences(path, reporter); })
          kind.checkReferences(path, reporter);
      },
      figure.what);
}

void checkOutlooksOf(const FigureSpec& figure, const std::string& path, const OutlookReporter& reporter) {
  std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.checkOutlooks(path, reporter); }) kind.checkOutlooks(path, reporter);
      },
      figure.what);
}

std::vector<std::filesystem::path> drawFigure(const Study& study, const FigureSpec& figure,
                                              const std::filesystem::path& studyDirectory) {
  const FigureTask task{study, figure.name, studyDirectory, figure.print};
  makeDirectory(task.directory());
  try {
    Files files = std::visit([&](const auto& kind) { return kind.draw(task); }, figure.what);
    if (figure.isForPrint()) {
      files.push_back(task.file("." + formatName(figure)));
      writePrint(pageOf(figure, task).value(), files.back());
    }
    return files;
  } catch (const Error& error) {
    throw Error(fmt::format("figure {}: {}", figure.name, error.what()));
  }
}

}  // namespace burnish
