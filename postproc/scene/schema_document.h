#pragma once
#include "engine/scene/schema.h"
#include "postproc/scene/scene_document.h"
#include "postproc/scene/schema_checks.h"

namespace burnish {

template <class Visitor>
void describe(Visitor& v, ScenePicture& s) {
  describeField(v, s);
  v.field("name", s.name, {.identifier = true},
          "Beginning of the file name; the field's name when left out.");
  v.field(
      "times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
      "One picture for each; the end of the run when left out. Once the run ends, several share one window and one "
      "range of colours.");
  v.field(
      "format", s.format, {},
      "png, or for print pdf or svg: size and text_size are in points then, the size 482, 271 when left out.");
  describe(v, static_cast<PrintOptions&>(s));
  if constexpr (Fills<Visitor>)
    if (s.isForPrint()) s.size = kPrintSize;
  describeRange(v, s);
  describe(v, static_cast<PictureOptions&>(s));
}

template <class Visitor>
void describe(Visitor& v, SceneProbe& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Beginning of the file names.");
  describe(v, static_cast<ProbeSpec&>(s));
  v.field("times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
          "A curve for each; the end of the run when left out. Not of values over time.");
}

/// Every key of a scene's file: those of the engine, and those that it leaves to others
/// (`keysOfDocuments`).
template <class Visitor>
void describe(Visitor& v, SceneDocument& s) {
  describeSimulation(v, s.scene);
  v.field("pictures", s.pictures, {}, "Contour pictures, drawn as the run passes their times.");
  v.field(
      "probes", s.probes, {},
      "Charts and tables of exact values along paths in the bodies, or over time, drawn at the end of the run.");
  describeMeasures(v, s.scene);
  v.field("variants", s.variants, {}, "Changed copies of the scene that `burnish verify` runs.");
  v.field("checks", s.checks, {}, "What the scene must produce, for `burnish verify`.");
  v.field("charts", s.charts, {}, "Charts that `burnish verify` draws: a curve for every family and mesh.");
}

}  // namespace burnish
