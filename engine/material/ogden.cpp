#include "engine/material/ogden.h"

#include <fmt/format.h>

#include "engine/schema/problems.h"

namespace burnish::inline material {

double Ogden::shearModulus() const {
  double sum = 0.0;
  for (std::size_t p = 0; p < mu.size(); ++p) sum += mu[p] * alpha[p];
  return 0.5 * sum;
}

IsochoricPoint Ogden::at(const Eigen::Array3d& logStretches) const {
  IsochoricPoint point;
  for (std::size_t p = 0; p < mu.size(); ++p) {
    point.energy += mu[p] / alpha[p] * powerSum(logStretches, alpha[p]);
    point.add(mu[p], alpha[p]);
  }
  return point;
}

void check(const Ogden& energy, const Problems& problems) {
  if (!problems.clean("mu") || !problems.clean("alpha")) return;
  if (energy.alpha.size() != energy.mu.size())
    problems.report("alpha", fmt::format("found {} exponents for {} factors mu; allowed: one for each.",
                                         energy.alpha.size(), energy.mu.size()));
  for (std::size_t p = 0; p < energy.alpha.size(); ++p)
    if (energy.alpha[p] == 0.0)
      problems.report(fmt::format("alpha[{}]", p), "found 0; allowed: a positive or a negative exponent.");
}

}  // namespace burnish::inline material
