#pragma once
#include <optional>
#include <span>
#include <vector>

#include "engine/solver/hierarchy.h"
#include "engine/solver/row_groups.h"

namespace burnish::inline solver {

/// PᵀAP of matrices A of one pattern, whose rows come in groups: the matrix of a coarser mesh.
class GalerkinProduct {
 public:
  using Prolongation = Hierarchy::Prolongation;

  /// Both have to stay.
  GalerkinProduct(const RowGroups& fine, const Prolongation& P);

  void assign(const SparseRows& A);

  /// Of the A that was assigned last, with an entry for all that P couples. The arrays stay where they are.
  SparseRows rows() const;
  const RowGroups& groups() const { return *groups_; }

 private:
  using Run = RowGroups::Run;

  /// The columns of A P in the rows of a group of A.
  std::span<const Run> runsOf(int group) const;
  void findRuns();
  void makePattern();
  void multiplyByP(const SparseRows& A, int group);
  void addTimesP(int group);
  void addRow(int row, double factor, std::span<const Run> runs);

  const RowGroups* fine_;
  const Prolongation* P_;
  std::vector<Run> runs_;
  std::vector<std::size_t> runBegins_;  ///< per group of A
  std::vector<int> begins_, columns_;
  std::vector<double> values_;
  std::optional<RowGroups> groups_;
  std::vector<double> product_;  ///< rows of the present group of A P, side by side in each column
  std::vector<double> row_;      ///< one of them, run after run
};

}  // namespace burnish::inline solver
