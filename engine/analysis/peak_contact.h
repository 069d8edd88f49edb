#pragma once
#include <string>

#include "engine/contact/face_contact.h"
#include "engine/core/state_archive.h"

namespace burnish::inline analysis {

/// Watches, state by state, whether the mesh resolves a contact when its force is largest: a tool that comes down is
/// carried by one control point at first, on any mesh.
class PeakContact {
 public:
  /// Takes in the last evaluated state of a contact, at the unknowns x. Point-wise penalties, which know no active
  /// functions, are not watched.
  template <int Dim>
  void update(const FaceContact<Dim>& contact, const Eigen::VectorXd& x, double time);

  /// The largest force, per thickness in the plane.
  double force() const { return force_; }

  /// When it was.
  double time() const { return time_; }

  /// Whether fewer control points than `limitOf(Condition::LostContact)`, and not all of the face, carried it, where the
  /// gap in the span that they are in differed by more than half of the way that the face had gone: how deep the contact
  /// is, is not known better. Where a sheet is bent over an edge that is little.
  bool isCoarse() const;

  /// "1 control point"
  std::string pointsText() const;

  void archive(StateArchive& archive);

 private:
  double force_ = 0.0, time_ = 0.0;
  double unresolved_ = 0.0;  ///< differences of the gap in a span over the way of the face
  int active_ = 0;           ///< control points that carried it
  bool all_ = false;         ///< these are all of the face
};

}  // namespace burnish::inline analysis
