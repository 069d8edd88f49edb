#pragma once
#include <utility>

#include "engine/contact/contact_term.h"
#include "engine/fields/measure.h"

namespace burnish {

/// The half ellipse p = p_0 (1 - (s - m)²/a²)^½ of the Hertz theory that fits a contact pressure best: least
/// squares of p² over the points above a fifth of the highest pressure, s the arc length of the deformed
/// face.
class EllipseMeasure final : public Measure {
 public:
  enum class Middle { Free, Begin, End };

  /// middle: where m is, if symmetry says so. The term must outlive the object.
  EllipseMeasure(const ContactTerm<2>& contact, Middle middle) : contact_(contact), middle_(middle) {}

  /// peak p_0, half_width a, middle m (measured from the begin of the face), and deviation: the largest
  /// |p - ellipse| over p_0 within nine tenths of the half width. All are zero until five points carry
  /// pressure and where p² is not concave.
  std::vector<std::string> columns() const override { return {"peak", "half_width", "middle", "deviation"}; }
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  /// Arc length of the deformed face from its begin to its quadrature points, and its whole length.
  std::pair<Eigen::VectorXd, double> arcLengths(const Eigen::VectorXd& x) const;

  const ContactTerm<2>& contact_;
  Middle middle_;
};

}  // namespace burnish
