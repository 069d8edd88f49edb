#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/solid/face_quadrature.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// Watches whether tools reach into outer faces of the body that they have no contact with, for instance
/// where one slides over the end of its face: nothing holds them there.
template <int Dim>
class ToolWatch {
 public:
  /// The model must outlive the object.
  explicit ToolWatch(const Model<Dim>& model);

  /// A sentence for every tool and face that is watched.
  std::vector<std::string> sentences() const;

  /// For each of them whether the tool is deeper in the face than a tenth of a knot span in the middle of
  /// one.
  std::vector<bool> reached(const std::vector<ToolPose>& poses, const Eigen::VectorXd& x) const;

 private:
  struct Face {
    std::size_t tool = 0;
    std::string name;
    FaceQuadrature<Dim> middles;
  };

  bool isReached(const Face& face, const ToolPose& pose, const Eigen::VectorXd& x) const;

  const Model<Dim>& model_;
  std::vector<Face> faces_;
};

}  // namespace burnish::inline analysis
