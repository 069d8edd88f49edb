#include "postproc/draw/contour/contour_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/nearest.h"

namespace burnish {

const std::vector<std::string>& viewNames() {
  static const std::vector<std::string> names{"auto", "iso", "xy", "xz", "yz"};
  return names;
}

ViewAxes viewNamed(const std::string& name, int dim) {
  const auto& names = viewNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(fmt::format("view: found \"{}\"; allowed: {}, or a direction X,Y,Z towards the eye.{}", name,
                            fmt::join(names, ", "), didYouMean(name, names)));
  if (dim == 2) {
    if (name == "auto" || name == "xy") return ViewAxes::Identity();
    throw Error(fmt::format("view: found \"{}\"; a plane body is only seen in its plane: auto or xy", name));
  }
  if (name == "auto") return viewFrom({0.5, 0.45, 1.0});
  if (name == "iso") return viewFrom({1.0, 1.0, 1.0});
  ViewAxes axes = ViewAxes::Zero();
  for (int row = 0; row < 2; ++row) axes(row, name[static_cast<std::size_t>(row)] - 'x') = 1.0;
  return axes;
}

ViewAxes viewFrom(const Eigen::Vector3d& towardsEye) {
  if (!towardsEye.allFinite() || towardsEye.norm() == 0.0)
    throw Error("view: expected a direction X,Y,Z towards the eye that is not 0,0,0");
  const Eigen::Vector3d eye = towardsEye.normalized();
  constexpr double kAlongY = 1e-4;  // x is to the right then: what it turns to, next to y, is rounding
  Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(eye);
  if (right.norm() < kAlongY) right = Eigen::Vector3d::UnitX() - eye.x() * eye;
  right.normalize();
  ViewAxes axes;
  axes << right.transpose(), eye.cross(right).transpose();
  return axes;
}

}  // namespace burnish
