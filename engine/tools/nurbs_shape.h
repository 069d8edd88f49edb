#pragma once
#include <Eigen/Dense>
#include <memory>

#include "engine/nurbs/patch.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/surface_mesh.h"

namespace burnish {

template <int P>
class NurbsDistance;

/// Tool bounded by a NURBS curve (P = 1, in the plane z = 0) or surface (P = 2): to the left of the curve,
/// behind the normal ∂1 x ∂2 of the surface.
template <int P>
struct NurbsShape {
  std::shared_ptr<const NurbsDistance<P>> distance;
  GapQuery query(const Eigen::Vector3d& x) const;
};

using NurbsCurve = NurbsShape<1>;
using NurbsSurface = NurbsShape<2>;

/// `flip`: the tool is on the other side. Throws `Error` for a curve or surface without extent.
template <int P>
NurbsShape<P> makeNurbsShape(Patch<P, 3> patch, bool flip = false);

/// The tessellated curve or surface.
template <int P>
SurfaceMesh outlineOf(const NurbsShape<P>& shape);

/// Half the smallest extent of a closed curve or surface, infinity for an open one and for a die.
template <int P>
double halfThicknessOf(const NurbsShape<P>& shape);

}  // namespace burnish
