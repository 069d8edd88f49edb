#include "engine/solver/newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/stopwatch.h"

namespace burnish {
namespace {

std::vector<CouplingGroups> couplingsOf(const std::vector<Term*>& terms) {
  std::vector<CouplingGroups> groups;
  for (const Term* term : terms) groups.push_back(term->couplings());
  return groups;
}

}  // namespace

std::string describe(NewtonOutcome outcome) {
  switch (outcome) {
    case NewtonOutcome::Converged:
      return "converged";
    case NewtonOutcome::Inadmissible:
      return "no admissible state was found (J <= 0 or a failed return map)";
    case NewtonOutcome::Singular:
      return "the tangent matrix is singular";
    case NewtonOutcome::TooManyIterations:
      return "the residual did not fall below the tolerance";
    case NewtonOutcome::NotFinite:
      return "the residual is not finite";
  }
  return {};
}

Newton::Newton(std::vector<Term*> terms, std::vector<bool> prescribed, ResidualScales scales, MatrixKind kind,
               NewtonOptions options)
    : terms_(std::move(terms)),
      scales_(std::move(scales)),
      options_(options),
      system_(std::move(prescribed), couplingsOf(terms_)),
      linear_(makeLinearSolver(kind)),
      forces_(terms_.size(), Eigen::VectorXd::Zero(system_.numUnknowns())) {
  timings_.terms.assign(terms_.size(), 0.0);
}

bool Newton::evaluate(double t, const Eigen::VectorXd& x) {
  system_.setZero();
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Stopwatch watch(timings_.terms[k]);
    forces_[k].setZero();
    Assembly out{forces_[k], &system_, k};
    if (!terms_[k]->evaluate(t, x, out)) return false;
  }
  return true;
}

void Newton::measure(const Eigen::VectorXd& x, bool prescribedReached, NewtonReport& report) {
  const auto nForces = scales_.numForces;
  double reference = scales_.forceFloor;
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(system_.numUnknowns());
  for (const auto& force : forces_) {
    reference = std::max(reference, force.head(nForces).norm());
    residual += force;
  }
  double sum = 0.0;
  double constraint = 0.0;
  for (const int i : system_.freeUnknowns()) {
    if (i < nForces)
      sum += residual(i) * residual(i);
    else
      constraint = std::max(constraint, std::abs(residual(i)) / scales_.constraints(i - nForces));
  }
  report.residual = std::sqrt(sum) / reference;
  report.constraint = constraint;
  report.history.push_back(report.residual);
  report.outcome = !std::isfinite(report.residual + report.constraint) ? NewtonOutcome::NotFinite
                   : prescribedReached && isConverged(report)          ? NewtonOutcome::Converged
                                                                       : NewtonOutcome::TooManyIterations;
  static_cast<void>(x);
}

bool Newton::isConverged(const NewtonReport& report) const {
  return report.iterations > 0 && report.residual < options_.tolerance &&
         report.constraint < options_.constraintTolerance;
}

NewtonReport Newton::solve(double t, const Eigen::VectorXd& target, Eigen::VectorXd& x) {
  NewtonReport report;
  const auto prescribedIncrement = [&] {
    Eigen::VectorXd increment = target - x;
    increment(system_.freeUnknowns()).setZero();
    return increment;
  };

  if (!evaluate(t, x)) {
    report.outcome = NewtonOutcome::Inadmissible;
    return report;
  }
  for (;;) {
    Eigen::VectorXd correction = prescribedIncrement();
    const bool reached = correction.isZero(0.0);
    measure(x, reached, report);
    if (report.outcome != NewtonOutcome::TooManyIterations || report.iterations == options_.maxIterations)
      return report;

    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(x.size());
    for (const auto& force : forces_) rhs -= force;
    if (!reached) rhs -= system_.tangent() * correction;
    {
      const Stopwatch watch(timings_.factorisation);
      if (!linear_->factorise(system_.freeTangent())) {
        report.outcome = NewtonOutcome::Singular;
        return report;
      }
    }
    {
      const Stopwatch watch(timings_.solve);
      correction += system_.expandFromFree(linear_->solve(system_.restrictToFree(rhs)));
    }
    ++report.iterations;
    ++timings_.iterations;
    if (!correction.allFinite()) {
      report.outcome = NewtonOutcome::Singular;
      return report;
    }

    // A correction that turns a point of the body inside out is shortened before it is taken.
    const Eigen::VectorXd start = x;
    double s = 1.0;
    for (int halvings = 0;; ++halvings, s *= 0.5) {
      x = start + s * correction;
      if (s == 1.0 && !reached) {
        for (int i = 0; i < system_.numUnknowns(); ++i)
          if (system_.isPrescribed(i)) x(i) = target(i);  // exactly, not up to a rounded sum
      }
      if (evaluate(t, x)) break;
      ++report.backtracks;
      if (halvings == options_.maxBacktracks) {
        report.outcome = NewtonOutcome::Inadmissible;
        return report;
      }
    }
  }
}

}  // namespace burnish
