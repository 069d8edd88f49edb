#pragma once
#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/results/result.h"
#include "postproc/probe/face_address.h"
#include "postproc/probe/probe_point.h"
#include "postproc/probe/probed_fields.h"

/// Exact values of fields, evaluated from their coefficients at points that are found by Newton's method.
namespace burnish {

/// The straight line between two points.
struct LinePath {
  Eigen::VectorXd begin, end;
};

/// All of a face of a plane body, in the direction of its parameter.
struct FacePath {
  FaceAddress address;
};

/// A straight line in space laid on a face: each of its points goes to the nearest one of the face.
struct LaidPath {
  FaceAddress address;
  LinePath line;
};

/// The straight line from a place on a face along the inward normal, up to where it leaves the body first.
struct DepthPath {
  FaceAddress address;
  Eigen::VectorXd place;  ///< a length along the face of a plane body, or a position: the nearest point
  std::optional<double> length{};  ///< no farther than this
};

using ProbePath = std::variant<LinePath, FacePath, LaidPath, DepthPath>;

/// Points of a path at equal distances, unless others are asked for.
inline constexpr int kProbePoints = 401;

/// The body in which a path lies and is measured.
enum class ProbedBody { Deformed, Undeformed };

struct ProbeOptions {
  ProbedBody body = ProbedBody::Deformed;
  int points = kProbePoints;  ///< at equal distances
  double window = 0.0;        ///< width of the window of averages; 0: values at points
  double spot =
      0.0;  ///< length along the face, in space side of a square, over which values of a `DepthPath` are means; 0: none
  double penetration = 0.0;  ///< of X-rays, see `penetrationAverages`; 0: values at points
};

/// The points of a path with the fields there. The axes of the surface are those where a `DepthPath` begins, and of each
/// point of a `FacePath` or `LaidPath`; in space the first direction of the face is the one along it. Throws `Error` for a path that does
/// not fit the body: of another dimension, of no length, wholly outside or beyond its face, of a face that is none, or of an area; for a spot that reaches beyond the
/// face; and if nothing on it has a field.
std::vector<ProbePoint> probedPath(const ModelRecord& model, const FrameRecord& frame,
                                   const ProbedFields& fields, const ProbePath& path,
                                   const ProbeOptions& options = {});

/// The means of the fields over all of a path, at the time of the frame; `kNone` where the path is outside of
/// the bodies that have them, and as position. Throws `Error` for a path that does not fit the body.
ProbePoint probedMean(const ModelRecord& model, const FrameRecord& frame, const ProbedFields& fields,
                      const ProbePath& path, const ProbeOptions& options = {});

/// A point of the material over time, or the mean about it.
class MaterialPoint {
 public:
  /// reference: its position in the undeformed body. window: diameter of the disc, in space of the ball, about that over
  /// which values are means, of the part that lies in the body of the point; 0: at the point alone. Throws `Error` for a
  /// position outside, and for a window of which next to nothing lies in the body.
  MaterialPoint(const ModelRecord& model, const Eigen::VectorXd& reference, double window = 0.0);
  ~MaterialPoint();
  MaterialPoint(const MaterialPoint&) = delete;
  MaterialPoint& operator=(const MaterialPoint&) = delete;

  /// The values in a frame, at its time, and the positions of the point itself. In a mesh that was made on the way the
  /// material is found as nearly as the mesh can say, and outside of it by a thousandth of the body's size and more there is
  /// nothing.
  ProbePoint in(const FrameRecord& frame, const ProbedFields& fields) const;

 private:
  class Finder;
  template <int Dim>
  class FinderIn;

  std::unique_ptr<Finder> finder_;
};

}  // namespace burnish
