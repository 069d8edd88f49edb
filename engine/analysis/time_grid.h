#pragma once
#include <vector>

#include "engine/scene/scene.h"

namespace burnish {

/// A time on which the steps land.
struct Landing {
  double time = 0.0;
  double nominalStep = 0.0;  ///< largest step on the way there
  bool frame = false;        ///< a frame is written
  bool corner = false;       ///< a schedule bends here
};

/// Landings of a scene in order: nominal steps, output times, those of wanted frames and corners of schedules. Times
/// closer than a billionth of a step are one; corners and output times then keep their exact values. The last
/// one has a frame.
std::vector<Landing> timeGrid(const Scene& scene, const std::vector<double>& corners);

}  // namespace burnish
