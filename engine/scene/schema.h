#pragma once
#include "engine/scene/scene.h"
#include "engine/scene/schema_boundary.h"
#include "engine/scene/schema_geometry.h"
#include "engine/scene/schema_measures.h"
#include "engine/scene/schema_run.h"

namespace burnish::inline schema {
class MappingReader;
class MappingWriter;
class DeclarationCollector;
}  // namespace burnish::inline schema

/// The one declaration of every option of a scene. Each struct of scene.h has a `describe(visitor, struct)`
/// that hands its fields to a visitor, in the order in which they are written:
///
///     visitor.field(key, value, rule, sentence)                         a leaf, a struct, a list or an optional of these
///     visitor.alternatives(key, variant, alternatives, sentence)        the key chooses the alternative, whose fields
///                                                                       follow in the same mapping
///
/// The default is what the field of a fresh struct holds. Reading, writing and listing a scene are visitors.
namespace burnish::inline scene {

constexpr auto enumNames(std::type_identity<BasisChoice>) {
  return std::array{std::pair{"nurbs", BasisChoice::Nurbs}, std::pair{"lagrange", BasisChoice::Lagrange}};
}

constexpr auto enumNames(std::type_identity<KinematicsChoice>) {
  return std::array{std::pair{"plane-strain", KinematicsChoice::PlaneStrain},
                    std::pair{"axisymmetric", KinematicsChoice::Axisymmetric}};
}

template <class Visitor>
void describe(Visitor& v, DefinitionSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Name, unlike X, Y, Z and t.");
  v.field("formula", s.formula, {.required = true}, "What it stands for.");
}

template <class Visitor>
void describe(Visitor& v, UnitsSpec& s) {
  v.field(
      "length", s.length, {.longest = kLongestShownText},
      "Label of the unit of length in pictures and files; nothing is converted into it but lengths of CAD files and "
      "of measured profiles.");
  v.field("stress", s.stress, {.longest = kLongestShownText}, "Label of the unit of stress.");
}

/// A key of a body that may have its value from elsewhere: a list of keys names no default then.
template <class Visitor, class T>
void describeInherited(Visitor& v, const char* key, T& value, const Rule& rule, const char* sentence,
                       bool inherits) {
  if constexpr (requires { Visitor::declares; }) {
    std::optional<T> none;
    if (inherits) return v.field(key, none, rule, sentence);
  }
  v.field(key, value, rule, sentence);
}

/// inherits: from what the scene says of all bodies.
template <class Visitor>
void describeBasis(Visitor& v, BodySpec& s, bool inherits = false) {
  describeInherited(v, "basis", s.basis, {},
                    "Basis functions of the body: NURBS, or Lagrange elements that are continuous only.",
                    inherits);
  describeInherited(
      v, "degree", s.degree, {.atLeast = 1, .atMost = 10},
      "Polynomial degree in every direction. Control nets of a lower degree are raised to it; a body of "
      "nets alone keeps theirs when the key is left out.",
      inherits);
}

template <class Visitor>
void describeIntegration(Visitor& v, BodySpec& s, bool inherits = false) {
  describeInherited(
      v, "formulation", s.formulation, {},
      "displacement alone, or fbar: with a projected change of volume, which does not lock when the "
      "material is nearly incompressible.",
      inherits);
  v.field(
      "quadrature_points", s.quadraturePoints, {.atLeast = 1, .atMost = 32},
      "Gauss points of the body per knot span and direction; the degree plus one when left out. As many as the "
      "degree do for NURBS with simple knots and two spans or more in every direction.");
}

template <class Visitor>
void describe(Visitor& v, InitialStressSpec& s) {
  v.field("xx", s.xx, {.unit = "stress"}, "Along x; the radial one in axisymmetry.");
  v.field("yy", s.yy, {.unit = "stress"}, "Along y.");
  v.field("zz", s.zz, {.unit = "stress"},
          "Along z; out of the plane, or around the axis, in two dimensions.");
  v.field("xy", s.xy, {.unit = "stress"}, "Shear in x and y.");
  v.field("yz", s.yz, {.unit = "stress"}, "Shear in y and z (3D).");
  v.field("zx", s.zx, {.unit = "stress"}, "Shear in z and x (3D).");
}

template <class Visitor>
void describe(Visitor& v, InitialSpec& s) {
  v.field(
      "stress", s.stress, {},
      "Cauchy stress, formulas in X, Y and Z; components left out are zero. It comes into equilibrium before "
      "the first step, and the summary says how far it had to change.");
  v.field("plastic_strain", s.plasticStrain, {},
          "Equivalent plastic strain, a formula in X, Y and Z; 0 when left out.");
}

/// unless: key that may stand in place of these two.
template <class Visitor>
void describeMatter(Visitor& v, BodySpec& s, const std::string& unless = {}) {
  v.field("geometry", s.geometry, {.required = true, .unless = unless},
          "Shape and mesh of the body; its dimension is the scene's.");
  v.field("material", s.material, {.required = true, .unless = unless}, "Material of the body.");
  v.field("initial", s.initial, {}, "Stress and plastic strain that the body has before the run begins.");
}

template <class Visitor>
void describe(Visitor& v, BodySpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name for supports, loads, contact, measures and results; unlike those of other bodies, tools and "
          "measures.");
  describeBasis(v, s, true);
  describeIntegration(v, s, true);
  describeMatter(v, s);
}

