#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/formula.h"

/// What a scene must produce, and the changed copies of it in which this is looked for.
namespace burnish {

/// A change of the scene, as `burnish run --set` takes it.
struct FamilySpec {
  std::string name;
  std::vector<std::string> set;
};
struct MeshVariantSpec {
  double size = 1.0;  ///< of a cell, in any unit; decreasing from mesh to mesh
  std::vector<std::string> set;
};

/// What `burnish verify` runs: every family on every mesh, coarse to fine.
struct VariantsSpec {
  std::vector<FamilySpec> families;
  std::vector<MeshVariantSpec> meshes;
};

/// The quantity is `value` within a tolerance.
struct ValueCheckSpec {
  FormulaText value;
  std::optional<double> relative, absolute;  ///< exactly one of the two
};
/// The quantity lies between two bounds, of which one may be missing.
struct RangeCheckSpec {
  std::optional<FormulaText> atLeast, atMost;
};
/// The quantity, an error, falls with this order of the cell size.
struct OrderCheckSpec {
  double order = 1.0;
  double tolerance = 0.2;            ///< the observed order may be lower by so much
  std::optional<FormulaText> limit;  ///< the error is |quantity - limit|; the quantity itself when left out
  double floor = 0.0;                ///< meshes with a smaller error are left out
};
/// The quantity grows or falls from mesh to mesh.
struct MonotoneCheckSpec {
  enum class Direction { Increasing, Decreasing } direction = Direction::Increasing;
};
/// The quantity of all families is the same within a tolerance relative to its largest absolute value.
struct SameCheckSpec {
  double relative = 0.01;
};

/// What a scene must produce.
struct CheckSpec {
  std::string name;
  std::string quantity;  ///< formula in the columns of the history
  enum class Reduction { Last, Max, Min } reduction = Reduction::Last;
  std::optional<double> time;         ///< row of this time instead of the reduction
  std::vector<std::string> families;  ///< all when empty
  enum class Meshes { Finest, Every } meshes = Meshes::Finest;
  std::variant<ValueCheckSpec, RangeCheckSpec, OrderCheckSpec, MonotoneCheckSpec, SameCheckSpec> expect;
  std::string source;  ///< where the value comes from
};

/// A chart of `burnish verify`: a curve for every family and mesh.
struct CurveChartSpec {
  std::string x, y;            ///< formulas in the columns of the history
  std::string xTitle, yTitle;  ///< the formulas when left out
};

}  // namespace burnish
