#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/schema/alternatives.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/profile.h"

namespace burnish::inline solid {

/// A curve or a face turned about an axis; exact, by rational arcs.
struct RevolutionBody {
  static constexpr PartKind kind{
      "revolution",
      "A curve in the plane turned about a point, or a face in space about an axis; needs no functions or spans."};
  static constexpr const char* name = "a revolution";
  static constexpr std::array nets{"profile"};

  Net profile;
  Point center{0.0, 0.0, 0.0};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of any length; 3D only
  double angle = 0.0;                               ///< degrees, (0, 360)

  int dim() const { return dimensionFrom(profile); }
  std::vector<KnotVector> knotVectors() const { return madeKnots(*this); }
  template <int Dim>
  Patch<Dim> patch() const;
};

template <class Visitor>
void describe(Visitor& v, RevolutionBody& s) {
  v.field("profile", s.profile, {.required = true},
          "The curve or face: the face `bottom` of a body of two dimensions, `back` in space.");
  v.field("center", s.center, {.unit = "length"}, "The point to turn about, or a point of the axis.");
  v.field("axis", s.axis, {}, "Direction of the axis; always z in two dimensions.");
  v.field(
      "angle", s.angle, {.required = true, .above = 0, .below = 360, .unit = "degrees"},
      "Angle, counterclockwise where the axis points at the reader; in exact arcs of at most a right angle. A ring "
      "that closes is made of several patches.");
}

void check(const RevolutionBody& body, const Problems& problems);

}  // namespace burnish::inline solid
