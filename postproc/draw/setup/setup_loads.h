#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/scene/scene.h"
#include "postproc/draw/setup/setup_faces.h"

namespace burnish {

/// A load when its schedule has its largest magnitude, or at the end of the run without one.
struct FaceLoad {
  std::vector<Eigen::Vector2d> vectors;  ///< at the points of the face: force per area
  double middle = 0.0;                   ///< their length at the middle of the face
  bool varies = false;                   ///< whether they differ in length
};

/// A traction, pressure or shear of a scene that ends at this time. Throws `Error` for a formula that has no
/// value on the face.
FaceLoad faceLoad(const LoadSpec& load, const FaceLine& face, const Scene& scene, double end);

/// A body force at a point: force per volume.
Eigen::Vector2d bodyForceAt(const LoadSpec& load, const Eigen::Vector2d& X, const Scene& scene, double end);

/// What a tool carries when its schedule has its largest magnitude, or at the end of the run without one. outward: normal
/// of the face that it follows.
struct DrawnToolLoad {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double moment = 0.0;
};
DrawnToolLoad toolLoad(const ToolCarrySpec& carry, const Eigen::Vector2d& outward, const Scene& scene,
                       double end);

}  // namespace burnish
