#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <vector>

class vtkPolyData;
struct RTCDeviceTy;
struct RTCSceneTy;

namespace burnish {

using Surfaces = std::vector<vtkSmartPointer<vtkPolyData>>;

/// What rays are computed in, with single precision.
struct RaySpace {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double scale = 1.0;

  Eigen::Vector3f place(const Eigen::Vector3d& x) const { return (scale * (x - middle)).cast<float>(); }
};

/// About the middle of all surfaces, so that a body far from the origin has the same rays, times a power of two that takes
/// places to 2 and less: Embree ends the program at such as 1e19.
RaySpace raySpaceOf(const Surfaces& surfaces);

/// Rays that are followed together.
inline constexpr int kRayPacket = 8;
inline constexpr unsigned kAllOfPacket = (1U << kRayPacket) - 1U;
using RayPacket = Eigen::Matrix<float, 3, kRayPacket>;

/// Polygons of surfaces, as triangles in boxes in boxes, that stop rays.
class RayStops {
 public:
  /// Throws `Error` where Embree cannot be loaded or there is not enough memory.
  RayStops(const Surfaces& surfaces, const RaySpace& space);
  ~RayStops();
  RayStops(const RayStops&) = delete;
  RayStops& operator=(const RayStops&) = delete;

  /// Which of the rays from a point (in the space) are stopped, of those that are asked for; all of these have bits. reach: in lengths
  /// of the directions.
  unsigned stopped(const Eigen::Vector3f& origin, const RayPacket& directions, float reach,
                   unsigned asked) const;

  /// How many times a ray from a point meets the surfaces, `most` at most. direction: a unit vector.
  int numMet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach, int most) const;

 private:
  void append(vtkPolyData& surface, std::vector<float>& points, std::vector<unsigned>& corners) const;
  void release();

  RaySpace space_;
  RTCDeviceTy* device_;
  RTCSceneTy* scene_;
  bool isEmpty_ = true;
};

/// Loads the library that follows rays. Throws `Error` where that fails.
void requireRays();

}  // namespace burnish
