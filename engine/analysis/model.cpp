#include "engine/analysis/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish {

template <int Dim>
Model<Dim>::Model(const Scene& scene, NamedBody<Dim> named)
    : body_(std::move(named.body)),
      faces_(body_, std::move(named.names)),
      supports_(scene, faces_),
      prescribed_(supports_.prescribed()),
      corners_(supports_.corners()),
      numForces_(numDisplacements()),
      numUnknowns_(numForces_) {}

template <int Dim>
std::size_t Model<Dim>::toolNumber(const std::string& name) const {
  const auto found =
      std::find_if(tools_.begin(), tools_.end(), [&](const auto& tool) { return tool->name == name; });
  return static_cast<std::size_t>(found - tools_.begin());
}

template <int Dim>
std::vector<Term*> Model<Dim>::terms() const {
  std::vector<Term*> terms{bulk_.get()};
  for (const auto& pair : contacts_) terms.push_back(pair.term.get());
  for (const auto& contact : selfContacts_) terms.push_back(contact.term.get());
  for (const auto& load : loads_) terms.push_back(load.get());
  for (const auto& load : toolLoads_) terms.push_back(load.term.get());
  if (stabilisation_) terms.push_back(stabilisation_.get());
  return terms;
}

template <int Dim>
Eigen::VectorXd Model<Dim>::target(double t) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(numUnknowns_);
  supports_.setValues(t, values);
  return values - origin_;
}

template <int Dim>
double Model<Dim>::forceFloor() const {
  return kForceFloor * youngsModulus(bulk_->material()) *
         std::pow(body_.size(), body_.axisymmetric ? 2 : Dim - 1);
}

template <int Dim>
double Model<Dim>::stabilisedShare(const std::vector<Eigen::VectorXd>& forces) const {
  if (!stabilisation_ || stabilisation_->force() < forceFloor()) return 0.0;
  const Eigen::Index n = numDisplacements();
  double largest = stabilisation_->force();
  for (std::size_t k = 1; k + 1 < forces.size(); ++k)  // the body's own forces hold one another
    largest = std::max(largest, forces[k].head(n).template lpNorm<1>());
  return stabilisation_->force() / largest;
}

template class Model<2>;
template class Model<3>;

}  // namespace burnish
