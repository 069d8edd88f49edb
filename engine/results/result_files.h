#pragma once
#include <filesystem>
#include <vector>

/// Names of the files of a result: `NAME.h5` with the model and `NAME/frame_000000.h5`, … beside it, one per
/// frame; `NAME/restart_000123.h5` is what a run that was stopped after so many steps goes on from.
namespace burnish::inline results {

/// DIR/result.h5, the model file of a run's directory.
std::filesystem::path modelFile(const std::filesystem::path& directory);

/// The directory of the frames that belong to a model file.
std::filesystem::path framesDirectory(const std::filesystem::path& modelFile);

std::filesystem::path frameFile(const std::filesystem::path& modelFile, int index);

std::filesystem::path restartFile(const std::filesystem::path& modelFile, int step);

/// All restart records, from the newest to the oldest.
std::vector<std::filesystem::path> restartFiles(const std::filesystem::path& modelFile);

/// Number of frame files that exist without a gap from frame 0 on.
int countFrames(const std::filesystem::path& modelFile);

/// Deletes a result with its summary and what a killed run left half written: the summary, which speaks of a
/// whole run, then the model file, then the frames from the last to the first, so that no moment shows a
/// model with frames of another run. Throws `Error`, with nothing deleted, if a file of one of these names
/// was not written by this program.
void removeResult(const std::filesystem::path& modelFile);

/// Deletes what a killed run left half written, and frames from number `frames` on.
void removeUnfinished(const std::filesystem::path& modelFile, int frames);

/// Throws `Error` if the file system refuses; a file that is not there is no error.
void deleteFile(const std::filesystem::path& path);

}  // namespace burnish::inline results
