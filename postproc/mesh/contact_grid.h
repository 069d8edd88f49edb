#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/index_box.h"

namespace burnish {

/// The quadrature points of a face in contact in rows and columns, along its first direction and its second one.
struct ContactGrid {
  IndexBox box;                         ///< in the plane one row
  Eigen::MatrixXd positions;            ///< dim x points, by their number in the box
  std::vector<std::size_t> recordedAt;  ///< the place in the record of the point that has its values
};

/// Throws `Error` for points that are not as many on each knot span of the face.
ContactGrid contactGrid(int dim, const MeshRecord& mesh, const ContactRecord& contact);

/// The face of a contact with its control points displaced. displacement: Dim x nodes of the mesh; empty: undeformed.
template <int Dim>
Patch<Dim - 1, Dim> contactFace(const MeshRecord& mesh, const ContactRecord& contact,
                                const Eigen::MatrixXd& displacement);

}  // namespace burnish
