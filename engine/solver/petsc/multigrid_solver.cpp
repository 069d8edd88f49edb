#include "engine/solver/petsc/multigrid_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/error.h"
#include "engine/solver/petsc/border.h"
#include "engine/solver/petsc/library.h"

namespace burnish {
namespace {

using petsc::check;

/// Where more are needed, others do better.
constexpr int kMostWithFactors = 60, kMostWithSweeps = 500;

/// A V-cycle of an earlier matrix is kept while a digit costs no more than this, over what it cost at first.
constexpr double kMostOverFirst = 1.5;

/// Searches that go without incomplete factors after a search that has needed to.
constexpr int kMostWithout = 64;

/// A residual that has grown so much does not come down again.
constexpr double kDivergence = 1e10;

/// Of GMRES: so many vectors are kept.
constexpr int kRestart = 100;

/// A matrix of the library, which has rows, over the arrays of one of Eigen: its transpose if that has columns.
template <int Order>
petsc::Matrix view(const Eigen::SparseMatrix<double, Order>& A) {
  petsc::Matrix matrix;
  check(MatCreateSeqAIJWithArrays(
      PETSC_COMM_SELF, static_cast<PetscInt>(A.outerSize()), static_cast<PetscInt>(A.innerSize()),
      const_cast<PetscInt*>(A.outerIndexPtr()), const_cast<PetscInt*>(A.innerIndexPtr()),
      const_cast<double*>(A.valuePtr()), matrix.place()));
  return matrix;
}

/// A vector of the library for reading, as one of Eigen.
template <class F>
void read(Vec vector, const F& f) {
  const PetscScalar* values = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArrayRead(vector, &values));
  f(Eigen::Map<const Eigen::VectorXd>(values, size));
  check(VecRestoreArrayRead(vector, &values));
}

bool isFinite(const SystemBorder& border) {
  return border.B.coeffs().allFinite() && border.G.coeffs().allFinite() && border.C.coeffs().allFinite();
}

template <class F>
void write(Vec vector, const F& f) {
  PetscScalar* values = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArray(vector, &values));
  f(Eigen::Map<Eigen::VectorXd>(values, size));
  check(VecRestoreArray(vector, &values));
}

}  // namespace

class MultigridSolver::Implementation {
 public:
  explicit Implementation(const LinearProblem& problem)
      : kind_(problem.kind),
        n_(problem.hierarchy->prolongations.empty() ? problem.leading
                                                    : problem.hierarchy->prolongations.front().rows()) {
    for (const auto& P : problem.hierarchy->prolongations) prolongations_.push_back(view(P));
  }

  void beginSearch() {
    isNear_ = false;
    if (factorises_ && hasSolved_) pause_ = 0;  // the search before has done with factors
    hasSolved_ = false;
    useFactors(searchesWithout_ == 0);
    if (searchesWithout_ > 0) --searchesWithout_;
  }

  bool factorise(const SystemMatrix& A) {
    border_ = A.border();
    if (!A.leading().coeffs().allFinite() || !isFinite(border_)) return false;
    m_ = border_.C.rows();
    if (K_ == nullptr) makeMatrix(A.leading());
    isIndefinite_ = false;
    ++counts_.systems;
    return (isNear_ || setUpCycle()) && zone_.factorise(A.leading(), border_);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    const bool wasNear = isNear_;
    Eigen::VectorXd x = solveWithCycle(b, accuracy);
    if (!x.allFinite() && wasNear && setUpCycle()) x = solveWithCycle(b, accuracy);
    if (!x.allFinite() && factorises_) {
      // Incomplete factors are of no use where shear is soft beside compression.
      searchesWithout_ = pause_ = std::clamp(2 * pause_, 1, kMostWithout);
      useFactors(false);
      if (setUpCycle()) x = solveWithCycle(b, accuracy);
    }
    hasSolved_ = hasSolved_ || x.allFinite();
    if (isIndefinite_) ++numIndefinite_;
    return x;
  }

