#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline contact {

/// Lengths of spans over their mean as a continuous function: at corners of spans the mean of those that meet
/// there, multilinear between.
template <int P>
class RelativeLength {
 public:
  /// sizes: of all spans, > 0.
  RelativeLength(const TensorBasis<P>& basis, const std::vector<double>& sizes);

  /// At a parameter within a span.
  double at(int span, const Eigen::Vector<double, P>& xi) const;
  double largestOn(int span) const;

 private:
  TensorBasis<P> basis_;
  std::vector<std::array<double, 1U << P>> corners_;  ///< per span, first direction fastest
};

}  // namespace burnish::inline contact
