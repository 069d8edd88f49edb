#pragma once
#include <Eigen/Dense>
#include <variant>
#include <vector>

#include "engine/tools/analytic_shapes.h"
#include "engine/tools/combined_shapes.h"
#include "engine/tools/faceted_shape.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/nurbs_shape.h"

namespace burnish {

/// The shapes of rigid tools, in the tool's reference position. 2D scenes live in the plane z = 0.
using RigidShape = std::variant<Plane, Cylinder, Sphere, Edge, Cone, Torus, RoundedBox, NurbsCurve,
                                NurbsSurface, FacetedShape, Die, Union>;

/// A shape as part of another one.
struct AnyShape {
  RigidShape shape;
};

Die dieOf(RigidShape solid);

Union unionOf(const std::vector<RigidShape>& parts, double blend = 0.0);

GapQuery queryGap(const RigidShape& shape, const Eigen::Vector3d& x);

/// The point that stands for a shape: its centre or tip, or where a plane was given.
Eigen::Vector3d middleOf(const RigidShape& shape);

/// How deep a point can be inside the tool before the nearest surface is on another side of it; infinity for
/// a plane, an edge, and a die around a convex solid. Of a mesh, a line, a NURBS curve or surface half the
/// smallest extent, of a union that of its thinnest part: bounds for simple forms, else estimates.
double halfThickness(const RigidShape& shape);

}  // namespace burnish
