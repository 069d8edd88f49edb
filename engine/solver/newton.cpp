#include "engine/solver/newton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"

namespace burnish::inline solver {
namespace {

/// keepsProducts: as solvers do that need no entries.
std::vector<CouplingGroups> couplingsOf(const std::vector<Term*>& terms, bool keepsProducts) {
  std::vector<CouplingGroups> groups;
  for (Term* term : terms) {
    if (keepsProducts) term->keepProducts();
    groups.push_back(term->couplings());
  }
  return groups;
}

TangentKind tangentKind(const std::vector<Term*>& terms) {
  const bool symmetric =
      std::all_of(terms.begin(), terms.end(), [](const Term* term) { return term->hasSymmetricTangent(); });
  return symmetric ? TangentKind::Symmetric : TangentKind::General;
}

/// Free unknowns with numbers below a limit.
std::ptrdiff_t numFreeBelow(const SparseSystem& system, int limit) {
  const auto& unknowns = system.freeUnknowns();
  return std::count_if(unknowns.begin(), unknowns.end(), [&](int unknown) { return unknown < limit; });
}

/// Unknowns that K of the tangent is over: those of the hierarchy of meshes where there is one, else all with
/// forces, free ways of tools included.
int numLeading(const std::vector<bool>& prescribed, int numForces,
               const std::optional<Hierarchy>& hierarchy) {
  if (!hierarchy || hierarchy->prolongations.empty()) return numForces;
  auto left = hierarchy->prolongations.front().rows();
  int end = 0;
  for (; left > 0; ++end) left -= prescribed.at(static_cast<std::size_t>(end)) ? 0 : 1;
  return end;
}

/// The tangent of terms, divided among the ranks of the team.
SparseSystem systemOf(const std::vector<Term*>& terms, const std::vector<bool>& prescribed, int numForces,
                      const std::optional<Hierarchy>& hierarchy, const Team& team,
                      const std::optional<Division>& division) {
  const std::vector<CouplingGroups> groups = couplingsOf(terms, hierarchy.has_value());
  const int leading = numLeading(prescribed, numForces, hierarchy);
  if (team.isAlone() || division) return {prescribed, groups, leading, division};
  return {prescribed, groups, leading,
          divideUnknowns(groups, prescribed, leading, hierarchy->grids, team.rank(), team.size())};
}

/// Ranks decide alike only from the same bits: processors of different kinds may round differently.
void requireSameOnAllRanks(const Team& team, std::array<double, 2> values) {
  const std::array<double, 2> mine = values;
  team.share(values, 0);
  if (!team.all(std::memcmp(values.data(), mine.data(), sizeof(mine)) == 0))
    throw Error(
        "the processes have found different residuals: their processors round differently; run them on "
        "processors of one kind");
}

/// Corrections at whose end the residual does this part, or more, of the work against them that it does for them at their
/// start have gone too far: metal that they made flow, or contact that they opened, holds against them there.
constexpr double kOvershoot = 0.5;

/// States along such a correction that are looked at, at most.
constexpr int kMostTries = 3;

/// Residual over the tolerance up to which what it does may be rounding.
constexpr double kNearTheEnd = 100.0;

/// Whether the last iterates of a search go to and fro between two states, as where each correction makes a place stick that
/// the next one makes slip. residuals: of all iterates.
bool goesToAndFro(const std::vector<double>& residuals) {
  constexpr double kSame = 0.01;
  const auto last = residuals.rbegin();
  const auto isAsBefore = [&](std::ptrdiff_t ago) { return std::abs(last[ago] - *last) < kSame * *last; };
  return residuals.size() > 4 && isAsBefore(2) && isAsBefore(4);
}

/// Corrections of a search of which each is the one before turned round and little smaller, as where the tangent lacks a part of
/// what a place resists: the points of a rule that is split where a contact ends move with the unknowns.
class Turns {
 public:
  /// The part of the next correction that leads to where such a sequence would end (Aitken); 1 of others. All before it, of
  /// this object, were taken whole.
  double partOf(const Eigen::VectorXd& correction) {
    constexpr double kSlow = 0.5, kSame = 1.05, kApart = 0.1;
    constexpr int kEnough = 3;
    const double ratio = last_.size() == 0 ? 0.0 : -correction.dot(last_) / last_.squaredNorm();
    const bool isTurned =
        ratio > kSlow && ratio < kSame && (correction + ratio * last_).norm() < kApart * correction.norm();
    count_ = isTurned ? count_ + 1 : 0;
    last_ = correction;
    if (count_ < kEnough) return 1.0;
    count_ = 0;
    last_.resize(0);
    return 1.0 / (1.0 + ratio);
  }

