#include "engine/analysis/settle.h"

#include <utility>
#include <vector>

#include "engine/analysis/contact_fit.h"

namespace burnish {
namespace {

/// λ_A of all pairs.
std::vector<Eigen::VectorXd> multipliersOf(const Simulation<2>& simulation) {
  const Eigen::VectorXd& x = simulation.stepping.state().x;
  std::vector<Eigen::VectorXd> multipliers;
  for (const auto& pair : simulation.model->contacts())
    multipliers.push_back(x.segment(pair.term->firstMultiplier(), pair.term->face().numFunctions()));
  return multipliers;
}

/// Calls f for every term of contact, with tools first.
template <class F>
void forEachContact(const Model<2>& model, const F& f) {
  for (const auto& pair : model.contacts()) f(*pair.term);
  for (const auto& contact : model.selfContacts()) f(*contact.term);
}

/// How much stiffer contact becomes: with the integral method the parameter weighs gaps against tractions, and
/// stays as it is.
double stiffnessOf(const FaceContact<2>& term) {
  return averagesGaps(term.options().method) ? kSettlingStiffness : 1.0;
}

/// Makes contact stiffer for as long as it lives.
class StifferContact {
 public:
  explicit StifferContact(const Model<2>& model) : model_(model) {
    forEachContact(model, [this](auto& term) {
      parameters_.push_back(term.parameter());
      term.setParameter(stiffnessOf(term) * parameters_.back());
    });
  }
  ~StifferContact() {
    auto parameter = parameters_.begin();
    forEachContact(model_, [&](auto& term) { term.setParameter(*parameter++); });
  }
  StifferContact(const StifferContact&) = delete;
  StifferContact& operator=(const StifferContact&) = delete;

 private:
  const Model<2>& model_;
  std::vector<double> parameters_;
};

/// Averaged gaps of every pair that should be closed and are not; zero elsewhere. In the state that the terms
/// have been evaluated at.
std::vector<Eigen::VectorXd> gapsAtStart(const Simulation<2>& simulation) {
  const auto multipliers = multipliersOf(simulation);
  const auto& contacts = simulation.model->contacts();
  std::vector<Eigen::VectorXd> atStart;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Eigen::VectorXd& gaps = contacts[k].term->state().averageGap;
    const auto toClose =
        gapsToClose(gaps, multipliers[k], kSettlingStiffness * contacts[k].term->parameter());
    atStart.emplace_back(Eigen::VectorXd::Zero(gaps.size()))(toClose) = gaps(toClose);
  }
  return atStart;
}

}  // namespace

Settlement settle(Simulation<2>& simulation, int parts) {
  Settlement result;
  NewtonReport& report = result.report;
  report.outcome = NewtonOutcome::Inadmissible;
  if (!simulation.evaluateHere().admissible) return result;
  const auto& contacts = simulation.model->contacts();
  const std::vector<Eigen::VectorXd> gaps = gapsAtStart(simulation);
  const StifferContact stiffer(*simulation.model);
  int iterations = 0;
  std::vector<Eigen::VectorXd> before = multipliersOf(simulation);
  for (int left = parts - 1; left >= 0; --left) {
    for (std::size_t k = 0; k < gaps.size(); ++k)
      contacts[k].term->measureGapsFrom(left == 0 ? Eigen::VectorXd()
                                                  : Eigen::VectorXd(gaps[k] * left / parts));
    report = simulation.stepping.settle();
    iterations += report.iterations;
    if (report.outcome != NewtonOutcome::Converged) break;
    std::vector<Eigen::VectorXd> now = multipliersOf(simulation);
    for (std::size_t k = 0; k < gaps.size(); ++k)
      result.gapWork += contacts[k]
                            .term->weights()
                            .head(gaps[k].size())
                            .dot((0.5 / parts * (before[k] + now[k])).cwiseProduct(gaps[k]));
    before = std::move(now);
  }
  report.iterations = iterations;
  return result;
}

}  // namespace burnish
