#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <span>
#include <vector>

namespace burnish {

/// Groups of unknowns; every pair of unknowns inside a group may be coupled.
using CouplingGroups = std::vector<std::vector<int>>;

/// The tangent matrix over all unknowns, on a sparsity pattern that is fixed once, with a precomputed place
/// for every entry of every group. Prescribed unknowns take part in the assembly (their rows give reactions,
/// their columns the effect of a prescribed increment) and are left out of the matrix that is factorised.
class SparseSystem {
 public:
  /// One list of groups per term. `prescribed`: one flag per unknown.
  SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups);

  int numUnknowns() const { return static_cast<int>(prescribed_.size()); }
  bool isPrescribed(int unknown) const { return prescribed_[static_cast<std::size_t>(unknown)]; }
  const std::vector<int>& freeUnknowns() const { return free_; }

  void setZero() { tangent_.coeffs().setZero(); }

  /// Adds a group's dense tangent (unknowns in the order of the group). Safe to call at the same time for
  /// groups that have no unknown in common.
  void add(std::size_t term, std::size_t group, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// Tangent over all unknowns.
  const Eigen::SparseMatrix<double>& tangent() const { return tangent_; }

  /// Replaces all entries of the tangent by those of another one on the same pattern.
  void setTangent(const Eigen::ArrayXd& entries) { tangent_.coeffs() = entries; }

  /// Tangent over the free unknowns, in the order of `freeUnknowns()`.
  const Eigen::SparseMatrix<double>& freeTangent();

  Eigen::VectorXd restrictToFree(const Eigen::VectorXd& all) const { return all(free_); }
  Eigen::VectorXd expandFromFree(const Eigen::VectorXd& free) const;

 private:
  std::vector<bool> prescribed_;
  std::vector<int> free_;
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseMatrix<double> freeTangent_;
  std::vector<int> freeEntries_;  ///< entry of `tangent_` behind each entry of `freeTangent_`

  /// Places of a group's entries in `tangent_`, column by column; one list per term, groups one after the
  /// other.
  struct Places {
    std::vector<int> entries;
    std::vector<std::size_t> offsets;
  };
  std::vector<Places> places_;
};

/// A partition of groups into classes whose members share no unknown: inside a class, groups may be assembled
/// in parallel, and the order of additions to any entry does not depend on the number of threads.
std::vector<std::vector<int>> colourGroups(const CouplingGroups& groups, int numUnknowns);

}  // namespace burnish
