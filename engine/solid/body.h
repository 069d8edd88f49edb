#pragma once
#include <Eigen/Dense>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/solid/kinematics.h"

namespace burnish::inline solid {

/// A body as one or more patches with a common numbering of its control points ("nodes"). Displacement
/// component d of node a is unknown number Dim * a + d. Where several bodies are computed together the numbers
/// are counted on from body to body, and `numNodes` counts the nodes of all.
template <int Dim>
struct Body {
  std::vector<Patch<Dim>> patches;
  std::vector<std::vector<int>> nodes;  ///< per patch: node of each function
  int numNodes = 0;

  /// Dim 2 only: the patches are a half plane's cut through a body of revolution, x the radius and y the
  /// axis.
  bool axisymmetric = false;

  Kinematics kinematics() const {
    if (Dim == 3) return Kinematics::Solid;
    return axisymmetric ? Kinematics::Axisymmetric : Kinematics::Plane;
  }

  /// Share of the body behind a reference point of its cut: the circumference 2πR in axisymmetry, else 1.
  double circumference(const Eigen::Vector<double, Dim>& X) const {
    return axisymmetric ? 2.0 * std::numbers::pi * X(0) : 1.0;
  }

  /// Reference positions of the nodes, Dim x nodes; zero for nodes of other bodies.
  Eigen::MatrixXd nodePositions() const;

  /// Its own nodes: the first one and the one behind the last.
  std::pair<int, int> nodeRange() const;

  /// Largest extent of the bounding box of the control points: the length L of all tolerances.
  double size() const;
};

/// A body of one patch; nodes are numbered like its functions.
template <int Dim>
Body<Dim> makeBody(Patch<Dim> patch);

/// Bodies that know their own nodes alone, numbered together: node numbers of each follow those of the one
/// before.
template <int Dim>
void numberTogether(std::vector<Body<Dim>>& bodies);

/// All patches of bodies that are numbered together, body after body.
template <int Dim>
Body<Dim> unitedBody(const std::vector<Body<Dim>>& bodies);

}  // namespace burnish::inline solid