 private:
  Eigen::VectorXd last_;
  int count_ = 0;
};

/// Residuals of all terms together, less what is held against them.
Eigen::VectorXd sumOf(const std::vector<Eigen::VectorXd>& forces, const Eigen::VectorXd& held, int size) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
  for (const auto& force : forces) sum += force;
  if (held.size() > 0) sum -= held;
  return sum;
}

/// Goes to a part of a way, no more than `far`, at whose end the work is small; it is measured by that at the start of the
/// way, atFar < 0 at `far`: regula falsi in the Illinois form, and the best of all states if none will do. workAt(part)
/// goes there and says what it is, nothing where no state is admissible.
template <class F>
bool findBalance(double far, double atFar, const F& workAt) {
  double near = 0.0, atNear = 1.0, best = far, atBest = atFar, part = far;
  int lastSide = 0;
  for (int k = 0; k < kMostTries && std::abs(atBest) > kOvershoot; ++k) {
    constexpr double kInside = 0.1;
    part = near + (far - near) * std::clamp(atNear / (atNear - atFar), kInside, 1.0 - kInside);
    const std::optional<double> work = workAt(part);
    if (work && std::abs(*work) < std::abs(atBest)) {
      best = part;
      atBest = *work;
    }
    const int side = work && *work > 0.0 ? 1 : -1;
    if (side > 0) {
      near = part;
      atNear = *work;
      if (lastSide == side) atFar *= 0.5;
    } else {
      far = part;
      if (work) atFar = *work;
      if (lastSide == side) atNear *= 0.5;
    }
    lastSide = side;
  }
  return part == best || workAt(best).has_value();
}

}  // namespace

std::string describe(NewtonOutcome outcome) {
  switch (outcome) {
    case NewtonOutcome::Converged:
      return "converged";
    case NewtonOutcome::Inadmissible:
      return "no admissible state was found (J <= 0, a failed return map, a tool that passes through the "
             "surface, or a face that has lost the part of itself it touches)";
    case NewtonOutcome::Singular:
      return "the tangent matrix is singular";
    case NewtonOutcome::Diverged:
      return "the iteration diverged";
    case NewtonOutcome::TooManyIterations:
      return "the residual did not fall below the tolerance";
    case NewtonOutcome::NotFinite:
      return "the residual is not finite";
  }
  return {};
}

Newton::Newton(std::vector<Term*> terms, std::vector<bool> prescribed, ResidualScales scales,
               NewtonOptions options, std::optional<Hierarchy> hierarchy, const Team& team,
               std::optional<Division> division)
    : terms_(std::move(terms)),
      scales_(std::move(scales)),
      options_(std::move(options)),
      hierarchy_(std::move(hierarchy)),
      team_(team),
      system_(systemOf(terms_, prescribed, scales_.numForces, hierarchy_, team, division)),
      linear_(makeLinearSolver(options_.linear,
                               {numFreeBelow(system_, scales_.numForces), tangentKind(terms_),
                                hierarchy_ ? &*hierarchy_ : nullptr, &team, system_.leadingDivision()})),
      inertia_(numFreeBelow(system_, scales_.numForces)),
      forces_(terms_.size(), Eigen::VectorXd::Zero(system_.numUnknowns())) {
  timings_.terms.assign(terms_.size(), 0.0);
  if (team_.isAlone() || division) return;
  for (Term* term : terms_) term->divideAmong(team_, system_.division());
}

