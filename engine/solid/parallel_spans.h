#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include "engine/core/thread_order.h"

namespace burnish::inline solid {

/// Calls f(i) for i in [0, count) on all threads, `grain` calls in a row on one; f returns false if the state
/// is not admissible, and then no further calls are started. Returns whether all calls returned true.
template <class F>
bool parallelAll(std::size_t count, std::size_t grain, const F& f) {
  std::atomic<bool> admissible{true};
  ThreadOrder begun, ended;
  begun.before();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    begun.after();
    for (std::size_t i = range.begin(); i != range.end() && admissible; ++i)
      if (!f(i)) admissible = false;
    ended.before();
  });
  ended.after();
  return admissible;
}

/// Batches of spans: those of one batch are worked on one after the other, batches at the same time.
using SpanBatches = std::vector<std::vector<int>>;

/// Calls f with the numbers of all spans, on all threads, those of one list of batches before those of the next one.
/// f returns false like that of `parallelAll`; returns whether all calls returned true.
template <class F>
bool parallelBatches(const std::vector<SpanBatches>& lists, const F& f) {
  return std::all_of(lists.begin(), lists.end(), [&](const SpanBatches& batches) {
    return parallelAll(batches.size(), 1, [&](std::size_t k) {
      return std::all_of(batches[k].begin(), batches[k].end(),
                         [&](int e) { return f(static_cast<std::size_t>(e)); });
    });
  });
}

}  // namespace burnish::inline solid
