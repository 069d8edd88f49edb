#include "engine/solver/petsc/multigrid_solver.h"

#include <petsc/private/petscimpl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/solver/galerkin_product.h"
#include "engine/solver/petsc/border.h"
#include "engine/solver/petsc/divided_product.h"
#include "engine/solver/petsc/level_smoother.h"
#include "engine/solver/petsc/library.h"
#include "engine/solver/petsc/matrix_blocks.h"
#include "engine/solver/petsc/prolongation_rows.h"
#include "engine/solver/petsc/vectors.h"

namespace burnish::inline solver {
namespace {

using petsc::check;
using petsc::fill;
using petsc::read;
using petsc::write;

/// Where more are needed, others do better.
constexpr int kMostWithFactors = 150, kMostWithSweeps = 500;

/// A V-cycle of an earlier matrix is kept while a digit costs no more than this, over what it cost at first.
constexpr double kMostOverFirst = 1.5;

/// What it takes to set up a V-cycle, in iterations: with one of an earlier matrix no more than these are spent beyond
/// those with its own.
constexpr int kSetUp = 8;

/// A V-cycle of an earlier matrix is kept after corrections that have left no more than this of the residual: of 33 that
/// were kept after others, 21 were of no use; of 43 after such ones, 2.
constexpr double kMostFallenForKept = 0.1;

/// Steps of the smoother where one leaves too much: with entries, and with products; by over-relaxation always.
constexpr int kMoreSteps = 3, kStepsWithProducts = 5, kStepsOfSweeps = 2;

/// Of a V-cycle with one step of the smoother, where more are tried: iterations of a system, and those that a digit
/// costs; and what is left of the latter where more steps pay, which take twice the time and more. Greater reductions have too few
/// digits to tell.
constexpr double kTelling = 1e-3;
constexpr long kFew = 4;
constexpr double kMostPerDigit = 1.5, kPaying = 0.5, kPayingWithProducts = 0.4;

/// Steps are compared by systems that are solved to about the same reduction: the first digits cost less than later ones, most so with
/// one step.
constexpr double kLikeReduction = 0.1;

/// Eigenvalues that a smoother's polynomial makes small, over the largest one that is estimated: from the smallest on
/// that coarser meshes leave to one step, and from those that are left where one does not do.
constexpr double kLargest = 1.1, kSmallestOfOneStep = 0.4, kSmallest = 0.1, kSmallestWithProducts = 0.05;

/// A larger eigenvalue of a matrix with its factors comes from few functions for which these are almost singular, where all others are
/// below 7: what a smoother's polynomial is then made for leaves the others as they are. A larger shift has factors without such ones.
constexpr double kMostOfFactors = 12.0;

/// Searches after which a larger shift is lowered again, as far as the factors allow: one bad matrix is not to be felt for ever.
constexpr int kSearchesWithShift = 32;

/// Searches that go without incomplete factors after a search that has needed to.
constexpr int kMostWithout = 64;

/// A residual that has grown so much does not come down again.
constexpr double kDivergence = 1e10;

/// Of GMRES: so many vectors are kept.
constexpr int kRestart = 100;

/// The rows of a matrix, or of the transpose of one that has columns.
template <int Order>
SparseRows rowsOf(const Eigen::SparseMatrix<double, Order>& A) {
  return {static_cast<int>(A.outerSize()), A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
}

/// A matrix of the library over the arrays of others.
petsc::Matrix view(const SparseRows& A, Eigen::Index numColumns) {
  petsc::Matrix matrix;
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, A.size, static_cast<PetscInt>(numColumns),
                                  const_cast<PetscInt*>(A.begins), const_cast<PetscInt*>(A.columns),
                                  const_cast<double*>(A.values), matrix.place()));
  return matrix;
}

/// Rows of one pattern, as the three of a node, are not gone through together, which takes half as long again.
void goRowByRow(Mat matrix) {
  check(MatSetOption(matrix, MAT_USE_INODES, PETSC_FALSE));
}

bool isFinite(const SystemBorder& border) {
  return border.B.coeffs().allFinite() && border.G.coeffs().allFinite() && border.C.coeffs().allFinite();
}

}  // namespace

class MultigridSolver::Implementation {
 public:
  explicit Implementation(const LinearProblem& problem)
      : kind_(problem.kind), team_(*problem.team), hierarchy_(*problem.hierarchy) {
    const auto& prolongations = hierarchy_.prolongations;
    N_ = prolongations.empty() ? problem.leading : prolongations.front().rows();
    begins_ = team_.isAlone() ? std::vector<int>{0, static_cast<int>(N_)} : problem.rows.begins;
    if (team_.isAlone()) {
      for (const auto& P : prolongations) prolongations_.push_back(view(rowsOf(P), P.cols()));
    } else {
      divisions_.push_back(problem.rows);
      for (const auto& P : prolongations) {
        Division columns = coarseDivision(P, divisions_.back());
        prolongations_.push_back(ownRows(P, divisions_.back(), columns));
        divisions_.push_back(std::move(columns));
      }
    }
    leastShifts_.assign(prolongations_.size(), 0.0);
    const auto rank = static_cast<std::size_t>(team_.rank());
    first_ = begins_[rank];
    n_ = begins_[rank + 1] - begins_[rank];
  }

