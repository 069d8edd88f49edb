#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>

#include "engine/analysis/build_model.h"
#include "engine/core/state_archive.h"
#include "engine/material/material.h"

namespace burnish::inline analysis {

/// Saves or restores a body of one patch with the history of its matter; an empty one is filled from the
/// archive. Restoring throws `Error` if what was saved is not that of one mesh.
template <int Dim>
void archiveBody(StateArchive& archive, const MaterialParameters& material,
                 std::optional<RezonedBody<Dim>>& body);

/// Saves or restores a matrix with this number of rows. Restoring throws `Error` if it had another one.
void archiveMatrix(StateArchive& archive, const std::string& name, Eigen::Index rows,
                   Eigen::MatrixXd& matrix);

}  // namespace burnish::inline analysis
