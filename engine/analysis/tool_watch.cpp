#include "engine/analysis/tool_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace burnish::inline analysis {
namespace {

constexpr double kReachedSpanShare = 0.1;

template <int Dim>
bool mayTouch(const Model<Dim>& model, std::size_t tool, const FacePlace& place) {
  return std::any_of(model.contacts().begin(), model.contacts().end(),
                     [&](const ContactPair<Dim>& pair) { return pair.tool == tool && pair.place == place; });
}

}  // namespace

template <int Dim>
ToolWatch<Dim>::ToolWatch(const Model<Dim>& model) : model_(model) {
  for (const OuterFace& face : model.faces().outerFaces())
    for (std::size_t tool = 0; tool < model.tools().size(); ++tool)
      if (!mayTouch(model, tool, face.place))
        faces_.push_back(
            {tool, face.text, FaceQuadrature<Dim>(model.body(), face.place.patch, face.place.face, 1)});
}

template <int Dim>
std::vector<std::string> ToolWatch<Dim>::sentences() const {
  std::vector<std::string> sentences;
  for (const Face& face : faces_)
    sentences.push_back(fmt::format("tool '{}' is inside the body at face {}, which it has no contact with",
                                    model_.tools()[face.tool]->name, face.name));
  return sentences;
}

template <int Dim>
std::vector<bool> ToolWatch<Dim>::reached(const std::vector<ToolPose>& poses,
                                          const Eigen::VectorXd& x) const {
  std::vector<bool> answers;
  for (const Face& face : faces_)
    answers.push_back(!model_.hasLeft(face.tool) && isReached(face, poses[face.tool], x));
  return answers;
}

template <int Dim>
bool ToolWatch<Dim>::isReached(const Face& face, const ToolPose& pose, const Eigen::VectorXd& x) const {
  const Tool& tool = *model_.tools()[face.tool];
  return std::any_of(face.middles.spans().begin(), face.middles.spans().end(), [&](const auto& span) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<Dim>() = face.middles.positions(span, x);
    return tool.query(pose, point).gap < -kReachedSpanShare * span.size;
  });
}

template class ToolWatch<2>;
template class ToolWatch<3>;

}  // namespace burnish::inline analysis