/// The keys of a scene up to its output.
template <class Visitor>
void describeSimulation(Visitor& v, Scene& s) {
  v.field("title", s.title, {.longest = kLongestShownText},
          "What the scene is about, shown in pictures and summaries.");
  v.field("units", s.units, {}, "Labels of the consistent units that the numbers of the scene are in.");
  describeBasis(v, s.body);
  v.field("kinematics", s.kinematics, {},
          "Of a body of two dimensions; axisymmetric: x is the radius, y the axis, forces are those of the "
          "whole ring.");
  describeIntegration(v, s.body);
  v.field("definitions", s.definitions, {},
          "Names for formulas in X, Y, Z and t, to be used in the formulas of the scene; each may use those "
          "before it.");
  if (s.bodies.empty()) describeMatter(v, s.body, "bodies");
  v.field("bodies", s.bodies, {.minEntries = 1},
          "Several bodies instead of geometry and material. What one of them does not say of basis, degree, "
          "formulation and quadrature_points is that of the scene.");
  v.field("supports", s.supports, {}, "Where the body is held or moved, face by face.");
  v.field("loads", s.loads, {}, "Tractions and pressures on faces of the body, and body forces.");
  v.field("tools", s.tools, {}, "Rigid tools with their motion.");
  v.field("contact", s.contact, {},
          "Which face may touch which tool, or which other faces, with or without friction.");
  v.field(
      "self_contact", s.selfContact, {},
      "Faces of a body that may touch themselves or, several together, one another: folds, and chips that "
      "come down on the body they were cut from.");
  v.field("steps", s.steps, {.required = true, .minEntries = 1}, "Phases of the run, from time 0 on.");
  v.field("solver", s.solver, {}, "Newton's method and the control of the step size.");
  v.field("stabilise", s.stabilise, {},
          "Holds a body that nothing but contact holds by a drag that fades while contact sets in: "
          "`stabilise: {}`. What it carries is reported.");
  v.field(
      "rezoning", s.rezoning, {},
      "Meshes a body anew while a tool, or another body, moves along it, so that its surface stays "
      "resolved under the tool; a plane or axisymmetric body of one patch, or a box with a resolution: its "
      "fine spans then follow the tool, by the travel or, when that is left out, by four half widths.");
  v.field("output", s.output, {}, "When and how finely results are written.");
}

template <class Visitor>
void describeMeasures(Visitor& v, Scene& s) {
  v.field("measures", s.measures, {}, "Columns of the history beside those that every run has.");
}

/// What the engine reads of a scene's file. A document around it names keys of its own in between.
template <class Visitor>
void describe(Visitor& v, Scene& s) {
  describeSimulation(v, s);
  describeMeasures(v, s);
}

// Compiled once, in reader.cpp.
extern template void describeSimulation(MappingReader&, Scene&);
extern template void describeSimulation(MappingWriter&, Scene&);
extern template void describeSimulation(DeclarationCollector&, Scene&);

}  // namespace burnish::inline scene
