#include "engine/analysis/supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/analysis/release_end.h"
#include "engine/core/input_error.h"

namespace burnish::inline analysis {
namespace {

constexpr std::array<const char*, 3> kComponents{"x", "y", "z"};
constexpr double kForever = std::numeric_limits<double>::infinity();

/// Anchors of the functions of a face, one parameter point per function, in the face's own order.
template <int P>
std::vector<Eigen::Vector<double, P>> anchorsOf(const TensorBasis<P>& trace) {
  std::vector<Eigen::Vector<double, P>> anchors;
  for (int a = 0; a < trace.numFunctions(); ++a) anchors.push_back(trace.anchor(a));
  return anchors;
}

/// Functions of a face whose anchors lie in a part of it, given in shares of the parameter ranges; where the
/// part is a point, the one that is nearest.
template <int P>
std::vector<std::size_t> functionsInPart(const TensorBasis<P>& trace, const std::vector<double>& part) {
  constexpr double kRounding = 1e-12;
  const auto anchors = anchorsOf(trace);
  const auto shareOf = [&](std::size_t a, std::size_t d) {
    return trace.direction(static_cast<int>(d)).shareOf(anchors[a](static_cast<Eigen::Index>(d)));
  };
  std::vector<double> begin, end;
  for (std::size_t d = 0; 2 * d + 1 < part.size(); ++d) {
    begin.push_back(part[2 * d]);
    end.push_back(part[2 * d + 1]);
    if (begin.back() < end.back()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < anchors.size(); ++a)
      if (std::abs(shareOf(a, d) - part[2 * d]) < std::abs(nearest - part[2 * d])) nearest = shareOf(a, d);
    begin.back() = end.back() = nearest;
  }
  std::vector<std::size_t> inside;
  for (std::size_t a = 0; a < anchors.size(); ++a) {
    bool isInside = true;
    for (std::size_t d = 0; d < begin.size(); ++d)
      isInside = isInside && shareOf(a, d) >= begin[d] - kRounding && shareOf(a, d) <= end[d] + kRounding;
    if (isInside) inside.push_back(a);
  }
  return inside;
}

/// The chosen anchor that is nearest: a formula for a part of a face need not have values elsewhere.
template <int P>
Eigen::Vector<double, P> nearestOf(const std::vector<Eigen::Vector<double, P>>& anchors,
                                   const std::vector<std::size_t>& chosen,
                                   const Eigen::Vector<double, P>& anchor) {
  const auto nearest = std::min_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
    return (anchors[a] - anchor).squaredNorm() < (anchors[b] - anchor).squaredNorm();
  });
  return anchors[*nearest];
}

}  // namespace

template <int Dim>
Eigen::VectorXd Supports<Dim>::Motion::values(double t) const {
  const double time = std::clamp(t, 0.0, until);  // lifted tools come down before
  if (!formula) return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(unknowns.size()), schedule(time));
  const Eigen::Matrix3Xd& places = interpolation->places;
  Eigen::VectorXd atPlaces(places.cols());
  for (Eigen::Index k = 0; k < places.cols(); ++k) atPlaces(k) = (*formula)(places.col(k), time);
  return interpolation->matrix * atPlaces;
}

template <int Dim>
Supports<Dim>::Supports(const Scene& scene, const FaceFinder<Dim>& faces)
    : prescribed_(static_cast<std::size_t>(Dim * faces.body().numNodes), false),
      heldUntil_(prescribed_.size(), -kForever) {
  constexpr int kSamples = 8;
  for (int k = 0; k <= kSamples; ++k) times_.push_back(scene.steps.back().until * k / kSamples);
  for (const auto& support : scene.supports) {
    if (support.until) corners_.push_back(*support.until);
    if (support.until) corners_.push_back(releaseEnd(scene, support));
    if (support.move) corners_.insert(corners_.end(), support.move->times.begin(), support.move->times.end());
  }
  times_.insert(times_.end(), corners_.begin(), corners_.end());
  InputProblems problems;
  for (std::size_t k = 0; k < scene.supports.size(); ++k)
    problems.gather([&] { add(scene.supports[k], fmt::format("supports[{}]", k), scene, faces); });
  problems.throwIfAny();
}

