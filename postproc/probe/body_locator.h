#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "engine/nurbs/inverse_map.h"
#include "engine/results/result.h"
#include "postproc/probe/probe_point.h"
#include "postproc/probe/probed_fields.h"

namespace burnish {

/// How far Lagrange elements may bulge out of the box around their nodes, as a share of its size.
inline constexpr double kLagrangeBulge = 0.25;

/// A place in a mesh: parameters in one of its patches.
template <int Dim>
struct MeshPlace {
  std::size_t patch = 0;
  Eigen::Vector<double, Dim> xi;
};

/// Tells which place of a mesh lies at a position.
template <int Dim>
class BodyLocator {
 public:
  using Point = Eigen::Vector<double, Dim>;

  struct Nearest {
    MeshPlace<Dim> place;
    double distance = 0.0;
  };

  /// The mesh, which must outlive the object, with its control points displaced. displacement: Dim x nodes;
  /// empty: undeformed.
  BodyLocator(const MeshRecord& mesh, const Eigen::MatrixXd& displacement);

  /// The place at a position, up to rounding: of the patch of the guess if that has one, else of the first
  /// patch that has; nothing outside.
  std::optional<MeshPlace<Dim>> find(const Point& position, const std::optional<MeshPlace<Dim>>& guess) const;

  /// The place of all bodies, or of one by its number, that Newton's method finds nearest to a position.
  Nearest nearest(const Point& position, std::optional<int> body = std::nullopt) const;

  const Patch<Dim>& patch(std::size_t number) const { return maps_[number].patch(); }

  /// Largest extent of what `box` covers.
  double size() const { return box().sizes().maxCoeff(); }

  /// Covers points of all patches, their corners among them.
  Eigen::AlignedBox<double, Dim> box() const;

  /// What is at a place. frame: has this mesh. axes: of the surface that fields may be told in.
  ProbePoint point(double at, const MeshPlace<Dim>& place, const FrameRecord& frame,
                   const ProbedFields& fields, const std::optional<SurfaceAxes>& axes = std::nullopt) const;

 private:
  std::optional<MeshPlace<Dim>> inPatch(std::size_t patch, const Point& position, const Point& guess) const;
  Point middle(std::size_t patch) const;

  const MeshRecord& mesh_;
  std::vector<InverseMap<Dim>> maps_;                   ///< one per patch
  std::vector<Eigen::AlignedBox<double, Dim>> around_;  ///< the same: where a point of the patch can be
};

/// "(1, 0.5)"
std::string pointText(const Eigen::VectorXd& point);

/// Throws `Error` for a length that is far beyond the size of the bodies: borders would be blurred. what: it is of.
void requireNotTooLong(const char* what, double length, double size);

/// Length of a line through bodies of this size. Throws `Error` for a point twice and for a line that is too long.
double lineLength(const Eigen::VectorXd& begin, const Eigen::VectorXd& end, double size);

/// "between (0, 0) and (2, 1)": where the bodies are.
template <int Dim>
std::string extentText(const BodyLocator<Dim>& bodies) {
  return "between " + pointText(bodies.box().min()) + " and " + pointText(bodies.box().max());
}

}  // namespace burnish
