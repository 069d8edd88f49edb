#include "engine/analysis/pass_watch.h"

#include <fmt/format.h>

#include "engine/core/same_time.h"

namespace burnish::inline analysis {

void PassWatch::update(const ToolPath& path, double time, bool touches) {
  if (touches && path.hasBeenLifted(time)) held_.note(time);
  const std::vector<ToolPath::Pass>& passes = path.passes();
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const bool ends = isSameTime(time, passes[k].end);
    if (time <= passes[k].begin || isSameTime(time, passes[k].begin) || (time > passes[k].end && !ends))
      continue;
    if (pass_ == static_cast<int>(k) && time == lastTime_) return;  // again, on a new mesh
    if (pass_ != static_cast<int>(k)) {
      pass_ = static_cast<int>(k);
      touched_ = false;
      states_ = 0;
    }
    lastTime_ = time;
    touched_ = touched_ || touches;
    ++states_;
    if (!ends || touched_) return;
    ++idle_;
    for (int state = 0; state < states_; ++state) doubt_.note(passes[k].begin);
    return;
  }
}

std::string PassWatch::passText(const ToolPath& path) const {
  return fmt::format("{} of {} passes", idle_, path.passes().size());
}

void PassWatch::archive(StateArchive& archive) {
  archive.together("pass", pass_, lastTime_, touched_, states_, idle_);
  archive.part("doubt", doubt_);
  archive.part("held", held_);
}

}  // namespace burnish::inline analysis
