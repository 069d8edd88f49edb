#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/results/frame_io.h"
#include "engine/results/model_io.h"
#include "tests/fuzz/small_result.h"
#include "tests/fuzz/temporary_file.h"

/// The model file or, after a first byte that is odd, a frame of a small result.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static burnish::fuzz::TemporaryFile file(".h5");
  static const burnish::StoredModel model = burnish::fuzz::smallModel();
  if (size == 0) return 0;
  const auto& path = file.hold(data + 1, size - 1);
  try {
    if (data[0] % 2 == 0)
      burnish::readModel(path);
    else
      burnish::readFrame(path, model);
  } catch (const burnish::Error&) {
  }
  return 0;
}
