#include <fmt/format.h>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/scene/reader.h"
#include "tests/fuzz/temporary_file.h"

/// STEP and IGES files: the first byte chooses the format, the second which part of the file the tool is. OpenCASCADE reads in a process
/// of its own, which may end as it likes; what it makes of the file becomes a tool in this one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using burnish::fuzz::TemporaryFile;
  static std::array<TemporaryFile, 2> files{TemporaryFile(".step"), TemporaryFile(".iges")};
  constexpr std::array kParts{"", "face: '1'", "solid: '1'", "open: true", "open: true, smoothing: 0.1"};
  if (size < 2) return 0;
  const auto& path = files[data[0] % files.size()].hold(data + 2, size - 2);
  const char* part = kParts[data[1] % kParts.size()];
  try {
    burnish::parseScene(
        fmt::format(
            "geometry: {{shape: box, size: [1, 1, 1], spans: [1, 1, 1]}}\n"
            "material: {{law: neo-hookean, E: 1, nu: 0.3}}\nsteps: [{{until: 1, count: 1}}]\n"
            "tools: [{{name: punch, shape: cad, file: \"{}\"{}{}}}]\ncontact: [{{tool: punch, face: top}}]\n",
            path.string(), *part == '\0' ? "" : ", ", part),
        "fuzz.yaml");
  } catch (const burnish::Error&) {
  }
  return 0;
}
