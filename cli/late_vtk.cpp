#include "cli/late_vtk.h"

#ifdef BURNISH_LATE_VTK
#include <algorithm>
#include <cstddef>

#include "engine/core/module_function.h"

// Written by cmake/late_functions.py.
extern "C" {
extern void* burnish_late_functions[];
extern const char burnish_late_table[];
extern const std::size_t burnish_late_count;
void burnish_load_late_functions();
}

namespace burnish {
namespace {

void (*afterLoading)() = [] {};

}  // namespace

void whenVtkIsThere(void (*task)()) {
  afterLoading = task;
}

}  // namespace burnish

/// Of several threads that call functions of VTK for the first time, one loads it, and the others wait.
void burnish_load_late_functions() {
  [[maybe_unused]] static const bool loaded = [] {
    const auto* table = static_cast<void* const*>(burnish::moduleFunction(
        {"burnish_vtk.so"}, burnish_late_table, "what draws, or reads and writes files of VTK,"));
    std::copy_n(table, burnish_late_count, burnish_late_functions);
    burnish::afterLoading();
    return true;
  }();
}

#else

namespace burnish {

void whenVtkIsThere(void (*task)()) {
  task();
}

}  // namespace burnish

#endif
