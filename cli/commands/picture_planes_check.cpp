#include "cli/commands/picture_planes_check.h"

#include <fmt/format.h>

#include <vector>

#include "engine/core/error.h"
#include "engine/core/input_error.h"
#include "engine/scene/scene_places.h"
#include "postproc/mesh/mirror.h"

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

ContourOptions contourOptions(const PictureSpec& picture) {
  ContourOptions options;
  options.field = picture.field;
  options.range = picture.range;
  options.size = picture.size;
  options.bands = picture.bands;
  options.knots = picture.knots;
  options.undeformed = picture.undeformed;
  if (picture.cut) options.cut = cutPlaneNamed(*picture.cut);
  if (picture.slice) options.slice = cutPlaneNamed(*picture.slice);
  if (picture.mirror) options.mirror = mirrorPlanesNamed(*picture.mirror).value();
  options.toolOpacity = picture.toolOpacity;
  return options;
}

void requirePlanes(const Scene& scene, const ModelRecord& model) {
  const FrameRecord frame = frameAtRest(model);
  std::vector<InputProblem> problems;
  for (std::size_t k = 0; k < scene.pictures.size(); ++k) {
    const PictureSpec& picture = scene.pictures[k];
    ContourOptions options = contourOptions(picture);
    options.field = "displacement";
    const std::string path = fmt::format("pictures[{}]", k);
    std::string key = "mirror";
    try {
      if (picture.mirror) static_cast<void>(mirrored(model, frame, options.mirror));
      key = picture.cut ? "cut" : "slice";
      if (picture.cut || picture.slice) static_cast<void>(contentOf(model, frame, options));
    } catch (const Error& error) {
      const std::string text = error.what();  // begins with the key
      problems.push_back(
          {path + "." + key, text.starts_with(key + ": ") ? text.substr(key.size() + 2) : text});
    }
  }
  if (!problems.empty()) throw Error(textWithPlaces(scene, problems));
}

}  // namespace burnish
