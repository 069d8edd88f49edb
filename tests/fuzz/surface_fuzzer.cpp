#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/tools/polyline.h"
#include "engine/tools/surface_file.h"
#include "tests/fuzz/temporary_file.h"

/// Files of tools: the first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using burnish::fuzz::TemporaryFile;
  static std::array<TemporaryFile, 5> files{TemporaryFile(".stl"), TemporaryFile(".obj"),
                                            TemporaryFile(".ply"), TemporaryFile(".off"),
                                            TemporaryFile(".txt")};
  if (size == 0) return 0;
  const std::size_t kind = data[0] % files.size();
  const auto& path = files[kind].hold(data + 1, size - 1);
  try {
    if (kind == 4)
      burnish::readPolyline(path, false);
    else
      burnish::readSurface(path, 1.0, true);
  } catch (const burnish::Error&) {
  }
  return 0;
}
