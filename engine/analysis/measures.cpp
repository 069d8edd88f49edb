#include "engine/analysis/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/fields/body_fields.h"
#include "engine/fields/ellipse_measure.h"
#include "engine/fields/error_measure.h"
#include "engine/fields/extent_measure.h"
#include "engine/fields/face_measure.h"
#include "engine/fields/percentile_measure.h"
#include "engine/fields/point_measure.h"
#include "engine/scene/scene_places.h"

namespace burnish::inline analysis {

template <int Dim>
Measures<Dim>::Measures(const Scene& scene, const Model<Dim>& model,
                        const std::vector<Projection<Dim>>& projections)
    : scene_(scene), model_(model), projections_(projections), fields_(model.bodies().size()) {
  std::vector<InputProblem> problems;
  for (std::size_t k = 0; k < scene.measures.size(); ++k) {
    const auto& spec = scene.measures[k];
    try {
      auto measure = std::visit([&](const auto& kind) { return make(kind); }, spec.kind);
      measures_.push_back({spec.name, std::move(measure)});
    } catch (const Error& error) {
      problems.push_back({fmt::format("measures[{}]", k), error.what()});
    }
  }
  if (!problems.empty()) throw Error(textWithPlaces(scene, problems));
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const PointMeasureSpec& spec) {
  using Vector = Eigen::Vector<double, Dim>;
  const std::size_t number = scene_.bodyNumber(spec.body);
  const ModelBody<Dim>& itsBody = model_.bodies()[number];
  const Body<Dim>& body = itsBody.body;
  int patch = spec.patch.empty() ? -1 : model_.faces().patch(spec.body, spec.patch) - itsBody.firstPatch;
  Vector xi;
  if (!spec.position.empty()) {
    std::tie(patch, xi) = findPoint<Dim>(body, patch, Eigen::Map<const Vector>(spec.position.data()));
  } else {
    patch = std::max(patch, 0);
    const auto& basis = body.patches[static_cast<std::size_t>(patch)].basis();
    for (int d = 0; d < Dim; ++d)
      xi(d) = basis.direction(d).parameterAt(spec.parameters[static_cast<std::size_t>(d)]);
  }
  auto names = spec.fields.empty() ? std::vector<std::string>{"displacement"} : spec.fields;
  return std::make_unique<PointMeasure<Dim>>(
      body, patch, xi, std::move(names),
      [this, number]() -> const std::map<std::string, FieldRecord>& { return fields(number); });
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const FaceMeasureSpec& spec) {
  const FacePlace place = model_.faces().face(spec.place);
  std::vector<const LoadTerm*> elsewhere;
  for (std::size_t k = 0; k < scene_.loads.size(); ++k) {
    const LoadSpec& load = scene_.loads[k];
    const bool here = load.bodyForce.empty() && model_.faces().face(load.place) == place;
    if (!here) elsewhere.push_back(model_.loads()[k].get());
  }
  FaceQuadrature<Dim> face(model_.body(), place.patch, place.face, 0,
                           model_.faces().part(spec.place, "face"));
  return std::make_unique<FaceMeasure<Dim>>(std::move(face), std::move(elsewhere));
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const ErrorMeasureSpec& spec) {
  return std::make_unique<ErrorMeasure<Dim>>(model_.bodies()[scene_.bodyNumber(spec.body)].body,
                                             makeFormulas(spec.displacement, scene_.definitions));
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const EllipseMeasureSpec& spec) {
  if constexpr (Dim == 2) {
    const auto middle = spec.middle == EllipseMeasureSpec::Middle::Free    ? EllipseMeasure::Middle::Free
                        : spec.middle == EllipseMeasureSpec::Middle::Begin ? EllipseMeasure::Middle::Begin
                                                                           : EllipseMeasure::Middle::End;
    const FacePlace place = model_.faces().face(spec.place);
    for (const auto& pair : model_.contacts())
      if (model_.tools()[pair.tool]->name == spec.tool && pair.place == place)
        return std::make_unique<EllipseMeasure>(*pair.term, middle);
    for (const auto& pair : model_.pairs())
      if (pair.name == spec.tool && pair.place == place)
        return std::make_unique<EllipseMeasure>(*pair.term, middle);
    throw Error(fmt::format("tool '{}' and face '{}' are no pair of contact", spec.tool, spec.place.face));
  } else {
    throw Error("an ellipse is fitted to the contact of two-dimensional bodies only");
  }
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const ExtentMeasureSpec& spec) {
  const auto [patch, face] = model_.faces().face(spec.place);
  return std::make_unique<ExtentMeasure<Dim>>(FaceQuadrature<Dim>(model_.body(), patch, face, 0));
}

template <int Dim>
std::unique_ptr<Measure> Measures<Dim>::make(const PercentileMeasureSpec& spec) {
  const BulkTerm<Dim>& bulk = *model_.bodies()[scene_.bodyNumber(spec.body)].bulk;
  return std::make_unique<PercentileMeasure>(
      spec.share,
      [this, &bulk, field = spec.field]() -> Eigen::VectorXd {
        const FieldRecord found = quadratureFields(bulk, scene_.units.stress).at(field);
        return bulk.portion().whole(found.values, Receivers::All).row(0);
      },
      [&bulk]() -> Eigen::VectorXd {
        return bulk.portion().whole(bulk.weights().transpose(), Receivers::All).row(0);
      });
}

template <int Dim>
std::vector<std::string> Measures<Dim>::columns() const {
  std::vector<std::string> columns;
  for (const auto& [name, measure] : measures_)
    for (const auto& column : measure->columns()) columns.push_back(name + "." + column);
  return columns;
}

template <int Dim>
std::vector<double> Measures<Dim>::values(const MeasuredState& state) {
  for (auto& fields : fields_) fields.clear();
  std::vector<double> result;
  for (const auto& [name, measure] : measures_) {
    const auto values = measure->values(state);
    result.insert(result.end(), values.begin(), values.end());
  }
  return result;
}

template <int Dim>
const std::map<std::string, FieldRecord>& Measures<Dim>::fields(std::size_t body) {
  auto& fields = fields_[body];
  const BulkTerm<Dim>& bulk = *model_.bodies()[body].bulk;
  if (fields.empty())
    fields = projected(projections_[body],
                       whole(bulk.portion(), quadratureFields(bulk, scene_.units.stress), Receivers::All));
  return fields;
}

template class Measures<2>;
template class Measures<3>;

}  // namespace burnish::inline analysis
