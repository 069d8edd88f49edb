#include "postproc/study/evidence/refinement.h"

#include <cmath>

namespace burnish {
namespace {

/// With a lower order the limit would be farther away than the last two meshes are from each other.
constexpr double kLowestOrder = 0.85;

/// Ratio of the differences of h^q between the three meshes; it grows with q.
double ratioOfDifferences(const std::array<MeshValue, 3>& meshes, double q) {
  const double coarse = std::pow(meshes[0].size / meshes[2].size, q);
  const double middle = std::pow(meshes[1].size / meshes[2].size, q);
  return (coarse - middle) / (middle - 1.0);
}

}  // namespace

std::optional<double> extrapolatedLimit(const std::array<MeshValue, 3>& meshes) {
  constexpr double kHighestOrder = 20.0;
  const double first = meshes[1].value - meshes[0].value, second = meshes[2].value - meshes[1].value;
  if (second == 0.0) return meshes[2].value;
  const double ratio = first / second;
  if (!(ratio >= ratioOfDifferences(meshes, kLowestOrder))) return {};
  double low = kLowestOrder, high = kHighestOrder;
  while (high - low > 1e-12 * high) {
    const double q = 0.5 * (low + high);
    (ratioOfDifferences(meshes, q) < ratio ? low : high) = q;
  }
  // The error of the finest mesh is that part of the last difference.
  return meshes[2].value + second / (std::pow(meshes[1].size / meshes[2].size, low) - 1.0);
}

std::optional<double> observedOrder(const MeshValue& coarse, const MeshValue& fine, double limit) {
  const double coarseError = std::abs(coarse.value - limit), fineError = std::abs(fine.value - limit);
  if (coarseError == 0.0 || fineError == 0.0) return {};
  return std::log(coarseError / fineError) / std::log(coarse.size / fine.size);
}

std::optional<double> meanOrder(const std::vector<MeshValue>& meshes, double limit) {
  double n = 0.0, sumX = 0.0, sumY = 0.0, sumXX = 0.0, sumXY = 0.0;
  for (const MeshValue& mesh : meshes) {
    const double error = std::abs(mesh.value - limit);
    if (error == 0.0) continue;
    const double x = std::log(mesh.size), y = std::log(error);
    n += 1.0;
    sumX += x;
    sumY += y;
    sumXX += x * x;
    sumXY += x * y;
  }
  if (n < 2.0) return {};
  return (n * sumXY - sumX * sumY) / (n * sumXX - sumX * sumX);
}

}  // namespace burnish
