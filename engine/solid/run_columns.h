#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

namespace burnish {

/// A sparse matrix whose columns are runs of consecutive rows, so that a multiple of a column is added to a
/// full vector without looking up single rows.
class RunColumns {
 public:
  RunColumns() = default;

  /// All zero. rows: of each column, ascending, without repetitions.
  explicit RunColumns(const std::vector<std::vector<int>>& rows) {
    for (const auto& column : rows) {
      begins_.push_back({runs_.size(), size_});
      for (const int row : column) {
        if (runs_.size() == begins_.back().run || row != runs_.back().first + runs_.back().length)
          runs_.push_back({row, 0});
        ++runs_.back().length;
      }
      size_ += column.size();
    }
    begins_.push_back({runs_.size(), size_});
    values_.resize(size_);
  }

  /// Entries of a column, in the order of its rows.
  const double* column(std::size_t c) const { return values_.data() + begins_[c].value; }

  /// Moves a full vector, zero outside of the column's rows, into the column, and leaves zeros behind.
  void take(std::size_t c, Eigen::VectorXd& full) {
    double* to = values_.data() + begins_[c].value;
    forRuns(c, [&](const Run& run) {
      auto from = full.segment(run.first, run.length);
      Eigen::Map<Eigen::VectorXd>(to, run.length) = from;
      from.setZero();
      to += run.length;
    });
  }

  /// Adds `factors[k]` times the column to the k-th column of `full`.
  template <std::size_t Count>
  void addTo(std::size_t c, const std::array<double, Count>& factors,
             Eigen::Ref<Eigen::MatrixXd> full) const {
    const double* from = column(c);
    const Eigen::Index stride = full.outerStride();
    forRuns(c, [&](const Run& run) {
      double* __restrict to = full.data() + run.first;
      for (std::size_t k = 0; k < Count; ++k, to += stride)
        for (int i = 0; i < run.length; ++i) to[i] += factors[k] * from[i];
      from += run.length;
    });
  }

 private:
  struct Run {
    int first;
    int length;
  };
  struct Begin {
    std::size_t run, value;
  };

  template <class F>
  void forRuns(std::size_t c, const F& f) const {
    for (std::size_t r = begins_[c].run; r < begins_[c + 1].run; ++r) f(runs_[r]);
  }

  std::vector<Run> runs_;
  std::vector<Begin> begins_;  ///< of each column, and the end
  std::size_t size_ = 0;
  std::vector<double> values_;
};

}  // namespace burnish
