#pragma once
#include "engine/fields/measure.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solid/load_term.h"

namespace burnish::inline fields {

/// Mean displacement of a face by reference area, and the resultant of the force that supports, contact and
/// the face's own loads apply there: the nodal forces of the body's stresses, which balance all loads,
/// without those of the loads that act elsewhere.
template <int Dim>
class FaceMeasure final : public Measure {
 public:
  /// elsewhere: loads that do not act on the face; they must outlive the object. Throws `Error` for a face
  /// without area (collapsed, or on the axis of revolution).
  FaceMeasure(FaceQuadrature<Dim> face, std::vector<const LoadTerm*> elsewhere);

  /// ux, uy, (uz), fx, fy, (fz)
  std::vector<std::string> columns() const override;
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  FaceQuadrature<Dim> face_;
  std::vector<const LoadTerm*> elsewhere_;
  double area_ = 0.0;
};

}  // namespace burnish::inline fields