template <int Dim>
void Supports<Dim>::add(const SupportSpec& spec, const std::string& place, const Scene& scene,
                        const FaceFinder<Dim>& faces) {
  const auto& patch = faces.body().patches[static_cast<std::size_t>(faces.patch(spec.place))];
  const auto trace = tracePatch(patch, faceFromName<Dim>(spec.place.face));
  owned_.emplace_back();
  faces.requireOuter(spec.place, place);
  const auto nodes = faces.nodes(spec.place);
  const auto chosen = functionsInPart(trace.basis(), faces.part(spec.place, place));
  if (chosen.empty())
    throw InputError(
        place,
        fmt::format("no control point belongs to this part of face '{}'; make it wider, or the mesh finer",
                    spec.place.face));

  std::array<bool, 3> held{};
  for (std::size_t d = 0; d < Dim; ++d)
    held[d] = std::find(spec.fix.begin(), spec.fix.end(), kComponents[d]) != spec.fix.end();
  if (spec.symmetry) {
    const Eigen::VectorXd extent = trace.points().rowwise().maxCoeff() - trace.points().rowwise().minCoeff();
    Eigen::Index normal = 0;
    if (extent.minCoeff(&normal) > 1e-12 * faces.body().size())
      throw InputError(place, fmt::format("face '{}' is not flat along an axis, so symmetry has no direction "
                                          "to hold; use fix with the components to hold",
                                          spec.place.face));
    held[static_cast<std::size_t>(normal)] = true;
  }

  std::array<const std::optional<std::vector<double>>*, 3> schedules{};
  if (spec.move) schedules = {&spec.move->x, &spec.move->y, &spec.move->z};
  std::array<const std::optional<FormulaText>*, 3> formulas{};
  std::shared_ptr<const Interpolation> interpolation;
  if (spec.prescribe) {
    formulas = {&spec.prescribe->x, &spec.prescribe->y, &spec.prescribe->z};
    interpolation = std::make_shared<const Interpolation>(interpolationOn(trace, chosen));
  }
  for (int d = 0; d < Dim; ++d) {
    const auto k = static_cast<std::size_t>(d);
    Motion motion;
    motion.place = place;
    motion.until = spec.until.value_or(kForever);
    if (spec.move && schedules[k]->has_value()) {
      motion.schedule = {spec.move->times, **schedules[k]};
    } else if (spec.prescribe && formulas[k]->has_value()) {
      motion.formula = Formula(**formulas[k], scene.definitions);
      motion.interpolation = interpolation;
    } else if (!held[k]) {
      continue;
    }
    for (const std::size_t a : chosen) motion.unknowns.push_back(Dim * nodes[a] + d);
    append(std::move(motion), spec.place.face, d);
  }
}

template <int Dim>
typename Supports<Dim>::Interpolation Supports<Dim>::interpolationOn(const Patch<Dim - 1, Dim>& trace,
                                                                     const std::vector<std::size_t>& chosen) {
  const auto anchors = anchorsOf(trace.basis());
  const auto n = static_cast<Eigen::Index>(anchors.size());
  Interpolation interpolation;
  interpolation.places = Eigen::Matrix3Xd::Zero(3, n);
  Eigen::MatrixXd collocation = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& anchor = anchors[static_cast<std::size_t>(k)];
    const int span = trace.findSpan(anchor);
    const auto shape = trace.shape(span, anchor);
    const auto functions = trace.basis().spanFunctions(span);
    for (std::size_t a = 0; a < functions.size(); ++a)
      collocation(k, functions[a]) = shape.R(static_cast<Eigen::Index>(a));
    interpolation.places.col(k).template head<Dim>() = trace.position(nearestOf(anchors, chosen, anchor));
  }
  const Eigen::MatrixXd inverse = collocation.partialPivLu().inverse();
  interpolation.matrix = inverse(chosen, Eigen::all);
  return interpolation;
}

template <int Dim>
void Supports<Dim>::append(Motion motion, const std::string& face, int component) {
  // A control point that two supports hold must be moved by both in the same way.
  std::vector<int> shared;
  for (const int unknown : motion.unknowns)
    if (prescribed_[static_cast<std::size_t>(unknown)]) shared.push_back(unknown);
  if (!shared.empty()) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(prescribed_.size()));
    Eigen::VectorXd now = before;
    for (const double t : times_) {
      if (t > motion.until) continue;
      setValues(t, before);
      now(motion.unknowns) = motion.values(t);
      const double scale = std::max(before.cwiseAbs().maxCoeff(), now.cwiseAbs().maxCoeff());
      for (const int unknown : shared)
        if (t <= heldUntil_[static_cast<std::size_t>(unknown)] &&
            !(std::abs(before(unknown) - now(unknown)) <= 1e-9 * scale))
          throw InputError(
              motion.place,
              fmt::format("face '{}' meets another support where component {} is prescribed differently by "
                          "the two at t = {:.6g} ({:.6g} and {:.6g}); give both the same motion",
                          face, kComponents[static_cast<std::size_t>(component)], t, before(unknown),
                          now(unknown)));
    }
  }
  for (const int unknown : motion.unknowns) {
    const auto k = static_cast<std::size_t>(unknown);
    if (motion.until <= heldUntil_[k]) continue;
    if (prescribed_[k])
      for (auto& others : owned_) std::erase(others, unknown);
    prescribed_[k] = true;
    owned_.back().push_back(unknown);
    heldUntil_[k] = motion.until;
  }
  motions_.push_back(std::move(motion));
}

template <int Dim>
void Supports<Dim>::setValues(double t, Eigen::VectorXd& x) const {
  for (const Motion& motion : motions_)
    if (t <= motion.until * (1.0 + 1e-9)) x(motion.unknowns) = motion.values(t);
}

template <int Dim>
void Supports<Dim>::requireFinite(const std::vector<double>& times) const {
  InputProblems problems;
  for (const Motion& motion : motions_) {
    if (!motion.formula) continue;
    std::vector<double> held;
    std::ranges::copy_if(times, std::back_inserter(held), [&](double t) { return t <= motion.until; });
    problems.gather([&] {
      placed(motion.place + ".prescribe",
             [&] { burnish::requireFinite({*motion.formula}, motion.interpolation->places, held); });
    });
  }
  problems.throwIfAny();
}

template class Supports<2>;
template class Supports<3>;

}  // namespace burnish::inline analysis
