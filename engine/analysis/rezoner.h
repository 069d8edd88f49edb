#pragma once
#include <memory>
#include <optional>

#include "engine/analysis/carry_over.h"
#include "engine/analysis/choose_mesh.h"
#include "engine/analysis/mesh_renewal.h"
#include "engine/analysis/rezoning_trigger.h"
#include "engine/results/result.h"

namespace burnish::inline analysis {

/// Remeshes a plane or axisymmetric body of one patch while a tool or another body moves along it, so that its
/// surface is always resolved where that is. Other bodies keep their meshes. `RezoningTrigger` decides when, `chooseMesh` how; `CarryOver` takes the
/// state to the new mesh, where `settle` brings it into equilibrium.
class Rezoner : public MeshRenewal<2> {
 public:
  /// Team and scene, which asks for rezoning, must outlive the object. initial: the simulation in which the run
  /// begins.
  Rezoner(const Scene& scene, const Simulation<2>& initial, const Team& team);

  /// Whether the last accepted state calls for a new mesh. Not while forces fade of supports and tools that have let go,
  /// nor while nothing may touch the face along which spans are distributed.
  bool isDue(const Simulation<2>& simulation) const;

  /// The simulation that goes on from the last accepted state of this one, in equilibrium on a new mesh.
  /// Nothing if there is no sound mesh or no equilibrium on it: the run then goes on as it is, and tries
  /// again later.
  std::unique_ptr<Simulation<2>> rezone(Simulation<2>& simulation);

  /// The meshes of a frame, control points of the remeshed body where the material of the mesh's parameters was
  /// at the start of the run, approximately; nothing before the first rezoning. displacement: of the present
  /// reference, becomes the one from the start of the run.
  std::optional<MeshRecord> frameMesh(const Simulation<2>& simulation, Eigen::MatrixXd& displacement) const;

  void archive(StateArchive& archive);

 private:
  /// The same as `rezone`; throws `Error` where the new body cannot be used.
  std::unique_ptr<Simulation<2>> attempt(Simulation<2>& simulation);

  MeshChoice choice_;
  RezoningTrigger trigger_;
  Eigen::MatrixXd origin_;  ///< 2 x nodes of the body: see `frameMesh`
};

}  // namespace burnish::inline analysis
