#include "engine/solid/stabilisation.h"

#include <algorithm>

namespace burnish::inline solid {

template <int Dim>
Stabilisation<Dim>::Stabilisation(int numNodes, const Drag& drag)
    : drag_(drag),
      viscosities_(Eigen::VectorXd::Zero(numNodes)),
      masses_(Eigen::VectorXd::Zero(numNodes)),
      x_(Eigen::VectorXd::Zero(Dim * numNodes)),
      time_(drag.start),
      step_(drag.end),
      trial_(x_),
      trialTime_(time_) {}

template <int Dim>
void Stabilisation<Dim>::hold(const SpanQuadrature<Dim>& quadrature, double viscosity) {
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature.spans()) {
    masses_(span.nodes) += span.values(buffer) * span.weights;
    viscosities_(span.nodes).setConstant(viscosity);
  }
}

template <int Dim>
double Stabilisation<Dim>::viscosity(Eigen::Index node, double t) const {
  return viscosities_(node) * std::clamp(1.0 - t / drag_.end, kRemainder, 1.0);
}

template <int Dim>
CouplingGroups Stabilisation<Dim>::couplings() const {
  CouplingGroups groups;
  for (int i = 0; i < static_cast<int>(x_.size()); ++i) groups.push_back({i});
  return groups;
}

template <int Dim>
bool Stabilisation<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  trial_ = x.head(x_.size());
  trialTime_ = t;
  const double step = t > time_ ? t - time_ : step_;  // none where a state is settled at its time
  force_ = 0.0;
  work_ = 0.0;
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    const double stiffness = viscosity(i / Dim, t) * masses_(i / Dim) / step;
    const double way = trial_(i) - x_(i);
    out.force(i) += stiffness * way;
    force_ += std::abs(stiffness * way);
    work_ += stiffness * way * way;
    if (out.system != nullptr)
      out.system->add(out.term, static_cast<std::size_t>(i), Eigen::MatrixXd::Constant(1, 1, stiffness));
  }
  return true;
}

template <int Dim>
void Stabilisation<Dim>::accept() {
  if (trialTime_ > time_) step_ = trialTime_ - time_;
  x_ = trial_;
  time_ = trialTime_;
}

template <int Dim>
void Stabilisation<Dim>::archive(StateArchive& archive) {
  archive.fixedField("displacement", x_);
  archive.field("time", time_);
  archive.field("step", step_);
}

template class Stabilisation<2>;
template class Stabilisation<3>;

}  // namespace burnish::inline solid
