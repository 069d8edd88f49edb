#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/analysis/mesh_renewal.h"
#include "engine/results/result.h"
#include "engine/scene/path_mesh.h"

namespace burnish::inline analysis {

/// Grades the mesh of a box anew while a tool moves along its path, so that knot spans are fine where the tool is. The
/// reference stays the undeformed box, and with it all parameters of the material: of the old mesh and the new one the
/// knots alone differ. The displacement is interpolated on the new splines, histories are interpolated in the
/// parameters (`regraded`), and `settle` brings the body into equilibrium. `followingMeshes` says when and how.
class Regrader : public MeshRenewal<3> {
 public:
  /// Team and scene, which asks for rezoning, must outlive the object. initial: the simulation in which the run
  /// begins.
  Regrader(const Scene& scene, const Simulation<3>& initial, const Team& team);

  /// Whether the tool is about to leave the part of its path that the mesh was made for. Not while forces fade of
  /// supports and tools that have let go.
  bool isDue(const Simulation<3>& simulation) const;

  /// The simulation that goes on from the last accepted state of this one, in equilibrium on the mesh that its time
  /// asks for. Nothing if there is no equilibrium on it: the run then goes on as it is, and tries again later.
  std::unique_ptr<Simulation<3>> rezone(Simulation<3>& simulation);

  /// The mesh of a frame; nothing before the first rezoning. Displacements are those of the undeformed box always.
  std::optional<MeshRecord> frameMesh(const Simulation<3>& simulation, Eigen::MatrixXd& displacement) const;

  void archive(StateArchive& archive);

 private:
  std::unique_ptr<Simulation<3>> attempt(const Simulation<3>& simulation);

  /// Number of the mesh that a time asks for.
  std::size_t meshAt(double time) const;

  std::vector<FollowingMesh> meshes_;
  double due_;  ///< time at which the next mesh is tried
};

}  // namespace burnish::inline analysis
