#include "engine/results/run_files.h"

#include <utility>

#include "engine/results/result_files.h"

namespace burnish::inline results {
namespace {

HistoryWriter makeTable(const std::filesystem::path& path, const std::vector<std::string>& columns,
                        const TableMark* mark) {
  if (mark != nullptr) return HistoryWriter(path, columns, *mark);
  return HistoryWriter(path, columns);
}

std::vector<std::string> convergenceColumns(bool countsLinear) {
  std::vector<std::string> columns{"step", "time", "iteration", "residual"};
  if (countsLinear) columns.emplace_back("linear_iterations");
  return columns;
}

}  // namespace

RunFiles::RunFiles(const std::filesystem::path& directory, const ModelRecord& model,
                   const std::vector<std::string>& columns, bool resumes, bool countsLinear)
    : directory_(directory),
      restart_(resumes ? std::optional<RestartRecord>(std::in_place) : std::nullopt),
      writer_(restart_ ? ResultWriter(directory, model, *restart_) : ResultWriter(directory, model)),
      history_(makeTable(directory / "history.csv", columns, restart_ ? &restart_->history : nullptr)),
      convergence_(makeTable(directory / "convergence.csv", convergenceColumns(countsLinear),
                             restart_ ? &restart_->convergence : nullptr)) {}

RestartRecord RunFiles::makeRestart(int step, int frames, SavedState state) {
  return {.step = step,
          .frames = frames,
          .history = history_.sync(),
          .convergence = convergence_.sync(),
          .state = std::move(state)};
}

void RunFiles::append(const FrameRecord& frame, int step, SavedState state) {
  writer_.append(frame, makeRestart(step, writer_.numFrames() + 1, std::move(state)));
}

void RunFiles::keep(int step, SavedState state) {
  writer_.keep(makeRestart(step, writer_.numFrames(), std::move(state)));
}

void RunFiles::finish(const RunAccount& account) {
  writeSummary(directory_, account);
  if (account.completed) writer_.removeRestarts();
}

bool canBeResumed(const std::filesystem::path& directory) {
  return !restartFiles(modelFile(directory)).empty();
}

}  // namespace burnish::inline results
