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
};

/// The values along the path in a frame of a result. Throws `Error` for what the spec asks for and the frame
/// does not have.
ProbedRun probedFrame(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// The values at the point, or the means of the path, in these frames (one or more). Throws `Error` as above,
/// and if there is no value in any of them.
ProbedRun probedHistory(const ResultReader& result, const std::vector<int>& frames, const ProbeSpec& spec);

/// Titles of the axes of a chart.
struct ProbeTitles {
  std::string x, y;
};

/// Throws `Error` if lengths or fields of the runs have several units.
ProbeTitles titlesOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs);

/// The curve of a field, by its number, named by the run, the field or both, where there are several.
ChartCurve curveOf(const ProbedRun& run, std::size_t field);

/// The runs side by side as CSV: distance or time, the positions of the material now and at the start, and the
/// fields; of means no positions.
std::string tableOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs);

}  // namespace burnish
