#include "engine/results/result_reader.h"

#include <fmt/format.h>

#include <system_error>

#include "engine/core/error.h"
#include "engine/results/frame_io.h"
#include "engine/results/result_files.h"

namespace burnish::inline results {
namespace {

namespace fs = std::filesystem;

fs::path located(const fs::path& directoryOrFile) {
  std::error_code status;
  if (!fs::exists(directoryOrFile, status))
    throw Error(fmt::format("{}: there is no such file or directory", directoryOrFile.string()));
  if (!fs::is_directory(directoryOrFile, status)) return directoryOrFile;
  const fs::path file = modelFile(directoryOrFile);
  if (!fs::exists(file, status))
    throw Error(fmt::format("{} holds no result.h5; give the directory of a run or the result file in it",
                            directoryOrFile.string()));
  return file;
}

}  // namespace

ResultReader::ResultReader(const fs::path& directoryOrFile)
    : modelFile_(located(directoryOrFile)),
      model_(readModel(modelFile_)),
      numFrames_(countFrames(modelFile_)) {}

std::vector<double> ResultReader::times() const {
  std::vector<double> times;
  for (int i = 0; i < numFrames_; ++i) times.push_back(readFrameTime(frameFile(modelFile_, i), model_));
  return times;
}

FrameRecord ResultReader::frame(int index) const {
  if (index < 0 || index >= numFrames_)
    throw Error(numFrames_ == 0 ? fmt::format("{} has no frames yet", modelFile_.string())
                                : fmt::format("{} has no frame {}; its frames are 0 to {}",
                                              modelFile_.string(), index, numFrames_ - 1));
  const fs::path file = frameFile(modelFile_, index);
  FrameRecord frame = readFrame(file, model_);
  if (frame.index != index)
    throw Error(
        fmt::format("{} holds frame {} instead of {}; was it renamed?", file.string(), frame.index, index));
  return frame;
}

}  // namespace burnish::inline results
