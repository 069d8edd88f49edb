#pragma once
#include <vector>

#include "postproc/foreign/foreign_file.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/probed_run.h"

/// Values of files of other programs, as far as their cells tell: between points as the cells interpolate.
namespace burnish {

/// The values along the line in an instant. Throws `Error` naming the file for what cannot be read, and for what the
/// spec asks for and the file does not have: faces with names, an undeformed body.
ProbedRun probedInstant(const ForeignFile& file, int instant, const ProbeSpec& spec);

/// The values at the point, or the means of the line, in these instants (one or more). The point is a place in the first
/// of them; as long as the file has the same cells it stays at its place in its cell. Throws `Error` as above, and if
/// the point is in no cell.
ProbedRun probedHistory(const ForeignFile& file, const std::vector<int>& instants, const ProbeSpec& spec);

}  // namespace burnish
