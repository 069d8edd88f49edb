#include "engine/analysis/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/analysis/geometry.h"
#include "engine/analysis/materials.h"
#include "engine/analysis/tool_start.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr std::array<const char*, 3> kComponents{"x", "y", "z"};

/// Schedules of a motion's components; empty ones for components that are left out.
std::array<Schedule, 3> schedules(const MotionSpec& motion) {
  std::array<Schedule, 3> result;
  const std::array<const std::optional<std::vector<double>>*, 3> components{&motion.x, &motion.y, &motion.z};
  for (std::size_t d = 0; d < 3; ++d)
    if (components[d]->has_value()) result[d] = {motion.times, **components[d]};
  return result;
}

Eigen::Vector3d padded(const std::vector<double>& values) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t d = 0; d < values.size(); ++d) result(static_cast<Eigen::Index>(d)) = values[d];
  return result;
}

RigidShape makeShape(const PlaneToolSpec& spec) {
  return Plane{padded(spec.origin), padded(spec.normal)};
}
RigidShape makeShape(const CylinderToolSpec& spec) {
  return Cylinder{padded(spec.center), padded(spec.axis), spec.radius};
}
RigidShape makeShape(const SphereToolSpec& spec) {
  return Sphere{padded(spec.center), spec.radius};
}

Enforcement enforcementOf(ContactMethod method) {
  switch (method) {
    case ContactMethod::AugmentedLagrangian:
      return Enforcement::AugmentedLagrangian;
    case ContactMethod::Penalty:
      return Enforcement::MortarPenalty;
    case ContactMethod::PointwisePenalty:
      return Enforcement::PointwisePenalty;
  }
  return Enforcement::AugmentedLagrangian;
}

/// ε when the scene does not say: the augmented Lagrangian's answer does not depend on it, the penalty
/// methods trade penetration against conditioning.
double defaultParameter(Enforcement enforcement, double E, double L) {
  return (enforcement == Enforcement::AugmentedLagrangian ? 1.0 : 100.0) * E / L;
}

}  // namespace

template <int Dim>
Model<Dim>::Model(const Scene& scene) : body_(makeBody(makePatch<Dim>(scene))) {
  quadrature_ = std::make_unique<SpanQuadrature<Dim>>(body_);
  bulk_ = std::make_unique<BulkTerm<Dim>>(*quadrature_, makeMaterial(scene.material));
  prescribed_.assign(static_cast<std::size_t>(numDisplacements()), false);
  for (const auto& support : scene.supports) addSupport(support);
  for (const auto& load : scene.loads) {
    const Schedule factor = load.schedule.value_or(Schedule{});
    corners_.insert(corners_.end(), factor.times.begin(), factor.times.end());
    tractions_.push_back(std::make_unique<TractionTerm<Dim>>(
        body_, 0, faceFromName<Dim>(load.face), padded(load.traction).template head<Dim>(), factor));
  }
  addTools(scene);
  addContacts(scene);
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  requireSupported();
  liftTools(scene);
}

