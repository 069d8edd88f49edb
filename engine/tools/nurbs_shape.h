#pragma once
#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/nurbs/net_words.h"
#include "engine/nurbs/patch.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;
template <int P>
class NurbsDistance;

/// Tool bounded by a NURBS curve (P = 1, in the plane z = 0) or surface (P = 2): to the left of the curve,
/// behind the normal ∂1 x ∂2 of the surface.
template <int P>
struct NurbsShape {
  std::shared_ptr<const NurbsDistance<P>> distance;

  GapQuery query(const Eigen::Vector3d& x) const;

  /// Half the smallest extent of a closed curve or surface, infinity for an open one and for a die.
  double halfThickness() const;
  Eigen::Vector3d middle() const;

  /// The tessellated curve or surface.
  SurfaceMesh outline(int dim, double reach) const;
};

using NurbsCurve = NurbsShape<1>;
using NurbsSurface = NurbsShape<2>;

/// `flip`: the tool is on the other side. Throws `Error` for a curve or surface without extent.
template <int P>
NurbsShape<P> makeNurbsShape(Patch<P, 3> patch, bool flip = false);

/// A curve in 2D, a surface in 3D, as a scene gives it.
struct NurbsTool {
  static constexpr ShapeKind kind{"nurbs", "A NURBS curve; a NURBS surface in 3D.", ForBodies::All,
                                  ShapeFile::ControlNet};

  std::string file;                        ///< its other keys are put in when the scene is read
  std::optional<int> entry;                ///< which one of several in the file; taken away with it
  std::vector<int> degrees;                ///< one per direction of the curve or surface
  std::vector<std::vector<double>> knots;  ///< per direction
  std::vector<std::vector<double>> points;
  std::vector<double> weights;  ///< all 1 when left out
  bool flip = false;

  RigidShape made() const;
};

template <class Visitor>
void describe(Visitor& v, NurbsTool& s) {
  v.field("file", s.file, {}, kNetFileSentence);
  v.field("entry", s.entry, {.atLeast = 0}, kNetEntrySentence);
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 1, .maxEntries = 2},
          "Degree in the direction of a curve (two dimensions), in both directions of a surface (3D).");
  v.field("knots", s.knots, {.minEntries = 1, .maxEntries = 2}, "An open knot vector for each direction.");
  v.field("points", s.points, {.minEntries = 2, .unit = "length"},
          "Coordinates of the control points, the first direction fastest. The tool is to the left of a "
          "curve, behind a surface whose parameters go counterclockwise.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
  v.field("flip", s.flip, {}, "The tool is on the other side.");
}

void check(const NurbsTool& nurbs, const ShapeProblems& problems);

}  // namespace burnish::inline tools
