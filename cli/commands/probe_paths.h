#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>

#include "postproc/probe/probe.h"

/// The places of `burnish probe` as options spell them, for bodies of `dim` dimensions. All throw `Error` with
/// the option, what was found and what is expected.
namespace burnish {

/// `X0,Y0:X1,Y1`
LinePath lineFromText(const std::string& text, int dim);

/// `X,Y`
Eigen::VectorXd pointFromText(const std::string& text, int dim);

/// `FACE@S` in the plane, or `FACE@X,Y`.
DepthPath depthFromText(const std::string& text, int dim);

}  // namespace burnish
