#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <span>
#include <vector>

namespace burnish {

/// Groups of unknowns; every pair of unknowns inside a group may be coupled.
using CouplingGroups = std::vector<std::vector<int>>;

/// The tangent matrix over all unknowns, on a sparsity pattern that is fixed once, with a precomputed place
/// for every run of consecutive unknowns in every column of every group. Prescribed unknowns take part in the
/// assembly (their rows give reactions, their columns the effect of a prescribed increment) and are left out
/// of the matrix that is factorised.
class SparseSystem {
 public:
  /// One list of groups per term. `prescribed`: one flag per unknown.
  SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups);

  int numUnknowns() const { return static_cast<int>(prescribed_.size()); }
  bool isPrescribed(int unknown) const { return prescribed_[static_cast<std::size_t>(unknown)]; }
  const std::vector<int>& freeUnknowns() const { return free_; }

  void setZero() { tangent_.coeffs().setZero(); }

  /// Adds the dense tangent of a group of a term (unknowns in the order of the group). Safe to call at the
  /// same time for groups that have no unknown in common.
  void add(std::size_t term, std::size_t number, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// Adds the dense tangent of some unknowns, in any order and also more than once, that a group has together.
  void add(const std::vector<int>& unknowns, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// Adds a column over the first unknowns, as many as there are values, zero outside of the pattern, and
  /// leaves zeros behind. Safe to call at the same time for different columns.
  void moveIntoColumn(int unknown, Eigen::Ref<Eigen::VectorXd> values);

  /// Tangent over all unknowns.
  const Eigen::SparseMatrix<double>& tangent() const { return tangent_; }

  /// Replaces all entries of the tangent by those of another one on the same pattern.
  void setTangent(const Eigen::ArrayXd& entries) { tangent_.coeffs() = entries; }

  /// Tangent over the free unknowns, in the order of `freeUnknowns()`.
  const Eigen::SparseMatrix<double>& freeTangent();

  Eigen::VectorXd restrictToFree(const Eigen::VectorXd& all) const { return all(free_); }
  Eigen::VectorXd expandFromFree(const Eigen::VectorXd& free) const;

 private:
  /// Consecutive unknowns of a group: entries that follow each other in every column of the tangent.
  struct Run {
    int first;
    int length;
  };
  struct Group {
    std::vector<int> order;  ///< the group's places, by ascending unknown
    std::vector<Run> runs;   ///< all unknowns, ascending
    /// Entry of `tangent_` where each run starts, column by column; found when the group is first added to,
    /// as some groups never are.
    std::vector<int> starts;
  };

  static Group sortedGroup(const std::vector<int>& unknowns);
  static Eigen::SparseMatrix<double> patternOf(std::size_t numUnknowns,
                                               const std::vector<std::vector<Group>>& terms);
  void findFreeEntries();
  void findStarts(Group& group) const;
  void add(const Group& group, const Eigen::Ref<const Eigen::MatrixXd>& K);
  void fetchAhead(const Group& group, const int* start);

  std::vector<bool> prescribed_;
  std::vector<int> free_;
  std::vector<std::vector<Group>> groups_;  ///< per term
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseMatrix<double> freeTangent_;
  std::vector<int> freeEntries_;  ///< entry of `tangent_` behind each entry of `freeTangent_`
};

/// A partition of groups into classes whose members share no unknown: inside a class, groups may be assembled
/// in parallel, and the order of additions to any entry does not depend on the number of threads.
std::vector<std::vector<int>> colourGroups(const CouplingGroups& groups, int numUnknowns);

}  // namespace burnish
