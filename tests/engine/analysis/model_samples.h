#pragma once
#include <array>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/results/result.h"

/// Models and frames without a solver, for tests of what is made from results.
namespace burnish::samples {

template <int Dim>
PatchRecord recordOf(const Patch<Dim>& patch) {
  PatchRecord record;
  for (int d = 0; d < Dim; ++d) {
    const UnivariateBasis& basis = patch.basis().direction(d);
    record.directions.push_back({basis.family(), basis.degree(), basis.knots()});
  }
  record.points = patch.points();
  record.weights = patch.weights();
  record.nodes.resize(static_cast<std::size_t>(patch.points().cols()));
  std::iota(record.nodes.begin(), record.nodes.end(), 0);
  return record;
}

template <int Dim>
ModelRecord modelOf(const Patch<Dim>& patch) {
  ModelRecord model;
  model.dim = Dim;
  model.mesh.numNodes = static_cast<int>(patch.points().cols());
  model.mesh.patches = {recordOf(patch)};
  return model;
}

constexpr double kInnerRadius = 1.0;
constexpr double kOuterRadius = 2.5;

/// A quarter ring about the origin of degree 2 with so many knot spans across and around.
inline Patch<2> ringOf(const std::array<int, 2>& spans) {
  const double quarter = std::numbers::pi / 2.0;
  return refined(annulus({0.0, 0.0}, kInnerRadius, kOuterRadius, 0.0, quarter),
                 {KnotVector::uniform(2, spans[0]), KnotVector::uniform(2, spans[1])});
}

inline Patch<2> quarterRing() {
  return ringOf({3, 4});
}

/// Lagrange elements of degree 3 on the same ring, 2 x 3 of them.
inline Patch<2> lagrangeRing() {
  return lagrangeInterpolant(quarterRing(), 3, {{0.0, 0.4, 1.0}, {0.0, 0.3, 0.7, 1.0}});
}

inline Eigen::MatrixXd randomCoefficients(int components, int nodes, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(components, nodes, [&] { return uniform(generator); });
}

/// A frame with arbitrary values in all fields.
inline FrameRecord frameOf(const ModelRecord& model, int index, double time) {
  const auto seed = static_cast<unsigned>(index);
  FrameRecord frame;
  frame.index = index;
  frame.time = time;
  frame.displacement = 0.1 * randomCoefficients(model.dim, model.mesh.numNodes, seed);
  frame.fields["plastic_strain"] = {{}, "", randomCoefficients(1, model.mesh.numNodes, seed + 1)};
  frame.fields["von_mises"] = {{}, "MPa", randomCoefficients(1, model.mesh.numNodes, seed + 2)};
  frame.fields["pressure"] = {{}, "MPa", randomCoefficients(1, model.mesh.numNodes, seed + 3)};
  frame.fields["stress"] = {
      {"xx", "yy", "xy", "zz"}, "MPa", randomCoefficients(4, model.mesh.numNodes, seed + 4)};
  frame.toolDisplacement =
      0.1 * randomCoefficients(model.dim, static_cast<int>(model.tools.size()), seed + 5);
  return frame;
}

}  // namespace burnish::samples
