#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/contact/tool.h"
#include "engine/solid/face_quadrature.h"

namespace burnish {

/// Watches whether a tip or an edge of a tool, too sharp for the knot spans of the contact face, is in the
/// body. Averaged gaps stay positive there and no force holds it, so the run would go on as if nothing
/// touched.
template <int Dim>
class TipWatch {
 public:
  /// The model must outlive the object.
  explicit TipWatch(const Model<Dim>& model);

  /// For each contact pair what is too sharp and how deep it is, as a sentence; empty where nothing is. In
  /// the state that the pairs have been evaluated at, with the tools at `poses`.
  std::vector<std::string> sentences(const std::vector<ToolPose>& poses, const Eigen::VectorXd& x) const;

 private:
  std::string sentence(std::size_t pair, const ToolPose& pose, const Eigen::VectorXd& x) const;

  const Model<Dim>& model_;
  std::vector<FaceQuadrature<Dim>> samples_;  ///< per contact pair: many points in every span
};

}  // namespace burnish
