#include "postproc/draw/contour/ray_stops.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/late_library.h"

namespace burnish {
namespace {

/// Embree, loaded when the first picture needs it.
class Embree {
 public:
  /// Throws `Error` where it cannot be loaded.
  static const Embree& loaded() {
    static const Embree embree;
    return embree;
  }

 private:
  static LateLibrary load() {
    try {
      return {"libembree3.so.3", "libembree3-3"};
    } catch (const Error& error) {
      throw Error(fmt::format(
          "{}; without it bodies in space are drawn as PNG with occlusion off and hidden lines off",
          error.what()));
    }
  }

  template <class Function>
  Function find(const char* name) const {
    return library_.find<Function>(name);
  }

  LateLibrary library_ = load();

 public:
  decltype(&rtcNewDevice) newDevice = find<decltype(&rtcNewDevice)>("rtcNewDevice");
  decltype(&rtcReleaseDevice) releaseDevice = find<decltype(&rtcReleaseDevice)>("rtcReleaseDevice");
  decltype(&rtcGetDeviceError) getDeviceError = find<decltype(&rtcGetDeviceError)>("rtcGetDeviceError");
  decltype(&rtcNewScene) newScene = find<decltype(&rtcNewScene)>("rtcNewScene");
  decltype(&rtcReleaseScene) releaseScene = find<decltype(&rtcReleaseScene)>("rtcReleaseScene");
  decltype(&rtcSetSceneFlags) setSceneFlags = find<decltype(&rtcSetSceneFlags)>("rtcSetSceneFlags");
  decltype(&rtcSetSceneBuildQuality) setSceneBuildQuality =
      find<decltype(&rtcSetSceneBuildQuality)>("rtcSetSceneBuildQuality");
  decltype(&rtcCommitScene) commitScene = find<decltype(&rtcCommitScene)>("rtcCommitScene");
  decltype(&rtcIntersect1) intersect1 = find<decltype(&rtcIntersect1)>("rtcIntersect1");
  decltype(&rtcOccluded8) occluded8 = find<decltype(&rtcOccluded8)>("rtcOccluded8");
  decltype(&rtcNewGeometry) newGeometry = find<decltype(&rtcNewGeometry)>("rtcNewGeometry");
  decltype(&rtcReleaseGeometry) releaseGeometry = find<decltype(&rtcReleaseGeometry)>("rtcReleaseGeometry");
  decltype(&rtcCommitGeometry) commitGeometry = find<decltype(&rtcCommitGeometry)>("rtcCommitGeometry");
  decltype(&rtcAttachGeometry) attachGeometry = find<decltype(&rtcAttachGeometry)>("rtcAttachGeometry");
  decltype(&rtcSetNewGeometryBuffer) setNewGeometryBuffer =
      find<decltype(&rtcSetNewGeometryBuffer)>("rtcSetNewGeometryBuffer");
};

template <class Number>
void setBuffer(const Embree& embree, RTCGeometry triangles, RTCBufferType type, RTCFormat format,
               const std::vector<Number>& numbers) {
  void* buffer =
      embree.setNewGeometryBuffer(triangles, type, 0, format, 3 * sizeof(Number), numbers.size() / 3);
  if (buffer != nullptr) std::copy(numbers.begin(), numbers.end(), static_cast<Number*>(buffer));
}

}  // namespace

RaySpace raySpaceOf(const Surfaces& surfaces) {
  Eigen::AlignedBox3d box;
  for (const auto& surface : surfaces) {
    std::array<double, 6> b{};
    if (surface->GetNumberOfPoints() == 0) continue;
    surface->GetBounds(b.data());
    box.extend(Eigen::Vector3d(b[0], b[2], b[4])).extend(Eigen::Vector3d(b[1], b[3], b[5]));
  }
  if (box.isEmpty()) return {};
  const double largest = 0.5 * box.sizes().maxCoeff();
  return {box.center(), largest > 0.0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0};
}

RayStops::RayStops(const Surfaces& surfaces, const RaySpace& space)
    : space_(space),
      device_(Embree::loaded().newDevice(nullptr)),
      scene_(Embree::loaded().newScene(device_)) {
  const Embree& embree = Embree::loaded();
  embree.setSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no ray gets through between two triangles
  embree.setSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  std::vector<float> points;
  std::vector<unsigned> corners;
  std::size_t numPoints = 0, numTriangles = 0;
  for (const auto& surface : surfaces) {
    vtkCellArray& polygons = *surface->GetPolys();
    numPoints += static_cast<std::size_t>(surface->GetNumberOfPoints());
    numTriangles += static_cast<std::size_t>(
        std::max<vtkIdType>(0, polygons.GetNumberOfConnectivityIds() - 2 * polygons.GetNumberOfCells()));
  }
  points.reserve(3 * numPoints);
  corners.reserve(3 * numTriangles);
  for (const auto& surface : surfaces) append(*surface, points, corners);
  isEmpty_ = corners.empty();
  if (isEmpty_) return;
  RTCGeometry triangles = embree.newGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  setBuffer(embree, triangles, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, points);
  setBuffer(embree, triangles, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, corners);
  embree.commitGeometry(triangles);
  embree.attachGeometry(scene_, triangles);
  embree.releaseGeometry(triangles);
  embree.commitScene(scene_);
  if (embree.getDeviceError(device_) != RTC_ERROR_NONE) {
    release();
    throw Error(
        "not enough memory to follow rays; draw a PNG picture with occlusion off and hidden lines off");
  }
}

RayStops::~RayStops() {
  release();
}

void RayStops::release() {
  Embree::loaded().releaseScene(scene_);
  Embree::loaded().releaseDevice(device_);
}

void RayStops::append(vtkPolyData& surface, std::vector<float>& points,
                      std::vector<unsigned>& corners) const {
  const auto first = static_cast<unsigned>(points.size() / 3);
  for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
    Eigen::Vector3d at;
    surface.GetPoint(k, at.data());
    const Eigen::Vector3f x = space_.place(at);
    points.insert(points.end(), x.begin(), x.end());
  }
  vtkCellArray& polygons = *surface.GetPolys();
  const auto polygon = vtk::TakeSmartPointer(polygons.NewIterator());
  for (polygon->GoToFirstCell(); !polygon->IsDoneWithTraversal(); polygon->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    polygon->GetCurrentCell(count, ids);
    for (vtkIdType k = 2; k < count; ++k)
      for (const vtkIdType corner : {vtkIdType{0}, k - 1, k})
        corners.push_back(first + static_cast<unsigned>(ids[corner]));
  }
}