void Newton::rememberTangent() {
  if (!linear_->isIterative()) remembered_ = system_.entries();
}

bool Newton::evaluate(double t, const Eigen::VectorXd& x) {
  hasEquilibrium_ = false;
  system_.setZero();
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Stopwatch watch(timings_.terms[k]);
    forces_[k].setZero();
    Assembly out{forces_[k], &system_, k};
    if (!terms_[k]->evaluate(t, x, out)) return false;
  }
  return true;
}

Newton::Residual Newton::measure() const {
  const auto nForces = scales_.numForces;
  Residual measured;
  measured.reference = scales_.forceFloor;
  for (const auto& force : forces_)
    measured.reference = std::max(measured.reference, force.head(nForces).norm());
  const Eigen::VectorXd total = sumOf(forces_, held_, system_.numUnknowns());
  double sum = 0.0, largest = 0.0;
  for (const int i : system_.freeUnknowns()) {
    const double size = std::abs(total(i));
    if (i >= nForces) {
      measured.constraint = std::max(measured.constraint, size / scales_.constraints(i - nForces));
      continue;
    }
    sum += size * size;
    if (size > largest) {
      largest = size;
      measured.worstUnknown = i;
    }
  }
  measured.force = std::sqrt(sum) / measured.reference;
  for (const auto& [turn, lengthOverRadius] : scales_.turns)
    if (!system_.isPrescribed(turn))
      measured.turn = std::max(measured.turn, lengthOverRadius * std::abs(total(turn)) / measured.reference);
  if (!team_.isAlone()) requireSameOnAllRanks(team_, {measured.force, measured.constraint});
  return measured;
}

