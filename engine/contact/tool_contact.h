#pragma once
#include <Eigen/Dense>
#include <memory>
#include <utility>
#include <vector>

#include "engine/contact/face_contact.h"
#include "engine/tools/tool.h"

namespace burnish {

/// Contact of one face of the body with a rigid tool, as the rest of the program sees it whatever the method.
template <int Dim>
class ToolContact : public FaceContact<Dim> {
 public:
  using Options = ContactOptions;

  /// Makes this pair the one that keeps a tool with free degrees of freedom in touch with the body, without
  /// which its place is not determined: while nothing is active, here or in the tool's other pairs (which are
  /// evaluated before), the nearest function (or point) counts as active.
  void keepInTouch(std::vector<const ToolContact*> others);

  /// Gaps are measured from these values instead of zero: those with which a state that does not fit begins
  /// can be taken away little by little. One per function, of averaged gaps or of a field of gaps; empty:
  /// from zero.
  void measureGapsFrom(Eigen::VectorXd origin) { gapOrigin_ = std::move(origin); }

  /// Gaps between the undeformed face and the tool at a place, one per function: averaged ones, or those at
  /// the functions' anchors.
  virtual Eigen::VectorXd referenceGaps(const ToolPose& pose) const = 0;

  /// Smallest gap between the undeformed face and the tool at a place, of those that the method closes:
  /// averaged ones, or those of points.
  virtual double smallestReferenceGap(const ToolPose& pose) const = 0;

 protected:
  using FaceContact<Dim>::FaceContact;

  /// Whether the tool touches the body nowhere else.
  bool isAlone() const;

  Eigen::VectorXd gapOrigin_;
  bool keepsInTouch_ = false;
  std::vector<const ToolContact*> others_;
};

/// The pair of a face and a tool as the options want it. options: with a parameter. firstMultiplier: number
/// of the first of the pair's multipliers among the unknowns. held: displacement components that supports
/// prescribe. definitions: of names in the formula for friction. Body and tool must outlive the term. Throws
/// `Error` as the term of the method.
template <int Dim>
std::unique_ptr<ToolContact<Dim>> makeToolContact(const Body<Dim>& body, int patch, FaceId face,
                                                  const Tool& tool, const ContactOptions& options,
                                                  int firstMultiplier, const std::vector<bool>& held,
                                                  const std::vector<DefinitionSpec>& definitions);

/// Mean distance of neighbouring control points of a face, over both directions in space.
template <int Dim>
double meanControlPointDistance(const Patch<Dim>& patch, FaceId face);

}  // namespace burnish
