#pragma once
#include <Eigen/Dense>

#include "engine/nurbs/patch.h"
#include "engine/solid/body.h"

namespace burnish::inline analysis {

/// The patch of a body that has no other, with its control points where the displacements have moved them. x:
/// unknowns, those of the displacements by the body's nodes.
Patch<2> deformedPatch(const Body<2>& body, const Eigen::VectorXd& x);

/// Value at the parameters xi of the field on a patch with these coefficients, components x control points.
Eigen::VectorXd valueAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi);

}  // namespace burnish::inline analysis
