#pragma once
#include "engine/fields/measure.h"
#include "engine/solid/face_quadrature.h"

namespace burnish::inline fields {

/// How far a face reaches now: the smallest and largest coordinates of its points.
template <int Dim>
class ExtentMeasure final : public Measure {
 public:
  /// face: the points that are looked at.
  explicit ExtentMeasure(FaceQuadrature<Dim> face) : face_(std::move(face)) {}

  /// xmin, xmax, ymin, ymax, (zmin, zmax)
  std::vector<std::string> columns() const override;
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  FaceQuadrature<Dim> face_;
};

}  // namespace burnish::inline fields
