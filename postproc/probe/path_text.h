#pragma once
#include <Eigen/Dense>

#include "postproc/probe/probe.h"
#include "postproc/probe/probe_spec.h"

/// The places of a spec in a body of `dim` dimensions. Both throw `Error` with the key, what was found and what
/// is expected.
namespace burnish {

ProbePath pathOf(const ProbeSpec& spec, int dim);

/// The place of `point`.
Eigen::VectorXd pointOf(const ProbeSpec& spec, int dim, const char* body = "the undeformed body");

}  // namespace burnish
