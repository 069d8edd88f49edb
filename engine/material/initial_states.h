#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/material/material_points.h"

namespace burnish::inline material {

/// Whether points of this material can have a plastic strain at the start.
bool carriesPlasticStrain(const MaterialParameters& material);

/// The state of a point of the material that bears the Cauchy stress `stress` without flowing, with the
/// equivalent plastic strain e_p, if the law knows one: b_e = V² with V the elastic stretch in the axes of the
/// stress that the law answers with it. Empty if there is none: a yield condition is violated, or no stretch is
/// found.
std::optional<PointStates> stateWithStress(const Material& material, const Eigen::Matrix3d& stress,
                                           double e_p);

}  // namespace burnish::inline material
