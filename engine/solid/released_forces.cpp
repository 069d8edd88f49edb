#include "engine/solid/released_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish::inline solid {

ReleasedForces::ReleasedForces(Eigen::Index numDisplacements, std::vector<Release> releases)
    : releases_(std::move(releases)) {
  forces_.setZero(numDisplacements);
  for (const Release& release : releases_)
    carried_.emplace_back(Eigen::VectorXd::Zero(std::ssize(release.unknowns)));
}

void ReleasedForces::letGo(double t, const Eigen::VectorXd& force) {
  for (std::size_t k = 0; k < releases_.size(); ++k)
    if (std::abs(releases_[k].begin - t) <= 1e-9 * t) carried_[k] = force(releases_[k].unknowns);
  takeForcesAt(t);
}

void ReleasedForces::takeForcesAt(double t) {
  forces_.setZero();
  for (std::size_t k = 0; k < releases_.size(); ++k) {
    const auto& [begin, end, unknowns] = releases_[k];
    forces_(unknowns) += std::clamp((end - t) / (end - begin), 0.0, 1.0) * carried_[k];
  }
}

bool ReleasedForces::evaluate(double t, const Eigen::VectorXd&, Assembly& out) {
  takeForcesAt(t);
  out.force.head(forces_.size()) -= forces_;
  return true;
}

void ReleasedForces::archive(StateArchive& archive) {
  for (std::size_t k = 0; k < carried_.size(); ++k)
    archive.fixedField(fmt::format("carried{}", k), carried_[k]);
}

}  // namespace burnish::inline solid
