#include "engine/analysis/path_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/pressed_part.h"
#include "engine/scene/path_of_tool.h"

namespace burnish::inline analysis {
PathSteps::PathSteps(const Scene& scene) {
  for (std::size_t k = 0; k < scene.tools.size(); ++k) {
    const ToolSpec& tool = scene.tools[k];
    if (tool.path && tool.path->stepPerHalfWidth)
      tools_.push_back({k, pathOf(tool), *tool.path->stepPerHalfWidth, {.tool = tool.name}});
  }
}

void PathSteps::expect(const Scene& scene) {
  for (const BodySpec& body : scene.allBodies())
    if (const auto& resolution = body.geometry.mesh.resolution)
      for (OfTool& tool : tools_)
        if (tool.record.tool == resolution->along) tool.setHalfWidth(resolution->halfWidth);
}

double PathSteps::size(double from, double to, double nominal) const {
  constexpr double kRounding = 1e-9;
  const double middle = 0.5 * (from + to);
  double size = nominal;
  for (const OfTool& tool : tools_) {
    const bool isInPass = std::ranges::any_of(tool.path.passes(), [&](const ToolPath::Pass& pass) {
      return pass.begin < middle && middle < pass.end;
    });
    if (tool.isMeasured() && isInPass) size = std::min(size, tool.record.longest / tool.path.speed());
  }
  if (size == nominal) return nominal;
  return (to - from) / std::ceil((to - from) / size - kRounding);
}

template <int Dim>
void PathSteps::measure(const Model<Dim>& model, double t) {
  for (OfTool& tool : tools_) {
    if (tool.isMeasured() || !tool.path.hasFullForce(t)) continue;
    double area = 0.0;
    for (const ContactPair<Dim>& pair : model.contacts())
      if (pair.tool == tool.number) area += pressedPart(*pair.term).area;
    tool.record.time = t;
    tool.setHalfWidth(halfWidthOf<Dim>(area));
  }
}

std::vector<PathStepsRecord> PathSteps::records() const {
  std::vector<PathStepsRecord> records;
  for (const OfTool& tool : tools_)
    if (tool.isMeasured()) records.push_back(tool.record);
  return records;
}

void PathSteps::archive(StateArchive& archive) {
  for (OfTool& tool : tools_) {
    PathStepsRecord& record = tool.record;
    archive.together(fmt::format("tool{}", tool.number), record.time, record.halfWidth, record.longest);
  }
}

template void PathSteps::measure(const Model<2>&, double);
template void PathSteps::measure(const Model<3>&, double);

}  // namespace burnish::inline analysis
