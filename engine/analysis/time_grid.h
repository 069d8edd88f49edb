#pragma once
#include <vector>

#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// A time at which a step ends.
struct TimePoint {
  double time = 0.0;
  double nominalStep = 0.0;  ///< largest step on the way there
  bool frame = false;        ///< a frame is written
  bool corner = false;       ///< a schedule bends here
};

/// Time points of a scene in order: ends of nominal steps, output times, times of wanted frames, ends of the
/// passes of tools (with a frame, so that a run can be resumed there) and corners of schedules. Times closer than a billionth of a step are one; corners and output times then keep their
/// exact values. The last one has a frame.
std::vector<TimePoint> timeGrid(const Scene& scene, const std::vector<double>& corners);

/// Times of the frames of a run that comes to its end, that at the start first.
std::vector<double> frameTimes(const Scene& scene);

}  // namespace burnish::inline analysis
