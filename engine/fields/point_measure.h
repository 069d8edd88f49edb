#pragma once
#include <functional>
#include <map>

#include "engine/fields/measure.h"
#include "engine/results/result.h"
#include "engine/solid/body.h"

namespace burnish::inline fields {

/// Displacement and projected fields at a material point.
template <int Dim>
class PointMeasure final : public Measure {
 public:
  using Fields = std::map<std::string, FieldRecord>;

  /// xi: the point's parameters in the patch. names: "displacement" and projected fields. `fields` answers
  /// the projected fields of the last evaluated state, with their components.
  PointMeasure(const Body<Dim>& body, int patch, const Eigen::Vector<double, Dim>& xi,
               std::vector<std::string> names, std::function<const Fields&()> fields);

  /// ux, ..., von_mises, stress_xx, ...
  std::vector<std::string> columns() const override;
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  std::vector<int> nodes_;
  Eigen::VectorXd R_;
  std::vector<std::string> names_;
  std::function<const Fields&()> fields_;
};

/// Parameters of a reference position in one of the patches (all if `patch` is negative) and the patch, by
/// Newton's method from the nearest of a grid of points. Throws `Error` if the position is farther from the
/// body than a millionth of its size.
template <int Dim>
std::pair<int, Eigen::Vector<double, Dim>> findPoint(const Body<Dim>& body, int patch,
                                                     const Eigen::Vector<double, Dim>& position);

}  // namespace burnish::inline fields
