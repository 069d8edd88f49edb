#include "engine/analysis/residual_scales.h"

namespace burnish {

template <int Dim>
ResidualScales residualScales(const Model<Dim>& model) {
  ResidualScales scales;
  scales.numForces = model.numForces();
  scales.forceFloor = model.forceFloor();
  scales.spanSizes = Eigen::VectorXd::Zero(model.numForces());
  for (const auto& body : model.bodies())
    for (const auto& span : body.quadrature->spans())
      for (const int node : span.nodes) {
        auto sizes = scales.spanSizes.segment<Dim>(Dim * node);
        sizes = sizes.cwiseMax(span.size);
      }
  scales.constraints.resize(model.numUnknowns() - model.numForces());
  const auto sizeAt = [&](const FacePlace& place) { return model.bodyOf(place).body.size(); };
  Eigen::Index next = 0;
  for (const auto& pair : model.contacts()) {
    scales.constraints.segment(next, pair.term->numMultipliers()) =
        sizeAt(pair.place) * pair.term->weights().head(pair.term->numMultipliers());
    next += pair.term->numMultipliers();
  }
  for (const auto& pair : model.pairs()) {
    scales.constraints.segment(next, pair.term->numMultipliers()) = sizeAt(pair.place) * pair.term->weights();
    next += pair.term->numMultipliers();
  }
  for (const auto& contact : model.selfContacts()) {
    scales.constraints.segment(next, contact.term->numMultipliers()) =
        sizeAt(contact.place) * contact.term->weights();
    next += contact.term->numMultipliers();
  }
  return scales;
}

template ResidualScales residualScales(const Model<2>&);
template ResidualScales residualScales(const Model<3>&);

}  // namespace burnish
