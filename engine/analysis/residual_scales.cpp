#include "engine/analysis/residual_scales.h"

#include <algorithm>

namespace burnish::inline analysis {

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
  const auto add = [&](const auto& contact) {
    const int count = contact.term->numMultipliers();
    scales.constraints.segment(next, count) = sizeAt(contact.place) * contact.term->weights().head(count);
    next += count;
  };
  for (const auto& pair : model.contacts()) add(pair);
  for (const auto& pair : model.pairs()) add(pair);
  for (const auto& contact : model.selfContacts()) add(contact);
  for (const auto& tool : model.tools())
    for (std::size_t dof = kTurn; dof < kAllToolDofs; ++dof)
      if (tool->isFree(dof))
        scales.turns.emplace_back(tool->unknowns[dof],
                                  std::max(1.0, tool->turnLength / tool->shape.halfThickness()));
  return scales;
}

template ResidualScales residualScales(const Model<2>&);
template ResidualScales residualScales(const Model<3>&);

}  // namespace burnish::inline analysis
