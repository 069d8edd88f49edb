#include "postproc/compare/data/compare_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/result_files.h"
#include "engine/results/result_reader.h"
#include "postproc/compare/baseline_place.h"
#include "postproc/compare/data/run_series.h"
#include "postproc/compare/data/vtk_series.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// Adds the names of all fields there are.
std::vector<FieldComparison> comparePair(const DataPair& pair, const DataRule& rule,
                                         std::vector<std::string>& names) {
  std::vector<FieldComparison> all;
  const auto add = [&](const auto& seriesOf) {
    const std::vector<FieldComparison> found =
        compareSeries(seriesOf(pair.actual), seriesOf(pair.baseline), rule, names);
    all.insert(all.end(), found.begin(), found.end());
  };
  if (pair.kind == ComparedKind::Result) {
    add(frameSeries);
    add(historySeries);
  } else {
    add(foreignSeries);
  }
  return all;
}

/// The model file of a result that was given as a directory or as this file.
fs::path modelFileOf(const fs::path& path) {
  return path.extension() == ".h5" ? path : modelFile(path);
}

/// Whether there is something to compare at one of the paths of a pair.
bool isThere(const DataPair& pair, const fs::path& path) {
  std::error_code status;
  return fs::exists(pair.kind == ComparedKind::Result ? modelFileOf(path) : path, status);
}

/// What stands for the fields of a pair that has none to compare.
FieldComparison wholeVerdict(FieldVerdict verdict, const std::string& message) {
  FieldComparison whole;
  whole.name = "result";
  whole.verdict = verdict;
  whole.message = message;
  return whole;
}

/// Of a pair below two directories.
std::vector<FieldComparison> compareMember(const DataPair& pair, const DataRule& rule,
                                           std::vector<std::string>& names) {
  if (!isThere(pair, pair.actual))
    return {wholeVerdict(FieldVerdict::NoActual,
                         fmt::format("missing: there is a baseline, but no {}", pair.actual.string()))};
  if (!isThere(pair, pair.baseline))
    return {wholeVerdict(FieldVerdict::NoBaseline,
                         fmt::format("no baseline: there is no {}", pair.baseline.string()))};
  try {
    return comparePair(pair, rule, names);
  } catch (const Error& error) {
    return {wholeVerdict(FieldVerdict::Unusable, error.what())};
  }
}

bool isToBeUpdated(const ResultComparison& comparison) {
  const auto has = [&](FieldVerdict verdict) {
    return std::ranges::count(comparison.fields, verdict, &FieldComparison::verdict) > 0;
  };
  return !has(FieldVerdict::Unusable) && isThere(comparison.pair, comparison.pair.actual) &&
         std::ranges::any_of(comparison.fields, [](const FieldComparison& field) {
           return field.verdict != FieldVerdict::Equal;
         });
}

/// The model comes last, so that at no moment it has the frames of another result.
void copyResult(const fs::path& from, const fs::path& to) {
  const fs::path source = modelFileOf(from), target = modelFileOf(to);
  const int frames = ResultReader(source).numFrames();
  removeResult(target);
  for (int k = 0; k < frames; ++k) writeText(readText(frameFile(source, k)), frameFile(target, k));
  std::error_code status;
  if (source.filename() == "result.h5")
    for (const char* table : {"history.csv", "convergence.csv", "summary.yaml"})
      if (fs::exists(source.parent_path() / table, status))
        writeText(readText(source.parent_path() / table), target.parent_path() / table);
  writeText(readText(source), target);
}

/// Throws `Error` if a baseline or its frames lie elsewhere, beyond a symbolic link.
void requireInPlace(const DataPair& pair) {
  const bool isResult = pair.kind == ComparedKind::Result;
  const fs::path file = isResult ? modelFileOf(pair.baseline) : pair.baseline;
  // Of one result that is named as a directory, this is the place.
  const fs::path kept = isResult && pair.name.empty() ? file.parent_path() : pair.baseline;
  const std::string name = isResult || !pair.name.empty() ? pair.name : file.filename().string();
  requireInBaselines(name, kept, file);
  if (isResult) requireInBaselines(name, kept, frameFile(file, 0));
}

/// Whether a file names others, which a copy of it would not have.
bool namesOthers(const DataPair& pair) {
  constexpr std::array kEndings{".pvd", ".pvtu", ".pvtp", ".pvts", ".pvtr",   ".pvti",
                                ".vtm", ".vtpc", ".case", ".cas",  ".series", ".foam"};
  return pair.kind != ComparedKind::Result && std::ranges::count(kEndings, pair.actual.extension()) > 0;
}

/// What stands beside a result that was drawn of a former one.
std::string leftOver(const DataPair& pair) {
  std::vector<std::string> names;
  std::error_code status;
  if (pair.kind == ComparedKind::Result)
    for (const char* name : {"frames.pvd", "frames", "pictures", "probes", "report.html"})
      if (fs::exists(modelFileOf(pair.baseline).parent_path() / name, status)) names.emplace_back(name);
  return names.empty() ? "" : fmt::format("; of the former one are left: {}", fmt::join(names, ", "));
}

}  // namespace

std::string fullName(const DataPair& pair, const FieldComparison& field) {
  return pair.name.empty() ? field.name : pair.name + ": " + field.name;
}

std::vector<ResultComparison> compareData(ComparedKind kind, const fs::path& actual, const fs::path& baseline,
                                          const DataRule& rule, bool mayLackBaseline) {
  std::vector<std::string> names;
  std::vector<ResultComparison> all;
  bool hasFields = false;
  for (const DataPair& pair : dataPairs(kind, actual, baseline)) {
    const bool isMember = !pair.name.empty() || (mayLackBaseline && !isThere(pair, pair.baseline));
    all.push_back({pair, isMember ? compareMember(pair, rule, names) : comparePair(pair, rule, names)});
    hasFields = hasFields || !all.back().fields.empty();
  }
  if (!names.empty()) requireMatches(rule, names);
  if (!hasFields) throw Error("--only, --skip: they leave no field to compare");
  return all;
}

bool becomesBaseline(const ResultComparison& comparison) {
  return isToBeUpdated(comparison) && !namesOthers(comparison.pair);
}

std::vector<std::string> makeBaseline(std::vector<ResultComparison>& comparisons, const DataRule& rule) {
  for (const ResultComparison& comparison : comparisons)
    if (isToBeUpdated(comparison)) requireInPlace(comparison.pair);
  std::vector<std::string> lines;
  for (ResultComparison& comparison : comparisons) {
    if (!isToBeUpdated(comparison)) continue;
    const DataPair& pair = comparison.pair;
    const std::string name = pair.name.empty() ? pair.baseline.string() : pair.name;
    if (namesOthers(pair)) {
      const std::string text =
          fmt::format("{}: it names other files; copy it together with them", pair.actual.string());
      if (comparisons.size() == 1) throw Error("--update: " + text);
      lines.push_back(text);
      continue;
    }
    if (pair.kind == ComparedKind::Result)
      copyResult(pair.actual, pair.baseline);
    else
      writeText(readText(pair.actual), pair.baseline);
    std::vector<std::string> names;
    comparison.fields = comparePair(pair, rule, names);
    lines.push_back(fmt::format("{}: the new baseline{}", name, leftOver(pair)));
  }
  return lines;
}

}  // namespace burnish
