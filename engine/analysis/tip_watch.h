#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/solid/face_quadrature.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// A tip or an edge that is in the body. Depth 0: there is none.
struct FoundTip {
  double depth = 0.0;
  double turn = 0.0;  ///< of the tool's normal within half a knot span, radians
  double span = 0.0;  ///< length of the knot span
};

/// Watches whether a tip or an edge of a tool, too sharp for the knot spans of the contact face, is in the
/// body. Averaged gaps stay positive there and no force holds it, so the run would go on as if nothing
/// touched.
template <int Dim>
class TipWatch {
 public:
  /// The model must outlive the object.
  explicit TipWatch(const Model<Dim>& model);

  /// For each contact pair a tip that is in its face, in the state that the pairs have been evaluated at,
  /// with the tools at `poses`.
  std::vector<FoundTip> tips(const std::vector<ToolPose>& poses, const Eigen::VectorXd& x) const;

  /// What a tip that was found at a contact pair means, and what helps.
  std::string sentence(std::size_t pair, const FoundTip& tip) const;

 private:
  FoundTip tip(std::size_t pair, const ToolPose& pose, const Eigen::VectorXd& x) const;

  const Model<Dim>& model_;
  std::vector<FaceQuadrature<Dim>> samples_;  ///< per contact pair: many points in every span
};

}  // namespace burnish::inline analysis