  void beginSearch() {
    isNear_ = knowsSpectra_ = false;
    if (factorises_ && hasSolved_) pause_ = 0;  // the search before has done with factors
    hasSolved_ = false;
    if (++searchesWithShift_ >= kSearchesWithShift) lowerShifts();
    useFactors(searchesWithout_ == 0);
    if (searchesWithout_ > 0) --searchesWithout_;
  }

  bool factorise(const SystemMatrix& A) {
    border_ = A.border();
    if (!team_.all(A.leading().coeffs().allFinite() && A.leadingElsewhere().coeffs().allFinite() &&
                   isFinite(border_)))
      return false;
    m_ = border_.C.rows();
    // Ranks have the border's entries in their rows and columns; what is in none of them the last one has.
    ownB_ = border_.B.middleRows(first_, n_);
    ownG_ = border_.G.middleCols(first_, n_);
    A_ = &A;
    if (K_ == nullptr) makeMatrix(A);
    isIndefinite_ = false;
    ++counts_.systems;
    return (isNear_ || setUpCycle()) && zone_.factorise(A, border_, team_, static_cast<int>(first_));
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    unfinished_.resize(0);
    // The V-cycle of a matrix that has changed more would be given up after as many iterations as a new one takes.
    if (isNear_ && accuracy.fallen > kMostFallenForKept) setUpCycle();
    const bool wasNear = isNear_;
    Eigen::VectorXd x = isSetUp_
                            ? solveWithCycle(b, accuracy)
                            : Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
    if (!x.allFinite() && wasNear && setUpCycle()) x = solveWithCycle(b, accuracy);
    if (!x.allFinite() && factorises_ && !team_.isAlone() && !overlaps_) {
      setSmoother(steps_, true);
      if (setUpCycle()) x = solveWithCycle(b, accuracy);
    }
    if (!x.allFinite() && factorises_) {
      if (smoothsWithProducts()) {  // they will not be tried again
        steps_ = 1;
        triesMoreSteps_ = false;
      }
      goOnWithoutFactors();  // they are of no use where shear is soft beside compression
      if (setUpCycle()) x = solveWithCycle(b, accuracy);
    }
    hasSolved_ = hasSolved_ || x.allFinite();
    if (isIndefinite_) ++numIndefinite_;
    return x;
  }

  /// Of the matrices of all levels, also while there is no V-cycle of them.
  Eigen::Index nonZeros() {
    if (K_ == nullptr || (!team_.isAlone() && divided_.size() < prolongations_.size())) return 0;
    Eigen::Index sum = 0;
    for (std::size_t level = 0; level <= prolongations_.size(); ++level) {
      MatInfo info;
      check(MatGetInfo(matrixOf(level), MAT_GLOBAL_SUM, &info));
      sum += static_cast<Eigen::Index>(info.nz_used);
    }
    return sum;
  }

  Definiteness definiteness() const {
    return isIndefinite_                                             ? Definiteness::NotDefinite
           : kind_ == TangentKind::Symmetric && !border_.isCoupled() ? Definiteness::Definite
                                                                     : Definiteness::NotKnown;
  }
  const IterationCounts& counts() const { return counts_; }
  void archive(StateArchive& archive) {
    archive.together("without_factors", searchesWithout_, pause_, factorises_, hasSolved_);
    archive.together("smoothing", steps_, overlaps_, perDigitOfOne_, reductionOfOne_, triesMoreSteps_);
    archive.fixedField("least_shifts", leastShifts_);
    archive.field("searches_with_shift", searchesWithShift_);
  }
  long numIndefinite() const { return numIndefinite_; }

 private:
  /// Of the present matrix.
  bool setUpCycle() {
    makeCoarseMatrices();
    do {
      if (!setUpLevels()) return setUpCycle();
    } while (isSetUp_ && raiseShifts());
    return isSetUp_;
  }

  /// Of matrices that have been made; false if the cycle has to be another one, without factors.
  bool setUpLevels() {
    if (cycle_ == nullptr) makeCycle();
    if (!team_.all(setUpSmoothers())) {
      goOnWithoutFactors();
      return false;
    }
    knowsSpectra_ = team_.all(knowsSpectra_);
    if (!knowsSpectra_)
      forSmoothers([&](KSP smoother, double&) {
        check(KSPChebyshevEstEigSet(smoother, 0.0, smallest(), 0.0, kLargest));
      });
    ++counts_.setUps;
    isNear_ = false;
    isSetUp_ = team_.all(PCSetUp(cycle_) == 0);
    if (isSetUp_ && !knowsSpectra_) keepSpectra();
    knowsSpectra_ = isSetUp_;
    return true;
  }

  /// Of factors that leave an eigenvalue which is too large; false if there are none.
  bool raiseShifts() {
    bool isRaised = false;
    for (std::size_t k = 0; k < smoothers_.size(); ++k) {
      const double largest = spectra_[smoothers_.size() - 1 - k];
      if (!(largest > kMostOfFactors) || !std::isfinite(largest)) continue;
      const std::optional<double> next = IncompleteFactors::nextShift(largestShift(k));
      if (!next) continue;
      leastShifts_[k] = *next;
      petsc::noteChangedValues(matrixOf(k));
      isRaised = true;
    }
    if (isRaised) {
      knowsSpectra_ = false;
      searchesWithShift_ = 0;
    }
    return isRaised;
  }

