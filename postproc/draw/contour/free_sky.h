#pragma once
#include <Eigen/Dense>

#include "postproc/draw/contour/ray_stops.h"

namespace burnish {

/// How much of the sky is seen from points of surfaces: ambient occlusion. It is the share of rays that get away,
/// cosine-weighted over the half space of the normal and the same for all points, so that there is no noise. Rays of mirror
/// images in planes across the axes are mirror images.
class FreeSky {
 public:
  /// bodies: polygons that stop all rays; tools: that stop a share `toolOpacity`. Throws as `RayStops`.
  FreeSky(const Surfaces& bodies, const Surfaces& tools, double toolOpacity);

  /// How long rays are, and where they begin, measured along the normals from the points.
  struct Rays {
    double reach;
    double amongBodies = 0.0;
    double amongTools = 0.0;  ///< below 0, so that a tool that reaches a little into a body closes its sky
    Eigen::Index most = 256;  ///< from a point; fewer where points are many
  };

  /// Shares at points with unit normals, 3 x points each: 1 where nothing is near, 0 where all is closed. Does not
  /// depend on the number of threads.
  Eigen::VectorXd sharesAt(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normals,
                           const Rays& rays) const;

 private:
  RaySpace space_;
  RayStops bodies_, tools_;
  double toolOpacity_;
};

}  // namespace burnish
