#include "engine/analysis/peak_contact.h"

#include <fmt/format.h>

#include "engine/results/doubts.h"

namespace burnish {

template <int Dim>
void PeakContact::update(const FaceContact<Dim>& contact, double time) {
  const auto& state = contact.state();
  if (state.active.empty()) return;
  const double force = state.reaction.norm();
  if (force <= force_) return;
  force_ = force;
  time_ = time;
  active_ = state.numActive();
  all_ = active_ == std::ssize(state.active);
}

bool PeakContact::isCoarse() const {
  return active_ > 0 && !all_ && active_ < limitOf(Condition::LostContact);
}

std::string PeakContact::pointsText() const {
  return fmt::format("{} control point{}", active_, active_ == 1 ? "" : "s");
}

void PeakContact::archive(StateArchive& archive) {
  archive.together("peak", force_, time_, active_, all_);
}

template void PeakContact::update(const FaceContact<2>&, double);
template void PeakContact::update(const FaceContact<3>&, double);

}  // namespace burnish
