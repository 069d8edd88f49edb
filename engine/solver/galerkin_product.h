#pragma once
#include <optional>
#include <span>
#include <vector>

#include "engine/solver/hierarchy.h"
#include "engine/solver/row_groups.h"

namespace burnish::inline solver {

/// PᵀAP of matrices A of one pattern, whose rows come in groups: the matrix of a coarser mesh. Of one of several ranks what its
/// rows of A and P make of it, P₁ᵀ (A₁ P₁ + A₂ P₂), with its own columns A₁ and those of other ranks, A₂.
class GalerkinProduct {
 public:
  using Prolongation = Hierarchy::Prolongation;

  /// Both have to stay.
  GalerkinProduct(const RowGroups& fine, const Prolongation& P);

  /// fine: rows in groups of A₁; elsewhere: A₂. The prolongations have to stay.
  GalerkinProduct(const RowGroups& fine, const Prolongation& P, const SparseRows& elsewhere,
                  const Prolongation& ofElsewhere);

  void assign(const SparseRows& A, const SparseRows& elsewhere = {});

  /// Of the A that was assigned last, with an entry for all that P couples. The arrays stay where they are.
  SparseRows rows() const;
  const RowGroups& groups() const { return *groups_; }

 private:
  using Run = RowGroups::Run;

  /// The columns of A P in the rows of a group of A.
  std::span<const Run> runsOf(int group) const;
  void findRuns(const SparseRows& elsewhere);
  void makePattern();
  void multiplyByP(const SparseRows& A, int group);
  void addElsewhere(const SparseRows& A, int group);
  void addTimesP(int group);
  void addRow(int row, double factor, std::span<const Run> runs);

  const RowGroups* fine_;
  const Prolongation* P_;
  const Prolongation* ofElsewhere_ = nullptr;  ///< P₂; null in a process that is alone
  std::vector<Run> runs_;
  std::vector<std::size_t> runBegins_;  ///< per group of A
  std::vector<int> begins_, columns_;
  std::vector<double> values_;
  std::optional<RowGroups> groups_;
  std::vector<double> product_;  ///< rows of the present group of A P, side by side in each column
  std::vector<double> row_;      ///< one of them, run after run
};

}  // namespace burnish::inline solver
