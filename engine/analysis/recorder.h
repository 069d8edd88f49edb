#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/measures.h"
#include "engine/analysis/model.h"
#include "engine/analysis/reactions.h"
#include "engine/analysis/tip_watch.h"
#include "engine/analysis/tool_watch.h"
#include "engine/fields/projection.h"
#include "engine/fields/span_extremes.h"
#include "engine/results/doubts.h"

namespace burnish {

/// What is to be known of how the forces of an accepted state balance.
struct Equilibrium {
  int unstableDirections = 0;    ///< see `Inertia`
  double stabilisedShare = 0.0;  ///< see `Model::stabilisedShare`
};

/// Quantities of one accepted state, in the units of the scene.
struct StateQuantities {
  double time = 0.0;
  std::vector<ToolPose> toolPoses;           ///< per tool
  std::vector<Eigen::Vector3d> toolForces;   ///< force of the body on each tool
  std::vector<Eigen::Vector3d> toolMoments;  ///< of that force about the tool's pivot
  double strainEnergy = 0.0;
  double contactEnergy = 0.0;
  double externalWork = 0.0;  ///< trapezoidal sum over the steps: tools, tractions, moved supports
  double plasticWork = 0.0;
  double maxPlasticStrain = 0.0;  ///< over quadrature points
  Extremes projectedPlasticStrain;
  int activeControlPoints = 0;
  double maxPenetration = 0.0;
  int selfActiveControlPoints = 0;  ///< of faces that touch themselves
  double maxSelfPenetration = 0.0;
  double selfForce = 0.0;  ///< between the parts of a face, summed over the faces
  double minJ = 1.0;
  double stabilisationWork = 0.0;  ///< taken from the body by a drag that holds it
  double stabilisedShare = 0.0;    ///< of the largest force, see `Model::stabilisedShare`
  double largestEnergy = 0.0;      ///< up to this state: of what work became, see `energyFound`

  /// What became of the work done: energies, plastic work, and what a drag took.
  double energyFound() const { return strainEnergy + contactEnergy + plasticWork + stabilisationWork; }

  void archive(StateArchive& archive);
};

/// Follows a run: sums the external work, watches extremes and doubts, and makes history rows.
template <int Dim>
class Recorder {
 public:
  /// Scene, model and projection must outlive the recorder.
  Recorder(const Scene& scene, const Model<Dim>& model, const Projection<Dim>& projection);

  /// Columns of the history, as documented in docs/results.md.
  std::vector<std::string> columns() const;

  /// Takes in the accepted state that the terms have just been evaluated at. `force`: sum of all terms'
  /// forces there.
  void update(const MeasuredState& state, const Eigen::VectorXd& force, const Equilibrium& equilibrium);

  /// Goes on with the sums and extremes of a recorder of the same scene on another mesh.
  void continueFrom(const Recorder& before);

  /// The run ends with the current state.
  void noteEnd();

  /// The current state is the first one after the body was meshed anew.
  void noteRezoning(const RezoningRecord& rezoning);

  /// A new mesh was due, and none was found.
  void noteFailedRezoning() { needsNewMesh_ = true; }

  const StateQuantities& current() const { return current_; }
  std::vector<double> row(int step, int newtonIterations) const;

  /// Smallest J and largest penetration of all states so far.
  double smallestJ() const { return smallestJ_; }
  double largestPenetration() const { return largestPenetration_; }

  /// Largest share of the forces that the stabilisation has carried.
  double largestStabilisedShare() const { return largestStabilisedShare_; }

  /// The conditions that held at some time, with how badly.
  std::vector<DoubtRecord> doubts() const;

  const Reactions<Dim>& reactions() const { return reactions_; }

  /// Extremes of the projected von Mises stress in the current state, which the terms have been evaluated at.
  Extremes projectedVonMises() const;

  /// Whether a contact face crosses itself in the current state (2D); parts that touch by self-contact do
  /// not.
  bool crossesItself() const { return crossesItself_; }

  /// Names of the tools with contact pairs that nothing has touched so far.
  std::vector<std::string> idleTools() const;

  /// All that later rows and the end of the run depend on.
  void archive(StateArchive& archive);

  /// Seconds spent in projections.
  double projectionSeconds() const { return projectionSeconds_; }

 private:
  double workIncrement(const Eigen::VectorXd& x, const Eigen::VectorXd& force,
                       const Eigen::VectorXd& loads) const;
  double toolWork(const StateQuantities& next) const;
  void addTools(const MeasuredState& state, StateQuantities& next) const;
  void addSelfContacts(StateQuantities& next) const;
  Eigen::VectorXd loadForces() const;
  void watch(const Equilibrium& equilibrium);
  void watchContacts();
  void watchWork();
  void watchTools();
  void note(Condition condition, bool holds, double value = 0.0);
  void nameTips();
  bool hasLostResolution(const ContactPair<Dim>& pair) const;
  bool faceCrossesItself(const ContactPair<Dim>& pair) const;
  bool anyFaceCrossesItself() const;

  const Model<Dim>& model_;
  const Projection<Dim>& projection_;
  SpanExtremes<Dim> extremes_;
  Measures<Dim> measures_;
  Reactions<Dim> reactions_;
  bool listsReactions_;  ///< in the history
  ToolWatch<Dim> toolWatch_;
  TipWatch<Dim> tipWatch_;
  StateQuantities current_;
  std::vector<double> measured_;       ///< of the current state
  Eigen::VectorXd x_, force_, loads_;  ///< of the last state; empty before the first
  double smallestJ_ = 1.0;
  double largestPenetration_ = 0.0;
  double largestStabilisedShare_ = 0.0;
  int states_ = 0;             ///< taken in, that at the start among them
  double suddenWork_ = 0.0;    ///< half of the work on the first step of loads that were there from the start
  std::vector<Doubt> doubts_;  ///< those of any scene
  std::vector<Doubt> toolDoubts_;  ///< one for each tool and face that `ToolWatch` watches
  std::vector<Doubt> tipDoubts_;   ///< one for each contact pair
  bool crossesItself_ = false;
  std::vector<FoundTip> tips_;  ///< the first ones
  std::vector<bool> touched_;   ///< per tool
  bool rezones_;
  bool needsNewMesh_ = false;  ///< of this mesh, since a rezoning that failed; the next one's begins anew
  int rezonings_ = 0;
  double energyLost_ = 0.0, gapWork_ = 0.0;         ///< sums of rezonings
  double volumeDrift_ = 0.0, boundaryError_ = 0.0;  ///< the last one, the largest
  double projectionSeconds_ = 0.0;
};

}  // namespace burnish
