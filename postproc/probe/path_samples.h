#pragma once
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "postproc/probe/probe_point.h"

namespace burnish {

/// What is on a path at a distance from its begin.
using PathProbe = std::function<ProbePoint(double distance)>;

/// Points at `count` (2 or more) equal distances from `begin` to `end`, and between two of them that lie in
/// different bodies, or one outside, the last and the first one of each body. Between bodies that touch there
/// is a point that belongs to none, so that curves are interrupted.
std::vector<ProbePoint> samplesAlong(const PathProbe& probe, double begin, double end, int count);

/// Throws `Error` if all of them are outside of bodies. path: what it is called; where: its points would have to be.
void requireAnyInside(const std::vector<ProbePoint>& samples, const char* path, const std::string& where);

/// The samples with the mean values of a window along the path instead of their own: of that part of `width`
/// around each that lies between `begin` and `end` and in bodies with the field.
std::vector<ProbePoint> windowAverages(const PathProbe& probe, std::vector<ProbePoint> samples, double width,
                                       double begin, double end);

/// The samples of a depth with what X-rays tell of what lies deeper instead of their own values: means with the
/// weight e^{-(z - z_sample)/penetration}, over the parts up to `end` that lie in bodies with the field; the value at
/// the sample where there is nothing below it.
std::vector<ProbePoint> penetrationAverages(const PathProbe& probe, std::vector<ProbePoint> samples,
                                            double penetration, double end);

/// Means of the fields over the parts of a path that lie in bodies with them; `kNone` without any. samples: of
/// all of the path.
Eigen::VectorXd meanAlong(const PathProbe& probe, std::vector<ProbePoint> samples);

}  // namespace burnish
