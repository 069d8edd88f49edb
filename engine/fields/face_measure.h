#pragma once
#include "engine/fields/measure.h"
#include "engine/solid/face_quadrature.h"

namespace burnish {

/// Mean displacement of a face by reference area, and the resultant of the body's stresses on it: the force
/// that a support or load applies there.
template <int Dim>
class FaceMeasure final : public Measure {
 public:
  explicit FaceMeasure(FaceQuadrature<Dim> face) : face_(std::move(face)) {}

  /// ux, uy, (uz), fx, fy, (fz)
  std::vector<std::string> columns() const override;
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  FaceQuadrature<Dim> face_;
};

}  // namespace burnish
