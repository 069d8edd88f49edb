#pragma once
#include "engine/scene/schema_run.h"
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/study/evidence/schema_measure.h"
#include "postproc/study/study.h"

namespace burnish {

template <>
struct EnumNames<SurfaceQuantity> {
  static constexpr std::array values{std::pair{"pressure", SurfaceQuantity::Pressure},
                                     std::pair{"gap", SurfaceQuantity::Gap}};
};

template <>
struct EnumNames<SheetScale> {
  static constexpr std::array values{std::pair{"panel", SheetScale::Panel}, std::pair{"row", SheetScale::Row},
                                     std::pair{"sheet", SheetScale::Sheet}};
};

template <class Visitor>
void describe(Visitor& v, CurveLooks& s) {
  v.field("color", s.color, {}, "Parameter that chooses the colour.");
  v.field("dash", s.dash, {}, "Parameter that chooses the dashes.");
  v.field("marker", s.marker, {}, "Parameter that chooses the marker.");
}

template <class Visitor>
void describeRuns(Visitor& v, std::vector<std::string>& runs) {
  v.field("runs", runs, {.required = true, .minEntries = 1}, "Names of runs, * for any part of a name.");
}

template <class Visitor>
void describeLooks(Visitor& v, CurveLooks& looks) {
  v.field("looks", looks, {}, "Which parameters tell the curves apart.");
}

template <class Visitor>
void describeTimes(Visitor& v, std::vector<double>& times, std::vector<std::string>& labels) {
  v.field("times", times,
          {.required = true, .atLeast = 0, .increasing = true, .minEntries = 1, .unit = "time"},
          "Times of frames.");
  v.field("time_labels", labels, {.longest = kLongestShownText},
          "What is written instead of t = ..., one for each time.");
}

template <class Visitor>
void describeField(Visitor& v, PictureOptions& picture) {
  v.field("field", picture.field, {.required = true, .choices = drawableFields()}, "What is drawn.");
}

template <class Visitor>
void describe(Visitor& v, HistoryChartSpec& s) {
  describeRuns(v, s.runs);
  describeCurve(v, s.x, s.y, s.where);
  v.field("x_title", s.xTitle, {.longest = kLongestShownText},
          "Title of the x axis; the formula when left out.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText},
          "Title of the y axis; the formula when left out.");
  describeLooks(v, s.looks);
  v.field("reference", s.reference, {},
          "File, relative to the study file: a PNG picture is shown beside the chart, points of a CSV file "
          "(x and y) in it.");
}

template <class Visitor>
void describe(Visitor& v, SurfaceChartSpec& s) {
  describeRuns(v, s.runs);
  describeTimes(v, s.times, s.timeLabels);
  v.field("quantity", s.quantity, {}, "What is drawn over the x position.");
  v.field("window", s.window, {.increasing = true, .unit = "length"},
          "Smallest and largest x; around the contact when left out.");
  describeLooks(v, s.looks);
}

template <class Visitor>
void describe(Visitor& v, RefinementChartSpec& s) {
  describeRuns(v, s.runs);
  v.field("refine", s.refine, {.required = true}, "Parameter that is the mesh, coarse to fine.");
  v.field("measure", s.measure, {.required = true}, "The number whose error is drawn.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText},
          "Title of the y axis; that of the measure when left out.");
  describeLooks(v, s.looks);
}

template <class Visitor>
void describe(Visitor& v, ContourSheetSpec& s) {
  describeRuns(v, s.runs);
  describeTimes(v, s.times, s.timeLabels);
  describeField(v, s.panel);
  describe(v, s.panel);
  describeSize(v, s.panel, "panel_size");
  describeTextSize(v, s.panel);
  v.field("scale", s.scale, {}, "What shares a colour scale.");
  v.field("panel_caption", s.panelCaption, {.longest = kLongestShownText},
          "Below a panel; in braces letter, label and time, and the parameters of the run.");
}

template <class Visitor>
void describe(Visitor& v, SetupSpec& s) {
  v.field("run", s.run, {.required = true}, "Name of the run.");
}

template <class Visitor>
void describe(Visitor& v, CompositeSpec& s) {
  v.field("figures", s.figures, {.required = true, .minEntries = 1},
          "Names of figures that are not composites themselves.");
  v.field("captions", s.captions, {.longest = kLongestShownText}, "Below each of them; one for each figure.");
  v.field("columns", s.columns, {.atLeast = 1, .atMost = 10}, "Pictures side by side.");
}

template <class Visitor>
void describe(Visitor& v, AnimationSpec& s) {
  describeRuns(v, s.runs);
  describeField(v, s.picture);
  describeRange(v, s.picture);
  describe(v, s.picture);
  v.field("frames_per_second", s.framesPerSecond, {.above = 0, .atMost = 100}, "Speed of the video.");
}

template <class Visitor>
void describe(Visitor& v, FigureSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Name of the file, and for --only.");
  v.field("caption", s.caption, {}, "Below the figure in the document.");
  v.alternatives(
      "kind", s.what,
      {{{"history", "Curves y(x) from the histories, one for each run."},
        {"surface", "A contact quantity along the contact face, a picture for each time."},
        {"refinement", "Error of a measure against the number of basis functions, log-log."},
        {"sheet", "Contour pictures in a grid, a row for each time and a column for each run."},
        {"setup", "Geometry and boundary conditions of a run."},
        {"composite", "Other figures side by side in one picture."},
        {"animation", "Every frame of each run as a picture, and as a video where ffmpeg is installed."}}},
      "What the figure shows.");
}

}  // namespace burnish
