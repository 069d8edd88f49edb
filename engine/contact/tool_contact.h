#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/contact/face_contact.h"
#include "engine/tools/tool.h"

namespace burnish::inline contact {

/// Gaps to a tool at a place.
GapAt gapTo(const Tool& tool, const ToolPose& pose);

/// Contact of a face with a tool as the options want it. options: with a parameter. firstMultiplier: number
/// of the first of the pair's multipliers among the unknowns. held: displacement components that supports
/// prescribe. definitions: of names in the formula for friction. Body and tool must outlive the term. Throws
/// `Error` as the term of the method.
template <int Dim>
std::unique_ptr<FaceContact<Dim>> makeToolContact(const Body<Dim>& body, int patch, FaceId face,
                                                  const Tool& tool, const ContactOptions& options,
                                                  int firstMultiplier, const std::vector<bool>& held,
                                                  const std::vector<DefinitionSpec>& definitions);

/// Mean distance of neighbouring control points of a face, over both directions in space.
template <int Dim>
double meanControlPointDistance(const Patch<Dim>& patch, FaceId face);

}  // namespace burnish::inline contact
