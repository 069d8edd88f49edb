#include "engine/analysis/time_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/scene/path_mesh.h"
#include "engine/scene/path_of_tool.h"

namespace burnish::inline analysis {
namespace {

/// Ends of passes, and the times at which the tool has been lifted after them: what is left shows then.
std::vector<double> pathTimes(const ToolSpec& tool) {
  const ToolPath path = pathOf(tool);
  std::vector<double> times = path.passEnds();
  if (tool.path->clearance.isZero(0.0)) return times;
  std::vector<double> corners = path.corners();
  std::ranges::sort(corners);
  for (const ToolPath::Pass& touch : path.touches())
    if (const auto lifted = std::ranges::upper_bound(corners, touch.end); lifted != corners.end())
      times.push_back(*lifted);
  return times;
}

std::vector<double> outputTimes(const Scene& scene, double end) {
  std::vector<double> times = scene.output.times;
  times.insert(times.end(), scene.wanted.frames.begin(), scene.wanted.frames.end());
  if (scene.output.every)
    for (long k = 1; static_cast<double>(k) * *scene.output.every < end * (1.0 + 1e-12); ++k)
      times.push_back(static_cast<double>(k) * *scene.output.every);
  for (const ToolSpec& tool : scene.tools) {
    if (tool.until) times.push_back(*tool.until);
    if (!tool.path) continue;
    const std::vector<double> ofPath = pathTimes(tool);
    times.insert(times.end(), ofPath.begin(), ofPath.end());
  }
  return times;
}

}  // namespace

std::vector<TimePoint> timeGrid(const Scene& scene, const std::vector<double>& corners) {
  std::vector<TimePoint> grid;
  double begin = 0.0;
  for (const auto& phase : scene.steps) {
    const double step = (phase.until - begin) / phase.count;
    for (int k = 1; k <= phase.count; ++k)
      grid.push_back({k == phase.count ? phase.until : begin + k * step, step, false, false});
    begin = phase.until;
  }

  const auto insert = [&](double time, auto&& mark) {
    const double end = grid.back().time;
    const auto at = std::lower_bound(grid.begin(), grid.end(), time, [](const TimePoint& point, double t) {
      return point.time < t - 1e-9 * point.nominalStep;
    });
    if (time <= 0.0 || at == grid.end()) return;
    if (std::abs(at->time - time) <= 1e-9 * at->nominalStep) {
      if (time < end) at->time = time;
      mark(*at);
    } else {
      mark(*grid.insert(at, {time, at->nominalStep, false, false}));
    }
  };
  for (const double time : outputTimes(scene, grid.back().time))
    insert(time, [](TimePoint& p) { p.frame = true; });
  for (const double time : corners) insert(time, [](TimePoint& p) { p.corner = true; });
  for (std::size_t k = 0; k < scene.allBodies().size(); ++k)
    if (hasFollowingMeshes(scene, k))
      for (const FollowingMesh& mesh : followingMeshes(scene, k)) insert(mesh.from, [](TimePoint&) {});
  grid.back().frame = true;
  return grid;
}

std::vector<double> frameTimes(const Scene& scene) {
  std::vector<double> times{0.0};
  for (const TimePoint& point : timeGrid(scene, {}))
    if (point.frame) times.push_back(point.time);
  return times;
}

}  // namespace burnish::inline analysis
