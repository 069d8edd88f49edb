#include "postproc/indentation/oliver_pharr.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "engine/core/error.h"

namespace burnish {
namespace {

using std::numbers::pi;

/// ln of P = p (x - f)^m over x = h/h_max, forces over their largest; shapes: p, f/(smallest x), m. The end of the
/// unloading stays below all depths.
struct PowerLaw {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  Eigen::ArrayXd x, forces;

  int inputs() const { return 3; }
  int values() const { return static_cast<int>(x.size()); }
  int operator()(const Eigen::VectorXd& shapes, Eigen::VectorXd& residuals) const {
    if (shapes(1) >= x.minCoeff()) return -1;
    residuals = shapes(0) * (x - shapes(1)).pow(shapes(2)) - forces;
    return residuals.allFinite() ? 0 : -1;
  }
};

/// Logarithms of forces are linear in those of x - f, of which this f begins.
Eigen::Vector3d startAt(const PowerLaw& law, double f) {
  Eigen::MatrixX2d rows(law.x.size(), 2);
  rows.col(0).setOnes();
  rows.col(1) = (law.x - f).log();
  const Eigen::Vector2d line = rows.colPivHouseholderQr().solve(law.forces.log().matrix());
  return {std::exp(line(0)), f, line(1)};
}

}  // namespace

double sectionArea(const Indenter& indenter, double depth) {
  const auto ofSphere = [](double radius, double h) { return pi * (2.0 * radius * h - h * h); };
  if (const auto* sphere = std::get_if<SphereIndenter>(&indenter)) return ofSphere(sphere->radius, depth);
  const auto& cone = std::get<ConeIndenter>(indenter);
  const double s = std::sin(cone.halfAngle);
  if (depth < cone.radius * (1.0 - s)) return ofSphere(cone.radius, depth);
  const double radius = std::tan(cone.halfAngle) * (depth + cone.radius * (1.0 / s - 1.0));
  return pi * radius * radius;
}

double usualBeta(const Indenter& indenter, double nu) {
  const auto* cone = std::get_if<ConeIndenter>(&indenter);
  if (cone == nullptr) return 1.0;
  const double k = (1.0 - 2.0 * nu) / (4.0 * (1.0 - nu) * std::tan(cone->halfAngle));
  return pi * (pi / 4.0 + 0.15483073 * k) / std::pow(pi / 2.0 - 0.83119312 * k, 2);
}

OliverPharr oliverPharr(const IndentationCurve& unloading, const Indenter& indenter,
                        const OliverPharrOptions& options) {
  constexpr int kFewest = 4;
  OliverPharr found;
  found.force = unloading.forces.front();
  found.depth = unloading.depths.front();
  std::vector<double> x, forces;
  for (std::size_t k = 0; k < unloading.forces.size(); ++k) {
    const double part = unloading.forces[k] / found.force;
    if (part < options.from || part > options.to) continue;
    x.push_back(unloading.depths[k] / found.depth);
    forces.push_back(part);
  }
  found.numPoints = static_cast<int>(x.size());
  if (found.numPoints < kFewest)
    throw Error(
        fmt::format("the unloading has {} steps between {:.6g} and {:.6g} of the largest force; expected "
                    "{} or more: smaller steps after the largest depth, or another part (fit)",
                    found.numPoints, options.from, options.to, kFewest));
  const PowerLaw law{Eigen::Map<const Eigen::ArrayXd>(x.data(), found.numPoints),
                     Eigen::Map<const Eigen::ArrayXd>(forces.data(), found.numPoints)};
  Eigen::NumericalDiff<PowerLaw, Eigen::Central> differentiable(law);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<PowerLaw, Eigen::Central>> solver(differentiable);
  solver.parameters.xtol = solver.parameters.ftol = 1e-14;
  solver.parameters.maxfev = 2000;
  double best = HUGE_VAL;
  Eigen::VectorXd shapes;
  for (const double part : {0.0, 0.3, 0.6, 0.9, 0.99}) {
    Eigen::VectorXd tried = startAt(law, part * law.x.minCoeff()), residuals(found.numPoints);
    solver.minimize(tried);
    if (law(tried, residuals) == 0 && tried(2) > 0.0 && residuals.norm() < best) {
      best = residuals.norm();
      shapes = tried;
    }
  }
  if (!std::isfinite(best))
    throw Error("no power law fits the unloading; it should fall from the largest force on");
  found.misfit = best / std::sqrt(static_cast<double>(found.numPoints));
  found.exponent = shapes(2);
  found.finalDepth = shapes(1) * found.depth;
  found.factor = shapes(0) * found.force / std::pow(found.depth, found.exponent);
  found.stiffness =
      found.factor * found.exponent * std::pow(found.depth - found.finalDepth, found.exponent - 1.0);
  found.contactDepth = found.depth - options.epsilon * found.force / found.stiffness;
  found.area = found.contactDepth > 0.0 ? sectionArea(indenter, found.contactDepth) : 0.0;
  if (!(found.area > 0.0))
    throw Error(fmt::format("the contact depth would be {:.6g} of {:.6g}; expected one in the indenter",
                            found.contactDepth, found.depth));
  const ModulusAndHardness of = withArea(found, found.area, options.beta);
  found.modulus = of.modulus;
  found.hardness = of.hardness;
  return found;
}

ModulusAndHardness withArea(const OliverPharr& found, double area, double beta) {
  return {std::sqrt(pi) / (2.0 * beta) * found.stiffness / std::sqrt(area), found.force / area};
}

}  // namespace burnish
