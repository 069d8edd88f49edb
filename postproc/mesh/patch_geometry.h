#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/results/result.h"

namespace burnish {

/// The basis of one direction of a patch. Throws `Error` for knots that are none.
UnivariateBasis basisOf(const DirectionRecord& direction);

/// The patch of a record in its reference configuration. Throws `Error` if basis and control points disagree.
template <int Dim>
Patch<Dim> patchGeometry(const PatchRecord& record);

/// The same with its control points displaced. displacement: Dim x nodes of the mesh; empty: undeformed.
/// Throws `Error` if the displacement does not fit.
template <int Dim>
Patch<Dim> patchGeometry(const PatchRecord& record, const Eigen::MatrixXd& displacement);

/// Parameters that cut every knot span into `subdivision` equal parts, both ends of the domain included:
/// spans * subdivision + 1 values. Throws `Error` if `subdivision` < 1.
std::vector<double> subdividedSpans(const UnivariateBasis& basis, int subdivision);

}  // namespace burnish
