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

struct EdgeToolSpec {
  std::vector<double> tip;
  std::vector<double> direction;
  std::vector<double> along{0.0, 0.0, 1.0};  ///< 3D only
  double angle = 0.0;                        ///< degrees, between the flanks
  double radius = 0.0;
};
struct ConeToolSpec {
  std::vector<double> tip;
  std::vector<double> direction;
  double halfAngle = 0.0;  ///< degrees, between the axis and the flank
  double radius = 0.0;
};
struct TorusToolSpec {
  std::vector<double> center;
  std::vector<double> axis{0.0, 0.0, 1.0};
  double radius = 0.0;
  double tubeRadius = 0.0;
};
struct BoxToolSpec {
  std::vector<double> center;
  std::vector<double> size;
  double radius = 0.0;
  std::vector<std::vector<double>> axes;  ///< along x, y, z when left out
};
/// A curve in 2D, a surface in 3D.
struct NurbsToolSpec {
  std::string file;                        ///< its other keys are put in when the scene is read
  std::vector<int> degrees;                ///< one per direction of the curve or surface
  std::vector<std::vector<double>> knots;  ///< per direction
  std::vector<std::vector<double>> points;
  std::vector<double> weights;  ///< all 1 when left out
  bool flip = false;
};
struct PolylineToolSpec {
  std::string file;  ///< absolute when the scene has been read
  std::vector<std::vector<double>> points;
  bool closed = true;
  std::optional<double> smoothing;
};
struct MeshToolSpec {
  std::string file;  ///< absolute when the scene has been read
  double scale = 1.0;
  bool open = false;
  std::optional<double> smoothing;
};

using ToolPartShapeSpec =
    std::variant<PlaneToolSpec, CylinderToolSpec, SphereToolSpec, EdgeToolSpec, ConeToolSpec, TorusToolSpec,
                 BoxToolSpec, NurbsToolSpec, PolylineToolSpec, MeshToolSpec>;

struct ToolPartSpec {
  ToolPartShapeSpec shape;
  bool inside = false;
};
struct UnionToolSpec {
  std::vector<ToolPartSpec> parts;
  double blend = 0.0;
};

using ToolShapeSpec =
    std::variant<PlaneToolSpec, CylinderToolSpec, SphereToolSpec, EdgeToolSpec, ConeToolSpec, TorusToolSpec,
                 BoxToolSpec, NurbsToolSpec, PolylineToolSpec, MeshToolSpec, UnionToolSpec>;

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
  bool inside = false;                           ///< the body is in the hollow of the shape
  std::vector<double> pivot;                     ///< the shape's own middle when left out
  std::vector<double> pivotAxis{0.0, 0.0, 1.0};  ///< 3D only
  /// At most one of the two; ways that are in none of the three are held.
  std::optional<ToolMotionSpec> motion;
  std::optional<ToolPrescribedSpec> prescribe;
  std::optional<ToolCarrySpec> carry;
};

}  // namespace burnish
