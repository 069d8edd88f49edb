#include "engine/analysis/peak_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/results/doubts.h"

namespace burnish::inline analysis {

namespace {

/// In the span where the gap is smallest: largest difference of gaps over the largest displacement of a control point.
template <int Dim>
double unresolvedShare(const FaceContact<Dim>& contact, const Eigen::VectorXd& x) {
  const Eigen::VectorXd& gap = contact.state().gap;
  Eigen::Index nearest = 0;
  const double smallest = gap.minCoeff(&nearest);
  for (const auto& span : contact.face().spans()) {
    const Eigen::Index points = span.weights.size();
    if (nearest < span.firstPoint || nearest >= span.firstPoint + points) continue;
    double way = 0.0;
    for (const int function : span.functions)
      way = std::max(way,
                     x.segment<Dim>(Dim * contact.face().nodes()[static_cast<std::size_t>(function)]).norm());
    const double apart = gap.segment(span.firstPoint, points).maxCoeff() - smallest;
    return std::isfinite(apart) && apart > 0.0 ? apart / way : 0.0;  // infinite without a partner
  }
  return 0.0;
}

}  // namespace

template <int Dim>
void PeakContact::update(const FaceContact<Dim>& contact, const Eigen::VectorXd& x, double time) {
  const auto& state = contact.state();
  if (state.active.empty()) return;
  const double force = state.reaction.norm();
  if (force <= force_) return;
  force_ = force;
  time_ = time;
  active_ = state.numActive();
  all_ = active_ == std::ssize(state.active);
  unresolved_ = unresolvedShare(contact, x);
}

bool PeakContact::isCoarse() const {
  constexpr double kResolved = 0.5;
  return active_ > 0 && !all_ && active_ < limitOf(Condition::LostContact) && unresolved_ > kResolved;
}

std::string PeakContact::pointsText() const {
  return fmt::format("{} control point{}", active_, active_ == 1 ? "" : "s");
}

void PeakContact::archive(StateArchive& archive) {
  archive.together("peak", force_, time_, unresolved_, active_, all_);
}

template void PeakContact::update(const FaceContact<2>&, const Eigen::VectorXd&, double);
template void PeakContact::update(const FaceContact<3>&, const Eigen::VectorXd&, double);

}  // namespace burnish::inline analysis
