#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/contact/master_search.h"
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"

namespace burnish::inline analysis {

/// The undeformed faces that a tool follows. What a body does under the tool does not turn the force on it, so that the
/// normal is a function of time, with the tool's motion, and no tangent of it is needed.
template <int Dim>
class FollowedSurface {
 public:
  /// Throws `Error` if more than two of the faces meet in a rim.
  FollowedSurface(const Body<Dim>& body, const std::vector<FacePlace>& faces);

  /// Unit normal, away from the body, at the point next to a position; on a kink and beyond a rim the direction from
  /// there to the position, which turns steadily. Throws `Error` where there is no such point.
  Eigen::Vector3d normalNextTo(const Eigen::Vector3d& position) const;

 private:
  MasterSurface<Dim> surface_;
  MasterSearch<Dim> search_;
};

}  // namespace burnish::inline analysis
