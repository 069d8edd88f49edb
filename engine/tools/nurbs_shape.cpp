#include "engine/tools/nurbs_shape.h"

#include "engine/tools/nurbs_distance.h"

namespace burnish {

template <int P>
GapQuery NurbsShape<P>::query(const Eigen::Vector3d& x) const {
  return distance->query(x);
}

template <int P>
NurbsShape<P> makeNurbsShape(Patch<P, 3> patch, bool flip) {
  return {std::make_shared<const NurbsDistance<P>>(std::move(patch), flip)};
}

template <int P>
SurfaceMesh outlineOf(const NurbsShape<P>& shape) {
  return shape.distance->outline();
}

template <int P>
double halfThicknessOf(const NurbsShape<P>& shape) {
  return shape.distance->halfThickness();
}

template struct NurbsShape<1>;
template struct NurbsShape<2>;
template NurbsShape<1> makeNurbsShape(Patch<1, 3>, bool);
template NurbsShape<2> makeNurbsShape(Patch<2, 3>, bool);
template SurfaceMesh outlineOf(const NurbsShape<1>&);
template SurfaceMesh outlineOf(const NurbsShape<2>&);
template double halfThicknessOf(const NurbsShape<1>&);
template double halfThicknessOf(const NurbsShape<2>&);

}  // namespace burnish
