#pragma once
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#include <sanitizer/tsan_interface.h>
#define BURNISH_THREAD_SANITIZER
#endif
#endif

namespace burnish::inline core {

/// Tells ThreadSanitizer what TBB guarantees and, not being instrumented, cannot show: what a thread did
/// until before() is done when another one has called after(). Nothing in other builds.
class ThreadOrder {
 public:
#ifdef BURNISH_THREAD_SANITIZER
  void before() {
    __tsan_release(this);
  }
  void after() {
    __tsan_acquire(this);
  }
#else
  void before() {}
  void after() {}
#endif
};

}  // namespace burnish::inline core
