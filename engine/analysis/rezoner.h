#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/results/result.h"
#include "engine/results/summary_file.h"
#include "engine/rezoning/curve.h"
#include "engine/rezoning/remesh.h"

namespace burnish {

/// Meshes a plane or axisymmetric body of one patch anew while a tool moves along it, so that its surface is
/// always resolved where the tool is.
class Rezoner {
 public:
  /// The scene, which asks for rezoning, must outlive the object. initial: the simulation in which the run begins.
  Rezoner(const Scene& scene, const Simulation<2>& initial);

  /// Whether the last accepted state calls for a new mesh: the tool's travel, the stretch or the quality of
  /// the mesh since the last one. Not where the face crosses itself: what is there twice has no mesh.
  bool isDue(const Simulation<2>& simulation) const;

  /// The simulation that goes on from the last accepted state of this one, in equilibrium on a new mesh. Nothing
  /// if there is no sound mesh or no equilibrium on it: the run then goes on as it is, and tries again after
  /// a quarter of the travel.
  std::unique_ptr<Simulation<2>> rezone(Simulation<2>& simulation);

  int count() const { return static_cast<int>(records_.size()); }
  const std::vector<RezoningRecord>& records() const { return records_; }

  /// How the last one that was tried came into equilibrium, or did not.
  const NewtonReport& lastReport() const { return lastReport_; }

  int numFailures() const { return numFailures_; }

  /// Why the last one failed that did since the run was begun or resumed; empty without.
  const std::string& lastFailure() const { return lastFailure_; }

  /// The mesh of a frame, its control points where the material of the mesh's parameters was at the start of
  /// the run, approximately; nothing before the first rezoning. displacement: of the present reference,
  /// becomes the one from the start of the run.
  std::optional<MeshRecord> frameMesh(const Simulation<2>& simulation, Eigen::MatrixXd& displacement) const;

  void archive(StateArchive& archive);

  /// After restoring: the simulation of the last rezoning, as it began; null if there was none.
  std::unique_ptr<Simulation<2>> restoredSimulation() const;

 private:
  struct Place {
    ArcInterval contact;     ///< along the face, by arc length
    double direction = 1.0;  ///< of the tools along the face: 1 towards its end
  };

  /// The same; throws `Error` where the new body cannot be used.
  std::unique_ptr<Simulation<2>> attempt(Simulation<2>& simulation);

  /// Where the tools press on the face, or are nearest to it.
  Place findContact(const Simulation<2>& simulation, const ArcLengthCurve& face) const;
  RemeshOptions options(const Simulation<2>& simulation, const Patch<2>& deformed) const;
  SteppingState startOn(const Simulation<2>& simulation, const Patch<2>& deformed, const Model<2>& next,
                        const Eigen::Matrix2Xd& anchors) const;
  Patch<2> inContact(const Simulation<2>& simulation, const Patch<2>& deformed,
                     const Remeshing& meshing) const;
  void setMultipliers(const Simulation<2>& simulation, const Patch<2>& deformed, const Model<2>& next,
                      Eigen::VectorXd& x) const;
  std::vector<ToolPose> posesOf(const Simulation<2>& simulation) const;
  double travelSince(const Simulation<2>& simulation) const;  ///< of a tool since `last_`
  void archiveRecords(StateArchive& archive);
  void fail(const Simulation<2>& simulation, const std::string& why);

  const Scene& scene_;
  RezoningSpec spec_;
  FaceId face_;
  double length_;  ///< scale of the lengths that the scene leaves out
  double travel_;
  double volume_;               ///< stress-free, of the body
  std::vector<ToolPose> last_;  ///< of the tools when the body was meshed, or that was tried
  double wait_ = 0.0;           ///< travel from there to the next try
  bool failedLast_ = false;
  std::vector<RezoningRecord> records_;
  NewtonReport lastReport_;
  int numFailures_ = 0;
  std::string lastFailure_;
  std::optional<RezonedBody<2>> body_;  ///< as the present simulation began
  Eigen::MatrixXd origin_;              ///< 2 x nodes: see `frameMesh`
};

}  // namespace burnish
