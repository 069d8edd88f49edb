#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/rezoning/inverse_map.h"
#include "engine/solid/reference_state.h"
#include "engine/solid/span_quadrature.h"

namespace burnish {

/// State at the quadrature points of a body.
struct PointStates {
  std::vector<Eigen::Matrix3d> b_e;  ///< elastic left Cauchy-Green tensors
  std::vector<double> e_p;
};

/// Parameters, in the old patch, of positions along a path through the new one, each found from the one
/// before.
Eigen::Matrix2Xd parametersIn(const InverseMap& old, const Eigen::Matrix2Xd& positions);

/// Positions of the quadrature points of a body of one patch, 2 x points.
Eigen::Matrix2Xd pointPositions(const SpanQuadrature<2>& quadrature, const Patch<2>& patch);

/// States at other parameters of a patch: log b_e and e_p by cubic interpolation on the tensor grid of its
/// quadrature points, e_p not below zero. `quadrature`: of a body of this patch alone.
PointStates interpolated(const SpanQuadrature<2>& quadrature, const PointStates& states,
                         const Eigen::Matrix2Xd& parameters);

/// The state of a reference configuration from what its points have been through.
template <int Dim>
ReferenceState referenceState(const SpanQuadrature<Dim>& quadrature, const PointStates& states);

}  // namespace burnish
