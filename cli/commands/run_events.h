#pragma once
#include <filesystem>

#include "engine/analysis/run.h"
#include "engine/results/run_account.h"

/// What `burnish run --json` prints: an object in a line for everything that happens, whose key `event` says what it is.
namespace burnish {

void printStepEvent(const RunProgress& progress, double elapsedSeconds);
void printFrameEvent(int index, double time);
void printPictureEvent(const std::filesystem::path& file);
/// account: all that summary.yaml has.
void printEndEvent(const RunAccount& account, const std::filesystem::path& directory);

}  // namespace burnish
