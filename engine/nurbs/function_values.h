#pragma once
#include <Eigen/Core>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// Values of the functions of a span at parameters in it, without weights, in the order of `spanFunctions`.
template <int Dim>
Eigen::VectorXd functionValues(const TensorBasis<Dim>& basis, int span,
                               const Eigen::Vector<double, Dim>& xi) {
  const auto index = basis.spanIndex(span);
  Eigen::VectorXd values = basis.direction(0).evaluate(index[0], xi(0), 0);
  for (int d = 1; d < Dim; ++d) {
    const Eigen::VectorXd next = basis.direction(d).evaluate(index[static_cast<std::size_t>(d)], xi(d), 0);
    values = (values * next.transpose()).reshaped().eval();
  }
  return values;
}

}  // namespace burnish::inline nurbs
