#include "postproc/probe/face_address.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/scene/patch_names.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

void requireOneBody(const ModelRecord& model, const MeshRecord& mesh) {
  std::vector<std::string> bodies;
  for (const PatchRecord& patch : mesh.patches)
    if (patch.body != mesh.patches.front().body) bodies = model.bodies;
  if (!bodies.empty())
    throw Error(fmt::format("face: there are the bodies {}; expected one of them, as --body {}",
                            fmt::join(bodies, ", "), bodies.front()));
}

/// Number of a patch in the mesh of one body.
int patchNumber(const ModelRecord& model, const MeshRecord& mesh, const std::string& name) {
  if (mesh.patches.size() == 1 && name.empty()) return 0;
  std::vector<std::string> names;
  if (mesh.patches.size() > 1) {
    const Scene scene = parseScene(model.sceneYaml, "the scene of the result");
    names = patchNames(scene.allBodies()[static_cast<std::size_t>(mesh.patches.front().body)]);
  }
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  if (names.empty())
    throw Error(fmt::format("patch: found {}; the body has one patch, which needs no name", quoted(name)));
  if (name.empty())
    throw Error(fmt::format("face: there are the patches {}; expected one of them, as --patch {}",
                            fmt::join(names, ", "), names.front()));
  throw Error(fmt::format("patch: found {}; the body has the patches {}.{}", quoted(name),
                          fmt::join(names, ", "), didYouMean(name, names)));
}

FaceId faceNumber(int dim, const std::string& name) {
  try {
    return dim == 2 ? faceFromName<2>(name) : faceFromName<3>(name);
  } catch (const Error& error) {
    throw Error(fmt::format("face: {}", error.what()));
  }
}

}  // namespace

FacePlace facePlace(const ModelRecord& model, const FrameRecord& frame, const FaceAddress& address) {
  const MeshRecord& mesh = meshOf(model, frame);
  requireOneBody(model, mesh);
  const FaceId face = faceNumber(model.dim, address.face);
  return {patchNumber(model, mesh, address.patch), face};
}

}  // namespace burnish
