#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// A plane curve by its arc length, from 0 at the begin of its parameter range.
class ArcLengthCurve {
 public:
  explicit ArcLengthCurve(Patch<1, 2> curve);

  double length() const { return lengths_.back(); }

  /// Parameter at an arc length, and the reverse; places outside the curve mean its ends.
  double parameterAt(double s) const;
  double lengthTo(double xi) const;

  Eigen::Vector2d at(double s) const { return curve_.position(parameter(parameterAt(s))); }

  /// Turn of the tangent per length, from places a length `apart`, at evenly spaced places from the begin to
  /// the end.
  std::vector<double> curvatures(int places, double apart) const;

  /// Unit tangent.
  Eigen::Vector2d tangentAt(double s) const;

 private:
  using Parameter = Eigen::Vector<double, 1>;

  static Parameter parameter(double xi) { return Parameter(xi); }
  double lengthBetween(double begin, double end) const;

  Patch<1, 2> curve_;
  std::vector<double> parameters_, lengths_;  ///< of samples in every span
};

}  // namespace burnish::inline nurbs
