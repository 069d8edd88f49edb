#include "engine/analysis/contact_fit.h"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/rezoning/mesh_energy.h"
#include "engine/rezoning/remesh.h"
#include "engine/solid/body.h"

namespace burnish::inline analysis {
namespace {

/// The gaps are nonlinear where the tool is round, and the areas change that they are averaged over.
constexpr int kMaxSteps = 8;
constexpr double kClosed = 1e-9;  // relative to what a control point may move

/// Part of the face, about, that must be out of contact to take up what is displaced under the tools.
constexpr double kFreeShare = 0.1;

/// Components of the face's control points that may be shifted: not those that a support holds, nor those
/// that would take its ends off the faces beside it.
std::vector<int> freeComponents(const Patch<2>& mesh, const ContactFitOptions& options) {
  const int n = static_cast<int>(faceFunctions(mesh.basis(), options.face).size());
  const FaceId besides = 2 * (1 - options.face / 2);
  std::vector<int> components;
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < 2; ++d) {
      const bool isFirst = a == 0, isLast = a + 1 == n;
      if (options.held[isFirst ? 0 : isLast ? 2 : 1][static_cast<std::size_t>(d)]) continue;
      if ((isFirst || isLast) && !isFlat(mesh, besides + (isLast ? 1 : 0), 1 - d)) continue;
      components.push_back(2 * a + d);
    }
  return components;
}

/// ∫ R_A R_B dΓ for both components of displacements.
Eigen::MatrixXd massOf(const FaceQuadrature<2>& face) {
  const Eigen::Index n = face.numFunctions();
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (const auto& span : face.spans()) {
    const Eigen::MatrixXd M = span.R * span.weights.asDiagonal() * span.R.transpose();
    for (std::size_t a = 0; a < span.functions.size(); ++a)
      for (std::size_t b = 0; b < span.functions.size(); ++b)
        mass.block<2, 2>(2 * span.functions[a], 2 * span.functions[b]).diagonal().array() +=
            M(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  return mass;
}

/// Change of the body's volume by the control points of its face, up to the sign.
Eigen::VectorXd volumeGradient(const FaceQuadrature<2>& face) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2 * face.numFunctions());
  for (const auto& span : face.spans()) {
    const Eigen::MatrixXd tangents = face.points()(Eigen::all, span.functions) * span.dR;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Vector2d normal = areaVector<2>(tangents.col(q)).normalized();
      for (std::size_t a = 0; a < span.functions.size(); ++a)
        gradient.segment<2>(2 * span.functions[a]) +=
            span.weights(q) * span.R(static_cast<Eigen::Index>(a), q) * normal;
    }
  }
  return gradient;
}

/// What a step of the shift is found from, at free components.
struct Linearised {
  Eigen::VectorXd gaps;      ///< to be closed
  Eigen::MatrixXd gradient;  ///< of these
  Eigen::MatrixXd mass;
  Eigen::VectorXd volume;  ///< gradient
};

/// Least xᵀ mass x of those x that close the gaps, or come nearest to that, and among these, unless the
/// whole face is in contact, keep the volume.
Eigen::VectorXd smallestShift(const Linearised& face) {
  const Eigen::LLT<Eigen::MatrixXd> factor(face.mass);
  const Eigen::MatrixXd gradient = factor.matrixL().solve(face.gradient.transpose()).transpose();
  const Eigen::VectorXd volume = factor.matrixL().solve(face.volume);
  const auto constraints = gradient.completeOrthogonalDecomposition();
  Eigen::VectorXd y = -constraints.solve(face.gaps);
  const Eigen::VectorXd elsewhere = volume - constraints.solve(gradient * volume);
  if (elsewhere.squaredNorm() > kFreeShare * volume.squaredNorm())
    y -= volume.dot(y) / elsewhere.squaredNorm() * elsewhere;
  return factor.matrixU().solve(y);
}

/// The mesh with the control points of a face shifted, 2 per function, those behind them in proportion to
/// their distance from the opposite face.
Patch<2> shifted(const Patch<2>& mesh, FaceId face, const Eigen::VectorXd& shift) {
  const auto& basis = mesh.basis();
  const int across = face / 2, along = 1 - across;
  Eigen::MatrixXd points = mesh.points();
  for (int a = 0; a < basis.numFunctions(); ++a) {
    const auto index = basis.functionIndex(a);
    const auto& depth = basis.direction(across);
    const double share = depth.shareOf(depth.anchor(index[static_cast<std::size_t>(across)]));
    points.col(a) += (face % 2 == 1 ? share : 1.0 - share) *
                     shift.segment<2>(2 * static_cast<Eigen::Index>(index[static_cast<std::size_t>(along)]));
  }
  return {basis, std::move(points), mesh.weights()};
}

}  // namespace

std::vector<int> gapsToClose(const Eigen::VectorXd& gaps, const Eigen::VectorXd& multipliers,
                             double parameter) {
  std::vector<int> functions;
  for (int a = 0; a < gaps.size(); ++a)
    if (multipliers(a) + parameter * gaps(a) < 0.0) functions.push_back(a);
  return functions;
}

std::optional<Patch<2>> fittedToTools(const Patch<2>& mesh, const std::vector<RestingTool>& tools,
                                      const ContactFitOptions& options) {
  const auto n = static_cast<Eigen::Index>(faceFunctions(mesh.basis(), options.face).size());
  const auto components = freeComponents(mesh, options);
  if (components.empty()) return mesh;
  std::vector<std::set<int>> toClose(tools.size());  // once closed, a gap stays so
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(2 * n);
  Patch<2> fitted = mesh;
  for (int step = 0; step < kMaxSteps; ++step) {
    Body<2> body = makeBody(fitted);
    body.axisymmetric = options.axisymmetric;
    Linearised linearised{{}, Eigen::MatrixXd(0, std::ssize(components)), {}, {}};
    auto& [gaps, gradient, mass, volume] = linearised;
    for (std::size_t k = 0; k < tools.size(); ++k) {
      const auto& resting = tools[k];
      const ContactTerm<2> term(body, 0, options.face, *resting.tool, resting.options, 0);
      const auto linear = term.linearReferenceGaps(resting.pose);
      for (const int a : gapsToClose(linear.values, resting.multipliers, *resting.options.parameter))
        if (linear.slopes(a) > kOpenSlope) toClose[k].insert(a);
      const std::vector<int> rows(toClose[k].begin(), toClose[k].end());
      const Eigen::Index first = gaps.size(), added = std::ssize(rows);
      gaps.conservativeResize(first + added);
      gaps.tail(added) = linear.values(rows);
      gradient.conservativeResize(first + added, Eigen::NoChange);
      gradient.bottomRows(added) = linear.gradient(rows, components);
      mass = massOf(term.face())(components, components);
      volume = volumeGradient(term.face())(components);
    }
    if (gaps.size() == 0 || gaps.cwiseAbs().maxCoeff() < kClosed * options.farthest) break;
    shift(components) += smallestShift(linearised);
    if (!(shift.reshaped(2, n).colwise().norm().maxCoeff() < options.farthest)) return std::nullopt;
    fitted = shifted(mesh, options.face, shift);
    if (!(meshQuality(fitted) > options.smallestDeterminant)) return std::nullopt;
  }
  return fitted;
}

}  // namespace burnish::inline analysis
