#include "engine/solver/petsc/level_smoother.h"

#include "engine/solver/petsc/vectors.h"

namespace burnish::inline solver {

using petsc::check;
using petsc::fill;
using petsc::MatrixBlocks;
using petsc::rowsOf;

LevelSmoother::Overlap::Overlap(Mat A) {
  PetscInt first = 0, end = 0, size = 0;
  IS rows = nullptr;
  petsc::Vector x;
  check(MatGetOwnershipRange(A, &first, &end));
  check(ISCreateStride(PETSC_COMM_SELF, end - first, first, 1, &rows));
  check(MatIncreaseOverlap(A, 1, &rows, 1));
  rows_ = petsc::Indices(rows);
  check(ISSort(rows));
  check(MatCreateSubMatrices(A, 1, &rows, &rows, MAT_INITIAL_MATRIX, &matrix_));
  groups_.emplace(rowsOf(*matrix_));
  check(ISGetLocalSize(rows, &size));
  check(VecCreateSeq(PETSC_COMM_SELF, size, in_.place()));
  check(VecDuplicate(in_, out_.place()));
  check(MatCreateVecs(A, x.place(), nullptr));
  check(VecScatterCreate(x, rows, in_, nullptr, scatter_.place()));
}

LevelSmoother::Overlap::~Overlap() {
  if (matrix_ != nullptr) MatDestroySubMatrices(1, &matrix_);
}

SparseRows LevelSmoother::Overlap::assign(Mat A) {
  const IS rows = rows_;
  check(MatCreateSubMatrices(A, 1, &rows, &rows, MAT_REUSE_MATRIX, &matrix_));
  return rowsOf(*matrix_);
}

template <class F>
void LevelSmoother::Overlap::apply(Vec b, Vec x, const F& f) {
  check(VecScatterBegin(scatter_, b, in_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter_, b, in_, INSERT_VALUES, SCATTER_FORWARD));
  fill(in_, out_, f);
  check(VecSet(x, 0.0));
  check(VecScatterBegin(scatter_, out_, x, ADD_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(scatter_, out_, x, ADD_VALUES, SCATTER_REVERSE));
}

LevelSmoother::LevelSmoother(Mat A, const RowGroups& groups, bool overlaps)
    : diagonal_(groups),
      overlap_(overlaps ? std::make_unique<Overlap>(A) : nullptr),
      factors_(overlap_ ? overlap_->groups() : groups) {
  if (const Mat block = MatrixBlocks(A).offDiagonal; block != nullptr) {
    check(MatDuplicate(block, MAT_DO_NOT_COPY_VALUES, offDiagonal_.place()));
    ghosts_.emplace(A);
  }
  PetscInt own = 0, all = 0;
  check(MatGetLocalSize(A, &own, nullptr));
  check(MatGetSize(A, &all, nullptr));
  const MPI_Comm ranks = PetscObjectComm(reinterpret_cast<PetscObject>(A));
  check(MatCreateShell(ranks, own, own, all, all, this, product_.place()));
  const auto multiplyBy = [](Mat product, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    check(MatShellGetContext(product, &self));
    static_cast<LevelSmoother*>(self)->multiply(x, y);
    return 0;
  };
  using Operation = PetscErrorCode (*)(Mat, Vec, Vec);
  check(MatShellSetOperation(product_, MATOP_MULT,
                             reinterpret_cast<void (*)()>(static_cast<Operation>(multiplyBy))));
}

bool LevelSmoother::assign(Mat A, double leastShift) {
  const MatrixBlocks blocks(A);
  diagonal_.assign(rowsOf(blocks.diagonal));
  if (ghosts_) check(MatCopy(blocks.offDiagonal, offDiagonal_, SAME_NONZERO_PATTERN));
  return factors_.factorise(overlap_ ? overlap_->assign(A) : rowsOf(blocks.diagonal), leastShift);
}

void LevelSmoother::attachTo(PC preconditioner) {
  check(PCSetType(preconditioner, PCSHELL));
  check(PCShellSetContext(preconditioner, this));
  check(PCShellSetApply(preconditioner, [](PC factors, Vec b, Vec x) -> PetscErrorCode {
    void* self = nullptr;
    check(PCShellGetContext(factors, &self));
    static_cast<const LevelSmoother*>(self)->solve(b, x);
    return 0;
  }));
}

void LevelSmoother::multiply(Vec x, Vec y) {
  if (ghosts_) ghosts_->begin(x);
  fill(x, y, [&](auto in, auto out) { diagonal_.multiply(in, out); });
  if (!ghosts_) return;
  ghosts_->end(x);
  check(MatMultAdd(offDiagonal_, ghosts_->values(), y, y));
}

void LevelSmoother::solve(Vec b, Vec x) const {
  const auto byFactors = [&](auto in, auto out) { factors_.solve(in, out); };
  if (overlap_)
    overlap_->apply(b, x, byFactors);
  else
    fill(b, x, byFactors);
}

}  // namespace burnish::inline solver
