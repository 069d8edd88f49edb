#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/contact/contact_term.h"
#include "engine/nurbs/patch.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// A tool at rest that presses on the face of a new mesh.
struct RestingTool {
  const Tool* tool = nullptr;  ///< must outlive the object
  ToolPose pose;
  ContactOptions options;       ///< ε: the one for `gapsToClose`
  Eigen::VectorXd multipliers;  ///< λ_A with which the mesh begins, functions of the face
};

struct ContactFitOptions {
  FaceId face = 3;
  bool axisymmetric = false;

  /// Components x, y that stay: at the face's first control point, at those in between and at its last one.
  std::array<std::array<bool, 2>, 3> held{};
  double farthest = 0.0;             ///< that a control point may move, a length
  double smallestDeterminant = 0.0;  ///< as of `RemeshOptions`
};

/// Functions that are in contact by their augmented multipliers λ_A + ε g_A. With an ε that is large for the
/// body these are the negative gaps and small positive ones under pressure. A face that is drawn to the tool
/// across wider gaps, which are those at the edges of the contact, is given matter that presses on the tool
/// from then on.
std::vector<int> gapsToClose(const Eigen::VectorXd& gaps, const Eigen::VectorXd& multipliers,
                             double parameter);

/// The mesh with its face where it touches the tools: shifted by the smallest mean square that makes the
/// averaged gaps of `gapsToClose` vanish, nearly so if that takes many steps, and keeps the volume, if there
/// is room beside the contact; less and less in the depth. Nothing if that takes more than a mesh may be
/// changed. Throws `Error` as the contact term.
std::optional<Patch<2>> fittedToTools(const Patch<2>& mesh, const std::vector<RestingTool>& tools,
                                      const ContactFitOptions& options);

}  // namespace burnish::inline analysis
