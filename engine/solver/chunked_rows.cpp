#include "engine/solver/chunked_rows.h"

#include <algorithm>

namespace burnish::inline solver {

ChunkedRows::ChunkedRows(const RowGroups& groups, bool onlyBehind) {
  std::size_t numValues = 0;
  for (int group = 0; group <= groups.size(); ++group) {
    chunkBegins.push_back(chunks.size());
    valueBegins.push_back(numValues);
    if (group == groups.size()) break;
    for (const auto [first, length] : groups.runs(group)) {
      const int end = first + length;
      for (int k = onlyBehind ? std::max(first, groups.begin(group + 1)) : first; k < end; k += kLanes)
        chunks.push_back({k, std::min(kLanes, end - k)});
    }
    numValues +=
        (chunks.size() - chunkBegins.back()) * static_cast<std::size_t>(groups.count(group) * kLanes);
  }
  values.resize(numValues);
}

}  // namespace burnish::inline solver
