#include "postproc/draw/setup/setup_motion.h"

#include <algorithm>

#include "engine/scene/path_of_tool.h"

namespace burnish {
namespace {

Eigen::Vector2d displacement(const MotionSpec& motion, double t) {
  const auto value = [&](const std::optional<std::vector<double>>& component) {
    return component ? Schedule{motion.times, *component}(t) : 0.0;
  };
  return {value(motion.x), value(motion.y)};
}

bool sameDirection(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.normalized().dot(b.normalized()) > 1.0 - 1e-9;
}

template <class Formulas>
Eigen::Vector2d displacement(const Formulas& formulas, const Eigen::Vector2d& X,
                             const std::vector<DefinitionSpec>& definitions, double t) {
  const auto value = [&](const std::optional<FormulaText>& text) {
    return text ? Formula(*text, definitions)({X.x(), X.y(), 0.0}, t) : 0.0;
  };
  return {value(formulas.x), value(formulas.y)};
}

/// A path in the plane as a table.
MotionSpec tableOf(const ToolPath& path) {
  MotionSpec table{path.corners(), std::vector<double>(), std::vector<double>(), {}};
  for (const double t : table.times) {
    table.x->push_back(path.displacement(t).x());
    table.y->push_back(path.displacement(t).y());
  }
  return table;
}

/// From begin to end in one; nothing for a point that does not move.
template <class Formulas>
std::vector<Eigen::Vector2d> wholeMotion(const Formulas& formulas, const Eigen::Vector2d& X,
                                         const std::vector<DefinitionSpec>& definitions, double end) {
  const Eigen::Vector2d phase =
      displacement(formulas, X, definitions, end) - displacement(formulas, X, definitions, 0.0);
  if (phase.norm() == 0.0) return {};
  return {phase};
}

}  // namespace

std::vector<Eigen::Vector2d> motionPhases(const MotionSpec& motion, double end) {
  std::vector<double> times{0.0};
  for (const double t : motion.times)
    if (t > 0.0 && t < end) times.push_back(t);
  times.push_back(end);
  std::vector<Eigen::Vector2d> phases;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const Eigen::Vector2d phase = displacement(motion, times[k]) - displacement(motion, times[k - 1]);
    if (phase.norm() == 0.0) continue;
    if (!phases.empty() && sameDirection(phases.back(), phase))
      phases.back() += phase;
    else
      phases.push_back(phase);
  }
  return phases;
}

std::vector<Eigen::Vector2d> motionPhases(const ToolSpec& tool,
                                          const std::vector<DefinitionSpec>& definitions, double end) {
  if (const auto& table = tool.motion) return motionPhases({table->times, table->x, table->y, table->z}, end);
  if (tool.path) return motionPhases(tableOf(pathOf(tool)), end);
  return tool.prescribe ? wholeMotion(*tool.prescribe, {0.0, 0.0}, definitions, end)
                        : std::vector<Eigen::Vector2d>();
}

double turnOf(const ToolSpec& tool, const std::vector<DefinitionSpec>& definitions, double end) {
  if (tool.motion && tool.motion->angle) {
    const Schedule angle{tool.motion->times, *tool.motion->angle};
    return angle(end) - angle(0.0);
  }
  if (!tool.prescribe || !tool.prescribe->angle) return 0.0;
  const Formula angle(*tool.prescribe->angle, definitions);
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  return angle(nowhere, end) - angle(nowhere, 0.0);
}

std::vector<Eigen::Vector2d> motionPhases(const SupportSpec& support, const Eigen::Vector2d& X,
                                          const std::vector<DefinitionSpec>& definitions, double end) {
  if (support.move) return motionPhases(*support.move, end);
  return support.prescribe ? wholeMotion(*support.prescribe, X, definitions, end)
                           : std::vector<Eigen::Vector2d>();
}

}  // namespace burnish
