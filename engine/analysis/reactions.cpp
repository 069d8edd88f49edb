#include "engine/analysis/reactions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/scene/support_names.h"

namespace burnish::inline analysis {
namespace {

constexpr std::array kAxisNames{"x", "y", "z"};

/// First axis about which there are moments in the plane of two dimensions, or in space.
template <int Dim>
constexpr std::size_t kFirstMoment = Dim == 2 ? 2 : 0;

}  // namespace

template <int Dim>
Reactions<Dim>::Reactions(const Scene& scene, const Model<Dim>& model)
    : model_(model), nodes_(model.body().nodePositions()) {
  const std::vector<std::string> names = supportNames(scene);
  const std::size_t moments = model.body().axisymmetric ? 0 : 3 - kFirstMoment<Dim>;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const FaceSpec& place = scene.supports[k].place;
    records_.push_back(
        {.support = names[k],
         .place = fmt::format("{}{}{}", place.face,
                              place.patch.empty() ? "" : fmt::format(" of patch {}", place.patch),
                              place.body.empty() ? "" : fmt::format(" of body {}", place.body)),
         .force = std::vector<double>(Dim, 0.0),
         .moment = std::vector<double>(moments, 0.0)});
  }
}

template <int Dim>
std::vector<std::string> Reactions<Dim>::columns() const {
  std::vector<std::string> columns;
  for (const ReactionRecord& record : records_) {
    for (std::size_t d = 0; d < Dim; ++d) columns.push_back(record.support + ".f" + kAxisNames[d]);
    for (std::size_t d = 0; d < record.moment.size(); ++d)
      columns.push_back(record.support + ".m" + kAxisNames[kFirstMoment<Dim> + d]);
  }
  return columns;
}

template <int Dim>
std::vector<double> Reactions<Dim>::values() const {
  std::vector<double> values;
  for (const ReactionRecord& record : records_) {
    values.insert(values.end(), record.force.begin(), record.force.end());
    values.insert(values.end(), record.moment.begin(), record.moment.end());
  }
  return values;
}

template <int Dim>
void Reactions<Dim>::update(const MeasuredState& state, const Eigen::VectorXd& force) {
  const bool axisymmetric = model_.body().axisymmetric;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
    for (const int unknown : model_.supports().owned(k)) {
      const int node = unknown / Dim, axis = unknown % Dim;
      if (axisymmetric && axis == 0) continue;  // radial forces around the ring balance one another
      Eigen::Vector3d share = Eigen::Vector3d::Zero(), position = share;
      share(axis) = -force(unknown);
      position.head<Dim>() = nodes_.col(node) + state.x.segment<Dim>(Dim * node);
      sum += share;
      moment += position.cross(share);
    }
    ReactionRecord& record = records_[k];
    record.force.assign(sum.begin(), sum.begin() + Dim);
    if (!axisymmetric) record.moment.assign(moment.begin() + kFirstMoment<Dim>, moment.end());
    if (state.time < 0.0 || sum.norm() <= record.largest) continue;  // lifted tools come down before t = 0
    record.largest = sum.norm();
    record.largestTime = state.time;
  }
}

template <int Dim>
void Reactions<Dim>::archive(StateArchive& archive) {
  std::vector<double> numbers;  // of all supports in one field, which is smaller than many
  forEachNumber([&](double& number) { numbers.push_back(number); });
  archive.fixedField("reactions", numbers);
  auto next = numbers.begin();
  forEachNumber([&](double& number) { number = *next++; });
}

template <int Dim>
template <class F>
void Reactions<Dim>::forEachNumber(const F& f) {
  for (ReactionRecord& record : records_) {
    std::for_each(record.force.begin(), record.force.end(), f);
    std::for_each(record.moment.begin(), record.moment.end(), f);
    f(record.largest);
    f(record.largestTime);
  }
}

template class Reactions<2>;
template class Reactions<3>;

}  // namespace burnish::inline analysis
