#include "cli/commands/document_places_check.h"

#include <fmt/format.h>

#include <vector>

#include "engine/core/error.h"
#include "engine/core/input_error.h"
#include "engine/scene/scene_places.h"
#include "postproc/mesh/mirror.h"
#include "postproc/probe/probed_run.h"

namespace burnish {
namespace {

/// The body before anything has moved, with a field that every body has.
FrameRecord frameAtRest(const ModelRecord& model) {
  FrameRecord frame;
  const auto tools = static_cast<Eigen::Index>(model.tools.size());
  frame.displacement = Eigen::MatrixXd::Zero(model.dim, model.mesh.numNodes);
  frame.toolDisplacement = Eigen::MatrixXd::Zero(model.dim, tools);
  frame.toolAngle = Eigen::VectorXd::Zero(tools);
  return frame;
}

}  // namespace

void requirePlaces(const SceneDocument& document, const ModelRecord& model) {
  const FrameRecord frame = frameAtRest(model);
  std::vector<InputProblem> problems;
  for (std::size_t k = 0; k < document.pictures.size(); ++k) {
    ContourOptions options(document.pictures[k]);
    options.field = "displacement";
    const std::string path = fmt::format("pictures[{}]", k);
    std::string key = "mirror";
    try {
      if (!options.mirror.empty()) static_cast<void>(mirrored(model, frame, options.mirror));
      key = options.cut ? "cut" : "slice";
      if (options.cut || options.slice) static_cast<void>(contentOf(model, frame, options));
    } catch (const Error& error) {
      const std::string text = error.what();  // begins with the key
      problems.push_back(
          {path + "." + key, text.starts_with(key + ": ") ? text.substr(key.size() + 2) : text});
    }
  }
  for (std::size_t k = 0; k < document.probes.size(); ++k) {
    try {
      requirePlace(model, frame, document.probes[k]);
    } catch (const Error& error) {
      const std::string text = error.what();  // begins with the key
      const std::size_t end = text.find(": ");
      std::string key = text.substr(0, end);
      if (key == "face" && document.probes[k].face.empty()) key = "depth";
      problems.push_back({fmt::format("probes[{}].{}", k, key), text.substr(end + 2)});
    }
  }
  if (!problems.empty()) throw Error(textWithPlaces(document.scene, problems));
}

}  // namespace burnish
