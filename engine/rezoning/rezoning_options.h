#pragma once
#include <optional>
#include <string>
#include <vector>

namespace burnish::inline rezoning {

/// What a new mesh is like, whatever part of the face is finest.
struct NewMeshOptions {
  double growth = 0.25;     ///< of the size of spans per distance from where they are finest
  double turn = 0.3;        ///< of the face within a knot span, radians, where h_0 allows it; 0: any
  double firstLayer = 1.5;  ///< size of the spans under the face over h_0
  double smallestDeterminant = 1e-3;  ///< of the map, over its largest: what a mesh must have
};

template <class Visitor>
void describe(Visitor& v, NewMeshOptions& s) {
  v.field("growth", s.growth, {.above = 0, .atMost = 2},
          "Growth of the spans' size per distance from there.");
  v.field("turn", s.turn, {.atLeast = 0, .atMost = 3, .unit = "radians"},
          "Largest turn of the face within a knot span; spans are not made smaller for it than under the "
          "tool, and there not smaller than half of that. 0: any turn.");
  v.field("first_layer", s.firstLayer, {.above = 0, .atMost = 10},
          "Depth of the spans under the face, over the length of those under the tool.");
  v.field("smallest_determinant", s.smallestDeterminant, {.above = 0, .below = 1},
          "New meshes whose smallest determinant over the largest is less are not used.");
}

/// Meshing a body anew while a tool, or another body, moves along it.
struct RezoningOptions {
  std::string body;              ///< name; empty in a scene of one body
  std::optional<double> travel;  ///< of a tool or another body, from one to the next
  double stretch = 1.6;          ///< largest principal one since the last, which calls for the next earlier
  double quality = 0.0;          ///< of the deformed mesh, below which the next comes earlier; 0: never
  std::vector<int> spans;        ///< knot spans per direction; as many as before when empty
  std::optional<double> ahead, behind;  ///< of the contact, along the face: where spans are finest
  NewMeshOptions mesh;
};

template <class Visitor>
void describe(Visitor& v, RezoningOptions& s) {
  v.field(
      "body", s.body, {.identifier = true},
      "Name of the body that is meshed anew, while the others keep their meshes; to be left out if there is "
      "only one.");
  v.field(
      "travel", s.travel, {.above = 0, .unit = "length"},
      "A new mesh after so much travel of a tool; 0.16 half thicknesses of the tool when left out, or of "
      "a sixth of the body's size if that is less. What is left out below counts from the same length. "
      "Another body in contact is a tool here, half its smaller extent its half thickness, the mean of its "
      "displacements less that of this body's its travel.");
  v.field("stretch", s.stretch, {.above = 1},
          "A new mesh earlier if the largest principal stretch since the last one exceeds this.");
  v.field("quality", s.quality, {.atLeast = 0, .below = 1},
          "A new mesh earlier if the smallest determinant of the deformed mesh's map over the largest falls "
          "below this; 0: not for this reason.");
  v.field("spans", s.spans, {.atLeast = 1, .atMost = 10'000, .perDimension = true},
          "Knot spans of new meshes per direction; as many as before when left out.");
  v.field("ahead", s.ahead, {.atLeast = 0, .unit = "length"},
          "Knot spans stay finest so far ahead of the contact, along the face; 0.4 half thicknesses of the "
          "tool when left out.");
  v.field("behind", s.behind, {.atLeast = 0, .unit = "length"},
          "The same behind it; a tenth of the tool's half thickness when left out.");
  describe(v, s.mesh);
}

}  // namespace burnish::inline rezoning
