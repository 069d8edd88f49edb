#include "engine/results/mesh_io.h"

#include <fmt/format.h>

#include <string>

#include "engine/core/error.h"

namespace burnish::inline results {
namespace {

using hdf5::InputDataset;
using hdf5::InputGroup;
using hdf5::OutputGroup;
using hdf5::OutputObject;

const char* const kFamilyNames[] = {"bspline", "lagrange"};  // in the order of BasisFamily

void writePatch(const OutputGroup& group, const PatchRecord& patch) {
  group.dataset("points", patch.points);
  group.dataset("weights", patch.weights);
  group.dataset("nodes", patch.nodes);
  for (std::size_t d = 0; d < patch.directions.size(); ++d) {
    const DirectionRecord& direction = patch.directions[d];
    const OutputObject knots = group.dataset(fmt::format("knots_{}", d), direction.knots);
    knots.attribute("family", std::string(kFamilyNames[static_cast<int>(direction.family)]));
    knots.attribute("degree", direction.degree);
  }
}

DirectionRecord readDirection(const InputDataset& dataset) {
  const std::string family = dataset.text("family");
  if (family != kFamilyNames[0] && family != kFamilyNames[1])
    throw Error(fmt::format("{}: family \"{}\" is neither {} nor {}", dataset.place(), family,
                            kFamilyNames[0], kFamilyNames[1]));
  const Eigen::VectorXd knots = dataset.vector();
  return {.family = family == kFamilyNames[0] ? BasisFamily::BSpline : BasisFamily::Lagrange,
          .degree = dataset.integer("degree"),
          .knots = {knots.begin(), knots.end()}};
}

PatchRecord readPatch(const InputGroup& group, int dim) {
  PatchRecord patch;
  patch.points = group.dataset("points").matrix();
  patch.weights = group.dataset("weights").vector();
  patch.nodes = group.dataset("nodes").integers();
  for (int d = 0; d < dim; ++d)
    patch.directions.push_back(readDirection(group.dataset(fmt::format("knots_{}", d))));
  return patch;
}

}  // namespace

void writePatches(const OutputGroup& parent, const std::vector<PatchRecord>& patches) {
  const OutputGroup group = parent.group("patches");
  for (std::size_t i = 0; i < patches.size(); ++i) writePatch(group.group(std::to_string(i)), patches[i]);
}

std::vector<PatchRecord> readPatches(const InputGroup& parent, int dim) {
  const InputGroup group = parent.group("patches");
  std::vector<PatchRecord> patches;
  for (std::size_t i = 0; i < group.names().size(); ++i)
    patches.push_back(readPatch(group.group(std::to_string(i)), dim));
  return patches;
}

void writeMesh(const OutputGroup& group, const MeshRecord& mesh) {
  group.attribute("num_nodes", mesh.numNodes);
  writePatches(group, mesh.patches);
}

MeshRecord readMesh(const InputGroup& group, int dim) {
  return {.numNodes = group.integer("num_nodes"), .patches = readPatches(group, dim)};
}

}  // namespace burnish::inline results
