#include "postproc/compare/data/compare_data.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/result_files.h"
#include "postproc/compare/data/run_series.h"
#include "postproc/compare/data/vtk_series.h"
#include "postproc/foreign/foreign_source.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

const char* kindInWords(ComparedKind kind) {
  switch (kind) {
    case ComparedKind::Result:
      return "a result";
    case ComparedKind::VtkFile:
      return "a VTK file";
    case ComparedKind::VtkCollection:
      return "a collection of VTK files";
    case ComparedKind::Pictures:
      break;
  }
  return "no data, but a picture or a directory of pictures";
}

std::optional<ComparedKind> kindByEnding(const fs::path& path) {
  if (path.extension() == ".h5") return ComparedKind::Result;
  if (path.extension() == ".pvd") return ComparedKind::VtkCollection;
  if (!foreignKind(path).empty()) return ComparedKind::VtkFile;
  return std::nullopt;
}

/// Nothing for a path that is not there and whose ending says nothing.
std::optional<ComparedKind> kindOfPath(const fs::path& path) {
  std::error_code status;
  if (fs::is_directory(path, status))
    return fs::exists(modelFile(path), status) ? ComparedKind::Result : ComparedKind::Pictures;
  if (const std::optional<ComparedKind> kind = kindByEnding(path)) return kind;
  if (fs::exists(path, status)) return ComparedKind::Pictures;
  return std::nullopt;
}

}  // namespace

ComparedKind kindOf(const fs::path& actual, const fs::path& baseline) {
  const std::optional<ComparedKind> first = kindOfPath(actual), second = kindOfPath(baseline);
  std::error_code status;
  if (first != second && fs::is_directory(actual, status) && fs::is_directory(baseline, status))
    return ComparedKind::Pictures;  // of a run, with a directory of baselines
  if (first && second && *first != *second)
    throw Error(fmt::format("{} is {}, {} is {}; expected two of a kind", actual.string(),
                            kindInWords(*first), baseline.string(), kindInWords(*second)));
  return first.value_or(second.value_or(ComparedKind::Pictures));
}

std::vector<FieldComparison> compareData(ComparedKind kind, const fs::path& actual, const fs::path& baseline,
                                         const DataRule& rule) {
  std::vector<std::string> names;
  std::vector<FieldComparison> all;
  const auto add = [&](const auto& seriesOf) {
    const std::vector<FieldComparison> found =
        compareSeries(seriesOf(actual), seriesOf(baseline), rule, names);
    all.insert(all.end(), found.begin(), found.end());
  };
  if (kind == ComparedKind::VtkFile || kind == ComparedKind::VtkCollection) add(foreignSeries);
  if (kind == ComparedKind::Result) {
    add(frameSeries);
    add(historySeries);
  }
  requireMatches(rule, names);
  if (all.empty()) throw Error("--only, --skip: they leave no field to compare");
  return all;
}

}  // namespace burnish
