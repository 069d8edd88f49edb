#include "engine/fields/extent_measure.h"

#include <array>
#include <limits>

namespace burnish::inline fields {

template <int Dim>
std::vector<std::string> ExtentMeasure<Dim>::columns() const {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  std::vector<std::string> columns;
  for (std::size_t d = 0; d < Dim; ++d)
    for (const char* end : {"min", "max"}) columns.push_back(std::string(axes[d]) + end);
  return columns;
}

template <int Dim>
std::vector<double> ExtentMeasure<Dim>::values(const MeasuredState& state) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector<double, Dim> low = Eigen::Vector<double, Dim>::Constant(infinity), high = -low;
  for (const auto& span : face_.spans()) {
    const Eigen::MatrixXd positions = face_.positions(span, state.x);
    low = low.cwiseMin(positions.rowwise().minCoeff());
    high = high.cwiseMax(positions.rowwise().maxCoeff());
  }
  std::vector<double> result;
  for (Eigen::Index d = 0; d < Dim; ++d) {
    result.push_back(low(d));
    result.push_back(high(d));
  }
  return result;
}

template class ExtentMeasure<2>;
template class ExtentMeasure<3>;

}  // namespace burnish::inline fields