  /// Of a level, that any rank has.
  double largestShift(std::size_t level) const {
    std::vector<double> shifts(static_cast<std::size_t>(team_.size()));
    std::vector<int> begins(shifts.size() + 1);
    std::iota(begins.begin(), begins.end(), 0);
    shifts[static_cast<std::size_t>(team_.rank())] = smoothers_[level]->shift();
    team_.gather(asSpan(shifts), begins);
    return std::ranges::max(shifts);
  }

  void lowerShifts() {
    for (double& shift : leastShifts_) shift = IncompleteFactors::shiftBefore(shift);
    searchesWithShift_ = 0;
  }

  /// Those of all levels below the finest one.
  void makeCoarseMatrices() {
    petsc::noteChangedValues(K_);
    if (team_.isAlone()) {
      SparseRows rows = rowsOf(A_->leading());
      for (std::size_t k = 0; k < products_.size(); ++k) {
        products_[k].assign(rows);
        petsc::noteChangedValues(coarse_[k]);
        rows = products_[k].rows();
      }
      return;
    }
    for (std::size_t k = 0; k < prolongations_.size(); ++k) {
      if (k == divided_.size()) {
        divided_.push_back(std::make_unique<DividedProduct>(
            matrixOf(k), groupsOf(k), hierarchy_.prolongations[k], divisions_[k], divisions_[k + 1]));
        goRowByRow(divided_.back()->matrix());
        coarseGroups_.emplace_back(petsc::rowsOf(petsc::MatrixBlocks(divided_.back()->matrix()).diagonal));
      }
      divided_[k]->assign(matrixOf(k));
    }
  }

