#pragma once
#include "postproc/study/schema_measure.h"
#include "postproc/study/study.h"

/// The one declaration of every option of a study, in the manner of engine/scene/schema.h.
namespace burnish {

constexpr auto enumNames(std::type_identity<ClaimSpec::Expect>) {
  return std::array{
      std::pair{"increasing", ClaimSpec::Expect::Increasing}, std::pair{"equal", ClaimSpec::Expect::Equal},
      std::pair{"different", ClaimSpec::Expect::Different}, std::pair{"between", ClaimSpec::Expect::Between}};
}

template <class Visitor>
void describe(Visitor& v, ParameterSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name of the parameter, for braces: {degree} is its value, {degree.label} its label.");
  v.field("values", s.values, {.required = true, .minEntries = 1},
          "Values that it takes, one after the other.");
  v.field("labels", s.labels, {.longest = kLongestShownText},
          "Shown instead of the values in legends and tables; one for each value.");
}

template <class Visitor>
void describe(Visitor& v, RunsSpec& s) {
  v.field(
      "name", s.name, {.required = true},
      "Name of the runs, with every parameter in braces; of letters, digits, - and _ and . when filled in.");
  v.field("scene", s.scene, {.required = true},
          "Scene file, relative to the study file; braces are filled in.");
  v.field("vary", s.vary, {},
          "Parameters: there is a run for every combination of their values, the last parameter changing "
          "fastest.");
  v.field("set", s.set, {},
          "Changes of the scene as path=value, such as degree={degree}; braces are filled in.");
  v.field("label", s.label, {.longest = kLongestShownText},
          "What legends and tables call a run, braces filled in; its name when left out.");
}

template <class Visitor>
void describe(Visitor& v, ClaimSpec& s) {
  v.field("text", s.text, {.required = true}, "What is claimed, in words; braces are filled in.");
  v.field("measure", s.measure, {.required = true}, "Name of a measure of this statement.");
  v.field("vary", s.vary, {}, "Parameters: there is a claim for every combination of their values.");
  v.field("runs", s.runs, {.required = true, .minEntries = 1},
          "Names of the runs whose numbers are compared, braces filled in.");
  v.field("expect", s.expect, {},
          "What the numbers should be like: growing in the order of the runs, equal, different, or between "
          "two values.");
  v.field("within", s.within, {.above = 0, .atMost = 1},
          "How far numbers may be apart to count as equal, as a part of the largest; required with equal and "
          "different.");
  v.field("range", s.range, {.increasing = true}, "Smallest and largest value; required with between.");
}

template <class Visitor>
void describe(Visitor& v, StatementSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Name of the section, for links.");
  v.field("title", s.title, {.required = true, .longest = kLongestShownText}, "Heading of the section.");
  v.field("text", s.text, {}, "What stands below the heading, as Markdown.");
  v.field("runs", s.runs, {}, "Names of runs, * for any part of a name; each is a row of the table.");
  v.field("measures", s.measures, {}, "Numbers that are read off the runs; each is a column of the table.");
  v.field("claims", s.claims, {}, "What the numbers should be like; the document says whether they are.");
  v.field("figures", s.figures, {}, "Names of figures that are shown below the table.");
}

template <class Visitor>
void describe(Visitor& v, StudySpec& s) {
  v.field("title", s.title, {.longest = kLongestShownText}, "Heading of the document.");
  v.field("text", s.text, {}, "What stands below it, as Markdown.");
  v.field("runs", s.runs, {.required = true, .minEntries = 1}, "What is computed.");
  v.field("figures", s.figures, {}, "What is drawn.");
  v.field("statements", s.statements, {}, "Sections of the document: tables, claims and figures.");
}

}  // namespace burnish
