#include "postproc/probe/gauge_rule.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/nurbs/quadrature.h"

namespace burnish {
namespace {

constexpr int kRadii = 4;

/// Directions of length 1 with weights that sum to 1; none of them lies in a plane of two axes.
template <int Dim>
std::vector<std::pair<Eigen::Vector<double, Dim>, double>> directions() {
  constexpr int kAround = Dim == 2 ? 48 : 32, kLatitudes = 4;  // these on each half
  static const QuadratureRule rule = gaussLegendre(kLatitudes);
  std::vector<std::pair<Eigen::Vector<double, Dim>, double>> all;
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / kAround;
    if constexpr (Dim == 2) {
      all.emplace_back(Eigen::Vector2d(std::cos(angle), std::sin(angle)), 1.0 / kAround);
    } else {
      for (int latitude = 0; latitude < kLatitudes; ++latitude)
        for (const double side : {-1.0, 1.0}) {
          const double height = rule.points(latitude), across = std::sqrt(1.0 - height * height);
          all.emplace_back(Eigen::Vector3d(across * std::cos(angle), side * height, across * std::sin(angle)),
                           0.5 * rule.weights(latitude) / kAround);
        }
    }
  }
  return all;
}

}  // namespace

template <int Dim>
GaugeRule<Dim> gaugeRule(double radius) {
  const QuadratureRule rule = gaussLegendre(kRadii);
  const auto around = directions<Dim>();
  const Eigen::Index count = kRadii * std::ssize(around);
  GaugeRule<Dim> gauge{Eigen::Matrix<double, Dim, Eigen::Dynamic>(Dim, count), Eigen::VectorXd(count)};
  Eigen::Index next = 0;
  for (int k = 0; k < kRadii; ++k)
    for (const auto& [direction, weight] : around) {
      gauge.offsets.col(next) = radius * rule.points(k) * direction;
      gauge.weights(next++) = Dim * rule.weights(k) * std::pow(rule.points(k), Dim - 1) * weight;
    }
  return gauge;
}

template GaugeRule<2> gaugeRule<2>(double);
template GaugeRule<3> gaugeRule<3>(double);

}  // namespace burnish
