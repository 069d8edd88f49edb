#pragma once
#include <vector>

#include "engine/results/hdf5_input.h"
#include "engine/results/hdf5_output.h"
#include "engine/results/result.h"

namespace burnish::inline results {

/// Makes the group `patches` with a group for each.
void writePatches(const hdf5::OutputGroup& parent, const std::vector<PatchRecord>& patches);

/// The group `patches` of patches with so many directions. Throws `Error` for what is missing or of another
/// type; whether sizes agree is for `checkMesh` to say.
std::vector<PatchRecord> readPatches(const hdf5::InputGroup& parent, int dim);

/// The attribute `num_nodes` and the patches.
void writeMesh(const hdf5::OutputGroup& group, const MeshRecord& mesh);

/// Throws as `readPatches`.
MeshRecord readMesh(const hdf5::InputGroup& group, int dim);

}  // namespace burnish::inline results
