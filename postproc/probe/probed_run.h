#pragma once
#include <string>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/probe/probe_point.h"
#include "postproc/probe/probe_spec.h"

namespace burnish {

/// What a run has on a path in a frame, or over time, ready for charts and tables.
struct ProbedRun {
  std::string name;  ///< among others; empty for the only one
  int dim = 2;
  std::string lengthUnit;
  std::vector<FieldChoice> fields;
  std::vector<ProbePoint> points;
  bool isForeign =
      false;  ///< of another program: units and the places of the material at the start are unknown
};

/// The run with the formula of the spec instead of the fields, which stands for means where the spec asks for these; as
/// it is without a formula. Throws `Error` for a value that is not finite.
ProbedRun withFormula(ProbedRun run, const ProbeSpec& spec);

/// Throws `Error` that begins with a key of the spec for a place that no frame of this model can have: of another
/// dimension, on a face or patch that it does not have, or a point outside. frame: any of them.
void requirePlace(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// The values along the path in a frame of a result. Throws `Error` for what the spec asks for and the frame
/// does not have.
ProbedRun probedFrame(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// The values at the point, or the means of the path, in these frames (one or more). Throws `Error` as above,
/// and if there is no value in any of them.
ProbedRun probedHistory(const ResultReader& result, const std::vector<int>& frames, const ProbeSpec& spec);

/// The frames of these times, the last one if there is none. Throws `Error` for a result without frames, and for a time
/// without a frame.
std::vector<int> framesAt(const ResultReader& result, const std::vector<double>& times);

/// The same of a whole result: over time in all of its frames, or else in those of these times, the last one if there
/// is none, each named by its time if there are several. Throws `Error` as `framesAt`, too.
std::vector<ProbedRun> probedRuns(const ResultReader& result, const ProbeSpec& spec,
                                  const std::vector<double>& times);

/// Titles of the axes of a chart.
struct ProbeTitles {
  std::string x, y;
};

/// Throws `Error` if lengths or fields of the runs have several units.
ProbeTitles titlesOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs);

/// A curve for each field and run, first those of the first field, named by the run, the field or both, where
/// there are several.
std::vector<ChartCurve> curvesOf(const std::vector<ProbedRun>& runs);

/// They as a chart. Throws `Error` as `titlesOf` does.
Chart chartOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs);

/// The runs side by side as CSV: distance or time, the positions of the material now and at the start, and the
/// fields; of means no positions.
std::string tableOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs);

}  // namespace burnish
