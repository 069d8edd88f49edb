#include "engine/results/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/results/atomic_file.h"
#include "engine/results/file_header.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

bool isFrameName(const std::string& name) {
  return name.size() == std::string("frame_000000.h5").size() && name.starts_with("frame_") &&
         name.ends_with(".h5") &&
         std::all_of(name.begin() + 6, name.begin() + 12, [](char c) { return c >= '0' && c <= '9'; });
}

/// Files of frames, complete or partial, from the last to the first.
std::vector<fs::path> frameFiles(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, status)) {
    const fs::path& path = entry.path();
    const bool isPartial = path.extension() == ".partial";
    if (isFrameName(isPartial ? path.stem().string() : path.filename().string())) files.push_back(path);
  }
  std::sort(files.begin(), files.end(), std::greater<>());
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

void deleteFile(const fs::path& path) {
  std::error_code status;
  fs::remove(path, status);
  if (status) throw Error(fmt::format("cannot delete {}: {}", path.string(), status.message()));
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

void removeResult(const fs::path& modelFile) {
  const std::vector<fs::path> frames = frameFiles(framesDirectory(modelFile));
  std::error_code status;
  if (fs::exists(modelFile, status)) requireOwn(modelFile, "model");
  for (const fs::path& frame : frames)
    if (frame.extension() != ".partial") requireOwn(frame, "frame");
  deleteFile(modelFile);
  deleteFile(partialName(modelFile));
  for (const fs::path& frame : frames) deleteFile(frame);
}

}  // namespace burnish
