#include "engine/solver/row_groups.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/core/lanes.h"

namespace burnish::inline solver {
namespace {

/// Rows of a group, each in one piece.
template <int Rows>
std::array<const double*, Rows> rowsOf(const SparseRows& A, int first) {
  std::array<const double*, Rows> rows;
  for (int r = 0; r < Rows; ++r) rows[static_cast<std::size_t>(r)] = A.values + A.begins[first + r];
  return rows;
}

template <int Rows>
void multiplyGroup(const SparseRows& A, int first, std::span<const RowGroups::Run> runs, const double* x,
                   double* y) {
  auto rows = rowsOf<Rows>(A, first);
  std::array<Lanes, Rows> sums{};
  std::array<double, Rows> rest{};
  for (const auto [column, length] : runs) {
    int k = 0;
    for (; k + kLanes <= length; k += kLanes) {
      Lanes factors, values;
      load(x + column + k, factors);
      unrolled<Rows>([&](auto r) {
        load(rows[r] + k, values);
        sums[r] += values * factors;
      });
    }
    for (; k < length; ++k) unrolled<Rows>([&](auto r) { rest[r] += rows[r][k] * x[column + k]; });
    for (const double*& row : rows) row += length;
  }
  unrolled<Rows>([&](auto r) { y[first + r] = sumOf(sums[r]) + rest[r]; });
}

template <int Rows>
void multiplyTransposedGroup(const SparseRows& A, int first, std::span<const RowGroups::Run> runs,
                             const double* x, double* y) {
  auto rows = rowsOf<Rows>(A, first);
  std::array<Lanes, Rows> factors{};
  for (int r = 0; r < Rows; ++r) factors[static_cast<std::size_t>(r)] += x[first + r];
  for (const auto [column, length] : runs) {
    int k = 0;
    for (; k + kLanes <= length; k += kLanes) {
      Lanes sum, values;
      load(y + column + k, sum);
      unrolled<Rows>([&](auto r) {
        load(rows[r] + k, values);
        sum += values * factors[r];
      });
      store(sum, y + column + k);
    }
    for (; k < length; ++k) unrolled<Rows>([&](auto r) { y[column + k] += rows[r][k] * x[first + r]; });
    for (const double*& row : rows) row += length;
  }
}

}  // namespace

RowGroups::RowGroups(const SparseRows& A) {
  const auto columnsOf = [&](int row) {
    return std::span(A.columns + A.begins[row], A.columns + A.begins[row + 1]);
  };
  for (int row = 0; row < A.size;) {
    const auto columns = columnsOf(row);
    const int begin = row;
    do {
      groupOf_.push_back(size());
      ++row;
    } while (row < A.size && row < begin + kMostRows && std::ranges::equal(columns, columnsOf(row)));
    runBegins_.push_back(static_cast<int>(runs_.size()));
    for (const int column : columns) append(column, runs_, static_cast<std::size_t>(runBegins_.back()));
    begins_.push_back(row);
  }
  runBegins_.push_back(static_cast<int>(runs_.size()));
}

void RowGroups::append(int column, std::vector<Run>& runs, std::size_t begin) {
  if (runs.size() == begin || column != runs.back().first + runs.back().length) runs.push_back({column, 0});
  ++runs.back().length;
}

void RowGroups::multiply(const SparseRows& A, const double* x, double* y) const {
  for (int group = 0; group < size(); ++group)
    withRows(count(group), [&](auto rows) { multiplyGroup<rows>(A, begin(group), runs(group), x, y); });
}

void RowGroups::multiplyTransposed(const SparseRows& A, const double* x, double* y) const {
  std::fill_n(y, numRows(), 0.0);
  for (int group = 0; group < size(); ++group)
    withRows(count(group),
             [&](auto rows) { multiplyTransposedGroup<rows>(A, begin(group), runs(group), x, y); });
}

}  // namespace burnish::inline solver
