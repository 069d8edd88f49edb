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

  /// The middle of the patch of a place; without its name that of a patch in the middle of its body's list.
  Eigen::Vector2d middleOf(const FaceSpec& place) const;

  /// "top", "top of PATCH" in a body of several patches, "top of BODY" where there are several bodies.
  std::string nameOf(const FaceSpec& place) const;

  /// Names of bodies, where there are several, and if wanted of the patches of a body that has several.
  struct Label {
    std::string text;
    Eigen::Vector2d at;
  };
  std::vector<Label> labels(bool ofPatches) const;

 private:
  /// A body: its patches, and their names if it has several.
  struct Named {
    std::string name;
    std::vector<Patch<2>> patches;
    std::vector<std::string> patchNames;
  };

  const Named& bodyNamed(const std::string& name) const;
  const Patch<2>& patchNamed(const FaceSpec& place) const;

  std::vector<Named> bodies_;
  int subdivision_;
};

}  // namespace burnish
