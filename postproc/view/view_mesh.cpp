#include "postproc/view/view_mesh.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>

#include "postproc/mesh/patch_borders.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/tensor_points.h"
#include "postproc/text/page.h"

namespace burnish {
namespace {

using End = PatchSide::End;

Json::Value rowJson(const DirectionRecord& direction) {
  const UnivariateBasis basis = basisOf(direction);
  const PointRow row = bernsteinPoints(basis);
  Json::Value json;
  json["p"] = basis.degree();
  json["functions"] = row.numFunctions;
  json["first"] = integersText(row.firstFunction);
  json["factors"] = floatsText(row.factors);
  return json;
}

/// The four sides of a face: the first and the last value of its first parameter, then of its second.
std::vector<PatchSide> sidesOf(const PatchSide& face) {
  std::vector<PatchSide> sides;
  for (std::size_t d = 0; d < face.ends.size(); ++d)
    if (face.ends[d] == End::None)
      for (const End end : {End::Begin, End::End}) {
        sides.push_back(face);
        sides.back().ends[d] = end;
      }
  return sides;
}

std::set<int> nodeSetOn(const MeshRecord& mesh, const PatchSide& side) {
  const std::vector<int> nodes = nodesOn(mesh, side);
  return {nodes.begin(), nodes.end()};
}

/// Numbers nodes in the order in which they are asked for.
class NodeNumbers {
 public:
  int of(int node) {
    const auto [place, isNew] = numbers_.try_emplace(node, static_cast<int>(nodes.size()));
    if (isNew) nodes.push_back(node);
    return place->second;
  }

  std::vector<int> nodes;

 private:
  std::map<int, int> numbers_;
};

/// Of a face, or of all of a patch.
Json::Value partJson(const MeshRecord& mesh, const PatchSide& part, NodeNumbers& numbers) {
  const PatchRecord& patch = mesh.patches[part.patch];
  Json::Value json;
  json["body"] = patch.body;
  json["rows"] = Json::arrayValue;
  for (std::size_t d = 0; d < part.ends.size(); ++d)
    if (part.ends[d] == End::None) json["rows"].append(rowJson(patch.directions[d]));
  const std::vector<int> functions = functionsOn(patch, part);
  std::vector<int> nodes;
  for (const int function : functions)
    nodes.push_back(numbers.of(patch.nodes[static_cast<std::size_t>(function)]));
  json["nodes"] = integersText(nodes);
  const Eigen::VectorXd weights = patch.weights(functions);
  if (!(weights.array() == weights(0)).all()) json["weights"] = floatsText(weights);
  return json;
}

/// The edges of the body, each once, as sides of faces.
Json::Value edgesJson(const MeshRecord& mesh, const PatchBorders& borders) {
  std::set<std::set<int>> wanted;
  for (const PatchSide& edge : borders.outline()) wanted.insert(nodeSetOn(mesh, edge));
  Json::Value json = Json::arrayValue;
  for (std::size_t f = 0; f < borders.surface().size(); ++f) {
    const std::vector<PatchSide> sides = sidesOf(borders.surface()[f]);
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (wanted.erase(nodeSetOn(mesh, sides[s])) > 0) {
        json.append(static_cast<int>(f));
        json.append(static_cast<int>(s));
      }
  }
  return json;
}

}  // namespace

std::string floatsText(const Eigen::MatrixXd& values) {
  const Eigen::MatrixXf floats = values.cast<float>();
  return base64({reinterpret_cast<const char*>(floats.data()),
                 static_cast<std::size_t>(floats.size()) * sizeof(float)});
}

std::string integersText(const std::vector<int>& values) {
  const std::vector<std::int32_t> integers(values.begin(), values.end());
  return base64({reinterpret_cast<const char*>(integers.data()), integers.size() * sizeof(std::int32_t)});
}

ViewMesh viewMesh(const MeshRecord& mesh, bool withVolumes) {
  const PatchBorders borders(mesh);
  NodeNumbers numbers;
  ViewMesh view;
  view.json["faces"] = Json::arrayValue;
  for (const PatchSide& face : borders.surface()) view.json["faces"].append(partJson(mesh, face, numbers));
  if (withVolumes)
    for (std::size_t k = 0; k < mesh.patches.size(); ++k)
      view.json["volumes"].append(
          partJson(mesh, {k, std::vector(mesh.patches[k].directions.size(), End::None)}, numbers));
  view.json["edges"] = edgesJson(mesh, borders);
  view.nodes = std::move(numbers.nodes);
  view.json["nodes"] = static_cast<int>(view.nodes.size());
  return view;
}

Eigen::MatrixXd controlPoints(const ViewMesh& view, const MeshRecord& mesh,
                              const Eigen::MatrixXd& displacement) {
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(mesh.dim(), mesh.numNodes);
  for (const PatchRecord& patch : mesh.patches) points(Eigen::all, patch.nodes) = patch.points;
  if (displacement.size() > 0) points += displacement;
  return points(Eigen::all, view.nodes);
}

}  // namespace burnish
