#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <limits>
#include <optional>
#include <vector>

#include "engine/solver/coupling_groups.h"
#include "engine/solver/division.h"
#include "engine/solver/system_matrix.h"
#include "engine/solver/tangent_product.h"

namespace burnish::inline solver {

/// The tangent over all unknowns, on a sparsity pattern that is fixed once, with a precomputed place for every
/// run of consecutive unknowns in every column of every group. Prescribed unknowns take part in the assembly
/// (their columns give the effect of a prescribed increment) and are left out of the linear systems.
///
/// It is kept in parts, each in one copy: K over the free leading unknowns, and all other entries. Where ranks
/// divide the unknowns, each keeps the columns that it answers for, and of all others what couples them with
/// the border, the free unknowns behind the leading ones.
class SparseSystem final : public SystemMatrix {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// The numbers that the pattern has places for.
  struct Entries {
    Eigen::VectorXd leading, rest;
  };

  /// One list of groups per term. `prescribed`: one flag per unknown; numLeading: the first unknowns, those
  /// behind them are the border; all where left out. division: of the unknowns among ranks, the border being the
  /// last one's; none for a process alone.
  SparseSystem(std::vector<bool> prescribed, const std::vector<CouplingGroups>& termGroups,
               int numLeading = std::numeric_limits<int>::max(), std::optional<Division> division = {});

  const Division& division() const { return division_; }

  /// The division of the free leading unknowns, numbered from 0 on; its order is that of the columns of K.
  Division leadingDivision() const;

  int numUnknowns() const { return static_cast<int>(prescribed_.size()); }
  bool isPrescribed(int unknown) const { return prescribed_[static_cast<std::size_t>(unknown)]; }

  /// In the order of linear systems: that of the division, with the border behind. Ascending for a process alone.
  const std::vector<int>& freeUnknowns() const { return free_; }

  void setZero();

  /// Adds the dense tangent of a group of a term (unknowns in the order of the group), as far as it is kept.
  /// Safe to call at the same time for groups that have no unknown in common.
  void add(std::size_t term, std::size_t number, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// Adds the dense tangent of some unknowns, in any order and also more than once, that a group has together.
  void add(const std::vector<int>& unknowns, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// Adds a column that is kept, over the first unknowns, as many as there are values, zero outside of the
  /// pattern, and leaves zeros behind. Safe to call at the same time for different columns.
  void moveIntoColumn(int unknown, Eigen::Ref<Eigen::VectorXd> values);

  /// Adds a part of the tangent that is kept as a product, until the tangent is set to zero. It must outlive that.
  void addProduct(const TangentProduct& product) { products_.push_back(&product); }
  bool hasProducts() const override { return !products_.empty(); }
  void addProducts(const Eigen::VectorXd& x, Eigen::VectorXd& y, Precision precision) const override;

  /// The free unknowns' matrix, in the order of `freeUnknowns()`.
  const Matrix& whole() override;
  const Matrix& leading() const override { return K_; }
  const Matrix& leadingElsewhere() const override { return elsewhere_; }
  SystemBorder border() const override;

  /// Tangent times increments of the prescribed unknowns; other entries are ignored. Of this rank's columns, and of
  /// products its rows; to be called by all ranks together.
  Eigen::VectorXd timesPrescribed(const Eigen::VectorXd& increments) const;

  /// Absolute values of the entries, without those of products, times numbers that are not negative. Of this rank's columns.
  Eigen::VectorXd timesMagnitudes(const Eigen::VectorXd& magnitudes) const;

  /// What follows is for a tangent that is not divided, and tells nothing of products.

  Eigen::Index nonZeros() const { return K_.nonZeros() + rest_.nonZeros(); }
  Entries entries() const { return {K_.coeffs(), rest_.coeffs()}; }

  /// Replaces all entries of the tangent by those of another one on the same pattern.
  void setEntries(const Entries& entries);

  /// Entries of the tangent over all unknowns, column by column, and back.
  Eigen::VectorXd byColumns(const Entries& entries) const;
  Entries fromColumns(const Eigen::VectorXd& entries) const;

  /// The tangent over all unknowns, put together.
  Matrix tangent() const;

  Eigen::VectorXd restrictToFree(const Eigen::VectorXd& all) const { return all(free_); }
  Eigen::VectorXd expandFromFree(const Eigen::VectorXd& free) const;

 private:
  /// What an unknown is for the tangent.
  enum class Kind { Own, Elsewhere, Border, Prescribed };

  /// Consecutive unknowns of a group, of one kind and rank: entries that follow each other in every column.
  struct Run {
    int first;
    int length;
  };
  struct Group {
    std::vector<int> order;  ///< the group's places, by ascending unknown; empty if they ascend as they are
    std::vector<Run> runs;   ///< all unknowns, ascending
    /// Where each run starts, column by column: see `entryAt`; found when the group is first added to, as some
    /// groups never are.
    std::vector<int> starts;
  };

  /// The place of an entry that is not kept.
  static constexpr int kNowhere = std::numeric_limits<int>::max();

  Kind kindOf(int unknown) const;
  int equationOf(int unknown) const { return equations_[static_cast<std::size_t>(unknown)]; }

  /// The number of a column among those of K that this rank has; -1 if it is none of them.
  int columnOfK(int unknown) const;

  /// Whether any entry between unknowns is kept.
  bool isKept(const std::vector<int>& unknowns) const;
  Group sortedGroup(const std::vector<int>& unknowns) const;
  void makePattern();
  void findWhole();
  const Matrix& wholeOfEntries();
  void findStarts(Group& group) const;
  void add(const Group& group, const Eigen::Ref<const Eigen::MatrixXd>& K);

  /// An entry of K here, behind these one of K elsewhere, or the complement of one of the rest.
  double& entryAt(int place) {
    if (place < 0) return rest_.valuePtr()[~place];
    return place < numHere_ ? K_.valuePtr()[place] : elsewhere_.valuePtr()[place - numHere_];
  }
  void fetchAhead(const Group& group, const int* start);
  template <class F>
  void forEachByColumns(const F& f) const;

  std::vector<bool> prescribed_;
  int numLeading_;
  std::vector<int> free_;
  std::vector<int> equations_;  ///< per unknown its place in `free_`, -1 if it is prescribed
  int numFreeLeading_ = 0;
  Division division_;
  int firstEquation_ = 0;                   ///< of this rank's columns
  std::vector<std::vector<Group>> groups_;  ///< per term; empty where nothing of them is kept
  Matrix K_;                                ///< over the free leading unknowns that are this rank's
  Matrix elsewhere_;                        ///< of the same columns, the other rows of K
  int numHere_ = 0;                         ///< entries of `K_`
  Matrix rest_;                             ///< over all unknowns, the entries that K has not
  Matrix whole_;                            ///< empty before it is asked for, and where it is K
  std::vector<const TangentProduct*> products_;
  Matrix wholeWithProducts_;      ///< empty before it is asked for
  std::vector<int> wholePlaces_;  ///< per entry of `whole_`, as in `Group::starts`
};

/// A partition of groups into classes whose members share no unknown: inside a class, groups may be assembled
/// in parallel, and the order of additions to any entry does not depend on the number of threads.
std::vector<std::vector<int>> colourGroups(const CouplingGroups& groups, int numUnknowns);

}  // namespace burnish::inline solver
