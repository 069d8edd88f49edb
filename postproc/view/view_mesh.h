#pragma once
#include <json/value.h>

#include <Eigen/Dense>
#include <vector>

#include "engine/results/result.h"

namespace burnish {

/// What a page needs of a mesh, of which it evaluates the faces that can be seen: all of a plane body, of one
/// in space its surface and, for sections, its inside.
struct ViewMesh {
  std::vector<int> nodes;  ///< that faces and volumes have; the page counts these
  /// `nodes`: their number. `faces`: each with its `body`, two `rows` (`p`, `functions`, `first` and `factors`
  /// of each of its Bernstein coefficients, which neighbouring spans share), `nodes` of its functions and, unless
  /// they are equal, their `weights`. `volumes`: if wanted, the patches alike, with three `rows`. `edges`: pairs of a face and its side, for the edges of the body; the
  /// sides are u = 0, u = 1, v = 0, v = 1.
  Json::Value json;
};

ViewMesh viewMesh(const MeshRecord& mesh, bool withVolumes);

/// Control points of the nodes of a page, dim x nodes, displaced by dim x nodes of the mesh (empty: not at all).
Eigen::MatrixXd controlPoints(const ViewMesh& view, const MeshRecord& mesh,
                              const Eigen::MatrixXd& displacement);

/// Numbers as a page reads them: the bytes of floats, or of integers of 32 bits, lowest first, in letters.
std::string floatsText(const Eigen::MatrixXd& values);
std::string integersText(const std::vector<int>& values);

}  // namespace burnish
