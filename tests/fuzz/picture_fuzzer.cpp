#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "postproc/compare/picture.h"
#include "tests/fuzz/temporary_file.h"

/// A picture that is to be compared.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static burnish::fuzz::TemporaryFile file(".png");
  try {
    burnish::readPicture(file.hold(data, size));
  } catch (const burnish::Error&) {
  }
  return 0;
}
