#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/material/material_points.h"
#include "engine/nurbs/inverse_map.h"
#include "engine/solid/reference_state.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline rezoning {

/// Parameters, in the old patch, of positions along a path through the new one, each found from the one
/// before. Throws `Error` if a position is farther than `farthest` from the old patch.
Eigen::Matrix2Xd parametersIn(const InverseMap<2>& old, const Eigen::Matrix2Xd& positions, double farthest);

/// Positions of the quadrature points of a body of one patch, 2 x points.
Eigen::Matrix2Xd pointPositions(const SpanQuadrature<2>& quadrature, const Patch<2>& patch);

/// States at other parameters of a patch, Dim x points. The law's numbers, none below what it may be at least,
/// and the deviator of log b_e by cubic interpolation on the tensor grid of its quadrature points. The volume change
/// ln det b_e by projection onto splines of one degree less: pressures that alternate from point to point, as
/// they do where a body that flows is nearly incompressible, would else be carried on from mesh to mesh and
/// grow. `quadrature`: of a body of this patch alone, on this basis.
template <int Dim>
PointStates interpolated(const SpanQuadrature<Dim>& quadrature, const TensorBasis<Dim>& basis,
                         const PointStates& states, const Eigen::MatrixXd& parameters);

/// States at the quadrature points of another mesh over the same parameters and the same reference, which stays:
/// those that are interpolated where matter has flowed; where it has not, b_e = F Fᵀ, without an error that would
/// count as flow from then on. gradients: F at the points of the other mesh.
PointStates regraded(const SpanQuadrature<3>& quadrature, const TensorBasis<3>& basis,
                     const PointStates& states, const SpanQuadrature<3>& next,
                     const std::vector<Eigen::Matrix3d>& gradients);

/// The state of a reference configuration from what its points have been through. gradients: F of the place in
/// which they are, against the reference; empty: the reference is that place.
template <int Dim>
ReferenceState referenceState(const SpanQuadrature<Dim>& quadrature, const PointStates& states,
                              std::vector<Eigen::Matrix3d> gradients = {});

}  // namespace burnish::inline rezoning