template <int Dim>
void Model<Dim>::addSupport(const SupportSpec& spec) {
  const FaceId face = faceFromName<Dim>(spec.face);
  const auto functions = faceFunctions(body_.patches.front().basis(), face);
  std::array<bool, 3> held{};
  std::array<Schedule, 3> motion;
  for (std::size_t d = 0; d < Dim; ++d)
    held[d] = std::find(spec.fix.begin(), spec.fix.end(), kComponents[d]) != spec.fix.end();
  if (spec.move) {
    motion = schedules(*spec.move);
    for (std::size_t d = 0; d < Dim; ++d) held[d] = !motion[d].times.empty();
    corners_.insert(corners_.end(), spec.move->times.begin(), spec.move->times.end());
  }
  if (spec.symmetry) {
    const Eigen::MatrixXd points = body_.patches.front().points()(Eigen::all, functions);
    const Eigen::VectorXd extent = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
    Eigen::Index normal = 0;
    if (extent.minCoeff(&normal) > 1e-12 * body_.size())
      throw Error(fmt::format(
          "supports: face '{}' is not flat along an axis, so symmetry has no direction to hold; use "
          "fix with the components to hold",
          spec.face));
    held[static_cast<std::size_t>(normal)] = true;
  }
  for (const int a : functions)
    for (int d = 0; d < Dim; ++d) {
      if (!held[static_cast<std::size_t>(d)]) continue;
      const int unknown = Dim * body_.nodes.front()[static_cast<std::size_t>(a)] + d;
      if (prescribed_[static_cast<std::size_t>(unknown)]) {
        // A corner that two supports hold must be moved by both in the same way.
        const auto same = std::find_if(motions_.begin(), motions_.end(),
                                       [&](const auto& m) { return m.unknown == unknown; });
        const Schedule before = same == motions_.end() ? Schedule{} : same->motion;
        if (!sameValues(before, motion[static_cast<std::size_t>(d)]))
          throw Error(
              fmt::format("supports: face '{}' meets another support at a corner where component {} is "
                          "prescribed differently by the two; give both the same motion",
                          spec.face, kComponents[static_cast<std::size_t>(d)]));
        continue;
      }
      prescribed_[static_cast<std::size_t>(unknown)] = true;
      if (!motion[static_cast<std::size_t>(d)].times.empty())
        motions_.push_back({unknown, motion[static_cast<std::size_t>(d)]});
    }
}

template <int Dim>
void Model<Dim>::addTools(const Scene& scene) {
  for (const auto& spec : scene.tools) {
    auto tool = std::make_unique<Tool>();
    tool->name = spec.name;
    tool->shape = std::visit([](const auto& shape) { return makeShape(shape); }, spec.shape);
    if (spec.motion) {
      tool->motion = schedules(*spec.motion);
      corners_.insert(corners_.end(), spec.motion->times.begin(), spec.motion->times.end());
    }
    tools_.push_back(std::move(tool));
  }
}

template <int Dim>
void Model<Dim>::addContacts(const Scene& scene) {
  numUnknowns_ = numDisplacements();
  for (const auto& spec : scene.contact) {
    const auto tool = static_cast<std::size_t>(
        std::find_if(tools_.begin(), tools_.end(), [&](const auto& t) { return t->name == spec.tool; }) -
        tools_.begin());
    const FaceId face = faceFromName<Dim>(spec.face);
    requireReachable(*tools_[tool], face, spec);
    const Enforcement enforcement = enforcementOf(spec.method);
    typename ContactTerm<Dim>::Options options{
        enforcement,
        spec.parameter.value_or(
            defaultParameter(enforcement, youngsModulus(bulk_->material()), body_.size())),
        spec.quadraturePoints.value_or(0)};
    auto term = std::make_unique<ContactTerm<Dim>>(body_, 0, face, *tools_[tool], options, numUnknowns_);
    numUnknowns_ += term->numMultipliers();
    contacts_.push_back({tool, 0, spec.face, std::move(term)});
  }
  prescribed_.resize(static_cast<std::size_t>(numUnknowns_), false);
}

template <int Dim>
void Model<Dim>::requireReachable(const Tool& tool, FaceId face, const ContactSpec& spec) const {
  const std::string place = fmt::format("contact[{}]", contacts_.size());
  const NearestPoint nearest = nearestPoint(body_, 0, face, tool);
  if (-nearest.gap > kTouching * std::min(curvatureRadius(tool.shape), body_.size()))
    throw Error(
        fmt::format("{}: tool '{}' overlaps face '{}' by {:.3g} at the start; move it away by at least "
                    "that much (touching is fine)",
                    place, spec.tool, spec.face, -nearest.gap));
  if (nearest.facing > 0.5)
    throw Error(
        fmt::format("{}: tool '{}' is behind face '{}' at the start, inside the body or on its other "
                    "side; put it in front of the face",
                    place, spec.tool, spec.face));
  const auto functions = faceFunctions(body_.patches.front().basis(), face);
  const bool held = std::all_of(functions.begin(), functions.end(), [&](int a) {
    const auto first = prescribed_.begin() + Dim * body_.nodes.front()[static_cast<std::size_t>(a)];
    return std::all_of(first, first + Dim, [](bool flag) { return flag; });
  });
  if (held)
    throw Error(
        fmt::format("{}: face '{}' is held in all its components, so tool '{}' cannot move it; name a "
                    "face that is free",
                    place, spec.face, spec.tool));
}

