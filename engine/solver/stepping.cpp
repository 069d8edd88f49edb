#include "engine/solver/stepping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline solver {
namespace {

/// Attempts, counted with the failed one, that do not start extrapolated after an extrapolated start has
/// failed.
constexpr int kPauseAfterFailedExtrapolation = 3;

}  // namespace

Stepping::Stepping(Newton& newton, std::vector<Term*> terms, std::function<Eigen::VectorXd(double)> target,
                   SteppingOptions options, SteppingState start, Travel travel)
    : newton_(newton),
      terms_(std::move(terms)),
      target_(std::move(target)),
      travel_(std::move(travel)),
      options_(options),
      state_(std::move(start)) {}

NewtonReport Stepping::attempt(double time, Start start, Eigen::VectorXd& x) {
  const Eigen::VectorXd target = target_(time);
  x = state_.x;
  if (start == Start::Extrapolated) {
    x += (time - state_.time) / state_.lastSize * lastIncrement(time, state_.travels);
    for (int i = 0; i < newton_.system().numUnknowns(); ++i)
      if (newton_.system().isPrescribed(i)) x(i) = target(i);
  } else {
    for (const Term* term : terms_) term->takeAlong(state_.time, time, x);
  }
  return newton_.solve(time, target, x,
                       start == Start::RememberedTangent ? FirstTangent::Remembered : FirstTangent::Current);
}

Eigen::VectorXd Stepping::lastIncrement(double time, bool moved) const {
  Eigen::VectorXd increment = state_.lastIncrement;
  if (moved) travel_(state_.time - state_.lastSize, time, increment);
  return increment;
}

bool Stepping::travelled(double time, const Eigen::VectorXd& x) const {
  constexpr double kMuchNearer = 0.6;
  if (!travel_ || state_.lastIncrement.size() == 0) return false;
  const Eigen::Index numForces = newton_.numForces();
  const Eigen::VectorXd increment = x - state_.x;
  const double ratio = (time - state_.time) / state_.lastSize;
  const auto distance = [&](bool moved) {
    return (increment - ratio * lastIncrement(time, moved)).head(numForces).norm();
  };
  return distance(true) < kMuchNearer * distance(false);
}

std::vector<Stepping::Start> Stepping::starts() const {
  // At a corner of a schedule points that flowed unload: what the last step ended with says nothing there.
  const bool goesOn = state_.lastIncrement.size() > 0;
  std::vector<Start> starts;
  if (goesOn && state_.stepsToExtrapolation == 0) starts.push_back(Start::Extrapolated);
  if (goesOn && newton_.remembersTangent()) starts.push_back(Start::RememberedTangent);
  starts.push_back(Start::Old);
  if (!goesOn && newton_.remembersTangent()) starts.push_back(Start::RememberedTangent);
  return starts;
}

void SteppingState::archive(StateArchive& archive) {
  archive.field("time", time);
  archive.fixedField("x", x);
  archive.field("last_increment", lastIncrement);
  if (lastIncrement.size() != 0 && lastIncrement.size() != x.size())
    throw Error("the saved increment is none of this run");
  archive.field("last_size", lastSize);
  archive.field("level", level);
  archive.field("easy_steps", easySteps);
  archive.field("steps_to_extrapolation", stepsToExtrapolation);
  archive.field("travels", travels);
  archive.field("steps", steps);
  archive.field("cuts", cuts);
  archive.field("iterations", iterations);
  archive.field("smallest_step", smallestStep);
}

NewtonReport Stepping::settle() {
  Eigen::VectorXd x = state_.x;
  NewtonReport report = newton_.solve(state_.time, target_(state_.time), x);
  state_.iterations += report.iterations;
  if (report.outcome != NewtonOutcome::Converged) return report;
  newton_.rememberTangent();
  for (Term* term : terms_) term->accept();
  state_.x = std::move(x);
  return report;
}

Walk Stepping::advance(double time, double nominal, const std::function<bool(const StepReport&)>& accepted) {
  int attempted = 0, cuts = 0;
  while (state_.time < time) {
    const double remaining = time - state_.time;
    double size = std::ldexp(nominal, -state_.level);
    // A remainder that differs from the step by rounding only is the step.
    const bool lands = size > remaining * (1.0 - 1e-9);
    const double next = lands ? time : state_.time + size;
    size = next - state_.time;

    Eigen::VectorXd x;
    NewtonReport report;
    for (const Start start : starts()) {
      report = attempt(next, start, x);
      attempted += report.iterations;
      if (start == Start::Extrapolated && report.outcome != NewtonOutcome::Converged)
        state_.stepsToExtrapolation = kPauseAfterFailedExtrapolation;
      if (report.outcome == NewtonOutcome::Converged) break;
    }
    state_.stepsToExtrapolation = std::max(0, state_.stepsToExtrapolation - 1);

    if (report.outcome != NewtonOutcome::Converged) {
      lastFailure_ = report;
      lastFailedStep_ = size;
      if (state_.level == options_.maxCuts) {
        state_.iterations += attempted;
        return Walk::Failed;
      }
      do  // the same step again would fail again
        ++state_.level;
      while (state_.level < options_.maxCuts && std::ldexp(nominal, -state_.level) > size * (1.0 - 1e-9));
      ++state_.cuts;
      ++cuts;
      state_.easySteps = 0;
      continue;
    }

    newton_.rememberTangent();
    for (Term* term : terms_) term->accept();
    state_.travels = travelled(next, x);
    // A body that has come free does not go on as it sprang back.
    state_.lastIncrement = report.cameFree ? Eigen::VectorXd() : Eigen::VectorXd(x - state_.x);
    state_.lastSize = size;
    state_.x = std::move(x);
    state_.time = next;
    ++state_.steps;
    state_.iterations += attempted;
    state_.smallestStep = state_.steps == 1 ? size : std::min(state_.smallestStep, size);
    state_.easySteps = report.iterations <= options_.easyIterations ? state_.easySteps + 1 : 0;
    if (state_.level > 0 && state_.easySteps >= 2) {
      --state_.level;
      state_.easySteps = 0;
    }
    const bool goesOn = accepted({state_.steps, state_.time, size, std::move(report), attempted, cuts});
    if (!goesOn && state_.time < time) return Walk::Halted;
    attempted = 0;
    cuts = 0;
  }
  return Walk::Arrived;
}

}  // namespace burnish::inline solver
