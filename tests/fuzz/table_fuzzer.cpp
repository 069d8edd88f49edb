#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "tests/fuzz/temporary_file.h"

/// The history of a run.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static burnish::fuzz::TemporaryFile file(".csv");
  try {
    burnish::readHistory(file.hold(data, size));
  } catch (const burnish::Error&) {
  }
  return 0;
}
