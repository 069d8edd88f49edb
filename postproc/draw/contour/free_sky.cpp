#include "postproc/draw/contour/free_sky.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/late_library.h"

namespace burnish {

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
      throw Error(fmt::format("{}; draw with occlusion off", error.what()));
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
  decltype(&rtcOccluded8) occluded8 = find<decltype(&rtcOccluded8)>("rtcOccluded8");
  decltype(&rtcNewGeometry) newGeometry = find<decltype(&rtcNewGeometry)>("rtcNewGeometry");
  decltype(&rtcReleaseGeometry) releaseGeometry = find<decltype(&rtcReleaseGeometry)>("rtcReleaseGeometry");
  decltype(&rtcCommitGeometry) commitGeometry = find<decltype(&rtcCommitGeometry)>("rtcCommitGeometry");
  decltype(&rtcAttachGeometry) attachGeometry = find<decltype(&rtcAttachGeometry)>("rtcAttachGeometry");
  decltype(&rtcSetNewGeometryBuffer) setNewGeometryBuffer =
      find<decltype(&rtcSetNewGeometryBuffer)>("rtcSetNewGeometryBuffer");
};

namespace {

/// With 256 rays a share is off by 0.003 (root mean square); with the fewest by 0.008.
constexpr Eigen::Index kFewestRaysOfPoint = 64;

/// Beyond these a point gets fewer.
constexpr Eigen::Index kRaysOfPicture = 8'000'000;

/// Rays that are followed together.
constexpr int kPacket = 8;
constexpr unsigned kAllOfPacket = (1U << kPacket) - 1U;
using RayPacket = Eigen::Matrix<float, 3, kPacket>;

/// Directions about the z axis, 3 x count (a multiple of four), in a spiral whose turns have equal shares of cosine-weighted
/// space: a quarter of it, and its images in x, in y and in both.
Eigen::Matrix3Xd spiral(Eigen::Index count) {
  constexpr double kGolden = 0.3819660112501051;  // of a turn
  const Eigen::Index quarter = count / 4;
  Eigen::Matrix3Xd directions(3, count);
  for (Eigen::Index k = 0; k < quarter; ++k) {
    const auto number = static_cast<double>(k);
    const double square = (number + 0.5) / static_cast<double>(quarter), radius = std::sqrt(square),
                 angle = 0.5 * std::numbers::pi * (kGolden * number - std::floor(kGolden * number)),
                 x = radius * std::cos(angle), y = radius * std::sin(angle), z = std::sqrt(1.0 - square);
    directions.middleCols<4>(4 * k) << x, -x, x, -x, y, y, -y, -y, z, z, z, z;
  }
  return directions;
}

/// Columns: two directions across a unit normal, and the normal. The first one lies with it and an axis in a plane, so
/// that of a mirror image across an axis it is the image or its opposite.
Eigen::Matrix3d frameOf(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix3d frame;
  frame.col(2) = normal;
  frame.col(0) = (Eigen::Vector3d::Unit(axis) - normal(axis) * normal).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

/// About the middle of all surfaces, so that a body far from the origin has the same rays, times a power of two that takes
/// places to 2 and less: Embree ends the program at such as 1e19.
FreeSky::Space spaceOf(const std::array<FreeSky::Surfaces, 2>& all) {
  Eigen::AlignedBox3d box;
  for (const auto& surfaces : all)
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

}  // namespace

/// Triangles in boxes in boxes.
class FreeSky::Occluders {
 public:
  Occluders(const Surfaces& surfaces, const Space& space)
      : space_(space), device_(embree_.newDevice(nullptr)), scene_(embree_.newScene(device_)) {
    embree_.setSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no ray gets through between two triangles
    embree_.setSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
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
    RTCGeometry triangles = embree_.newGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy(triangles, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, points);
    copy(triangles, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, corners);
    embree_.commitGeometry(triangles);
    embree_.attachGeometry(scene_, triangles);
    embree_.releaseGeometry(triangles);
    embree_.commitScene(scene_);
    if (embree_.getDeviceError(device_) != RTC_ERROR_NONE) {
      release();
      throw Error("not enough memory for occlusion; draw without it");
    }
  }
  ~Occluders() { release(); }
  Occluders(const Occluders&) = delete;
  Occluders& operator=(const Occluders&) = delete;

  /// Which of the rays from a point are stopped, of those that are asked for; all of these have bits.
  unsigned stopped(const Eigen::Vector3f& origin, const RayPacket& directions, float reach,
                   unsigned asked) const {
    if (isEmpty_ || asked == 0) return 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay8 rays;
    alignas(32) std::array<int, kPacket> valid;
    for (int k = 0; k < kPacket; ++k) {
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
    embree_.occluded8(valid.data(), scene_, &context, &rays);
    unsigned stopped = 0;
    for (int k = 0; k < kPacket; ++k)
      if (rays.tfar[k] < 0.0F) stopped |= 1U << k;
    return stopped & asked;
  }

 private:
  void append(vtkPolyData& surface, std::vector<float>& points, std::vector<unsigned>& corners) const {
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

  template <class Number>
  void copy(RTCGeometry triangles, RTCBufferType type, RTCFormat format,
            const std::vector<Number>& numbers) const {
    void* buffer =
        embree_.setNewGeometryBuffer(triangles, type, 0, format, 3 * sizeof(Number), numbers.size() / 3);
    if (buffer != nullptr) std::copy(numbers.begin(), numbers.end(), static_cast<Number*>(buffer));
  }

  void release() {
    embree_.releaseScene(scene_);
    embree_.releaseDevice(device_);
  }

  const Embree& embree_ = Embree::loaded();
  Space space_;
  RTCDevice device_;
  RTCScene scene_;
  bool isEmpty_ = true;
};

FreeSky::FreeSky(const Surfaces& bodies, const Surfaces& tools, double toolOpacity)
    : space_(spaceOf({bodies, tools})),
      bodies_(std::make_unique<Occluders>(bodies, space_)),
      tools_(std::make_unique<Occluders>(tools, space_)),
      toolOpacity_(toolOpacity) {}

FreeSky::~FreeSky() = default;

Eigen::VectorXd FreeSky::sharesAt(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normals,
                                  const Rays& rays) const {
  Eigen::VectorXd shares(points.cols());
  if (points.cols() == 0) return shares;
  const Eigen::Index wanted = std::clamp(kRaysOfPicture / points.cols(), kFewestRaysOfPoint, rays.most),
                     count = wanted / kPacket * kPacket;
  const Eigen::Matrix3Xd directions = spiral(count);
  const auto reach = static_cast<float>(space_.scale * rays.reach);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, points.cols(), 64), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const Eigen::Vector3d x = points.col(i), n = normals.col(i);
      if (!(n.squaredNorm() > 0.0)) {  // of a face that has shrunk to a line or a point
        shares(i) = 1.0;
        continue;
      }
      const Eigen::Vector3f amongBodies = space_.place(x + rays.amongBodies * n),
                            amongTools = space_.place(x + rays.amongTools * n);
      const Eigen::Matrix3d frame = frameOf(n);
      int free = 0, throughTools = 0;
      for (Eigen::Index k = 0; k < count; k += kPacket) {
        const RayPacket packet = (frame * directions.middleCols<kPacket>(k)).cast<float>();
        const unsigned past = kAllOfPacket & ~bodies_->stopped(amongBodies, packet, reach, kAllOfPacket),
                       dimmed = tools_->stopped(amongTools, packet, reach, past);
        free += std::popcount(past & ~dimmed);
        throughTools += std::popcount(dimmed);
      }
      shares(i) = (free + (1.0 - toolOpacity_) * throughTools) / static_cast<double>(count);
    }
  });
  return shares;
}

void requireFreeSky() {
  Embree::loaded();
}

}  // namespace burnish
