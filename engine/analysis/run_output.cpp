#include "engine/analysis/run_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/results/result_reader.h"

namespace burnish::inline analysis {
namespace {

/// Hands the values of the first rank to all others.
void shareState(const Team& team, SavedState& state) {
  std::vector<double> head;  // per value its size, its name's, and the name
  for (const auto& [name, values] : state) {
    head.push_back(static_cast<double>(values.size()));
    head.push_back(static_cast<double>(name.size()));
    head.insert(head.end(), name.begin(), name.end());
  }
  double length = static_cast<double>(head.size());
  team.share({&length, 1}, 0);
  head.resize(static_cast<std::size_t>(length));
  team.share(head, 0);
  for (auto next = head.begin(); next != head.end();) {
    const auto size = static_cast<Eigen::Index>(*next++);
    const auto letters = static_cast<std::ptrdiff_t>(*next++);
    std::string name(static_cast<std::size_t>(letters), ' ');
    std::transform(next, next + letters, name.begin(),
                   [](double letter) { return static_cast<char>(letter); });
    next += letters;
    Eigen::VectorXd& values = state[name];
    values.conservativeResize(size);
    team.share(asSpan(values), 0);
  }
}

}  // namespace

RunOutput::RunOutput(const std::filesystem::path& directory, ModelRecord model,
                     const std::vector<std::string>& columns, bool resumes, bool countsLinear,
                     RunObserver& observer, const Team& team)
    : directory_(directory),
      model_(std::move(model)),
      team_(team),
      countsLinear_(countsLinear),
      observer_(observer) {
  team_.first([&] { files_.emplace(directory, model_, columns, resumes, countsLinear); });
}

std::optional<SavedState> RunOutput::restart() const {
  std::optional<SavedState> state;
  if (team_.isFirst() && files_->restart() != nullptr) state = files_->restart()->state;
  if (team_.any(state.has_value())) {
    if (!state) state.emplace();
    shareState(team_, *state);
  }
  return state;
}

void RunOutput::showAgain() {
  team_.first([&] {
    const ResultReader result(directory_);
    for (int k = 0; k < result.numFrames(); ++k) observer_.onFrame(model_, result.frame(k));
  });
}

template <int Dim>
void RunOutput::appendRow(const Recorder<Dim>& recorder, int step, int iterations) {
  const std::vector<double> row = recorder.row(step, iterations);
  for (std::size_t column = 0; column < row.size(); ++column)
    if (!std::isfinite(row[column]))
      throw RunError(
          fmt::format("{} is not finite at t = {:.6g}", recorder.columns()[column], recorder.current().time));
  team_.first([&] { files_->appendHistory(row); });
  lastRowTime_ = recorder.current().time;
}

void RunOutput::appendConvergence(int number, const StepReport& step) {
  team_.first([&] {
    for (std::size_t k = 0; k < step.newton.history.size(); ++k) {
      std::vector<double> row{static_cast<double>(number), step.time, static_cast<double>(k),
                              step.newton.history[k]};
      if (countsLinear_)
        row.push_back(k > 0 ? static_cast<double>(step.newton.linearIterations[k - 1]) : 0.0);
      files_->appendConvergence(row);
    }
  });
}

void RunOutput::accept(const FrameRecord& frame) {
  const std::string place = fmt::format("the frame at t = {:.6g}", frame.time);
  std::string refusal;
  try {
    if (team_.isFirst()) checkFrame(frame, model_, place);
  } catch (const Error& error) {
    refusal = error.what();
  }
  if (team_.any(!refusal.empty()))
    throw RunError(team_.isFirst() ? refusal : fmt::format("{}: the first rank has refused it", place));
  lastFrameTime_ = frame.time;
}

void RunOutput::append(const FrameRecord& frame, int steps, SavedState state) {
  team_.first([&] {
    files_->append(frame, steps, std::move(state));
    observer_.onFrame(model_, frame);
  });
}

void RunOutput::appendLast(const FrameRecord& frame) {
  team_.first([&] {
    files_->appendLast(frame);
    observer_.onFrame(model_, frame);
  });
}

void RunOutput::keep(int steps, SavedState state) {
  team_.first([&] { files_->keep(steps, std::move(state)); });
}

void RunOutput::finish(const RunAccount& summary) {
  team_.first([&] { files_->finish(summary); });
}

void RunOutput::archive(StateArchive& archive) {
  archive.field("last_frame_time", lastFrameTime_);
  archive.field("last_row_time", lastRowTime_);
}

template void RunOutput::appendRow(const Recorder<2>&, int, int);
template void RunOutput::appendRow(const Recorder<3>&, int, int);

}  // namespace burnish::inline analysis
