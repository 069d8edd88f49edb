#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/fields/span_extremes.h"
#include "engine/results/run_account.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// What meshing a body anew has cost so far.
struct RezoningSums {
  int count = 0;
  double energyLost = 0.0;     ///< altogether
  double gapWork = 0.0;        ///< altogether
  double volumeDrift = 0.0;    ///< at the last one
  double boundaryError = 0.0;  ///< the largest

  void add(const RezoningRecord& rezoning);
};

/// What contact with a tool is like, over all of its pairs, or of faces with themselves.
struct ToolTouch {
  double area = 0.0;               ///< reference area under pressure, of pairs that know it
  double friction = 0.0;           ///< ∫ |t| dΓ of frictional tractions
  int sticking = 0, slipping = 0;  ///< control points
  double frictionWork = 0.0;       ///< since the start
};

/// What a pair of faces is like.
struct PairTouch {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the face with the multipliers on the other one
  double pressed = 0.0;                             ///< ∫ p dΓ
  double friction = 0.0;                            ///< ∫ |t| dΓ of frictional tractions
  int active = 0, sticking = 0, slipping = 0;       ///< control points
  double penetration = 0.0;                         ///< at quadrature points
  double frictionWork = 0.0;                        ///< since the start
};

/// Of one body among several.
struct BodyQuantities {
  double strainEnergy = 0.0;
  double plasticWork = 0.0;
  double maxPlasticStrain = 0.0;  ///< over quadrature points
  double minJ = 0.0;
  bool crossesItself = false;  ///< a contact face of it does
};

/// Quantities of one accepted state, in the units of the scene.
struct StateQuantities {
  double time = 0.0;
  std::vector<ToolPose> toolPoses;           ///< per tool
  std::vector<Eigen::Vector3d> toolForces;   ///< force of the body on each tool
  std::vector<Eigen::Vector3d> toolMoments;  ///< of that force about the tool's pivot
  std::vector<ToolTouch> toolTouches;        ///< per tool
  std::vector<PairTouch> pairs;              ///< per pair of faces
  std::vector<BodyQuantities> bodies;        ///< per body; empty if there is one
  double strainEnergy = 0.0;
  double contactEnergy = 0.0;
  double externalWork = 0.0;  ///< trapezoidal sum over the steps: tools, tractions, moved supports, fits
  double plasticWork = 0.0;
  double maxPlasticStrain = 0.0;  ///< over quadrature points
  Extremes projectedPlasticStrain;
  int activeControlPoints = 0;
  double maxPenetration = 0.0;
  int selfActiveControlPoints = 0;  ///< of faces that touch themselves
  double maxSelfPenetration = 0.0;
  double selfForce = 0.0;  ///< between the parts of a face, summed over the faces
  ToolTouch selfTouch;     ///< between them; no area
  double minJ = 1.0;
  double stabilisationWork = 0.0;  ///< taken from the body by a drag that holds it
  double stabilisedShare = 0.0;    ///< of the largest force, see `Model::stabilisedShare`
  double largestEnergy = 0.0;      ///< up to this state: of what work became, see `energyFound`
  bool crossesItself = false;      ///< a contact face does
  RezoningSums rezonings;
  std::vector<double> reactions;  ///< one for each of their columns
  std::vector<double> measured;   ///< one for each column of the scene's measures

  /// Whether a contact face of a body crosses itself.
  bool bodyCrossesItself(std::size_t body) const {
    return bodies.empty() ? crossesItself : bodies[body].crossesItself;
  }

  /// Work that friction has taken since the start.
  double frictionWork() const;

  /// What became of the work done: energies, plastic work, and what a drag and friction took.
  double energyFound() const {
    return strainEnergy + contactEnergy + plasticWork + stabilisationWork + frictionWork();
  }

  /// The vectors must have their sizes.
  void archive(StateArchive& archive);
};

}  // namespace burnish::inline analysis
