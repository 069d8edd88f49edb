#pragma once
#include <Eigen/Dense>

#include "engine/contact/partner.h"

namespace burnish::inline contact {

/// Work that friction takes from the bodies and the tool of a pair, by the trapezoidal rule over the steps
/// like the work of tools and loads:
///
///     ΔW = ½ (f_n + f_{n+1})·Δu,
///
/// f the forces of friction on all unknowns, less what they do on the prescribed motion of a tool.
class FrictionWork {
 public:
  /// The work of friction on another mesh comes before that of this one.
  void continueFrom(double work) { accepted_.work = work; }

  /// Begins an evaluation with the unknowns x.
  void start(const Eigen::VectorXd& x);

  /// Forces of friction of the evaluation, as a term adds them to its own, and on the partner.
  Eigen::VectorXd& force() { return trial_.force; }
  Eigen::Vector3d& reaction() { return trial_.reaction; }
  Eigen::Vector3d& moment() { return trial_.moment; }

  /// Ends the evaluation.
  template <int Dim>
  void end(const Partner<Dim>& partner) {
    trial_.work = accepted_.work + 0.5 * (accepted_.force + trial_.force).dot(trial_.x - accepted_.x) -
                  partner.prescribedWork(0.5 * (accepted_.reaction + trial_.reaction),
                                         0.5 * (accepted_.moment + trial_.moment));
  }

  /// Since the start, at the last evaluated state.
  double work() const { return trial_.work; }

  /// Unknowns in the accepted state.
  const Eigen::VectorXd& acceptedUnknowns() const { return accepted_.x; }

  void accept() { accepted_ = trial_; }
  void archive(StateArchive& archive);

 private:
  struct State {
    Eigen::VectorXd x;      ///< all unknowns; empty before the first evaluation
    Eigen::VectorXd force;  ///< by these
    Eigen::Vector3d reaction = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  ///< on the partner
    double work = 0.0;
  };
  State accepted_, trial_;
};

}  // namespace burnish::inline contact
