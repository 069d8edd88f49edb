#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>

#include "engine/core/thread_order.h"

namespace burnish {

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

}  // namespace burnish
