#include "postproc/mesh/picture_planes.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace burnish {

std::vector<std::string_view> commaParts(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(std::min(parts.back().size() + 1, text.size()));
  }
  return parts;
}

std::optional<double> finiteNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

namespace {

/// `x=V`, `y=V` or `z=V`.
std::optional<MirrorPlane> axisPlane(std::string_view text) {
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') return std::nullopt;
  const auto at = finiteNumber(text.substr(2));
  if (!at) return std::nullopt;
  return MirrorPlane{text[0] - 'x', *at};
}

}  // namespace

std::optional<CutPlane> cutPlaneNamed(std::string_view text) {
  if (const auto plane = axisPlane(text)) {
    const Eigen::Vector3d normal = Eigen::Vector3d::Unit(plane->axis);
    return CutPlane{plane->at * normal, normal};
  }
  const auto parts = commaParts(text);
  Eigen::Vector<double, 6> numbers;
  if (static_cast<Eigen::Index>(parts.size()) != numbers.size()) return std::nullopt;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto number = finiteNumber(parts[k]);
    if (!number) return std::nullopt;
    numbers(static_cast<Eigen::Index>(k)) = *number;
  }
  if (numbers.tail<3>().norm() == 0.0) return std::nullopt;
  return CutPlane{numbers.head<3>(), numbers.tail<3>()};
}

std::optional<std::vector<MirrorPlane>> mirrorPlanesNamed(std::string_view text) {
  std::vector<MirrorPlane> planes;
  for (const std::string_view part : commaParts(text)) {
    const bool isLetter = part.size() == 1 && part[0] >= 'x' && part[0] <= 'z';
    const std::optional<MirrorPlane> plane = isLetter ? MirrorPlane{part[0] - 'x', 0.0} : axisPlane(part);
    const auto isSame = [&](const MirrorPlane& other) { return other.axis == plane->axis; };
    if (!plane || std::any_of(planes.begin(), planes.end(), isSame)) return std::nullopt;
    planes.push_back(*plane);
  }
  return planes;
}

}  // namespace burnish
