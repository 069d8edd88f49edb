#include "postproc/mesh/patch_borders.h"

#include <algorithm>
#include <map>

#include "postproc/mesh/index_box.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {
namespace {

using End = PatchSide::End;
using Nodes = std::vector<int>;

/// The sides that have these nodes.
using SidesByNodes = std::map<Nodes, std::vector<PatchSide>>;

/// All sides of a patch on which so many parameters have their first or last value.
std::vector<PatchSide> sidesOf(std::size_t patch, std::size_t dim, std::ptrdiff_t fixed) {
  std::vector<std::vector<End>> all{{}};
  for (std::size_t d = 0; d < dim; ++d) {
    std::vector<std::vector<End>> longer;
    for (const std::vector<End>& ends : all)
      for (const End end : {End::Begin, End::End, End::None}) {
        longer.push_back(ends);
        longer.back().push_back(end);
      }
    all = std::move(longer);
  }
  std::vector<PatchSide> sides;
  for (std::vector<End>& ends : all)
    if (std::ssize(ends) - std::count(ends.begin(), ends.end(), End::None) == fixed)
      sides.push_back({patch, std::move(ends)});
  return sides;
}

/// Sorted, each once.
Nodes sortedNodesOn(const MeshRecord& mesh, const PatchSide& side) {
  Nodes nodes = nodesOn(mesh, side);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Without those that have collapsed to a point.
SidesByNodes groupedSides(const MeshRecord& mesh, std::ptrdiff_t fixed) {
  SidesByNodes groups;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (PatchSide& side : sidesOf(p, static_cast<std::size_t>(mesh.dim()), fixed)) {
      Nodes nodes = sortedNodesOn(mesh, side);
      if (nodes.size() > 1) groups[std::move(nodes)].push_back(std::move(side));
    }
  return groups;
}

/// The faces of a patch that meet at an edge of it.
std::vector<PatchSide> facesAt(const PatchSide& edge) {
  std::vector<PatchSide> faces;
  for (std::size_t d = 0; d < edge.ends.size(); ++d) {
    if (edge.ends[d] == End::None) continue;
    faces.push_back({edge.patch, std::vector<End>(edge.ends.size(), End::None)});
    faces.back().ends[d] = edge.ends[d];
  }
  return faces;
}

/// How many of the edges with these nodes lie apart in their patches: a face that has collapsed to one has it twice.
std::ptrdiff_t numPlaces(const MeshRecord& mesh, const Nodes& nodes, const std::vector<PatchSide>& edges) {
  const auto isOfCollapsed = [&](const PatchSide& edge) {
    return std::ranges::any_of(facesAt(edge),
                               [&](const PatchSide& face) { return sortedNodesOn(mesh, face) == nodes; });
  };
  return std::ssize(edges) - std::ranges::count_if(edges, isOfCollapsed) / 2;
}

}  // namespace

std::vector<int> functionsOn(const PatchRecord& patch, const PatchSide& side) {
  IndexBox all, own;
  for (std::size_t d = 0; d < side.ends.size(); ++d) {
    all.extent[d] = basisOf(patch.directions[d]).numFunctions();
    if (side.ends[d] == End::None) own.extent[d] = all.extent[d];
  }
  std::vector<int> functions;
  for (int a = 0; a < own.size(); ++a) {
    IndexBox::Index index = own.index(a);
    for (std::size_t d = 0; d < side.ends.size(); ++d)
      if (side.ends[d] == End::End) index[d] = all.extent[d] - 1;
    functions.push_back(all.number(index));
  }
  return functions;
}

std::vector<int> nodesOn(const MeshRecord& mesh, const PatchSide& side) {
  const PatchRecord& patch = mesh.patches[side.patch];
  Nodes nodes;
  for (const int function : functionsOn(patch, side))
    nodes.push_back(patch.nodes[static_cast<std::size_t>(function)]);
  return nodes;
}

PatchBorders::PatchBorders(const MeshRecord& mesh) {
  const SidesByNodes faces = groupedSides(mesh, 1);
  const auto isFree = [&](const PatchSide& face) {
    const auto group = faces.find(sortedNodesOn(mesh, face));
    return group != faces.end() && group->second.size() == 1;
  };
  for (const auto& [nodes, edges] : groupedSides(mesh, mesh.dim() - 1)) {
    if (edges.size() > 1) sharedEdges_.push_back(edges);
    std::ptrdiff_t most = 0, all = 0;  // free faces: of one of the patches, of all of them
    for (const PatchSide& edge : edges) {
      const std::vector<PatchSide> around = facesAt(edge);
      const auto free = std::count_if(around.begin(), around.end(), isFree);
      most = std::max(most, free);
      all += free;
    }
    const bool isCorner = most == mesh.dim() - 1,
               isAroundOthers = all > 0 && edges.size() > 2 && numPlaces(mesh, nodes, edges) > 2;
    if (isCorner || isAroundOthers)
      outline_.push_back(edges.front());
    else if (mesh.dim() == 2 || all > 0)
      seams_.push_back(edges.front());
  }
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (PatchSide& side : sidesOf(p, static_cast<std::size_t>(mesh.dim()), mesh.dim() - 2))
      if (mesh.dim() == 2 || isFree(side)) surface_.push_back(std::move(side));
}

}  // namespace burnish
