#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/tools/cad_tool.h"
#include "tests/fuzz/temporary_file.h"

/// STEP and IGES files: the first byte chooses the format, the second which part of the file the tool is and what may be done with it.
/// OpenCASCADE reads in a process of its own, which may end as it likes; what it makes of the file becomes a tool in this one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using burnish::fuzz::TemporaryFile;
  static std::array<TemporaryFile, 2> files{TemporaryFile(".step"), TemporaryFile(".iges")};
  if (size < 2) return 0;
  burnish::CadTool tool;
  tool.file = files[data[0] % files.size()].hold(data + 2, size - 2).string();
  if ((data[1] & 1U) != 0) tool.face = "1";
  if ((data[1] & 2U) != 0 && tool.face.empty()) ((data[1] & 16U) != 0 ? tool.shell : tool.solid) = "1";
  tool.open = (data[1] & 4U) != 0;
  if ((data[1] & 8U) != 0) tool.smoothing = 0.1;
  try {
    const burnish::RigidShape shape = tool.made();
    shape.query(Eigen::Vector3d(0.5, 0.8, 0.5));
  } catch (const burnish::Error&) {
  }
  return 0;
}
