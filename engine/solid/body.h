#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish {

/// A body as one or more patches with a common numbering of its control points ("nodes"). Displacement
/// component d of node a is unknown number Dim * a + d.
template <int Dim>
struct Body {
  std::vector<Patch<Dim>> patches;
  std::vector<std::vector<int>> nodes;  ///< per patch: node of each function
  int numNodes = 0;

  /// Largest extent of the bounding box of the control points: the length L of all tolerances.
  double size() const;
};

/// A body of one patch; nodes are numbered like its functions.
template <int Dim>
Body<Dim> makeBody(Patch<Dim> patch);

}  // namespace burnish
