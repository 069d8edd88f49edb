#include "postproc/draw/setup/setup_loads.h"

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

using Eigen::Vector2d;

/// A time and the factor of the loads then.
struct Instant {
  double time, factor;
};

Instant largestOf(const std::optional<Schedule>& schedule, double end) {
  if (!schedule || schedule->times.empty()) return {end, 1.0};
  Instant largest{end, (*schedule)(end)};
  for (const double t : schedule->times)
    if (t >= 0.0 && t < end && std::abs((*schedule)(t)) > std::abs(largest.factor))
      largest = {t, (*schedule)(t)};
  return largest;
}

/// What a scene's load is anywhere on a face, as a vector.
class LoadVector {
 public:
  LoadVector(const LoadSpec& load, const Scene& scene, double end)
      : instant_(largestOf(load.schedule, end)), isShear_(load.shear.has_value()) {
    const auto add = [&](const FormulaText& text) { formulas_.emplace_back(text, scene.definitions); };
    for (const FormulaText& component : load.traction) add(component);
    for (const FormulaText& component : load.bodyForce) add(component);
    if (load.pressure) add(*load.pressure);
    if (load.shear) add(*load.shear);
  }

  /// tangent: in the direction of the growing parameter.
  Vector2d at(const Vector2d& X, const Vector2d& outward, const Vector2d& tangent) const {
    if (formulas_.size() == 2) return {value(0, X), value(1, X)};
    return isShear_ ? Vector2d(value(0, X) * tangent) : Vector2d(-value(0, X) * outward);
  }

 private:
  double value(std::size_t k, const Vector2d& X) const {
    return instant_.factor * formulas_[k]({X.x(), X.y(), 0.0}, instant_.time);
  }

  Instant instant_;
  bool isShear_;
  std::vector<Formula> formulas_;
};

Vector2d tangentAt(const FaceLine& face, std::size_t k) {
  const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, face.points.size() - 1);
  return (face.points[after] - face.points[before]).normalized();
}

}  // namespace

FaceLoad faceLoad(const LoadSpec& load, const FaceLine& face, const Scene& scene, double end) {
  constexpr double kRounding = 1e-6;
  const LoadVector vector(load, scene, end);
  FaceLoad result;
  double smallest = HUGE_VAL, largest = 0.0;
  for (std::size_t k = 0; k < face.points.size(); ++k) {
    result.vectors.push_back(vector.at(face.points[k], face.outward[k], tangentAt(face, k)));
    smallest = std::min(smallest, result.vectors.back().norm());
    largest = std::max(largest, result.vectors.back().norm());
  }
  result.middle = vector.at(face.middle, face.meanNormal(), tangentAt(face, face.points.size() / 2)).norm();
  result.varies = largest - smallest > kRounding * largest;
  return result;
}

Vector2d bodyForceAt(const LoadSpec& load, const Vector2d& X, const Scene& scene, double end) {
  return LoadVector(load, scene, end).at(X, Vector2d::Zero(), Vector2d::Zero());
}

DrawnToolLoad toolLoad(const ToolCarrySpec& carry, const Vector2d& outward, const Scene& scene, double end) {
  const Instant instant = largestOf(carry.schedule, end);
  const auto value = [&](const std::optional<FormulaText>& text) {
    return text ? instant.factor * Formula(*text, scene.definitions)({0.0, 0.0, 0.0}, instant.time) : 0.0;
  };
  return {value(carry.normal) * outward + Vector2d(value(carry.x), value(carry.y)), value(carry.moment)};
}

}  // namespace burnish
