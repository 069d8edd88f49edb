#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <memory>
#include <vector>

class vtkPolyData;

namespace burnish {

/// How much of the sky is seen from points of surfaces: ambient occlusion. It is the share of rays that get away,
/// cosine-weighted over the half space of the normal and the same for all points, so that there is no noise. Rays of mirror
/// images in planes across the axes are mirror images.
class FreeSky {
 public:
  using Surfaces = std::vector<vtkSmartPointer<vtkPolyData>>;

  /// What rays are computed in, with single precision.
  struct Space {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double scale = 1.0;

    Eigen::Vector3f place(const Eigen::Vector3d& x) const { return (scale * (x - middle)).cast<float>(); }
  };

  /// bodies: polygons that stop all rays; tools: that stop a share `toolOpacity`. Throws `Error`
  /// where there is not enough memory.
  FreeSky(const Surfaces& bodies, const Surfaces& tools, double toolOpacity);
  ~FreeSky();
  FreeSky(const FreeSky&) = delete;
  FreeSky& operator=(const FreeSky&) = delete;

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
  class Occluders;
  Space space_;
  std::unique_ptr<Occluders> bodies_, tools_;
  double toolOpacity_;
};

/// Loads the library that follows the rays. Throws `Error` where that fails.
void requireFreeSky();

}  // namespace burnish
