#pragma once
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace burnish::inline solver {

/// A sparse matrix row by row, or the transpose of one column by column, in arrays of somebody else. Columns ascend in each row.
struct SparseRows {
  int size;           ///< rows
  const int* begins;  ///< of rows among entries, and their end
  const int* columns;
  const double* values;
};

/// Neighbouring rows of a matrix of symmetric pattern that have the same columns, as those of a node's displacements, and runs of neighbouring columns in
/// them: indices are read once for many entries, which stream through the lanes of the processor.
class RowGroups {
 public:
  static constexpr int kMostRows = 3;  ///< in a group
  struct Run {
    int first, length;  ///< columns
  };

  explicit RowGroups(const SparseRows& A);

  /// Makes the last one of the runs from `begin` on longer by a column, or begins another one.
  static void append(int column, std::vector<Run>& runs, std::size_t begin);

  int size() const { return static_cast<int>(begins_.size()) - 1; }
  int numRows() const { return begins_.back(); }
  int begin(int group) const { return begins_[static_cast<std::size_t>(group)]; }
  int count(int group) const { return begin(group + 1) - begin(group); }
  int groupOf(int row) const { return groupOf_[static_cast<std::size_t>(row)]; }
  std::span<const Run> runs(int group) const {
    const auto g = static_cast<std::size_t>(group);
    return {runs_.data() + runBegins_[g], runs_.data() + runBegins_[g + 1]};
  }

  /// y = A x, of a matrix with this pattern.
  void multiply(const SparseRows& A, const double* x, double* y) const;

  /// y = Aᵀ x.
  void multiplyTransposed(const SparseRows& A, const double* x, double* y) const;

 private:
  std::vector<int> begins_{0};  ///< rows
  std::vector<int> groupOf_;    ///< per row
  std::vector<Run> runs_;       ///< of all groups
  std::vector<int> runBegins_;
};

/// Calls f with the number of a group's rows as a compile-time constant.
template <class F>
[[gnu::always_inline]] inline void withRows(int count, const F& f) {
  if (count == 3)
    f(std::integral_constant<int, 3>{});
  else if (count == 2)
    f(std::integral_constant<int, 2>{});
  else
    f(std::integral_constant<int, 1>{});
}

}  // namespace burnish::inline solver
