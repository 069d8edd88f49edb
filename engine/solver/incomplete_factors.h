#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/solver/chunked_rows.h"

namespace burnish::inline solver {

/// Incomplete Cholesky factors without fill of a matrix whose rows come in groups: A ≈ (D + U)ᵀ D⁻¹ (D + U), D a block per
/// group and U above it on the pattern of A (Meijerink, van der Vorst 1977). U is kept in single precision. Of a matrix that
/// is not symmetric, entries above the diagonal count.
class IncompleteFactors {
 public:
  explicit IncompleteFactors(const RowGroups& groups) : groups_(&groups), upper_(groups, true) {}

  /// Where a block is not positive definite or nearly so, those of A + α S, S(i, i) the sum of magnitudes in row i: with the first α of
  /// 0.001, 0.004, ... that has factors, as that beyond 1 has where rows are not zero (Manteuffel 1980). False if there are none.
  /// leastShift: 0 or one of these, from which on they are tried.
  bool factorise(const SparseRows& A, double leastShift = 0.0);

  /// The one of the α after this one; none after the last.
  static std::optional<double> nextShift(double shift);

  /// The one before; 0 before the first and 0 itself.
  static double shiftBefore(double shift);

  /// α of the present factors.
  double shift() const { return shift_; }

  /// x = (D + U)⁻¹ D (D + U)⁻ᵀ b. Not thread-safe.
  void solve(const double* b, double* x) const;

 private:
  using Block = std::array<double, static_cast<std::size_t>(RowGroups::kMostRows* RowGroups::kMostRows)>;

  bool factoriseShifted(const SparseRows& A);
  template <int Rows>
  void copyBlock(int begin, double* D) const;
  template <int Rows>
  bool factoriseGroup(const SparseRows& A, int group);
  template <int Rows, int Above>
  void subtractAbove(int group, int above);

  void sumMagnitudes(const SparseRows& A);

  const RowGroups* groups_;
  ChunkedRows upper_;
  std::vector<Block> inverses_;  ///< of blocks of D, row after row
  double shift_ = 0.0;

  // While factors are made:
  std::vector<double> magnitudes_;  ///< S
  std::array<std::vector<double>, RowGroups::kMostRows>
      row_;  ///< the group's, over columns; those outside of the pattern hold anything
  std::vector<std::size_t> reached_;  ///< chunk of each group of `upper_` to go on from
  mutable std::vector<double> x_;     ///< as long as chunks are read
};

}  // namespace burnish::inline solver
