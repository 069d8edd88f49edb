#include "engine/results/result_writer.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/results/frame_io.h"
#include "engine/results/result_files.h"
#include "engine/results/summary_file.h"

namespace burnish::inline results {
namespace {

namespace fs = std::filesystem;

void create(const fs::path& directory) {
  std::error_code status;
  fs::create_directories(directory, status);
  if (status)
    throw Error(fmt::format("cannot create the directory {}: {}", directory.string(), status.message()));
}

DirectoryLock locked(const fs::path& directory) {
  return {directory, DirectoryLock::Children::LetGo,
          fmt::format("another run is writing its result to {}; wait for its end or choose another directory",
                      directory.string())};
}

StoredModel checked(ModelRecord model, const fs::path& file) {
  checkModel(model, file.string());
  std::string id = modelId(model);
  return {.id = std::move(id), .record = std::move(model)};
}

}  // namespace

ResultWriter::ResultWriter(const fs::path& directory, ModelRecord model)
    : lock_(locked(directory)),
      modelFile_(modelFile(directory)),
      model_(checked(std::move(model), modelFile_)) {
  removeResult(modelFile_);
  writeFileAtomically(modelFile_, modelImage(model_));
  create(framesDirectory(modelFile_));
}

ResultWriter::ResultWriter(const fs::path& directory, ModelRecord model, RestartRecord& restart)
    : lock_(locked(directory)),
      modelFile_(modelFile(directory)),
      model_(checked(std::move(model), modelFile_)) {
  const StoredModel stored = readModel(modelFile_);
  if (stored.record.program != model_.record.program)
    throw Error(
        fmt::format("{} was written by {}, but this program is {}: it would go on with other rounding; "
                    "resume the run with the program that began it, or compute its scene again",
                    modelFile_.string(), stored.record.program, model_.record.program));
  if (stored.id != model_.id)
    throw Error(
        fmt::format("{}: a file that its scene names has changed since the run began; bring it back, or "
                    "compute the scene again",
                    modelFile_.string()));
  restart = readNewestRestart(modelFile_, stored);
  removeSummary(directory);
  removeUnfinished(modelFile_, restart.frames);
  numFrames_ = restart.frames;
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::append(const FrameRecord& frame, const RestartRecord& restart) {
  check(frame);
  writeRestart(modelFile_, restart, model_.id);
  write(frame);
  removeRestartsBefore(modelFile_, restart.step);
}

void ResultWriter::keep(const RestartRecord& restart) {
  writeRestart(modelFile_, restart, model_.id);
  removeRestartsBefore(modelFile_, restart.step);
}

void ResultWriter::removeRestarts() {
  for (const fs::path& file : restartFiles(modelFile_)) deleteFile(file);
}

void ResultWriter::append(const FrameRecord& frame) {
  check(frame);
  write(frame);
}

void ResultWriter::check(const FrameRecord& frame) const {
  const std::string file = frameFile(modelFile_, numFrames_).string();
  if (frame.index != numFrames_)
    throw Error(fmt::format("{}: a frame of index {} was to be appended to {} frames", file, frame.index,
                            numFrames_));
  checkFrame(frame, model_.record, file);
}

void ResultWriter::write(const FrameRecord& frame) {
  writeFileAtomically(frameFile(modelFile_, numFrames_), frameImage(frame, model_.id));
  ++numFrames_;
}

}  // namespace burnish::inline results
