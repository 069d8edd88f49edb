#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/analysis/partner_places.h"
#include "engine/analysis/simulation.h"
#include "engine/rezoning/remesh.h"
#include "engine/scene/scene.h"
#include "engine/solid/face_place.h"
#include "engine/tools/tool_path.h"

namespace burnish::inline analysis {

/// How the new meshes of a run are chosen: what the scene says, and what it leaves out.
struct MeshChoice {
  std::size_t body = 0;   ///< its number
  FacePlace place;        ///< the face along which the knot spans are distributed
  double travel = 0.0;    ///< of a tool, after which the body is remeshed
  double ahead = 0.0;     ///< length of the fine part of the face in front of the contact, …
  double behind = 0.0;    ///< … and behind it
  double rounding = 0.0;  ///< length within which the growth of the spans begins
  RezoningOptions options;
  std::vector<std::optional<ToolPath>> paths;  ///< per tool
};

/// The face is the body's in the first contact of the scene that it has a part in. Lengths that the scene leaves
/// out are parts of the smaller of the tools' half thickness and a sixth of the body's size; other bodies that
/// the face may touch are tools here, half their smaller extent their half thickness. initial: the simulation in
/// which the run begins.
MeshChoice meshChoice(const Scene& scene, const Simulation<2>& initial);

/// Whether a tool that has not left nor been lifted between two passes, or another body, may touch the face along which
/// spans are distributed.
bool mayBeTouched(const MeshChoice& choice, const Simulation<2>& simulation);

/// A sound mesh of the deformed body that is fine where tools and other bodies press on its face, or are nearest
/// to it, and ahead of them, and that begins in contact with the tools where such a mesh is found. Nothing if no
/// mesh is sound. deformed: the patch in its current place. before: where its partners were when the last mesh
/// was tried.
std::optional<Remeshing> chooseMesh(const MeshChoice& choice, const Simulation<2>& simulation,
                                    const Patch<2>& deformed, const PartnerPlaces& before);

}  // namespace burnish::inline analysis
