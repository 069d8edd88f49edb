#pragma once
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/body.h"
#include "engine/tools/tool.h"

namespace burnish::test {

/// A 1 x 0.5 block of 6 x 2 spans whose top face is pressed by a tool.
inline Body<2> block(int degree, BasisFamily family, bool axisymmetric = false) {
  const Patch<2> shape = rectangle({0.0, 0.0}, {1.0, 0.5});
  Body<2> body =
      family == BasisFamily::BSpline
          ? makeBody(refined(shape, {KnotVector::uniform(degree, 6), KnotVector::uniform(degree, 2)}))
          : makeBody(lagrangeInterpolant(shape, degree,
                                         {KnotVector::uniform(1, 6).breakpoints(), {0.0, 0.5, 1.0}}));
  body.axisymmetric = axisymmetric;
  return body;
}

inline Tool disc() {
  return {"disc", Cylinder{{0.4, 0.5 + 0.24, 0.0}, Eigen::Vector3d::UnitZ(), 0.3}};
}

/// A tool that is turned and displaced, and free in all its degrees of freedom; its unknowns follow the
/// displacements.
inline Tool freeTool(Tool tool, int firstUnknown) {
  tool.pivot = {0.3, 0.8, 0.1};
  for (std::size_t dof = 0; dof < kToolDofs; ++dof) tool.unknowns[dof] = firstUnknown + static_cast<int>(dof);
  tool.turnLength = 1.7;
  return tool;
}

/// A tool that is free along the normal of a surface that it follows and about its pivot, the two unknowns behind the
/// displacements.
inline Tool followingTool(Tool tool, int firstUnknown) {
  tool.pivot = {0.3, 0.8, 0.1};
  tool.normal = [](double) { return Eigen::Vector3d(0.6, 0.8, 0.0); };
  tool.unknowns[kNormal] = firstUnknown;
  tool.unknowns[kTurn] = firstUnknown + 1;
  tool.turnLength = 1.7;
  return tool;
}

}  // namespace burnish::test
