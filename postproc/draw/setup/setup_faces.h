#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/results/result.h"
#include "engine/scene/scene.h"

namespace burnish {

/// A face of a plane body, or a part of it: points along it in the direction of the growing parameter and the
/// outward unit normals there.
struct FaceLine {
  std::vector<Eigen::Vector2d> points, outward;
  Eigen::Vector2d middle;  ///< at the middle of the parameters

  Eigen::Vector2d meanNormal() const;
};

/// Finds the places that a scene names on the undeformed body of its result, in two dimensions.
class SetupFaces {
 public:
  /// subdivision: pieces of a face per knot span.
  SetupFaces(const ModelRecord& model, const Scene& scene, int subdivision);

  FaceLine line(const FaceSpec& place) const;

  /// The middle of a patch; without a name that of a patch in the middle of the list.
  Eigen::Vector2d middleOf(const std::string& patch) const;

  /// "top", or "top of PATCH" in a body of several patches.
  std::string nameOf(const FaceSpec& place) const;

  /// Names of the patches; empty for a body of a single shape.
  const std::vector<std::string>& patchNames() const { return names_; }

 private:
  const Patch<2>& patchNamed(const std::string& name) const;

  std::vector<Patch<2>> patches_;
  std::vector<std::string> names_;
  int subdivision_;
};

}  // namespace burnish
