#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "cli/console.h"
#include "cli/faults.h"
#include "cli/late_vtk.h"
#include "engine/core/error.h"
#include "engine/core/memory_limit.h"
#include "engine/core/module_function.h"

// Written by cmake/late_functions.py.
extern "C" {
extern void* burnish_late_functions[];
extern const char burnish_late_table[];
extern const std::size_t burnish_late_count;
void burnish_load_late_functions() noexcept;
}

namespace burnish {
namespace {

/// What VTK and the libraries that it brings along take; measured, with a tenth added.
constexpr std::uint64_t kData = 2 * kMegabyte, kMapped = 52 * kMegabyte;

/// Other threads may call functions meanwhile.
void fillSlots() {
  requireMemory(kData, "VTK", kMapped);
  const auto* table = static_cast<void* const*>(
      moduleFunction({.library = "burnish_vtk.so", .bindsLate = true}, burnish_late_table,
                     "what draws, or reads and writes files of VTK,"));
  for (std::size_t k = 0; k < burnish_late_count; ++k)
    std::atomic_ref(burnish_late_functions[k]).store(table[k], std::memory_order_release);
}

[[maybe_unused]] const bool isLate = [] {
  loadVtkBy(fillSlots);
  return true;
}();

}  // namespace
}  // namespace burnish

/// Of several threads that call functions of VTK for the first time, one loads it, and the others wait.
void burnish_load_late_functions() noexcept {
  try {
    burnish::loadVtk();
  } catch (const burnish::Error& error) {
    burnish::printError("burnish: {}\n", error.what());
    ::_exit(static_cast<int>(burnish::ExitCode::BadInput));
  }
}
