#include "engine/analysis/settle.h"

#include <utility>
#include <vector>

#include "engine/analysis/contact_fit.h"

namespace burnish::inline analysis {
namespace {

/// Terms of the contacts of a body with tools that are there and with other bodies.
template <int Dim>
std::vector<FaceContact<Dim>*> touchesOf(const Model<Dim>& model, const ModelBody<Dim>& body) {
  std::vector<FaceContact<Dim>*> terms;
  for (const auto& pair : model.contacts())
    if (&model.bodyOf(pair.place) == &body && !model.hasLeft(pair.tool)) terms.push_back(pair.term.get());
  for (const auto& pair : model.pairs())
    if (model.touches(pair, body)) terms.push_back(pair.term.get());
  return terms;
}

/// λ_A of contacts; of one whose multipliers are not all there, those that the evaluation answered with.
template <int Dim>
std::vector<Eigen::VectorXd> multipliersOf(const std::vector<FaceContact<Dim>*>& terms,
                                           const Eigen::VectorXd& x) {
  std::vector<Eigen::VectorXd> multipliers;
  for (const FaceContact<Dim>* term : terms)
    multipliers.push_back(term->hasAllMultipliers() ? Eigen::VectorXd(x.segment(term->firstMultiplier(),
                                                                                term->face().numFunctions()))
                                                    : term->state().lambdaHat);
  return multipliers;
}

/// How much stiffer contact becomes: with the integral method the parameter weighs gaps against tractions, and
/// stays as it is.
template <int Dim>
double stiffnessOf(const FaceContact<Dim>& term) {
  return averagesGaps(term.options().method) ? kSettlingStiffness : 1.0;
}

/// Makes contacts stiffer for as long as it lives.
template <int Dim>
class StifferContact {
 public:
  explicit StifferContact(std::vector<FaceContact<Dim>*> terms) : terms_(std::move(terms)) {
    for (FaceContact<Dim>* term : terms_) {
      parameters_.push_back(term->parameter());
      term->setParameter(stiffnessOf(*term) * parameters_.back());
    }
  }
  ~StifferContact() {
    for (std::size_t k = 0; k < terms_.size(); ++k) terms_[k]->setParameter(parameters_[k]);
  }
  StifferContact(const StifferContact&) = delete;
  StifferContact& operator=(const StifferContact&) = delete;

 private:
  std::vector<FaceContact<Dim>*> terms_;
  std::vector<double> parameters_;
};

/// Averaged gaps of every contact that should be closed and are not; zero elsewhere. In the state x that the
/// terms have been evaluated at.
template <int Dim>
std::vector<Eigen::VectorXd> gapsAtStart(const std::vector<FaceContact<Dim>*>& terms,
                                         const Eigen::VectorXd& x) {
  const auto multipliers = multipliersOf(terms, x);
  std::vector<Eigen::VectorXd> atStart;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const Eigen::VectorXd& gaps = terms[k]->state().averageGap;
    const auto toClose = gapsToClose(gaps, multipliers[k], kSettlingStiffness * terms[k]->parameter());
    atStart.emplace_back(Eigen::VectorXd::Zero(gaps.size()))(toClose) = gaps(toClose);
  }
  return atStart;
}

/// Of the forces that are out of balance at the start what is still held back; empty for none. residual: of all unknowns.
Eigen::VectorXd heldBack(const Model<3>& model, const Eigen::VectorXd& residual, int left, int parts) {
  if (left == 0) return {};
  Eigen::VectorXd held = Eigen::VectorXd::Zero(residual.size());
  held.head(model.numForces()) = residual.head(model.numForces()) * left / parts;
  return held;
}

}  // namespace

template <int Dim>
Settlement settle(Simulation<Dim>& simulation, const ModelBody<Dim>& body, int parts) {
  Settlement result;
  NewtonReport& report = result.report;
  report.outcome = NewtonOutcome::Inadmissible;
  const auto forces = simulation.evaluateHere();
  if (!forces.admissible) return result;
  const Model<Dim>& model = *simulation.model;
  const Eigen::VectorXd& x = simulation.stepping.state().x;
  const std::vector<FaceContact<Dim>*> terms = touchesOf(model, body);
  const std::vector<Eigen::VectorXd> gaps = gapsAtStart(terms, x);
  std::vector<FaceContact<Dim>*> stiffened = terms;
  for (const auto& contact : model.selfContacts())
    if (&model.bodyOf(contact.place) == &body) stiffened.push_back(contact.term.get());
  const StifferContact<Dim> stiffer(std::move(stiffened));
  int iterations = 0;
  std::vector<Eigen::VectorXd> before = multipliersOf(terms, x);
  for (int left = parts - 1; left >= 0; --left) {
    for (std::size_t k = 0; k < gaps.size(); ++k)
      terms[k]->measureGapsFrom(left == 0 ? Eigen::VectorXd() : Eigen::VectorXd(gaps[k] * left / parts));
    if constexpr (Dim == 3) simulation.newton.hold(heldBack(model, forces.onSupports, left, parts));
    report = simulation.stepping.settle();
    iterations += report.iterations;
    if (report.outcome != NewtonOutcome::Converged) break;
    std::vector<Eigen::VectorXd> now = multipliersOf(terms, x);
    for (std::size_t k = 0; k < gaps.size(); ++k)
      result.gapWork +=
          terms[k]->functionWeights().dot((0.5 / parts * (before[k] + now[k])).cwiseProduct(gaps[k]));
    before = std::move(now);
  }
  if constexpr (Dim == 3) simulation.newton.hold({});
  report.iterations = iterations;
  return result;
}

template Settlement settle(Simulation<2>&, const ModelBody<2>&, int);
template Settlement settle(Simulation<3>&, const ModelBody<3>&, int);

}  // namespace burnish::inline analysis
