#include "engine/solver/multigrid.h"

#include <limits>
#include <new>

#include "engine/solver/direct_solver.h"
#include "engine/solver/petsc_module.h"

namespace burnish::inline solver {
namespace {

using Maker = LinearSolver*(const LinearProblem&);

/// Factors of more unknowns than these in space do not fit into the memory of most machines.
constexpr Eigen::Index kMostForDirect = 100'000;

/// The same where entries of products are to be made, which couple some five times as many unknowns.
constexpr Eigen::Index kMostForDirectWithProducts = 25'000;

/// Multigrid, and a direct solver for what it cannot solve alone.
class MultigridOrDirect final : public LinearSolver {
 public:
  explicit MultigridOrDirect(const LinearProblem& problem) : problem_(problem) {
    static auto* const make =
        reinterpret_cast<Maker*>(petscFunction("burnishMultigridSolver", "solver: linear: multigrid"));
    multigrid_.reset(make(problem));
  }

  void beginSearch() override { multigrid_->beginSearch(); }

  [[nodiscard]] bool factorise(SystemMatrix& A) override {
    A_ = &A;
    isDirect_ = false;
    return multigrid_->factorise(A) || fallBack();
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) override {
    if (!isDirect_) {
      Eigen::VectorXd x = multigrid_->solve(b, accuracy);
      if (x.allFinite() || !fallBack()) return x;
    }
    try {
      return direct_->solve(b);
    } catch (const std::bad_alloc&) {
      --fallbacks_;
      doWithoutFactors();
      return Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
    }
  }

  Eigen::Index factorNonZeros() override {
    return isDirect_ ? direct_->factorNonZeros() : multigrid_->factorNonZeros();
  }
  Definiteness definiteness() const override {
    if (isDirect_) return direct_->definiteness();
    const Definiteness found = multigrid_->definiteness();
    // Unstable directions are counted with the help of factors.
    return found == Definiteness::NotDefinite && A_ != nullptr && !fitsDirect() ? Definiteness::NotKnown
                                                                                : found;
  }
  long numIndefinite() const override {
    return indefinite_ + multigrid_->numIndefinite() + (direct_ ? direct_->numIndefinite() : 0);
  }

  std::optional<IterationCounts> counts() const override {
    IterationCounts counts = multigrid_->counts().value();
    counts.iterations += before_.iterations;
    counts.systems += before_.systems;
    counts.setUps += before_.setUps;
    counts.fallbacks = before_.fallbacks + fallbacks_;
    return counts;
  }

  void archive(StateArchive& archive) override {
    IterationCounts now = counts().value();
    long indefinite = numIndefinite();
    archive.field("iterations", now.iterations);
    archive.field("systems", now.systems);
    archive.field("set_ups", now.setUps);
    archive.field("fallbacks", now.fallbacks);
    archive.field("indefinite", indefinite);
    archive.field("without_factors", isWithoutFactors_);
    archive.part("multigrid", *multigrid_);
    if (!archive.restores()) return;
    before_ = now;
    indefinite_ = indefinite;
  }

 private:
  /// Whether one may try to factorise the matrix.
  bool fitsDirect() const {
    return problem_.leading <= (A_->hasProducts() ? kMostForDirectWithProducts : kMostForDirect) &&
           problem_.team->isAlone() && !isWithoutFactors_;
  }

  /// From now on: the memory does not hold them.
  void doWithoutFactors() {
    indefinite_ += direct_->numIndefinite();
    direct_.reset();
    isDirect_ = false;
    isWithoutFactors_ = true;
  }

  /// False if the matrix is too large to be factorised, also for the memory of this machine, divided among ranks, or
  /// singular.
  bool fallBack() {
    if (!fitsDirect()) return false;
    if (!direct_) direct_ = std::make_unique<DirectSolver>(problem_.leading, problem_.kind);
    try {
      isDirect_ = direct_->factorise(*A_);
    } catch (const std::bad_alloc&) {
      doWithoutFactors();
    }
    if (isDirect_) ++fallbacks_;
    return isDirect_;
  }

  LinearProblem problem_;
  std::unique_ptr<LinearSolver> multigrid_;
  std::unique_ptr<DirectSolver> direct_;  ///< null before it is needed
  SystemMatrix* A_ = nullptr;
  bool isDirect_ = false;  ///< the last matrix
  bool isWithoutFactors_ = false;
  long fallbacks_ = 0;
  IterationCounts before_;  ///< in the part of the run that this one goes on with
  long indefinite_ = 0;     ///< in that part, and with factors that are gone
};

}  // namespace

bool hasMultigrid() {
#ifdef BURNISH_PETSC
  return true;
#else
  return false;
#endif
}

std::unique_ptr<LinearSolver> makeMultigridSolver(const LinearProblem& problem) {
  return std::make_unique<MultigridOrDirect>(problem);
}

}  // namespace burnish::inline solver
