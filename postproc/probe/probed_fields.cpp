#include "postproc/probe/probed_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/probe/probe_point.h"
#include "postproc/probe/stress_tensor.h"

namespace burnish {
namespace {

/// A component of the stress in the axes of a surface: σ(row, column).
struct SurfaceStress {
  const char* component;
  const char* words;
  int row, column;
};

constexpr std::array<SurfaceStress, 5> kSurfaceStresses{
    {{"along", "Cauchy stress along the face", 1, 1},
     {"across", "Cauchy stress across", 2, 2},
     {"normal", "Cauchy stress normal to the face", 0, 0},
     {"shear_along", "Cauchy stress of shear along the face", 0, 1},
     {"shear_across", "Cauchy stress of shear across", 0, 2}}};

const SurfaceStress* surfaceStress(const std::string& name) {
  const auto found = std::ranges::find_if(kSurfaceStresses, [&](const SurfaceStress& stress) {
    return name == std::string("stress.") + stress.component;
  });
  return found == kSurfaceStresses.end() ? nullptr : &*found;
}

/// As of a component, with the coefficients of all of them.
FieldChoice chooseSurfaceStress(const ModelRecord& model, const FrameRecord& frame,
                                const SurfaceStress& stress) {
  FieldChoice choice = chooseField(model, frame, "stress.xx");
  choice.name = std::string("stress.") + stress.component;
  choice.words = stress.words;
  choice.coefficients = frame.fields.at("stress").values;
  return choice;
}

void requireBodyField(const FrameRecord& frame, const std::string& name) {
  std::vector<std::string> names = fieldNames(frame);
  std::erase_if(names, isContactField);
  if (std::ranges::count(names, "stress.xx"))
    for (std::string& one : surfaceFieldNames()) names.push_back(std::move(one));
  if (std::ranges::count(names, name)) return;
  throw Error(fmt::format("field: found {}{}; available in frame {}: {}.{}", quoted(name),
                          isContactField(name) ? ", which only faces in contact have" : "", frame.index,
                          fmt::join(names, ", "), didYouMean(name, names)));
}

}  // namespace

std::vector<std::string> surfaceFieldNames() {
  std::vector<std::string> names;
  for (const SurfaceStress& stress : kSurfaceStresses)
    names.push_back(std::string("stress.") + stress.component);
  return names;
}

bool isSurfaceField(const std::string& name) {
  return surfaceStress(name) != nullptr;
}

ProbedFields::ProbedFields(const ModelRecord& model, const FrameRecord& frame,
                           const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    requireBodyField(frame, name);
    if (const SurfaceStress* stress = surfaceStress(name); stress != nullptr) {
      choices_.push_back(chooseSurfaceStress(model, frame, *stress));
      inAxes_.push_back(InAxes{stress->row, stress->column, frame.fields.at("stress").components});
    } else {
      choices_.push_back(chooseField(model, frame, name));
      inAxes_.emplace_back();
    }
    const std::vector<std::string> without = bodiesWithout(model, frame, name);
    std::vector<bool>& has = has_.emplace_back();
    if (without.empty()) continue;
    for (const std::string& body : model.bodies) has.push_back(!std::ranges::count(without, body));
  }
}

bool ProbedFields::needsAxes() const {
  return std::ranges::any_of(inAxes_, [](const std::optional<InAxes>& one) { return one.has_value(); });
}

Eigen::VectorXd ProbedFields::values(int body, const std::vector<int>& nodes, const Eigen::VectorXd& R,
                                     const std::optional<SurfaceAxes>& axes) const {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(std::ssize(choices_), ProbePoint::kNone);
  for (std::size_t k = 0; k < choices_.size(); ++k) {
    if (!has_[k].empty() && !has_[k][static_cast<std::size_t>(body)]) continue;
    const Eigen::VectorXd here = choices_[k].coefficients(Eigen::all, nodes) * R;
    double& value = values(static_cast<Eigen::Index>(k));
    if (const std::optional<InAxes>& inAxes = inAxes_[k]; !inAxes)
      value = choices_[k].scalars(here)(0);
    else if (axes)
      value =
          axes->col(inAxes->row).dot(symmetricTensor(inAxes->components, here) * axes->col(inAxes->column));
  }
  return values;
}

}  // namespace burnish
