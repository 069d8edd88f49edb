#include "engine/fields/ellipse_measure.h"

#include <algorithm>
#include <cmath>

namespace burnish::inline fields {

std::pair<Eigen::VectorXd, double> EllipseMeasure::arcLengths(const Eigen::VectorXd& x) const {
  const auto& face = contact_.face();
  const Eigen::MatrixXd positions = face.positions(x);
  const auto corner = [&](int function) {
    return Eigen::Vector2d(face.points().col(function) +
                           x.segment<2>(2 * face.nodes()[static_cast<std::size_t>(function)]));
  };
  Eigen::VectorXd s(positions.cols());
  double length = 0.0;
  Eigen::Vector2d last = corner(0);
  for (Eigen::Index q = 0; q < s.size(); ++q) {
    length += (positions.col(q) - last).norm();
    s(q) = length;
    last = positions.col(q);
  }
  return {s, length + (corner(face.numFunctions() - 1) - last).norm()};
}

HalfEllipse fittedHalfEllipse(const Eigen::VectorXd& s, const Eigen::VectorXd& p,
                              std::optional<double> knownMiddle) {
  constexpr double kLowest = 0.2, kInside = 0.9;
  const auto count = static_cast<Eigen::Index>((p.array() > kLowest * p.maxCoeff()).count());
  if (count < 5) return {};
  Eigen::VectorXd places(count), squares(count);
  for (Eigen::Index q = 0, k = 0; q < p.size(); ++q) {
    if (!(p(q) > kLowest * p.maxCoeff())) continue;
    places(k) = s(q);
    squares(k++) = p(q) * p(q);
  }

  // p² = c0 + c1 r² (+ c2 r), r from the origin in units of the chosen points' extent
  const double origin = knownMiddle.value_or(places(0));
  const double unit = (places.array() - origin).abs().maxCoeff();
  const Eigen::VectorXd r = (places.array() - origin) / unit;
  Eigen::MatrixXd powers(count, knownMiddle ? 2 : 3);
  powers.col(0).setOnes();
  powers.col(1) = r.cwiseAbs2();
  if (!knownMiddle) powers.col(2) = r;
  const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(squares);
  const double shift = knownMiddle ? 0.0 : -0.5 * c(2) / c(1);
  const double peakSquared = c(0) - c(1) * shift * shift;
  if (!(c(1) < 0.0) || !(peakSquared > 0.0)) return {};
  const double peak = std::sqrt(peakSquared), halfWidth = unit * std::sqrt(-peakSquared / c(1));
  const double middle = origin + shift * unit;

  double deviation = 0.0;
  for (Eigen::Index q = 0; q < p.size(); ++q) {
    const double share = (s(q) - middle) / halfWidth;
    if (std::abs(share) <= kInside)
      deviation = std::max(deviation, std::abs(p(q) - peak * std::sqrt(1.0 - share * share)));
  }
  return {peak, halfWidth, middle, deviation / peak};
}

std::vector<std::string> EllipseMeasure::columns() const {
  std::vector<std::string> columns{"peak", "half_width", "middle", "deviation"};
  if (contact_.frictionLaw().coefficient().value_or(0.0) > 0.0)
    columns.insert(columns.end(), {"stick_peak", "stick_half_width", "stick_middle", "stick_deviation"});
  return columns;
}

std::vector<double> EllipseMeasure::values(const MeasuredState& state) const {
  const auto [s, length] = arcLengths(state.x);
  std::optional<double> middle;
  if (middle_ != Middle::Free) middle = middle_ == Middle::Begin ? 0.0 : length;
  std::vector<double> values;
  const auto add = [&, &places = s](const Eigen::VectorXd& profile) {
    const HalfEllipse fit = fittedHalfEllipse(places, profile, middle);
    values.insert(values.end(), {fit.peak, fit.halfWidth, fit.middle, fit.deviation});
  };
  const ContactState& contact = contact_.state();
  add(contact.pressure);
  if (const double friction = contact_.frictionLaw().coefficient().value_or(0.0); friction > 0.0)
    add(friction * contact.pressure - contact.traction.colwise().norm().transpose());
  return values;
}

}  // namespace burnish::inline fields
