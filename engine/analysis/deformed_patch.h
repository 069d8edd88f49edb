#pragma once
#include <Eigen/Dense>

#include "engine/nurbs/patch.h"

namespace burnish {

/// A patch with its control points where the displacements have moved them. x: unknowns that begin with the
/// displacements of this patch's body, which has no other.
Patch<2> deformedPatch(const Patch<2>& patch, const Eigen::VectorXd& x);

/// Value at the parameters xi of the field on a patch with these coefficients, components x control points.
Eigen::VectorXd valueAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi);

}  // namespace burnish