double Newton::roundOff(const Eigen::VectorXd& x) const {
  Eigen::VectorXd magnitude = x.cwiseAbs();
  magnitude.head(scales_.numForces) += scales_.spanSizes;
  Eigen::VectorXd bound = system_.timesMagnitudes(magnitude);
  team_.sum(asSpan(bound));
  double sum = 0.0;
  for (const int i : system_.freeUnknowns())
    if (i < scales_.numForces) sum += bound(i) * bound(i);
  return 4.0 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

int Newton::countUnstableDirections() {
  // The last iterate is so near that a definite tangent there is one here.
  if (!hasEquilibrium_ || system_.freeUnknowns().empty() || !team_.isAlone() ||
      linear_->definiteness() != Definiteness::NotDefinite)
    return 0;
  const Stopwatch watch(timings_.factorisation);
  return inertia_.unstableDirections(system_.whole());
}

NewtonOutcome Newton::judge(const Residual& residual, const Eigen::VectorXd& x, NewtonReport& report) const {
  report.residual = residual.force;
  report.constraint = residual.constraint;
  report.worstUnknown = residual.worstUnknown;
  report.history.push_back(residual.force);
  if (!std::isfinite(residual.force + residual.constraint)) return NewtonOutcome::NotFinite;
  if (report.iterations > 0 && residual.constraint < options_.constraintTolerance) {
    // The bound of rounding is generous on graded meshes: what still falls by a digit is not rounding.
    constexpr double kStillFalls = 0.1;
    const double before = report.history[report.history.size() - 2];
    const bool isLast = report.iterations == options_.maxIterations;
    if (residual.force < options_.tolerance) {
      const bool turnsAreFree = residual.turn < options_.turnTolerance || before < options_.tolerance;
      if (turnsAreFree || isLast) return NewtonOutcome::Converged;
    } else {
      report.atRoundOff = (isLast || !(residual.force < kStillFalls * before)) &&
                          residual.force * residual.reference < roundOff(x);
      if (report.atRoundOff) return NewtonOutcome::Converged;
    }
  }
  const auto count = static_cast<std::ptrdiff_t>(options_.divergedIterations);
  const auto& history = report.history;
  if (std::ssize(history) > count && std::all_of(history.end() - count, history.end(),
                                                 [&](double r) { return r > options_.divergedResidual; }))
    return NewtonOutcome::Diverged;
  return NewtonOutcome::TooManyIterations;
}

/// Eisenstat and Walker's forcing terms: no more digits than the tangent is worth, as the last correction has
/// shown.
SolveAccuracy Newton::accuracyFor(const Eigen::VectorXd& rhs, double reference) {
  // One digit is enough far from equilibrium, once the first system of a search has told what digits cost; near it, a
  // residual that hardly falls is to be that of rounding.
  constexpr double kMost = 0.1, kMostNearby = 1e-3, kLeast = 1e-13, kBeyond = 1e-2, kNearby = 1e5;
  const auto& free = system_.freeUnknowns();
  SolveAccuracy accuracy;
  accuracy.rowWeights.resize(rhs.size());
  for (Eigen::Index k = 0; k < rhs.size(); ++k) {
    const int unknown = free[static_cast<std::size_t>(k)];
    const double goal = unknown < scales_.numForces
                            ? options_.tolerance * reference
                            : options_.constraintTolerance * scales_.constraints(unknown - scales_.numForces);
    accuracy.rowWeights(k) = 1.0 / goal;
  }
  const double size = rhs.cwiseProduct(accuracy.rowWeights).norm();
  const double ratio = size / weighedResidual_;
  weighedResidual_ = size;
  const double most = std::isfinite(ratio) && size > kNearby ? kMost : kMostNearby;
  accuracy.reduction = options_.linear.tolerance.value_or(
      std::clamp(std::max(kBeyond / size, 0.9 * ratio * ratio), kLeast, most));
  if (std::isfinite(ratio)) accuracy.fallen = ratio;
  return accuracy;
}

bool Newton::findCorrection(bool isFirst, FirstTangent first, const Residual& residual,
                            Eigen::VectorXd& correction) {
  if (isFirst && first == FirstTangent::Remembered && remembersTangent()) system_.setEntries(remembered_);
  if (system_.freeUnknowns().empty()) return true;  // supports say it all
  Eigen::VectorXd rhs = -sumOf(forces_, held_, static_cast<int>(correction.size()));
  if (!correction.isZero(0.0)) {
    Eigen::VectorXd moved = system_.timesPrescribed(correction);
    team_.sum(asSpan(moved));
    rhs -= moved;
  }
  {
    const Stopwatch watch(timings_.factorisation);
    if (!linear_->factorise(system_)) return false;
  }
  const Stopwatch watch(timings_.solve);
  const Eigen::VectorXd free = system_.restrictToFree(rhs);
  const SolveAccuracy accuracy =
      linear_->isIterative() ? accuracyFor(free, residual.reference) : SolveAccuracy{};
  correction += system_.expandFromFree(linear_->solve(free, accuracy));
  return correction.allFinite();
}

bool Newton::take(double t, const Eigen::VectorXd& correction, double part, const Eigen::VectorXd& target,
                  Eigen::VectorXd& x, NewtonReport& report) {
  const Eigen::VectorXd start = x;
  const double before = report.history.back();
  double useful = 1.0;
  for (const Term* term : terms_) useful = std::min(useful, term->usefulPart(start, correction));
  report.cameFree = report.cameFree || useful < 1.0;
  Eigen::VectorXd way = correction;
  if (useful < 1.0) way.head(scales_.numForces) *= useful;
  const auto goTo = [&](double share) {
    x = start + share * way;
    if (share == 1.0 && useful == 1.0)
      for (int i = 0; i < system_.numUnknowns(); ++i)
        if (system_.isPrescribed(i)) x(i) = target(i);  // exactly, not up to a rounded sum
    return evaluate(t, x);
  };
  const auto work = [&] {
    const Eigen::VectorXd residual = sumOf(forces_, held_, system_.numUnknowns());
    double sum = 0.0;
    for (const int i : system_.freeUnknowns())
      if (i < scales_.numForces) sum += residual(i) * way(i);
    if (!team_.isAlone()) requireSameOnAllRanks(team_, {sum, 0.0});
    return sum;
  };
  // Factors have their own way to a good first correction, the remembered tangent; where a problem has several solutions, as
  // metal that piles up, they keep to those that they have always found.
  bool mayGoTooFar = linear_->isIterative() && useful == 1.0 && before > kNearTheEnd * options_.tolerance;
  for (int i = 0; mayGoTooFar && i < system_.numUnknowns(); ++i)
    mayGoTooFar = !system_.isPrescribed(i) || correction(i) == 0.0;
  const double workAtStart = mayGoTooFar ? work() : 0.0;
  double s = part;
  if (before > kNearTheEnd * options_.tolerance && goesToAndFro(report.history))
    s = std::min(s, 0.5);  // leads away from both states
  if (s < 1.0) ++report.backtracks;
  for (int halvings = 0;; ++halvings, s *= 0.5) {
    if (goTo(s)) {
      if (workAtStart < 0.0) {
        const double over = work() / workAtStart;
        if (over < -kOvershoot && std::isfinite(over))
          return findBalance(s, over, [&](double share) -> std::optional<double> {
            ++report.backtracks;
            const double there =
                goTo(share) ? work() / workAtStart : std::numeric_limits<double>::quiet_NaN();
            return std::isfinite(there) ? std::optional(there) : std::nullopt;
          });
      }
      const bool mayGrow =
          report.iterations <= options_.freeIterations || halvings >= options_.maxShortenings;
      const double now = mayGrow ? 0.0 : measure().force;
      if (mayGrow || now < options_.harmlessResidual || now < before) return true;
    } else if (halvings >= options_.maxBacktracks) {
      return false;
    }
    ++report.backtracks;
  }
}

void Newton::archive(StateArchive& archive) {
  Eigen::VectorXd entries;
  if (remembersTangent()) entries = system_.byColumns(remembered_);
  archive.field("remembered_tangent", entries);
  if (entries.size() != 0 && entries.size() != system_.nonZeros())
    throw Error("the saved tangent is none of this run");
  if (archive.restores())
    remembered_ = entries.size() != 0 ? system_.fromColumns(entries) : SparseSystem::Entries{};
  archive.fixedField("seconds_of_terms", timings_.terms);
  archive.field("seconds_of_factorisation", timings_.factorisation);
  archive.field("seconds_of_solve", timings_.solve);
  archive.field("iterations", timings_.iterations);
  archive.part("linear_solver", *linear_);
}

NewtonReport Newton::solve(double t, const Eigen::VectorXd& target, Eigen::VectorXd& x, FirstTangent first) {
  NewtonReport report;
  Turns turns;
  weighedResidual_ = 0.0;
  linear_->beginSearch();
  if (!evaluate(t, x)) {
    report.outcome = NewtonOutcome::Inadmissible;
    return report;
  }
  for (;;) {
    const Residual residual = measure();
    report.outcome = judge(residual, x, report);
    Eigen::VectorXd correction = target - x;  // of the prescribed unknowns; the others follow
    correction(system_.freeUnknowns()).setZero();
    if (report.outcome == NewtonOutcome::Converged && !correction.isZero(0.0))
      report.outcome = NewtonOutcome::TooManyIterations;
    hasEquilibrium_ = report.outcome == NewtonOutcome::Converged;
    if (report.outcome != NewtonOutcome::TooManyIterations || report.iterations == options_.maxIterations)
      return report;

    const auto before = linear_->counts();
    if (!findCorrection(report.iterations == 0, first, residual, correction)) {
      report.outcome = NewtonOutcome::Singular;
      return report;
    }
    if (before) report.linearIterations.push_back(linear_->counts()->iterations - before->iterations);
    ++report.iterations;
    ++timings_.iterations;
    const int shortened = report.backtracks;
    if (!take(t, correction, turns.partOf(correction.head(scales_.numForces)), target, x, report)) {
      report.outcome = NewtonOutcome::Inadmissible;
      return report;
    }
    if (report.backtracks > shortened || report.cameFree) turns = Turns();
  }
}

}  // namespace burnish::inline solver
