#include <fmt/format.h>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/scene/reader.h"
#include "tests/fuzz/temporary_file.h"

/// Control nets in files of other programs: the first byte chooses the format, the second the shape that takes the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using burnish::fuzz::TemporaryFile;
  static std::array<TemporaryFile, 2> files{TemporaryFile(".g2"), TemporaryFile(".json")};
  constexpr std::array kShapes{"shape: control-net, file: \"{}\"",
                               "shape: extrusion, profile: {{file: \"{}\"}}, vector: [0, 1]",
                               "shape: revolution, profile: {{file: \"{}\", entry: 0}}, angle: 90"};
  if (size < 2) return 0;
  const auto& path = files[data[0] % files.size()].hold(data + 2, size - 2);
  const std::string shape = fmt::format(fmt::runtime(kShapes[data[1] % kShapes.size()]), path.string());
  try {
    burnish::parseScene(fmt::format("geometry: {{{}}}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
                                    "steps: [{{until: 1, count: 1}}]\n",
                                    shape),
                        "fuzz.yaml");
  } catch (const burnish::Error&) {
  }
  return 0;
}
