#include "engine/solver/incomplete_factors.h"

#include <algorithm>
#include <cmath>

namespace burnish::inline solver {
namespace {

constexpr double kFirstShift = 0.001, kNextShift = 4.0, kMostShift = 5.0;

/// Of the pivots that a block has by itself: where rows above leave less of one, factors stand for a matrix that is almost
/// singular where A is not. Of matrices near incompressibility on graded meshes, those with a pivot of 0.01 left eigenvalues
/// up to 130, and up to 6 with a shift; all that were of use without a shift had kept 0.03 and more.
constexpr double kSmallestPivot = 0.02;

/// L of a symmetric block L Lᵀ, below the diagonal and on it, and the pivots; false if the block is not positive definite.
template <int Rows>
bool factoriseBlock(double* D, double* pivots) {
  const auto at = [&](int i, int j) -> double& { return D[i * Rows + j]; };
  for (int j = 0; j < Rows; ++j) {
    for (int k = 0; k < j; ++k) at(j, j) -= at(j, k) * at(j, k);
    pivots[j] = at(j, j);
    if (!(pivots[j] > 0.0) || !std::isfinite(pivots[j])) return false;
    at(j, j) = std::sqrt(at(j, j));
    for (int i = j + 1; i < Rows; ++i) {
      for (int k = 0; k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      at(i, j) /= at(j, j);
    }
  }
  return true;
}

/// (L Lᵀ)⁻¹ in place of L.
template <int Rows>
void invertBlock(double* D) {
  const auto at = [&](int i, int j) -> double& { return D[i * Rows + j]; };
  for (int j = 0; j < Rows; ++j) {
    at(j, j) = 1.0 / at(j, j);
    for (int i = j + 1; i < Rows; ++i) {
      double sum = 0.0;
      for (int k = j; k < i; ++k) sum -= at(i, k) * at(k, j);
      at(i, j) = sum / at(i, i);
    }
  }
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (int k = i; k < Rows; ++k) sum += at(k, i) * at(k, j);
      at(j, i) = sum;
    }
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < i; ++j) at(i, j) = at(j, i);
}

/// y = D x
template <int Rows>
void multiplyBlock(const double* D, const double* x, double* y) {
  for (int i = 0; i < Rows; ++i) {
    y[i] = 0.0;
    for (int j = 0; j < Rows; ++j) y[i] += D[i * Rows + j] * x[j];
  }
}

}  // namespace

std::optional<double> IncompleteFactors::nextShift(double shift) {
  const double next = shift > 0.0 ? kNextShift * shift : kFirstShift;
  return next < kMostShift ? std::optional(next) : std::nullopt;
}

double IncompleteFactors::shiftBefore(double shift) {
  return shift > kFirstShift ? shift / kNextShift : 0.0;
}

bool IncompleteFactors::factorise(const SparseRows& A, double leastShift) {
  inverses_.resize(static_cast<std::size_t>(groups_->size()));
  for (auto& row : row_) row.assign(static_cast<std::size_t>(groups_->numRows() + ChunkedRows::kBehind), 0.0);
  bool hasMagnitudes = false;
  for (std::optional<double> shift = leastShift; shift; shift = nextShift(*shift)) {
    if (*shift > 0.0 && !hasMagnitudes) {
      sumMagnitudes(A);
      hasMagnitudes = true;
    }
    shift_ = *shift;
    if (factoriseShifted(A)) return true;
  }
  return false;
}

/// As of a symmetric matrix, of what is on the diagonal and above it.
void IncompleteFactors::sumMagnitudes(const SparseRows& A) {
  magnitudes_.assign(static_cast<std::size_t>(A.size), 0.0);
  for (int row = 0; row < A.size; ++row)
    for (int k = A.begins[row]; k < A.begins[row + 1]; ++k) {
      if (A.columns[k] < row) continue;
      magnitudes_[static_cast<std::size_t>(row)] += std::abs(A.values[k]);
      if (A.columns[k] > row) magnitudes_[static_cast<std::size_t>(A.columns[k])] += std::abs(A.values[k]);
    }
}

bool IncompleteFactors::factoriseShifted(const SparseRows& A) {
  reached_ = upper_.chunkBegins;
  bool isDone = true;
  for (int group = 0; group < groups_->size() && isDone; ++group)
    withRows(groups_->count(group), [&](auto rows) { isDone = factoriseGroup<rows>(A, group); });
  return isDone;
}

