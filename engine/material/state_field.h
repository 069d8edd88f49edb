#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace burnish::inline material {

/// How a field is called.
struct FieldKind {
  std::string name;                     ///< in files and scenes: "plastic_strain"
  std::vector<std::string> components;  ///< "xx", "yy", …; empty for a scalar
  std::string unit;                     ///< "stress" stands for the scene's unit of stress; empty for none
  std::string words;                    ///< in pictures: "Equivalent plastic strain"
  std::string symbol;                   ///< in pictures; what follows ^ or _ is raised or lowered
  bool isNonNegative = false;           ///< values below zero are errors of a projection and are not drawn
};

/// A field that a law makes of the state of a point.
template <class State>
struct StateField : FieldKind {
  /// Writes the values at a point: one for a scalar, else one per component.
  void (*write)(const State& state, std::span<double> values);
};

/// A number that goes along to a new mesh, where it is interpolated between the points of the old one.
struct CarriedKind {
  std::string name;  ///< in restart files
  double atLeast = -std::numeric_limits<double>::infinity();
};

/// A number of a law's state that goes along to a new mesh.
template <class State>
struct CarriedNumber : CarriedKind {
  double& (*of)(State&);
};

}  // namespace burnish::inline material
