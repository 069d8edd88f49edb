#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/formula.h"
#include "engine/core/schedule.h"

/// The parts of a scene that describe how things move, and the rigid tools.
namespace burnish {

/// Displacement components as piecewise linear functions of time, constant before the first and after the
/// last time.
struct MotionSpec {
  std::vector<double> times;                   ///< strictly increasing
  std::optional<std::vector<double>> x, y, z;  ///< one value per time; at least one component is given
};

struct PlaneToolSpec {
  std::vector<double> origin;
  std::vector<double> normal;  ///< points away from the tool, towards the body
};
struct CylinderToolSpec {
  std::vector<double> center;
  double radius = 0.0;
  std::vector<double> axis{0.0, 0.0, 1.0};  ///< 3D only
};
struct SphereToolSpec {
  std::vector<double> center;
  double radius = 0.0;
};

using ToolShapeSpec = std::variant<PlaneToolSpec, CylinderToolSpec, SphereToolSpec>;

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
/// these ways.
struct ToolCarrySpec {
  std::optional<FormulaText> x, y, z;
  std::optional<FormulaText> moment;
  std::optional<Schedule> schedule;  ///< factor over time
};

struct ToolSpec {
  std::string name;
  ToolShapeSpec shape;
  std::vector<double> pivot;                     ///< the shape's own middle when left out
  std::vector<double> pivotAxis{0.0, 0.0, 1.0};  ///< 3D only
  /// At most one of the two; ways that are in none of the three are held.
  std::optional<ToolMotionSpec> motion;
  std::optional<ToolPrescribedSpec> prescribe;
  std::optional<ToolCarrySpec> carry;
};

}  // namespace burnish
