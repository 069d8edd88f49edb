#pragma once
#include <array>
#include <span>
#include <utility>
#include <variant>

#include "engine/schema/alternatives.h"
#include "engine/tools/box.h"
#include "engine/tools/cad_tool.h"
#include "engine/tools/cone.h"
#include "engine/tools/cylinder.h"
#include "engine/tools/die.h"
#include "engine/tools/edge.h"
#include "engine/tools/mesh_tool.h"
#include "engine/tools/nurbs_shape.h"
#include "engine/tools/plane.h"
#include "engine/tools/polyline.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/sphere.h"
#include "engine/tools/torus.h"

namespace burnish::inline tools {

class ShapeProblems;

/// The shapes of tools, in the order in which they are documented. Each has a `kind` and a `describe`, and a
/// `check` if its keys may contradict one another; it is a `ToolSurface`, or `made()` gives one.
using SimpleShape = std::variant<Plane,         //
                                 Cylinder,      //
                                 Sphere,        //
                                 Edge,          //
                                 Cone,          //
                                 Torus,         //
                                 BoxTool,       //
                                 NurbsTool,     //
                                 PolylineTool,  //
                                 MeshTool,      //
                                 CadTool>;

template <class... Shape>
std::array<ShapeKind, sizeof...(Shape)> kindsOf(const std::variant<Shape...>& /*shape*/) {
  return {Shape::kind...};
}

/// The rigid surface of a shape that a scene gives, or the die around it. Throws `Error` if a file cannot be
/// read or does not hold a surface.
template <class... Shape>
RigidShape makeShape(const std::variant<Shape...>& given, bool inside) {
  RigidShape shape = std::visit(
      []<class S>(const S& one) -> RigidShape {
        if constexpr (requires { one.made(); })
          return one.made();
        else
          return one;
      },
      given);
  return inside ? RigidShape(Die{std::move(shape)}) : shape;
}

/// The shape is for such a body; `found`: its number among the kinds.
void requireBody(const ShapeProblems& problems, std::span<const ShapeKind> kinds, std::size_t found);

/// Reports what is wrong with a shape, unless it is not known which one it is.
template <class... Shape>
void checkShape(const std::variant<Shape...>& shape, const ShapeProblems& problems) {
  requireBody(problems, kindsOf(shape), shape.index());
  std::visit(
      [&](const auto& one) {
        if constexpr (requires { check(one, problems); }) check(one, problems);
      },
      shape);
}

}  // namespace burnish::inline tools