unsigned RayStops::stopped(const Eigen::Vector3f& origin, const RayPacket& directions, float reach,
                           unsigned asked) const {
  if (isEmpty_ || asked == 0) return 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay8 rays;
  alignas(32) std::array<int, kRayPacket> valid;
  for (int k = 0; k < kRayPacket; ++k) {
    const auto i = static_cast<std::size_t>(k);
    valid[i] = (asked >> k & 1U) != 0 ? -1 : 0;
    rays.org_x[k] = origin.x();
    rays.org_y[k] = origin.y();
    rays.org_z[k] = origin.z();
    rays.dir_x[k] = directions(0, k);
    rays.dir_y[k] = directions(1, k);
    rays.dir_z[k] = directions(2, k);
    rays.tnear[k] = rays.time[k] = 0.0F;
    rays.tfar[k] = reach;
    rays.mask[k] = ~0U;
    rays.id[k] = rays.flags[k] = 0;
  }
  Embree::loaded().occluded8(valid.data(), scene_, &context, &rays);
  unsigned stopped = 0;
  for (int k = 0; k < kRayPacket; ++k)
    if (rays.tfar[k] < 0.0F) stopped |= 1U << k;
  return stopped & asked;
}

int RayStops::numMet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach,
                     int most) const {
  constexpr float kApart = 1e-5F;  // what is met twice within this is the border of two triangles
  if (isEmpty_) return 0;
  const Eigen::Vector3f from = space_.place(origin), along = direction.cast<float>();
  const auto end = static_cast<float>(space_.scale * reach);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  float begin = 0.0F;
  for (int met = 0; met < most; ++met) {
    RTCRayHit ray{};
    ray.ray = {from.x(), from.y(), from.z(), begin, along.x(), along.y(), along.z(), 0.0F, end, ~0U, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Embree::loaded().intersect1(scene_, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return met;
    begin = ray.ray.tfar + kApart;
  }
  return most;
}

void requireRays() {
  Embree::loaded();
}

}  // namespace burnish
