#include "engine/material/hill_yield.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

constexpr double kSkew = 1e-6;  // cosine that still counts as a right angle

std::string text(const Eigen::Vector3d& direction) {
  return fmt::format("{} {} {}", direction.x(), direction.y(), direction.z());
}

}  // namespace

HillYield::Factors HillYield::factors() const {
  const double G = 1.0 / (1.0 + r0), H = r0 * G, F = H / r90;
  const double N = (r0 + r90) * (1.0 + 2.0 * r45) / (2.0 * r90 * (1.0 + r0));
  return {F, G, H, 1.5, 1.5, N};
}

Eigen::Matrix3d HillYield::axes() const {
  const Eigen::Vector3d first = Eigen::Vector3d(rolling[0], rolling[1], rolling[2]).normalized();
  const Eigen::Vector3d second = Eigen::Vector3d(transverse[0], transverse[1], transverse[2]).normalized();
  Eigen::Matrix3d axes;
  axes << first, second, first.cross(second);
  return axes;
}

void check(const HillYield& hill, const Problems& problems, const std::string& key) {
  const std::string path = key + ".transverse";
  if (!problems.clean(key + ".rolling") || !problems.clean(path)) return;
  const Eigen::Map<const Eigen::Vector3d> first(hill.rolling.data()), second(hill.transverse.data());
  if (first.norm() > 0.0 && second.norm() > 0.0 &&
      std::abs(first.dot(second)) <= kSkew * first.norm() * second.norm())
    return;
  problems.report(
      path, fmt::format("found {} beside the rolling direction {}; allowed: two directions at a right angle.",
                        text(second), text(first)));
}

void checkInPlane(const HillYield& hill, const Problems& problems, const std::string& key) {
  const auto checkDirection = [&](const std::string& path, const std::vector<double>& entries) {
    if (!problems.clean(path)) return;
    const Eigen::Map<const Eigen::Vector3d> d(entries.data());
    if (std::min(d.head<2>().norm(), std::abs(d.z())) > kSkew * d.norm())
      problems.report(path,
                      fmt::format("found {}; allowed in the plane: a direction in it, or 0 0 1.", text(d)));
  };
  checkDirection(key + ".rolling", hill.rolling);
  checkDirection(key + ".transverse", hill.transverse);
}

}  // namespace burnish::inline material
