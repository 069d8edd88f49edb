#pragma once
#include <Eigen/Dense>
#include <optional>
#include <utility>

#include "engine/contact/face_contact.h"
#include "engine/fields/measure.h"

namespace burnish::inline fields {

/// The half ellipse p = p_0 (1 - (s - m)²/a²)^½ of the Hertz theory.
struct HalfEllipse {
  double peak = 0.0;       ///< p_0
  double halfWidth = 0.0;  ///< a
  double middle = 0.0;     ///< m
  double deviation = 0.0;  ///< largest |p - ellipse| over p_0 within nine tenths of the half width
};

/// The half ellipse that fits pressures at the arc lengths s best: least squares of p² over the points above
/// a fifth of the highest pressure. `middle`: m, if it is known. All is zero for less than five such points
/// and where p² is not concave.
HalfEllipse fittedHalfEllipse(const Eigen::VectorXd& s, const Eigen::VectorXd& pressure,
                              std::optional<double> middle);

/// The half ellipse that fits a contact pressure best, s the arc length of the deformed face. With a number
/// for friction also the one that fits best what the tangential traction t lacks of its limit, μ p - |t|:
/// where a Hertzian contact sticks partly (Cattaneo 1938, Mindlin 1949) that is μ p_0/a (c² - s²)^½, and the
/// face sticks within c.
class EllipseMeasure final : public Measure {
 public:
  enum class Middle { Free, Begin, End };

  /// middle: where m is, if symmetry says so. The term must outlive the object.
  EllipseMeasure(const FaceContact<2>& contact, Middle middle) : contact_(contact), middle_(middle) {}

  /// Those of the half ellipse; the middle is measured from the begin of the face.
  std::vector<std::string> columns() const override;
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  /// Arc length of the deformed face from its begin to its quadrature points, and its whole length.
  std::pair<Eigen::VectorXd, double> arcLengths(const Eigen::VectorXd& x) const;

  const FaceContact<2>& contact_;
  Middle middle_;
};

}  // namespace burnish::inline fields
