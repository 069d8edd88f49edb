#include "engine/analysis/recorder.h"

namespace burnish::inline analysis {

template <int Dim>
void Recorder<Dim>::update(const MeasuredState& state, const Eigen::VectorXd& force,
                           const Equilibrium& equilibrium) {
  history_.update(state, force, equilibrium.stabilisedShare);
  doubts_.update(history_, equilibrium.unstableDirections);
}

template <int Dim>
void Recorder<Dim>::continueFrom(const Recorder& before) {
  history_.continueFrom(before.history_);
  doubts_.continueFrom(before.doubts_);
}

template <int Dim>
void Recorder<Dim>::archive(StateArchive& archive) {
  archive.part("history", history_);
  archive.part("doubts", doubts_);
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace burnish::inline analysis