template <int Dim>
void Model<Dim>::liftTools(const Scene& scene) {
  constexpr int kApproachSteps = 4;
  const double approachTime = kApproachSteps * scene.steps.front().until / scene.steps.front().count;
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    std::vector<const ContactTerm<Dim>*> pairs;
    for (const auto& pair : contacts_)
      if (pair.tool == k && pair.term->options().enforcement != Enforcement::PointwisePenalty)
        pairs.push_back(pair.term.get());
    if (pairs.empty()) continue;
    tools_[k]->lift = liftToSeparate<Dim>(pairs, *tools_[k], body_.size());
    if (tools_[k]->lift.isZero(0.0)) continue;
    tools_[k]->approachTime = approachTime;
    startTime_ = -approachTime;
  }
}

template <int Dim>
void Model<Dim>::requireSupported() const {
  // The rigid motions of the reference body must not all fit the supports: their values at the prescribed
  // unknowns have to be linearly independent.
  constexpr int kRigid = Dim == 2 ? 3 : 6;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(numDisplacements(), kRigid);
  const auto& patch = body_.patches.front();
  for (int a = 0; a < body_.numNodes; ++a) {
    const Eigen::Vector<double, Dim> X = patch.points().col(a) / body_.size();
    for (int d = 0; d < Dim; ++d) motions(Dim * a + d, d) = 1.0;
    int column = Dim;
    for (int i = 0; i < Dim; ++i)
      for (int j = i + 1; j < Dim; ++j, ++column) {
        motions(Dim * a + i, column) = -X(j);
        motions(Dim * a + j, column) = X(i);
      }
  }
  std::vector<int> held;
  for (int i = 0; i < numDisplacements(); ++i)
    if (prescribed_[static_cast<std::size_t>(i)]) held.push_back(i);
  const Eigen::MatrixXd atSupports = motions(held, Eigen::all);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(atSupports);
  qr.setThreshold(1e-10);
  if (held.empty() || qr.rank() < kRigid)
    throw Error(fmt::format(
        "supports: they leave the body free to move as a rigid whole in {} way{}; hold more components "
        "or faces",
        kRigid - (held.empty() ? 0 : static_cast<int>(qr.rank())),
        kRigid - (held.empty() ? 0 : static_cast<int>(qr.rank())) == 1 ? "" : "s"));
}

template <int Dim>
std::vector<Term*> Model<Dim>::terms() const {
  std::vector<Term*> terms{bulk_.get()};
  for (const auto& pair : contacts_) terms.push_back(pair.term.get());
  for (const auto& traction : tractions_) terms.push_back(traction.get());
  return terms;
}

template <int Dim>
Eigen::VectorXd Model<Dim>::target(double t) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(numUnknowns_);
  for (const auto& prescribed : motions_) values(prescribed.unknown) = prescribed.motion(std::max(t, 0.0));
  return values;
}

template <int Dim>
SteppingState Model<Dim>::startState() const {
  SteppingState start;
  start.time = startTime_;
  start.x = Eigen::VectorXd::Zero(numUnknowns_);
  return start;
}

template <int Dim>
ResidualScales Model<Dim>::residualScales() const {
  const double L = body_.size();
  ResidualScales scales;
  scales.numForces = numDisplacements();
  scales.forceFloor = 1e-9 * youngsModulus(bulk_->material()) * std::pow(L, Dim - 1);
  scales.spanSize =
      std::pow(quadrature_->volume() / static_cast<double>(quadrature_->spans().size()), 1.0 / Dim);
  scales.constraints.resize(numUnknowns_ - numDisplacements());
  Eigen::Index next = 0;
  for (const auto& pair : contacts_) {
    scales.constraints.segment(next, pair.term->numMultipliers()) =
        L * pair.term->weights().head(pair.term->numMultipliers());
    next += pair.term->numMultipliers();
  }
  return scales;
}

template class Model<2>;
template class Model<3>;

}  // namespace burnish