  Eigen::Index nonZeros() {
    if (!isSetUp_) return 0;
    Eigen::Index sum = 0;
    for (PetscInt level = 0; level <= static_cast<PetscInt>(prolongations_.size()); ++level) {
      KSP smoother = nullptr;
      Mat matrix = nullptr;
      MatInfo info;
      check(PCMGGetSmoother(cycle_, level, &smoother));
      check(KSPGetOperators(smoother, &matrix, nullptr));
      check(MatGetInfo(matrix, MAT_LOCAL, &info));
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
  }
  long numIndefinite() const { return numIndefinite_; }

 private:
  /// Of the present matrix.
  bool setUpCycle() {
    if (cycle_ == nullptr) makeCycle();
    // The library does not know that the values have changed; as long as it does not, smoothers keep what they
    // have made of others.
    double* values = nullptr;
    check(MatSeqAIJGetArrayWrite(K_, &values));
    check(MatSeqAIJRestoreArrayWrite(K_, &values));
    check(PCSetOperators(cycle_, K_, K_));
    ++counts_.setUps;
    isNear_ = false;
    isSetUp_ = PCSetUp(cycle_) == 0;
    return isSetUp_;
  }

  void useFactors(bool factorises) {
    if (factorises == factorises_) return;
    factorises_ = factorises;
    cycle_.reset();
    isSetUp_ = false;
  }

  /// Not finite if it does not converge.
  Eigen::VectorXd solveWithCycle(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    const long before = counts_.iterations;
    Eigen::VectorXd x = iterateWithCycle(b, accuracy);
    const double perDigit =
        static_cast<double>(counts_.iterations - before) / -std::log10(accuracy.reduction);
    if (!isNear_) perDigitAtFirst_ = perDigit;
    isNear_ = factorises_ && x.allFinite() && perDigit <= kMostOverFirst * perDigitAtFirst_;
    return x;
  }

  Eigen::VectorXd iterateWithCycle(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    if (kind_ == TangentKind::Symmetric && !border_.isCoupled()) {
      Eigen::VectorXd x(b.size());
      x.tail(m_) = zone_.solve(b.tail(m_));
      if (byConjugateGradients(b.head(n_), accuracy, x)) return x;
      // With the V-cycle of another matrix that tells nothing about this one.
      if (isNear_) return Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
    }
    return byGmres(b, accuracy);
  }

  int mostIterations() const { return factorises_ ? kMostWithFactors : kMostWithSweeps; }

  /// The library sees the transpose of K, which need not be symmetric.
  void makeMatrix(const Eigen::SparseMatrix<double>& K) {
    K_ = view(K);
    check(MatCreateVecs(K_, in_.place(), out_.place()));
    if (kind_ != TangentKind::Symmetric) return;
    check(MatSetOption(K_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(K_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  }

  /// One V-cycle over all levels.
  void makeCycle() {
    const auto levels = static_cast<PetscInt>(prolongations_.size()) + 1;
    check(PCCreate(PETSC_COMM_SELF, cycle_.place()));
    check(PCSetOperators(cycle_, K_, K_));
    check(PCSetType(cycle_, PCMG));
    check(PCMGSetLevels(cycle_, levels, nullptr));
    check(PCMGSetGalerkin(cycle_, PC_MG_GALERKIN_BOTH));
    for (PetscInt level = 1; level < levels; ++level) {
      check(
          PCMGSetInterpolation(cycle_, level, prolongations_[static_cast<std::size_t>(levels - 1 - level)]));
      KSP smoother = nullptr;
      PC sweep = nullptr;
      check(PCMGGetSmoother(cycle_, level, &smoother));
      check(KSPSetType(smoother, KSPCHEBYSHEV));
      check(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, factorises_ ? 1 : 2));
      check(KSPGetPC(smoother, &sweep));
      check(PCSetType(sweep, factorises_ ? PCICC : PCSOR));
      if (factorises_) check(PCFactorSetShiftType(sweep, MAT_SHIFT_POSITIVE_DEFINITE));
    }
    KSP coarse = nullptr;
    PC factors = nullptr;
    check(PCMGGetCoarseSolve(cycle_, &coarse));
    check(KSPSetType(coarse, KSPPREONLY));
    check(KSPGetPC(coarse, &factors));
    check(PCSetType(factors, PCLU));
    check(PCFactorSetMatSolverType(factors, MATSOLVERUMFPACK));
  }

  /// Solves for the vector that `rhs` holds; false if it does not converge.
  bool iterate(KSP krylov, Vec rhs, Vec solution, double reduction, KSPConvergedReason& reason) {
    check(KSPSetNormType(krylov, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(krylov, reduction, 0.0, kDivergence, mostIterations()));
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
    check(KSPCreate(PETSC_COMM_SELF, krylov.place()));
    check(KSPSetType(krylov, KSPCG));
    check(KSPSetOperators(krylov, K_, K_));
    check(KSPSetPC(krylov, cycle_));
    check(MatCreateVecs(K_, solution.place(), rhs.place()));
    write(rhs, [&](auto values) { values = b; });
    KSPConvergedReason reason{};
    const bool converged = iterate(krylov, rhs, solution, accuracy.reduction, reason);
    isIndefinite_ =
        !isNear_ && (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC);
    read(solution, [&](auto values) { x.head(n_) = values; });
    return converged;
  }

  Eigen::VectorXd byGmres(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) {
    weights_ = accuracy.rowWeights;
    petsc::Matrix whole;
    petsc::Solver krylov;
    petsc::Vector rhs, solution;
    const auto size = static_cast<PetscInt>(b.size());
    check(MatCreateShell(PETSC_COMM_SELF, size, size, size, size, this, whole.place()));
    check(MatShellSetOperation(whole, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(MatCreateVecs(whole, solution.place(), rhs.place()));
    check(KSPCreate(PETSC_COMM_SELF, krylov.place()));
    check(KSPSetType(krylov, KSPGMRES));
    check(KSPGMRESSetRestart(krylov, kRestart));
    check(KSPSetOperators(krylov, whole, whole));
    check(KSPSetPCSide(krylov, PC_RIGHT));
    PC preconditioner = nullptr;
    check(KSPGetPC(krylov, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, this));
    check(PCShellSetApply(preconditioner, precondition));
    write(rhs, [&](auto values) { values = b.cwiseProduct(weights_); });
    KSPConvergedReason reason{};
    const bool converged = iterate(krylov, rhs, solution, accuracy.reduction, reason);
    Eigen::VectorXd x;
    read(solution, [&](auto values) { x = values; });
    if (!converged) x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return x;
  }

  /// y = W A x with the weights W of rows.
  static PetscErrorCode multiply(Mat whole, Vec x, Vec y) {
    void* context = nullptr;
    check(MatShellGetContext(whole, &context));
    auto& self = *static_cast<Implementation*>(context);
    const auto n = self.n_, m = self.m_;
    read(x, [&](auto in) {
      write(self.in_, [&](auto u) { u = in.head(n); });
      check(self.kind_ == TangentKind::Symmetric ? MatMult(self.K_, self.in_, self.out_)
                                                 : MatMultTranspose(self.K_, self.in_, self.out_));
      write(y, [&](auto out) {
        read(self.out_, [&](auto Ku) { out.head(n) = Ku; });
        out.head(n) += self.border_.B * in.tail(m);
        out.tail(m) = self.border_.G * in.head(n) + self.border_.C * in.tail(m);
        out.array() *= self.weights_.array();
      });
    });
    return 0;
  }

  /// y = P⁻¹ W⁻¹ x.
  static PetscErrorCode precondition(PC pc, Vec x, Vec y) {
    void* context = nullptr;
    check(PCShellGetContext(pc, &context));
    auto& self = *static_cast<Implementation*>(context);
    const auto n = self.n_, m = self.m_;
    read(x, [&](auto in) {
      const Eigen::VectorXd r = in.cwiseQuotient(self.weights_);
      const Eigen::VectorXd border = self.zone_.solve(r.tail(m));
      write(self.in_, [&](auto u) { u = r.head(n) - self.border_.B * border; });
      check(PCApply(self.cycle_, self.in_, self.out_));
      write(y, [&](auto out) {
        read(self.out_, [&](auto u) { out.head(n) = u; });
        out.tail(m) = border;
      });
    });
    return 0;
  }

  TangentKind kind_;
  Eigen::Index n_, m_ = 0;
  SystemBorder border_;
  BorderZone zone_;
  std::vector<petsc::Matrix> prolongations_;  ///< from the finest on
  petsc::Matrix K_;                           ///< transposed
  petsc::Preconditioner cycle_;
  petsc::Vector in_, out_;
  Eigen::VectorXd weights_;  ///< of rows in GMRES
  IterationCounts counts_;
  long numIndefinite_ = 0;
  bool factorises_ = true;  ///< smooths with incomplete factors, else by over-relaxation
  bool isIndefinite_ = false;
  bool isSetUp_ = false;  ///< the V-cycle

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

}  // namespace burnish
