#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

namespace burnish::inline solid {

/// A sparse matrix whose columns are runs of consecutive rows, so that a multiple of a column is added to a
/// full vector without looking up single rows.
class RunColumns {
 public:
  RunColumns() = default;

  /// All zero. rows: of each column, ascending, without repetitions.
  explicit RunColumns(const std::vector<std::vector<int>>& rows) {
    std::size_t size = 0;
    for (const auto& column : rows) {
      begins_.push_back(runs_.size());
      for (const int row : column) {
        if (runs_.size() == begins_.back() || row != runs_.back().end) runs_.push_back({row, row, size});
        ++runs_.back().end;
        ++size;
      }
    }
    begins_.push_back(runs_.size());
    values_.resize(size);
  }

  /// Entries of a column, in the order of its rows.
  const double* column(std::size_t c) const { return values_.data() + runs_[begins_[c]].value; }

  /// Moves a full vector, zero outside of the column's rows, into the column, and leaves zeros behind.
  void take(std::size_t c, Eigen::VectorXd& full) {
    for (std::size_t r = begins_[c]; r < begins_[c + 1]; ++r) {
      auto from = full.segment(runs_[r].first, runs_[r].end - runs_[r].first);
      Eigen::Map<Eigen::VectorXd>(&values_[runs_[r].value], from.size()) = from;
      from.setZero();
    }
  }

  /// Adds `factors[k]` times the column to the k-th column of `full`.
  template <std::size_t Count>
  void addTo(std::size_t c, const std::array<double, Count>& factors,
             Eigen::Ref<Eigen::MatrixXd> full) const {
    for (std::size_t r = begins_[c]; r < begins_[c + 1]; ++r) {
      const int length = runs_[r].end - runs_[r].first;
      const double* from = &values_[runs_[r].value];
      double* __restrict to = full.data() + runs_[r].first;
      for (std::size_t k = 0; k < Count; ++k, to += full.outerStride())
        for (int i = 0; i < length; ++i) to[i] += factors[k] * from[i];
    }
  }

 private:
  struct Run {
    int first, end;     ///< rows
    std::size_t value;  ///< place of the first entry
  };

  std::vector<Run> runs_;
  std::vector<std::size_t> begins_;  ///< runs of each column, and the end
  std::vector<double> values_;
};

}  // namespace burnish::inline solid
