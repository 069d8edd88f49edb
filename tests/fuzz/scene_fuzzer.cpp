#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/core/error.h"
#include "postproc/scene/scene_document.h"

/// A scene is read, or refused with a sentence; what was read is the same scene when it is written and read
/// again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string yaml(data, data + size);
  std::string written;
  try {
    written = burnish::parseSceneDocument(yaml, "fuzz.yaml").scene.resolvedYaml;
  } catch (const burnish::Error&) {
    return 0;
  }
  if (burnish::parseSceneDocument(written, "fuzz.yaml").scene.resolvedYaml != written) __builtin_trap();
  return 0;
}
