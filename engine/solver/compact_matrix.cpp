#include "engine/solver/compact_matrix.h"

#include <algorithm>

namespace burnish::inline solver {

void CompactMatrix::assign(const SparseRows& A) {
  for (int group = 0; group < groups_->size(); ++group) {
    float* to = rows_.valuesOf(group);
    int entry = 0;  // in each row
    for (const auto *chunk = rows_.chunksOf(group), *end = rows_.endOf(group); chunk < end; ++chunk) {
      for (int row = groups_->begin(group); row < groups_->begin(group + 1); ++row, to += kLanes) {
        const double* from = A.values + A.begins[row] + entry;
        for (int lane = 0; lane < chunk->length; ++lane) to[lane] = static_cast<float>(from[lane]);
      }
      entry += chunk->length;
    }
  }
}

void CompactMatrix::multiply(const double* x, double* y) const {
  x_.resize(static_cast<std::size_t>(groups_->numRows() + ChunkedRows::kBehind));
  std::copy_n(x, groups_->numRows(), x_.begin());
  for (int group = 0; group < groups_->size(); ++group)
    withRows(groups_->count(group),
             [&](auto rows) { rows_.multiply<rows>(group, x_.data(), y + groups_->begin(group)); });
}

}  // namespace burnish::inline solver
