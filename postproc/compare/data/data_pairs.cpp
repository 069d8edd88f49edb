#include "postproc/compare/data/data_pairs.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/result_files.h"
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
    case ComparedKind::Directory:
      return "a directory of results";
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

bool isRun(const fs::path& directory) {
  std::error_code status;
  return fs::exists(modelFile(directory), status);
}

/// What there is to compare below a directory.
struct DirectoryContents {
  std::map<std::string, ComparedKind> data;  ///< by names relative to it
  bool hasPictures = false;                  ///< outside of runs
};

class DirectoryWalk {
 public:
  explicit DirectoryWalk(const fs::path& root) : root_(root) { visit(root, true); }

  DirectoryContents contents;

 private:
  /// A collection names the files beside and below it. withFiles: those of other programs count.
  void visit(const fs::path& directory, bool withFiles) {
    std::vector<fs::path> directories, files;
    std::error_code error;
    for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code status;
      (entry->is_directory(status) ? directories : files).push_back(entry->path());
    }
    if (error) throw Error(fmt::format("{}: {}", directory.string(), error.message()));
    bool hasCollection = false;
    for (const fs::path& file : files)
      if (withFiles && file.extension() == ".pvd") {
        add(file, ComparedKind::VtkCollection);
        hasCollection = true;
      }
    for (const fs::path& file : files) {
      contents.hasPictures = contents.hasPictures || file.extension() == ".png";
      const auto kind = kindByEnding(file);
      if (withFiles && !hasCollection && kind == ComparedKind::VtkFile) add(file, *kind);
    }
    for (const fs::path& below : directories) {
      if (isRun(below))
        add(below, ComparedKind::Result);
      else if (!fs::is_symlink(below))
        visit(below, withFiles && !hasCollection);
    }
  }

  void add(const fs::path& path, ComparedKind kind) {
    contents.data[path.lexically_relative(root_).generic_string()] = kind;
  }

  fs::path root_;
};

DirectoryContents contentsOf(const fs::path& directory) {
  std::error_code status;
  if (!fs::is_directory(directory, status)) return {};
  return DirectoryWalk(directory).contents;
}

/// Nothing for a directory in which there is nothing to compare.
std::optional<ComparedKind> kindOfDirectory(const fs::path& directory) {
  if (isRun(directory)) return ComparedKind::Result;
  const DirectoryContents contents = contentsOf(directory);
  for (const auto& [name, kind] : contents.data)
    if (kind == ComparedKind::Result || !contents.hasPictures) return ComparedKind::Directory;
  return contents.hasPictures ? std::optional(ComparedKind::Pictures) : std::nullopt;
}

/// Nothing for a path that is not there and whose ending says nothing.
std::optional<ComparedKind> kindOfPath(const fs::path& path) {
  std::error_code status;
  if (fs::is_directory(path, status)) return kindOfDirectory(path);
  if (const std::optional<ComparedKind> kind = kindByEnding(path)) return kind;
  if (fs::exists(path, status)) return ComparedKind::Pictures;
  return std::nullopt;
}

}  // namespace

ComparedKind kindOf(const fs::path& actual, const fs::path& baseline) {
  const std::optional<ComparedKind> first = kindOfPath(actual), second = kindOfPath(baseline);
  std::error_code status;
  const bool areDirectories = fs::is_directory(actual, status) && fs::is_directory(baseline, status);
  if (first && second && first != second && areDirectories && first != ComparedKind::Directory &&
      second != ComparedKind::Directory)
    return ComparedKind::Pictures;  // of a run, with a directory of baselines
  if (first && second && *first != *second)
    throw Error(fmt::format("{} is {}, {} is {}; expected two of a kind", actual.string(),
                            kindInWords(*first), baseline.string(), kindInWords(*second)));
  return first.value_or(second.value_or(ComparedKind::Pictures));
}

std::vector<DataPair> dataPairs(ComparedKind kind, const fs::path& actual, const fs::path& baseline) {
  if (kind != ComparedKind::Directory) return {{"", kind, actual, baseline}};
  std::map<std::string, ComparedKind> all = contentsOf(actual).data;
  all.merge(contentsOf(baseline).data);
  std::vector<DataPair> pairs;
  for (const auto& [name, own] : all) pairs.push_back({name, own, actual / name, baseline / name});
  return pairs;
}

}  // namespace burnish
