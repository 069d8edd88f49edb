#include "engine/analysis/model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace burnish::inline analysis {

namespace {

template <int Dim>
std::vector<ModelBody<Dim>> modelBodies(const Scene& scene, const std::vector<NamedBody<Dim>>& named) {
  std::vector<Body<Dim>> numbered;
  for (const NamedBody<Dim>& one : named) numbered.push_back(one.body);
  numberTogether(numbered);
  std::vector<ModelBody<Dim>> bodies;
  int patches = 0;
  for (std::size_t k = 0; k < named.size(); ++k) {
    bodies.push_back({scene.allBodies()[k].name, patches, std::move(numbered[k]), nullptr, nullptr});
    patches += static_cast<int>(named[k].names.size());
  }
  return bodies;
}

template <int Dim>
Body<Dim> united(const std::vector<ModelBody<Dim>>& bodies) {
  std::vector<Body<Dim>> all;
  for (const ModelBody<Dim>& one : bodies) all.push_back(one.body);
  return unitedBody(all);
}

template <int Dim>
std::vector<BodyNames> namesOf(const Scene& scene, const std::vector<NamedBody<Dim>>& named) {
  std::vector<BodyNames> names;
  for (std::size_t k = 0; k < named.size(); ++k) names.push_back({scene.allBodies()[k].name, named[k].names});
  return names;
}

}  // namespace

template <int Dim>
Model<Dim>::Model(const Scene& scene, const std::vector<NamedBody<Dim>>& bodies)
    : bodies_(modelBodies(scene, bodies)),
      body_(united(bodies_)),
      faces_(body_, namesOf(scene, bodies)),
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
  std::vector<Term*> terms;
  for (const auto& body : bodies_) terms.push_back(body.bulk.get());
  for (const auto& pair : contacts_) terms.push_back(pair.term.get());
  for (const auto& pair : pairs_) terms.push_back(pair.term.get());
  for (const auto& contact : selfContacts_) terms.push_back(contact.term.get());
  for (const auto& load : loads_) terms.push_back(load.get());
  for (const auto& load : toolLoads_)
    if (!hasLeft(load.tool)) terms.push_back(load.term.get());
  for (const auto& leaving : leaving_) terms.push_back(leaving.held.get());
  if (released_) terms.push_back(released_.get());
  if (stabilisation_) terms.push_back(stabilisation_.get());
  return terms;
}

template <int Dim>
bool Model<Dim>::hasLeft(std::size_t tool) const {
  return std::ranges::any_of(
      leaving_, [tool](const LeavingTool& leaving) { return leaving.tool == tool && leaving.hasLeft; });
}

template <int Dim>
bool Model<Dim>::releaseBehind(double t, const Eigen::VectorXd& x) {
  constexpr double kRounding = 1e-9;
  bool changes = false;
  const auto keep = [&](int unknown, double value) {
    kept_[unknown] = value;
    prescribed_[static_cast<std::size_t>(unknown)] = true;
  };
  for (LeavingTool& leaving : leaving_) {
    if (leaving.hasLeft || leaving.until > t * (1.0 + kRounding)) continue;
    leaving.hasLeft = changes = true;
    for (const int unknown : tools_[leaving.tool]->freeUnknowns()) keep(unknown, x(unknown));
    for (const auto& pair : contacts_) {
      if (pair.tool != leaving.tool) continue;
      pair.term->loseTouch();
      for (int k = 0; k < pair.term->numMultipliers(); ++k) keep(pair.term->firstMultiplier() + k, 0.0);
    }
  }
  if (!released_) return changes;  // no support ever lets go
  for (int unknown = 0; unknown < numDisplacements(); ++unknown) {
    const auto k = static_cast<std::size_t>(unknown);
    if (!prescribed_[k] || supports_.holdsBehind(t, unknown)) continue;
    prescribed_[k] = false;
    changes = true;
  }
  return changes;
}

template <int Dim>
void Model<Dim>::holdReleased(double t, const std::vector<Eigen::VectorXd>& forces) {
  if (released_) released_->letGo(t, forcesOnSupports(forces));
  for (LeavingTool& leaving : leaving_) {
    Eigen::VectorXd balanced = Eigen::VectorXd::Zero(numDisplacements());
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      if (contacts_[k].tool == leaving.tool) balanced -= forces[bodies_.size() + k].head(numDisplacements());
    leaving.held->letGo(t, balanced);
  }
}

template <int Dim>
Eigen::VectorXd Model<Dim>::forcesOnSupports(const std::vector<Eigen::VectorXd>& forces) const {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(numUnknowns_);
  for (const Eigen::VectorXd& force : forces) total += force;
  if (released_) total.head(numDisplacements()) += released_->nodalForces();
  return total;
}

template <int Dim>
Eigen::VectorXd Model<Dim>::target(double t) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(numUnknowns_);
  supports_.setValues(t, values);
  values -= origin_;
  for (const auto& [unknown, value] : kept_) values(unknown) = value;
  return values;
}

template <int Dim>
const ModelBody<Dim>& Model<Dim>::bodyOf(int patch) const {
  return *std::prev(std::find_if(bodies_.begin() + 1, bodies_.end(),
                                 [&](const ModelBody<Dim>& body) { return body.firstPatch > patch; }));
}

template <int Dim>
bool Model<Dim>::touches(const FacePair<Dim>& pair, const ModelBody<Dim>& body) const {
  const auto isOfBody = [&](const FacePlace& place) { return &bodyOf(place) == &body; };
  return isOfBody(pair.place) || std::any_of(pair.against.begin(), pair.against.end(), isOfBody);
}

template <int Dim>
double Model<Dim>::forceFloorOf(const ModelBody<Dim>& body) const {
  return kForceFloor * youngsModulus(body.bulk->material()) *
         std::pow(body.body.size(), body_.axisymmetric ? 2 : Dim - 1);
}

template <int Dim>
double Model<Dim>::forceFloor() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies_) smallest = std::min(smallest, forceFloorOf(body));
  return smallest;
}

template <int Dim>
Eigen::VectorXd Model<Dim>::bulkForces(const std::vector<Eigen::VectorXd>& forces) const {
  Eigen::VectorXd sum = forces.front();
  for (std::size_t k = 1; k < bodies_.size(); ++k) sum += forces[k];
  return sum;
}

template <int Dim>
double Model<Dim>::stabilisedShare(const std::vector<Eigen::VectorXd>& forces) const {
  if (!stabilisation_ || stabilisation_->force() < forceFloor()) return 0.0;
  const Eigen::Index n = numDisplacements();
  double largest = stabilisation_->force();
  for (std::size_t k = bodies_.size(); k + 1 < forces.size(); ++k)  // a body's own forces hold one another
    largest = std::max(largest, forces[k].head(n).template lpNorm<1>());
  return stabilisation_->force() / largest;
}

template class Model<2>;
template class Model<3>;

}  // namespace burnish::inline analysis
