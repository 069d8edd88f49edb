#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

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
void describe(Visitor& v, PhaseSpec& s) {
  v.field("until", s.until, {.required = true, .above = 0, .unit = "time"},
          "Time at which the phase ends; it begins where the one before ended, the first one at 0.");
  v.field("count", s.count, {.required = true, .atLeast = 1, .atMost = 1'000'000},
          "Number of equal nominal steps of the phase; difficult ones are cut.");
}

template <class Visitor>
void describe(Visitor& v, OutputSpec& s) {
  v.field("times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
          "Times at which a frame is written, beside the start and the end.");
  v.field("every", s.every, {.above = 0, .unit = "time"}, "A frame every so much time.");
  v.field("subdivision", s.subdivision, {.atLeast = 1, .atMost = 64},
          "Cells per knot span and direction in VTU files and pictures.");
  v.field("vtu", s.vtu, {}, "Write VTU files, one per frame, and a PVD collection.");
  v.field("reactions", s.reactions, {},
          "Add the force of the body on every support, and its moment about the origin, to the history: "
          "columns SUPPORT.fx, ... The summary has those of the end in any case.");
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
