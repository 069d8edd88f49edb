#include "engine/results/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/output_file.h"
#include "engine/results/file_header.h"
#include "engine/results/summary_file.h"

namespace burnish::inline results {
namespace {

namespace fs = std::filesystem;

/// Whether a file's name is that of a frame ("frame") or a restart record ("restart"): six digits or more.
bool isNumbered(const std::string& name, const std::string& kind) {
  const std::string head = kind + "_", tail = ".h5";
  return name.size() >= head.size() + 6 + tail.size() && name.starts_with(head) && name.ends_with(tail) &&
         std::all_of(name.begin() + std::ssize(head), name.end() - std::ssize(tail),
                     [](char c) { return c >= '0' && c <= '9'; });
}

bool isPartial(const fs::path& path) {
  return path.extension() == kPartial;
}

/// Files of a kind, complete or partial, from the last to the first.
std::vector<fs::path> numberedFiles(const fs::path& modelFile, const std::string& kind) {
  std::vector<fs::path> files;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(framesDirectory(modelFile), status)) {
    const fs::path& path = entry.path();
    if (isNumbered(isPartial(path) ? path.stem().string() : path.filename().string(), kind))
      files.push_back(path);
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string left = a.filename().string(), right = b.filename().string();
    return left.size() != right.size() ? left.size() > right.size() : left > right;
  });
  return files;
}

void requireOwn(const fs::path& path, const std::string& kind) {
  try {
    readHeader(hdf5::InputFile(path).root(), kind);
  } catch (const Error& error) {
    throw Error(
        fmt::format("{}: it would be overwritten; move it away or choose another directory", error.what()));
  }
}

}  // namespace

fs::path modelFile(const fs::path& directory) {
  return directory / "result.h5";
}

fs::path framesDirectory(const fs::path& modelFile) {
  return modelFile.parent_path() / modelFile.stem();
}

fs::path frameFile(const fs::path& modelFile, int index) {
  return framesDirectory(modelFile) / fmt::format("frame_{:06}.h5", index);
}

int countFrames(const fs::path& modelFile) {
  int count = 0;
  std::error_code status;
  while (fs::exists(frameFile(modelFile, count), status)) ++count;
  return count;
}

fs::path restartFile(const fs::path& modelFile, int step) {
  return framesDirectory(modelFile) / fmt::format("restart_{:06}.h5", step);
}

std::vector<fs::path> restartFiles(const fs::path& modelFile) {
  std::vector<fs::path> files = numberedFiles(modelFile, "restart");
  std::erase_if(files, isPartial);
  return files;
}

void removeResult(const fs::path& modelFile) {
  const std::vector<fs::path> frames = numberedFiles(modelFile, "frame");
  const std::vector<fs::path> restarts = numberedFiles(modelFile, "restart");
  std::error_code status;
  if (fs::exists(modelFile, status)) requireOwn(modelFile, "model");
  for (const fs::path& frame : frames)
    if (!isPartial(frame)) requireOwn(frame, "frame");
  for (const fs::path& restart : restarts)
    if (!isPartial(restart)) requireOwn(restart, "restart");
  removeSummary(modelFile.parent_path());
  deleteFile(modelFile);
  deleteFile(partialName(modelFile));
  for (const fs::path& restart : restarts) deleteFile(restart);
  for (const fs::path& frame : frames) deleteFile(frame);
}

void removeUnfinished(const fs::path& modelFile, int frames) {
  for (const char* kind : {"frame", "restart"})
    for (const fs::path& file : numberedFiles(modelFile, kind))
      if (isPartial(file)) deleteFile(file);
  for (int index = countFrames(modelFile) - 1; index >= frames; --index)
    deleteFile(frameFile(modelFile, index));
}

void deleteFile(const fs::path& path) {
  std::error_code status;
  fs::remove(path, status);
  if (status) throw Error(fmt::format("cannot delete {}: {}", path.string(), status.message()));
}

}  // namespace burnish::inline results
