#pragma once
#include <cstddef>
#include <vector>

#include "engine/core/lanes.h"
#include "engine/solver/row_groups.h"

namespace burnish::inline solver {

/// Rows of groups in single precision, which are computed with in double precision. Columns are taken by chunks of as many as
/// there are lanes; those of a chunk beyond the end of its run have zeros, and are read, and written back as they were, in
/// vectors too, which have to be longer by `kBehind`.
struct ChunkedRows {
  static constexpr int kBehind = kLanes - 1;

  struct Chunk {
    int first, length;  ///< columns
  };

  /// All columns of each group, or those behind its last row alone.
  ChunkedRows(const RowGroups& groups, bool onlyBehind);

  const Chunk* chunksOf(int group) const {
    return chunks.data() + chunkBegins[static_cast<std::size_t>(group)];
  }
  const Chunk* endOf(int group) const { return chunksOf(group + 1); }
  float* valuesOf(int group) { return values.data() + valueBegins[static_cast<std::size_t>(group)]; }
  const float* valuesOf(int group) const {
    return values.data() + valueBegins[static_cast<std::size_t>(group)];
  }

  /// sums(r) = sum over columns of the group's row r times x.
  template <int Rows>
  void multiply(int group, const double* x, double* sums) const {
    Lanes lanes[Rows] = {}, factors, entries;
    const float* from = valuesOf(group);
    for (const Chunk *chunk = chunksOf(group), *end = endOf(group); chunk < end;
         ++chunk, from += Rows * kLanes) {
      load(x + chunk->first, factors);
      unrolled<Rows>([&](auto r) {
        load(from + r * kLanes, entries);
        lanes[r] += entries * factors;
      });
    }
    unrolled<Rows>([&](auto r) { sums[r] = sumOf(lanes[r]); });
  }

  /// y -= sum over the group's rows r times factors(r).
  template <int Rows>
  void subtract(int group, const double* factors, double* y) const {
    Lanes lanes[Rows], sum, entries;
    unrolled<Rows>([&](auto r) { lanes[r] = Lanes{} + factors[r]; });
    const float* from = valuesOf(group);
    for (const Chunk *chunk = chunksOf(group), *end = endOf(group); chunk < end;
         ++chunk, from += Rows * kLanes) {
      load(y + chunk->first, sum);
      unrolled<Rows>([&](auto r) {
        load(from + r * kLanes, entries);
        sum -= entries * lanes[r];
      });
      store(sum, y + chunk->first);
    }
  }

  std::vector<Chunk> chunks;
  std::vector<std::size_t> chunkBegins, valueBegins;  ///< per group
  std::vector<float> values;                          ///< row after row in each chunk
};

}  // namespace burnish::inline solver
