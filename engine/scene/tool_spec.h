#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/formula.h"
#include "engine/core/schedule.h"
#include "engine/schema/coordinates.h"
#include "engine/tools/tool_path.h"
#include "engine/tools/tool_shape.h"

/// The parts of a scene that describe how things move, and the rigid tools.
namespace burnish::inline scene {

/// Displacement components as piecewise linear functions of time, constant before the first and after the
/// last time.
struct MotionSpec {
  std::vector<double> times;                   ///< strictly increasing
  std::optional<std::vector<double>> x, y, z;  ///< one value per time; at least one component is given
};

/// Displacement of the pivot and turn about the axis through it, as piecewise linear functions of time.
struct ToolMotionSpec {
  std::vector<double> times;
  std::optional<std::vector<double>> x, y, z;
  std::optional<std::vector<double>> angle;  ///< degrees
};

/// The same as formulas in t.
struct ToolPrescribedSpec {
  std::optional<FormulaText> x, y, z;
  std::optional<FormulaText> angle;  ///< degrees
};

/// Forces and the moment about the axis through the pivot that a tool presses with; it is free to move in
/// these degrees of freedom.
struct ToolCarrySpec {
  std::optional<FormulaText> x, y, z;
  std::optional<FormulaText> normal;  ///< along the outward normal of the face, instead of x, y, z
  std::optional<FormulaText> moment;
  bool spin = false;                 ///< a ball: free to turn about all axes through its middle
  std::optional<Schedule> schedule;  ///< factor over time
};

struct ToolSpec {
  std::string name;
  ToolShape shape;
  bool inside = false;                                   ///< the body is in the hollow of the shape
  Point pivot;                                           ///< the shape's own middle when left out
  Eigen::Vector3d pivotAxis = Eigen::Vector3d::UnitZ();  ///< 3D only
  /// At most one of the three; degrees of freedom that are in none of them and carry nothing are held.
  std::optional<ToolMotionSpec> motion;
  std::optional<ToolPrescribedSpec> prescribe;
  std::optional<PathSpec> path;
  std::optional<ToolCarrySpec> carry;
  std::optional<double> until;       ///< taken away then
  std::optional<double> releasedBy;  ///< what it pressed with is zero then; the end of the run when left out
};

}  // namespace burnish::inline scene