template <int Rows>
bool IncompleteFactors::factoriseGroup(const SparseRows& A, int group) {
  const int begin = groups_->begin(group);
  for (int r = 0; r < Rows; ++r) {
    double* row = row_[static_cast<std::size_t>(r)].data();
    for (int k = A.begins[begin + r]; k < A.begins[begin + r + 1]; ++k)
      if (A.columns[k] >= begin) row[A.columns[k]] = A.values[k];
    if (shift_ > 0.0) row[begin + r] += shift_ * magnitudes_[static_cast<std::size_t>(begin + r)];
  }
  double* D = inverses_[static_cast<std::size_t>(group)].data();
  double ownPivots[Rows], pivots[Rows];
  copyBlock<Rows>(begin, D);
  if (!factoriseBlock<Rows>(D, ownPivots)) return false;
  for (const auto [first, length] : groups_->runs(group))
    for (int column = first, end = std::min(first + length, begin); column < end;) {
      const int above = groups_->groupOf(column);
      withRows(groups_->count(above), [&](auto count) { subtractAbove<Rows, count>(group, above); });
      column = groups_->begin(above + 1);
    }
  copyBlock<Rows>(begin, D);
  if (!factoriseBlock<Rows>(D, pivots)) return false;
  for (int r = 0; r < Rows; ++r)
    if (pivots[r] < kSmallestPivot * ownPivots[r]) return false;
  invertBlock<Rows>(D);
  float* to = upper_.valuesOf(group);
  for (const auto *chunk = upper_.chunksOf(group), *end = upper_.endOf(group); chunk < end; ++chunk)
    for (int r = 0; r < Rows; ++r, to += kLanes)
      for (int lane = 0; lane < chunk->length; ++lane)
        to[lane] = static_cast<float>(
            row_[static_cast<std::size_t>(r)][static_cast<std::size_t>(chunk->first + lane)]);
  return true;
}

/// The group's block of its rows, which hold what is on the diagonal and above it.
template <int Rows>
void IncompleteFactors::copyBlock(int begin, double* D) const {
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < Rows; ++j) {
      const int row = std::min(i, j), column = std::max(i, j);
      D[i * Rows + j] = row_[static_cast<std::size_t>(row)][static_cast<std::size_t>(begin + column)];
    }
}

/// Takes U(above, group)ᵀ D⁻¹ U(above, .) from the group's rows.
template <int Rows, int Above>
void IncompleteFactors::subtractAbove(int group, int above) {
  const auto a = static_cast<std::size_t>(above);
  const int begin = groups_->begin(group);
  const auto *chunk = upper_.chunks.data() + reached_[a], *const end = upper_.endOf(above);
  if (chunk == end) return;
  const auto seek = [&](int column) {
    while (chunk + 1 < end && chunk[1].first <= column) ++chunk;
  };
  seek(begin);
  reached_[a] = static_cast<std::size_t>(chunk - upper_.chunks.data());
  const auto* const first = chunk;
  const float* const values = upper_.valuesOf(above) + (first - upper_.chunksOf(above)) * (Above * kLanes);
  double factors[Rows][Above];  // U(above, group)ᵀ D⁻¹
  for (int i = 0; i < Rows; ++i) {
    seek(begin + i);
    double column[Above] = {};
    if (const int lane = begin + i - chunk->first; lane >= 0 && lane < chunk->length)
      for (int k = 0; k < Above; ++k) column[k] = values[((chunk - first) * Above + k) * kLanes + lane];
    multiplyBlock<Above>(inverses_[a].data(), column, factors[i]);
  }
  double* rows[Rows] = {};
  Lanes lanes[Rows][Above];
  unrolled<Rows>([&](auto i) {
    rows[i] = row_[i].data();
    unrolled<Above>([&](auto k) { lanes[i][k] = Lanes{} + factors[i][k]; });
  });
  const float* from = values;
  for (chunk = first; chunk < end; ++chunk, from += Above * kLanes) {
    Lanes U[Above], sum;
    unrolled<Above>([&](auto k) { load(from + k * kLanes, U[k]); });
    unrolled<Rows>([&](auto i) {
      double* to = rows[i] + chunk->first;
      load(to, sum);
      unrolled<Above>([&](auto k) { sum -= lanes[i][k] * U[k]; });
      store(sum, to);
    });
  }
}

void IncompleteFactors::solve(const double* b, double* x) const {
  x_.assign(static_cast<std::size_t>(groups_->numRows() + ChunkedRows::kBehind), 0.0);
  std::copy_n(b, groups_->numRows(), x_.begin());
  for (int group = 0; group < groups_->size(); ++group)
    withRows(groups_->count(group), [&](auto rows) {
      double* own = x_.data() + groups_->begin(group);
      double solution[rows];
      multiplyBlock<rows>(inverses_[static_cast<std::size_t>(group)].data(), own, solution);
      std::copy_n(solution, rows.value, own);
      upper_.subtract<rows>(group, solution, x_.data());
    });
  for (int group = groups_->size(); group-- > 0;)
    withRows(groups_->count(group), [&](auto rows) {
      double* own = x_.data() + groups_->begin(group);
      double sums[rows], correction[rows];
      upper_.multiply<rows>(group, x_.data(), sums);
      multiplyBlock<rows>(inverses_[static_cast<std::size_t>(group)].data(), sums, correction);
      for (int r = 0; r < rows; ++r) own[r] -= correction[r];
    });
  std::copy_n(x_.begin(), groups_->numRows(), x);
}

}  // namespace burnish::inline solver
