#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

namespace burnish::inline scene {

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
          "Cells per knot span and direction in VTU files.");
  v.field("vtu", s.vtu, {}, "Write VTU files, one per frame, and a PVD collection.");
  v.field(
      "pieces", s.pieces, {.atLeast = 1, .atMost = 100'000},
      "About so many VTU files for each body and frame, and a PVTU file that names them: large bodies take less "
      "memory so, and ParaView reads them with several processes.");
  v.field("reactions", s.reactions, {},
          "Add the force of the body on every support, and its moment about the origin, to the history: "
          "columns SUPPORT.fx, ... The summary has those of the end in any case.");
}

}  // namespace burnish::inline scene
