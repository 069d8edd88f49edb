#pragma once

#if defined(__has_feature)
#define BURNISH_HAS_FEATURE(name) __has_feature(name)
#else
#define BURNISH_HAS_FEATURE(name) 0
#endif

namespace burnish::inline core {

/// Whether this is compiled for a sanitizer that brings its own memory, AddressSanitizer or ThreadSanitizer: these reserve more
/// addresses than any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    BURNISH_HAS_FEATURE(address_sanitizer) || BURNISH_HAS_FEATURE(thread_sanitizer)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace burnish::inline core

#undef BURNISH_HAS_FEATURE