  /// Of all levels; false if one should have incomplete factors and has none.
  bool setUpSmoothers() {
    bool hasFactors = true;
    for (std::size_t k = 0; k <= prolongations_.size(); ++k) {
      const Mat entries = matrixOf(k);
      Mat product = entries;
      if (k < smoothers_.size()) {
        const double shift = smoothers_[k]->shift();
        if (!smoothers_[k]->assign(entries, leastShifts_[k])) hasFactors = false;
        knowsSpectra_ = knowsSpectra_ && smoothers_[k]->shift() == shift;
        product = k == 0 && smoothsWithProducts() ? static_cast<Mat>(rough_) : smoothers_[k]->product();
      }
      check(KSPSetOperators(smootherOf(static_cast<PetscInt>(prolongations_.size() - k)), product, entries));
    }
    // The library looks here for whether there is anything new.
    for (const Mat shell : {static_cast<Mat>(exact_), static_cast<Mat>(rough_)})
      check(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(shell)));
    return hasFactors;
  }

  /// Of a level, from the finest one on.
  Mat matrixOf(std::size_t level) const {
    if (level == 0) return K_;
    return team_.isAlone() ? static_cast<Mat>(coarse_[level - 1]) : divided_[level - 1]->matrix();
  }

  KSP smootherOf(PetscInt level) const {
    KSP smoother = nullptr;
    check(PCMGGetSmoother(cycle_, level, &smoother));
    return smoother;
  }

  /// f(smoother, the largest eigenvalue of its level).
  template <class F>
  void forSmoothers(const F& f) {
    spectra_.resize(prolongations_.size());
    for (std::size_t k = 0; k < spectra_.size(); ++k)
      f(smootherOf(static_cast<PetscInt>(k + 1)), spectra_[k]);
  }

  /// Of the matrix that has been set up, for the next ones of the search: an estimate takes as long as four or five
  /// iterations, and the largest eigenvalue of a matrix with its incomplete factors hardly changes.
  void keepSpectra() {
    forSmoothers([](KSP smoother, double& largest) {
      KSP estimate = nullptr;
      PetscInt count = 0;
      check(KSPChebyshevEstEigGetKSP(smoother, &estimate));
      check(KSPGetIterationNumber(estimate, &count));
      Eigen::VectorXd real(count), imaginary(count);
      check(KSPComputeEigenvalues(estimate, count, real.data(), imaginary.data(), &count));
      largest = count > 0 ? real.head(count).maxCoeff() : 0.0;
    });
    useSpectra();
  }

  void useSpectra() {
    forSmoothers([&](KSP smoother, double largest) {
      if (largest > 0.0)
        check(KSPChebyshevSetEigenvalues(smoother, kLargest * largest, smallest() * largest));
    });
  }

  double smallest() const {
    return steps() == 1 ? kSmallestOfOneStep : smoothsWithProducts() ? kSmallestWithProducts : kSmallest;
  }
  int steps() const { return factorises_ ? steps_ : kStepsOfSweeps; }

  /// Whether the finest smoother multiplies by the tangent with its products, which its factors do not know of: by the entries
  /// alone each iteration is worth little where these are as far from it as near incompressibility.
  bool smoothsWithProducts() const { return factorises_ && steps_ > 1 && A_->hasProducts(); }

  /// For some searches.
  void goOnWithoutFactors() {
    searchesWithout_ = pause_ = std::clamp(2 * pause_, 1, kMostWithout);
    useFactors(false);
  }

  void useFactors(bool factorises) {
    if (factorises == factorises_) return;
    factorises_ = factorises;
    forgetCycle();
  }

  void forgetCycle() {
    cycle_.reset();
    isSetUp_ = isNear_ = knowsSpectra_ = false;
  }

  /// Not finite if it does not converge.
  Eigen::VectorXd solveWithCycle(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    const long before = counts_.iterations;
    const bool isOwn = !isNear_, isWhole = unfinished_.size() == 0;
    Eigen::VectorXd x = iterateWithCycle(b, accuracy);
    const long iterations = counts_.iterations - before;
    const double perDigit = static_cast<double>(iterations) / -std::log10(accuracy.reduction);
    if (isOwn) perDigitAtFirst_ = perDigit;
    isNear_ = factorises_ && x.allFinite() && perDigit <= kMostOverFirst * perDigitAtFirst_;
    if (isNear_ && isOwn && isWhole && !isIndefinite_ && accuracy.reduction <= kTelling)
      chooseSteps(iterations, perDigit, accuracy.reduction);
    return x;
  }

  /// Near incompressibility and beside faces that are collapsed more steps save more than half of the iterations; with
  /// fewer sums over ranks, where factors that overlap save as many again.
  void chooseSteps(long iterations, double perDigit, double reduction) {
    if (!triesMoreSteps_) return;
    if (steps_ == 1 && iterations > kFew && perDigit > kMostPerDigit) {
      perDigitOfOne_ = perDigit;
      reductionOfOne_ = reduction;
      perDigitAtFirst_ = paying() * perDigit;
      setSmoother(A_->hasProducts() ? kStepsWithProducts : kMoreSteps, true);
    } else if (steps_ > 1 && reduction >= kLikeReduction * reductionOfOne_ &&
               perDigit > paying() * perDigitOfOne_) {
      triesMoreSteps_ = false;
      setSmoother(1, false);
    }
  }

  double paying() const { return A_->hasProducts() ? kPayingWithProducts : kPaying; }

  /// Factors that overlap, or do so no longer, have to be made anew; with products or without them the eigenvalues that factors
  /// leave are others.
  void setSmoother(int steps, bool overlaps) {
    const bool hadProducts = smoothsWithProducts();
    steps_ = steps;
    if ((!team_.isAlone() && overlaps != overlaps_) || smoothsWithProducts() != hadProducts) {
      overlaps_ = overlaps;
      forgetCycle();
      return;
    }
    forSmoothers([&](KSP smoother, double) {
      check(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, steps));
    });
    useSpectra();
  }

  Eigen::VectorXd iterateWithCycle(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    if (kind_ == TangentKind::Symmetric && !border_.isCoupled()) {
      Eigen::VectorXd x(b.size());
      x.tail(m_) = solveZone(b.segment(first_, numOwn())).tail(m_);
      if (byConjugateGradients(b.segment(first_, n_), accuracy, x)) return x;
      // With the V-cycle of another matrix that tells nothing about this one.
      if (isNear_) return Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
    }
    return byGmres(b, accuracy);
  }

  /// Where a V-cycle of another matrix is given up, GMRES goes on with one of the matrix.
  int mostIterations(double reduction) const {
    const int most = factorises_ ? kMostWithFactors : kMostWithSweeps;
    if (!isNear_) return most;
    return std::min(most, kSetUp + static_cast<int>(std::ceil(perDigitAtFirst_ * -std::log10(reduction))));
  }

  /// The solution over the zone and the border, for this rank's rows of a right-hand side; the same on all ranks.
  Eigen::VectorXd solveZone(const Eigen::VectorXd& r) {
    const auto z = std::ssize(zone_.unknowns());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(z + m_);
    forOwnOfZone([&](Eigen::Index k, Eigen::Index own) { x(k) = r(own); });
    if (team_.isLast()) x.tail(m_) = r.tail(m_);
    team_.sum(asSpan(x));
    if (team_.isLast()) x = zone_.solve(x);
    team_.share(asSpan(x), team_.size() - 1);
    return x;
  }

  /// f(place in the zone, place among this rank's rows of K) for those unknowns of the zone that this rank has.
  template <class F>
  void forOwnOfZone(const F& f) const {
    const auto& unknowns = zone_.unknowns();
    const auto end = std::ranges::lower_bound(unknowns, first_ + n_);
    for (auto unknown = std::ranges::lower_bound(unknowns, first_); unknown != end; ++unknown)
      f(unknown - unknowns.begin(), *unknown - first_);
  }

  /// Subtracts K x from numbers of this rank's rows of K, x over the zone, with zeros elsewhere. Without products:
  /// neither the zone's factors nor the V-cycle know of them.
  void subtractTimesZone(const Eigen::VectorXd& x, Vec from) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(n_);
    write(from, [&](auto out) {
      forOwnOfZone([&](Eigen::Index k, Eigen::Index column) {
        own(column) = x(k);
        for (Eigen::SparseMatrix<double>::InnerIterator entry(A_->leading(), column); entry; ++entry)
          out(entry.row()) -= entry.value() * x(k);
      });
    });
    if (!ghosts_) return;
    write(ghosts_->values(), [&](auto out) { out = -(offDiagonalBlock().transpose() * own); });
    ghosts_->addTo(from);
  }

  /// Numbers of this rank's rows of a system, in a vector of the library: of K and, in the last one, the border.
  Eigen::Index numOwn() const { return n_ + (team_.isLast() ? m_ : 0); }

  /// Completes a solution of which this rank has its own rows.
  void gather(Eigen::VectorXd& x) const {
    std::vector<int> begins = begins_;
    begins.back() = static_cast<int>(x.size());
    team_.gather(asSpan(x), begins);
  }

  MPI_Comm communicator() const { return team_.isAlone() ? PETSC_COMM_SELF : PETSC_COMM_WORLD; }

  /// Coarse functions go to the rank of the fine one that has most of them.
  static Division coarseDivision(const Hierarchy::Prolongation& P, const Division& rows) {
    std::vector<double> largest(static_cast<std::size_t>(P.cols()), 0.0);
    std::vector<int> owners(largest.size(), 0);
    for (int row = 0; row < P.rows(); ++row)
      for (Hierarchy::Prolongation::InnerIterator entry(P, row); entry; ++entry) {
        const auto column = static_cast<std::size_t>(entry.col());
        if (entry.value() <= largest[column]) continue;
        largest[column] = entry.value();
        owners[column] = rows.ownerOf(row);
      }
    return {std::move(owners), rows.rank, rows.ranks()};
  }

  /// This rank's rows of a prolongation, as the library has them: rows and columns in the order of divisions.
  static petsc::Matrix ownRows(const Hierarchy::Prolongation& P, const Division& rows,
                               const Division& columns) {
    const std::vector<int> places = placesIn(columns);
    const auto own = someRows(P, rows.own(), P.cols(),
                              [&](int column) { return places[static_cast<std::size_t>(column)]; });
    petsc::Matrix matrix;
    check(MatCreateMPIAIJWithArrays(
        PETSC_COMM_WORLD, static_cast<PetscInt>(own.rows()), static_cast<PetscInt>(columns.own().size()),
        static_cast<PetscInt>(P.rows()), static_cast<PetscInt>(P.cols()), own.outerIndexPtr(),
        own.innerIndexPtr(), own.valuePtr(), matrix.place()));
    return matrix;
  }

  /// K over the arrays of its two blocks; the library numbers the columns of the off-diagonal one anew.
  petsc::Matrix viewBlocks(const SystemMatrix& A) {
    const auto &here = A.leading(), &elsewhere = A.leadingElsewhere();
    const auto own = static_cast<PetscInt>(n_), all = static_cast<PetscInt>(N_);
    offDiagonalColumns_.assign(elsewhere.innerIndexPtr(), elsewhere.innerIndexPtr() + elsewhere.nonZeros());
    petsc::Matrix matrix;
    check(MatCreateMPIAIJWithSplitArrays(
        PETSC_COMM_WORLD, own, own, all, all, const_cast<PetscInt*>(here.outerIndexPtr()),
        const_cast<PetscInt*>(here.innerIndexPtr()), const_cast<double*>(here.valuePtr()),
        const_cast<PetscInt*>(elsewhere.outerIndexPtr()), offDiagonalColumns_.data(),
        const_cast<double*>(elsewhere.valuePtr()), matrix.place()));
    return matrix;
  }

  /// The library sees the transpose of K, which need not be symmetric.
  void makeMatrix(const SystemMatrix& A) {
    groups_.emplace(rowsOf(A.leading()));
    if (team_.isAlone())
      makeLevels(rowsOf(A.leading()));
    else
      K_ = viewBlocks(A);
    coarseGroups_.reserve(prolongations_.size());  // smoothers look at them
    goRowByRow(K_);
    check(MatCreateVecs(K_, in_.place(), out_.place()));
    const auto makeShell = [&](petsc::Matrix& shell, PetscErrorCode (*times)(Mat, Vec, Vec)) {
      check(MatCreateShell(communicator(), static_cast<PetscInt>(n_), static_cast<PetscInt>(n_),
                           static_cast<PetscInt>(N_), static_cast<PetscInt>(N_), this, shell.place()));
      check(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(times)));
    };
    makeShell(exact_, multiplyByK);
    makeShell(rough_, multiplyRoughlyByK);
    if (team_.isAlone()) return;
    ghosts_.emplace(K_);
    if (kind_ != TangentKind::Symmetric) return;
    check(MatSetOption(K_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(K_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  }

  /// Of a process that is alone.
  void makeLevels(const SparseRows& rows) {
    K_ = view(rows, rows.size);
    products_.reserve(hierarchy_.prolongations.size());  // each looks at the one before
    for (const auto& P : hierarchy_.prolongations) {
      const auto& product = products_.emplace_back(groupsOf(products_.size()), P);
      coarse_.push_back(view(product.rows(), P.cols()));
      goRowByRow(coarse_.back());
    }
  }

  /// Of the diagonal block of a level, from the finest one on.
  const RowGroups& groupsOf(std::size_t level) const {
    if (level == 0) return *groups_;
    return team_.isAlone() ? products_[level - 1].groups() : coarseGroups_[level - 1];
  }

  /// One V-cycle over all levels.
  void makeCycle() {
    const auto levels = static_cast<PetscInt>(prolongations_.size()) + 1;
    smoothers_.clear();
    if (factorises_)
      for (std::size_t k = 0; k < prolongations_.size(); ++k)
        smoothers_.push_back(
            std::make_unique<LevelSmoother>(matrixOf(k), groupsOf(k), overlaps_ && !team_.isAlone()));
    check(PCCreate(communicator(), cycle_.place()));
    check(PCSetType(cycle_, PCMG));
    check(PCSetOperators(cycle_, exact_, exact_));
    check(PCMGSetLevels(cycle_, levels, nullptr));
    check(PCMGSetGalerkin(cycle_, PC_MG_GALERKIN_NONE));
    for (PetscInt level = 1; level < levels; ++level) {
      const auto fromFinest = static_cast<std::size_t>(levels - 1 - level);
      check(PCMGSetInterpolation(cycle_, level, prolongations_[fromFinest]));
      KSP smoother = smootherOf(level);
      PC sweep = nullptr;
      check(KSPSetType(smoother, KSPCHEBYSHEV));
      check(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, steps()));
      check(KSPGetPC(smoother, &sweep));
      if (factorises_)
        smoothers_[fromFinest]->attachTo(sweep);
      else
        check(PCSetType(sweep, PCSOR));  // of several ranks over their own rows
    }
    KSP coarse = nullptr;
    PC factors = nullptr;
    check(PCMGGetCoarseSolve(cycle_, &coarse));
    check(KSPSetType(coarse, KSPPREONLY));
    check(KSPGetPC(coarse, &factors));
    if (!team_.isAlone()) {
      check(PCSetType(factors, PCREDUNDANT));
      check(PCRedundantGetKSP(factors, &coarse));
      check(KSPSetType(coarse, KSPPREONLY));
      check(KSPGetPC(coarse, &factors));
    }
    check(PCSetType(factors, PCLU));
    check(PCFactorSetMatSolverType(factors, MATSOLVERUMFPACK));
  }

  /// Solves for the vector that `rhs` holds; false if it does not converge.
  bool iterate(KSP krylov, Vec rhs, Vec solution, double reduction, KSPConvergedReason& reason) {
    check(KSPSetNormType(krylov, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(krylov, reduction, 0.0, kDivergence, mostIterations(reduction)));
    check(KSPSolve(krylov, rhs, solution));
    PetscInt iterations = 0;
    check(KSPGetIterationNumber(krylov, &iterations));
    check(KSPGetConvergedReason(krylov, &reason));
    counts_.iterations += iterations;
    return reason > 0;
  }

  bool byConjugateGradients(const Eigen::VectorXd& b, const SolveAccuracy& accuracy, Eigen::VectorXd& x) {
    petsc::Solver krylov;
    petsc::Vector rhs, solution;
    check(KSPCreate(communicator(), krylov.place()));
    check(KSPSetType(krylov, KSPCG));
    check(KSPSetPC(krylov, cycle_));
    check(MatCreateVecs(K_, solution.place(), rhs.place()));
    write(rhs, [&](auto values) { values = b; });
    KSPConvergedReason reason{};
    const bool converged = iterate(krylov, rhs, solution, accuracy.reduction, reason);
    isIndefinite_ =
        !isNear_ && (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC);
    Eigen::VectorXd displacements(N_);
    read(solution, [&](auto values) { displacements.segment(first_, n_) = values; });
    team_.gather(asSpan(displacements), begins_);
    x.head(N_) = displacements;
    return converged;
  }

  Eigen::VectorXd byGmres(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    const auto own = static_cast<PetscInt>(numOwn()), size = static_cast<PetscInt>(b.size());
    weights_ = accuracy.rowWeights.segment(first_, own);
    petsc::Matrix whole;
    petsc::Solver krylov;
    petsc::Vector rhs, solution;
    check(MatCreateShell(communicator(), own, own, size, size, this, whole.place()));
    check(MatShellSetOperation(whole, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(MatCreateVecs(whole, solution.place(), rhs.place()));
    check(KSPCreate(communicator(), krylov.place()));
    check(KSPSetType(krylov, KSPGMRES));
    check(KSPGMRESSetRestart(krylov, kRestart));
    check(KSPSetOperators(krylov, whole, whole));
    check(KSPSetPCSide(krylov, PC_RIGHT));
    PC preconditioner = nullptr;
    check(KSPGetPC(krylov, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, this));
    check(PCShellSetApply(preconditioner, precondition));
    write(rhs, [&](auto values) { values = b.segment(first_, own).cwiseProduct(weights_); });
    if (unfinished_.size() > 0) {
      write(solution, [&](auto values) { values = unfinished_.segment(first_, own); });
      check(KSPSetInitialGuessNonzero(krylov, PETSC_TRUE));
    }
    KSPConvergedReason reason{};
    const bool converged = iterate(krylov, rhs, solution, accuracy.reduction, reason);
    Eigen::VectorXd x(b.size());
    read(solution, [&](auto values) { x.segment(first_, own) = values; });
    gather(x);
    if (converged) return x;
    unfinished_ = reason == KSP_DIVERGED_ITS ? x : Eigen::VectorXd();
    return Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
  }

  /// y = K x, products included.
  static PetscErrorCode multiplyByK(Mat shell, Vec x, Vec y) {
    void* context = nullptr;
    check(MatShellGetContext(shell, &context));
    auto& self = *static_cast<Implementation*>(context);
    if (self.kind_ == TangentKind::Symmetric)
      self.multiplyByEntries(x, y);
    else
      self.multiplyByTransposed(x, y);
    if (self.A_->hasProducts()) self.addProducts(x, y, Precision::Full);
    return 0;
  }

  /// The same for the finest smoother, roughly: with the entries that it has, which while a V-cycle is kept are those of an
  /// earlier matrix, and transposed where K is not symmetric.
  static PetscErrorCode multiplyRoughlyByK(Mat shell, Vec x, Vec y) {
    void* context = nullptr;
    check(MatShellGetContext(shell, &context));
    auto& self = *static_cast<Implementation*>(context);
    check(MatMult(self.smoothers_.front()->product(), x, y));
    self.addProducts(x, y, Precision::Rough);
    return 0;
  }

  void addProducts(Vec x, Vec y, Precision precision) {
    Eigen::VectorXd coupled = Eigen::VectorXd::Zero(N_), product = Eigen::VectorXd::Zero(n_);
    read(x, [&](auto in) { coupled.segment(first_, n_) = in; });
    if (!team_.isAlone()) fillGhosts(x, coupled);
    A_->addProducts(coupled, product, precision);
    write(y, [&](auto out) { out += product; });
  }

  /// y = A x, A with the rows that the library has; K, if it is symmetric.
  void multiplyByEntries(Vec x, Vec y) {
    if (ghosts_) ghosts_->begin(x);
    fill(x, y, [&](auto in, auto out) { groups_->multiply(rowsOf(A_->leading()), in, out); });
    if (!ghosts_) return;
    ghosts_->end(x);
    read(ghosts_->values(), [&](auto in) { write(y, [&](auto out) { out += offDiagonalBlock() * in; }); });
  }

  /// y = Aᵀ x, A with the rows that the library has.
  void multiplyByTransposed(Vec x, Vec y) {
    fill(x, y, [&](auto in, auto out) { groups_->multiplyTransposed(rowsOf(A_->leading()), in, out); });
    if (!ghosts_) return;
    read(x, [&](auto in) {
      write(ghosts_->values(), [&](auto out) { out = offDiagonalBlock().transpose() * in; });
    });
    ghosts_->addTo(y);
  }

  /// Of this rank's rows, the columns of other ranks, in the order of what comes from these.
  Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> offDiagonalBlock() const {
    const SparseRows rows = petsc::rowsOf(petsc::MatrixBlocks(K_).offDiagonal);
    return {rows.size,
            static_cast<Eigen::Index>(ghosts_->numbers().size()),
            rows.begins[rows.size],
            rows.begins,
            rows.columns,
            rows.values};
  }

  /// Those numbers of a vector that other ranks have and this one's rows of K need.
  void fillGhosts(Vec x, Eigen::VectorXd& values) {
    const auto numbers = ghosts_->numbers();
    ghosts_->begin(x);
    ghosts_->end(x);
    read(ghosts_->values(), [&](auto in) {
      for (Eigen::Index k = 0; k < in.size(); ++k) values(numbers[static_cast<std::size_t>(k)]) = in(k);
    });
  }

  /// y = W A x with the weights W of rows.
  static PetscErrorCode multiply(Mat whole, Vec x, Vec y) {
    void* context = nullptr;
    check(MatShellGetContext(whole, &context));
    auto& self = *static_cast<Implementation*>(context);
    const auto n = self.n_, m = self.m_;
    const bool isLast = self.team_.isLast();
    read(x, [&](auto in) {
      write(self.in_, [&](auto u) { u = in.head(n); });
      check(multiplyByK(self.exact_, self.in_, self.out_));
      Eigen::VectorXd lambda(m), border = self.ownG_ * in.head(n);
      if (isLast) lambda = in.tail(m);
      self.team_.share(asSpan(lambda), self.team_.size() - 1);
      self.team_.sum(asSpan(border));
      write(y, [&](auto out) {
        read(self.out_, [&](auto Ku) { out.head(n) = Ku; });
        out.head(n) += self.ownB_ * lambda;
        if (isLast) out.tail(m) = border + self.border_.C * lambda;
        out.array() *= self.weights_.array();
      });
    });
    return 0;
  }

  /// y = P⁻¹ W⁻¹ x: the zone with the border first, then a V-cycle for what that leaves of the displacements'
  /// residual.
  static PetscErrorCode precondition(PC pc, Vec x, Vec y) {
    void* context = nullptr;
    check(PCShellGetContext(pc, &context));
    auto& self = *static_cast<Implementation*>(context);
    const auto n = self.n_, m = self.m_;
    read(x, [&](auto in) {
      const Eigen::VectorXd r = in.cwiseQuotient(self.weights_);
      const Eigen::VectorXd ofZone = self.solveZone(r);
      write(self.in_, [&](auto u) { u = r.head(n) - self.ownB_ * ofZone.tail(m); });
      self.subtractTimesZone(ofZone, self.in_);
      check(PCApply(self.cycle_, self.in_, self.out_));
      write(y, [&](auto out) {
        read(self.out_, [&](auto u) { out.head(n) = u; });
        self.forOwnOfZone([&](Eigen::Index k, Eigen::Index own) { out(own) += ofZone(k); });
        if (self.team_.isLast()) out.tail(m) = ofZone.tail(m);
      });
    });
    return 0;
  }

  TangentKind kind_;
  const Team& team_;
  std::vector<int> begins_;                 ///< rows of K of each rank, and their number
  Eigen::Index N_ = 0, first_ = 0, n_ = 0;  ///< rows of K, the first of this rank, and their number
  Eigen::Index m_ = 0;                      ///< of the border
  SystemBorder border_;
  Eigen::SparseMatrix<double> ownB_;                   ///< this rank's rows of B
  Eigen::SparseMatrix<double, Eigen::RowMajor> ownG_;  ///< and columns of G
  std::vector<PetscInt> offDiagonalColumns_;           ///< columns of K that other ranks have
  BorderZone zone_;
  const Hierarchy& hierarchy_;
  std::vector<petsc::Matrix> prolongations_;  ///< from the finest level on
  std::vector<Division> divisions_;           ///< of the unknowns of all levels, of several ranks
  const SystemMatrix* A_ = nullptr;
  petsc::Matrix K_;                  ///< transposed; without products
  petsc::Matrix exact_;              ///< K as it is, with products, to multiply by
  petsc::Matrix rough_;              ///< to smooth with, see `multiplyRoughlyByK`
  std::optional<RowGroups> groups_;  ///< of K's diagonal block

  // From the finest level on:
  std::vector<GalerkinProduct> products_;  ///< matrices of the levels below it in a process that is alone
  std::vector<petsc::Matrix> coarse_;      ///< the same for the library
  std::vector<std::unique_ptr<DividedProduct>> divided_;  ///< the same of several ranks
  std::vector<RowGroups> coarseGroups_;                   ///< of the diagonal blocks of those
  std::vector<std::unique_ptr<LevelSmoother>>
      smoothers_;                    ///< of all levels but the coarsest, if the cycle has factors
  std::vector<double> leastShifts_;  ///< of the factors of these
  int searchesWithShift_ = 0;        ///< since one of them was set last

  petsc::Preconditioner cycle_;
  petsc::Vector in_, out_;
  std::optional<petsc::GhostValues> ghosts_;  ///< of K, of several ranks
  Eigen::VectorXd weights_;                   ///< of rows in GMRES
  Eigen::VectorXd unfinished_;  ///< where GMRES has come to for this right-hand side; empty where it begins
  IterationCounts counts_;
  long numIndefinite_ = 0;
  bool factorises_ = true;  ///< smooths with incomplete factors, else by over-relaxation
  int steps_ = 1;           ///< of the smoother with incomplete factors
  bool overlaps_ = false;   ///< those of several ranks
  double perDigitOfOne_ = 0.0,
         reductionOfOne_ = 0.0;  ///< iterations with one step, where more are taken, and to what
  bool triesMoreSteps_ = true;
  bool isIndefinite_ = false;
  bool isSetUp_ = false;         ///< the V-cycle
  bool knowsSpectra_ = false;    ///< of its smoothers, from an earlier matrix of the search
  std::vector<double> spectra_;  ///< their largest eigenvalues, from the coarsest level with a smoother on

  bool isNear_ = false;           ///< the V-cycle is to be kept for the next matrix
  double perDigitAtFirst_ = 0.0;  ///< iterations, with the V-cycle of the matrix itself
  int searchesWithout_ = 0;       ///< incomplete factors, from the next search on
  int pause_ = 0;                 ///< `searchesWithout_` as it was set last
  bool hasSolved_ = false;        ///< a system of this search
};

MultigridSolver::MultigridSolver(const LinearProblem& problem) {
  if (problem.hierarchy == nullptr) throw Error("multigrid: no hierarchy of meshes is known");
  petsc::begin();
  implementation_ = std::make_unique<Implementation>(problem);
}

MultigridSolver::~MultigridSolver() = default;

void MultigridSolver::beginSearch() {
  implementation_->beginSearch();
}

bool MultigridSolver::factorise(SystemMatrix& A) {
  return implementation_->factorise(A);
}

Eigen::VectorXd MultigridSolver::solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
  return implementation_->solve(b, accuracy);
}

Eigen::Index MultigridSolver::factorNonZeros() {
  return implementation_->nonZeros();
}
Definiteness MultigridSolver::definiteness() const {
  return implementation_->definiteness();
}
long MultigridSolver::numIndefinite() const {
  return implementation_->numIndefinite();
}
std::optional<IterationCounts> MultigridSolver::counts() const {
  return implementation_->counts();
}
void MultigridSolver::archive(StateArchive& archive) {
  implementation_->archive(archive);
}

}  // namespace burnish::inline solver
