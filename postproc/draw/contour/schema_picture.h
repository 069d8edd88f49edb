#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/material/material.h"
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/picture_spec.h"

namespace burnish {

/// Fields and components that contour pictures show.
inline std::vector<std::string> drawableFields() {
  std::vector<std::string> names{"displacement", "displacement.x", "displacement.y", "displacement.z"};
  for (std::string& name : materialComponentNames()) names.push_back(std::move(name));
  for (const char* name : {"von_mises", "stress.xx", "stress.yy", "stress.zz", "stress.xy", "stress.yz",
                           "stress.zx", "pressure"})
    names.emplace_back(name);
  return names;
}

template <class Visitor>
void describe(Visitor& v, PictureSpec& s) {
  v.field("field", s.field, {.required = true, .choices = drawableFields()},
          "What is drawn; displacement alone is its magnitude.");
  v.field("name", s.name, {.identifier = true},
          "Beginning of the file name; the field's name when left out.");
  v.field("times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
          "One picture for each; the end of the run when left out.");
  v.field("range", s.range, {.increasing = true},
          "Smallest and greatest value of the colours; automatic when left out.");
  v.field("size", s.size, {.atLeast = 200, .atMost = 8000}, "Width and height in pixels.");
  v.field("bands", s.bands, {.atLeast = 0, .atMost = 256}, "Number of colour bands; 0 for smooth colours.");
  v.field("knots", s.knots, {}, "Draw the knot lines.");
  v.field("undeformed", s.undeformed, {}, "Draw the outline of the undeformed body.");
  v.field("cut", s.cut, {},
          "Plane, x=V, y=V or z=V, or X,Y,Z,NX,NY,NZ: a point and a normal; what is on the eye's side of it "
          "is left out (3D).");
  v.field("slice", s.slice, {}, "Plane, given like that of cut; only the section is drawn (3D).");
  v.field("mirror", s.mirror, {},
          "Planes of symmetry, x, or x,z=V where one is not at 0; the images of the body beyond them are "
          "drawn too. Of an axisymmetric body, x is the axis.");
  v.field("tool_opacity", s.toolOpacity, {.above = 0, .atMost = 1},
          "Of the tools in space; 1 hides what is behind.");
  v.field("doubt_marks", s.doubtMarks, {}, "Mark the picture if the run doubts its results.");
}

}  // namespace burnish
