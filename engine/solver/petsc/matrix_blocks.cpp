#include "engine/solver/petsc/matrix_blocks.h"

#include <petsc/private/petscimpl.h>

namespace burnish::inline solver::petsc {

MatrixBlocks::MatrixBlocks(Mat A) : diagonal(A) {
  PetscMPIInt ranks = 1;
  MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(A)), &ranks);
  if (ranks > 1) check(MatMPIAIJGetSeqAIJ(A, &diagonal, &offDiagonal, nullptr));
}

SparseRows rowsOf(Mat matrix) {
  SparseRows rows{};
  PetscBool isDone = PETSC_FALSE;
  check(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &rows.size, &rows.begins, &rows.columns, &isDone));
  check(MatSeqAIJGetArrayRead(matrix, &rows.values));
  const SparseRows found = rows;  // they stay where they are
  check(MatSeqAIJRestoreArrayRead(matrix, &rows.values));
  check(
      MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &rows.size, &rows.begins, &rows.columns, &isDone));
  return found;
}

void noteChangedValues(Mat matrix) {
  const MatrixBlocks blocks(matrix);
  for (Mat block : {blocks.diagonal, blocks.offDiagonal}) {
    if (block == nullptr) continue;
    double* values = nullptr;
    check(MatSeqAIJGetArrayWrite(block, &values));
    check(MatSeqAIJRestoreArrayWrite(block, &values));
  }
  if (blocks.offDiagonal != nullptr) check(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(matrix)));
}

GhostValues::GhostValues(Mat A) {
  PetscInt count = 0;
  const PetscInt* numbers = nullptr;
  Indices from;
  Vector x;
  check(MatGetGhosts(A, &count, &numbers));
  numbers_ = {numbers, static_cast<std::size_t>(count)};
  check(ISCreateGeneral(PETSC_COMM_SELF, count, numbers, PETSC_USE_POINTER, from.place()));
  check(VecCreateSeq(PETSC_COMM_SELF, count, values_.place()));
  check(MatCreateVecs(A, x.place(), nullptr));
  check(VecScatterCreate(x, from, values_, nullptr, scatter_.place()));
}

void GhostValues::begin(Vec x) {
  check(VecScatterBegin(scatter_, x, values_, INSERT_VALUES, SCATTER_FORWARD));
}

void GhostValues::end(Vec x) {
  check(VecScatterEnd(scatter_, x, values_, INSERT_VALUES, SCATTER_FORWARD));
}

void GhostValues::addTo(Vec x) {
  check(VecScatterBegin(scatter_, values_, x, ADD_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(scatter_, values_, x, ADD_VALUES, SCATTER_REVERSE));
}

}  // namespace burnish::inline solver::petsc
