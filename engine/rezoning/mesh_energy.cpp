#include "engine/rezoning/mesh_energy.h"

#include <vector>

#include "engine/material/neo_hookean.h"
#include "engine/solid/displacement_term.h"
#include "engine/solver/newton.h"

namespace burnish::inline rezoning {
namespace {

constexpr double kTolerance = 1e-8;
constexpr int kMaxIterations = 60;
constexpr double kFlat = 1e-9;  // relative to the size

/// The rectangle on the basis of the mesh.
Patch<2> rectangleLike(const Patch<2>& mesh, const Eigen::Vector2d& size) {
  const auto& basis = mesh.basis();
  Eigen::MatrixXd points(2, basis.numFunctions());
  for (int a = 0; a < basis.numFunctions(); ++a) {
    const Eigen::Vector2d anchor = basis.anchor(a);
    for (int d = 0; d < 2; ++d) points(d, a) = size(d) * basis.direction(d).shareOf(anchor(d));
  }
  return {basis, std::move(points), Eigen::VectorXd::Ones(basis.numFunctions())};
}

/// Components of control points that the boundary holds.
std::vector<bool> heldComponents(const Patch<2>& mesh, FaceId fixed) {
  std::vector<bool> held(static_cast<std::size_t>(2 * mesh.basis().numFunctions()), false);
  for (FaceId face = 0; face < 4; ++face) {
    const auto functions = faceFunctions(mesh.basis(), face);
    for (int d = 0; d < 2; ++d) {
      const bool slides = face != fixed && isFlat(mesh, face, 1 - d);
      for (std::size_t k = 0; k < functions.size(); ++k)
        if (!slides || k == 0 || k + 1 == functions.size())
          held[static_cast<std::size_t>(2 * functions[k] + d)] = true;
    }
  }
  return held;
}

}  // namespace

bool isFlat(const Patch<2>& mesh, FaceId face, int coordinate) {
  const Eigen::VectorXd values = mesh.points()(coordinate, faceFunctions(mesh.basis(), face));
  const Eigen::VectorXd size = mesh.points().rowwise().maxCoeff() - mesh.points().rowwise().minCoeff();
  return values.maxCoeff() - values.minCoeff() < kFlat * size.maxCoeff();
}

std::optional<Patch<2>> relaxed(const Patch<2>& mesh, const Eigen::Vector2d& size, FaceId fixed) {
  const Patch<2> rectangle = rectangleLike(mesh, size);
  const Body<2> body = makeBody(rectangle);
  const SpanQuadrature<2> quadrature(body);
  const auto points = static_cast<std::size_t>(quadrature.numPoints());
  ReferenceState unitSpans{std::vector<Eigen::Matrix3d>(points, Eigen::Matrix3d::Identity()),
                           {},
                           Eigen::VectorXd(quadrature.numPoints()),
                           0.0};
  for (const auto& span : quadrature.spans())
    unitSpans.weights.segment(span.firstPoint, span.weights.size()) = span.weights / span.weights.sum();
  DisplacementTerm<2> sheet(quadrature, NeoHookean({1.0, 0.3}), unitSpans);

  const Eigen::Index n = 2 * static_cast<Eigen::Index>(body.numNodes);
  // Forces of a sheet in which every span is strained by one; those of the solution may vanish.
  const double scale = static_cast<double>(quadrature.spans().size()) / size.minCoeff();
  ResidualScales scales{static_cast<int>(n), scale, Eigen::VectorXd::Constant(n, size.minCoeff()), {}};
  Newton newton({&sheet}, heldComponents(mesh, fixed), std::move(scales),
                {.tolerance = kTolerance,
                 .maxIterations = kMaxIterations,
                 .freeIterations = 0,
                 .harmlessResidual = 0.0,
                 .divergedIterations = kMaxIterations});
  Eigen::VectorXd x = (mesh.points() - rectangle.points()).reshaped();
  const Eigen::VectorXd target = x;
  if (newton.solve(0.0, target, x).outcome != NewtonOutcome::Converged) return std::nullopt;
  return Patch<2>(mesh.basis(), rectangle.points() + x.reshaped(2, body.numNodes), mesh.weights());
}

}  // namespace burnish::inline rezoning
