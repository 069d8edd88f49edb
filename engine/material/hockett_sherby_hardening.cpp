#include "engine/material/hockett_sherby_hardening.h"

#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "engine/material/power_term.h"

namespace burnish::inline material {
namespace {

/// ∫_0^x exp(−(N e)^p) de by the regularised lower incomplete gamma function P.
double integral(double N, double p, double x) {
  return std::tgamma(1.0 + 1.0 / p) / N * Eigen::numext::igamma(1.0 / p, std::pow(N * x, p));
}

}  // namespace

double HockettSherbyHardening::sigma_y(double e) const {
  return sigmaInf - (sigmaInf - sigma0) * std::exp(-std::pow(rate * (e + kLeastPlasticStrain), exponent));
}

double HockettSherbyHardening::slope(double e) const {
  const double power = std::pow(rate * (e + kLeastPlasticStrain), exponent);
  return (sigmaInf - sigma0) * std::exp(-power) * exponent * power / (e + kLeastPlasticStrain);
}

double HockettSherbyHardening::work(double e) const {
  const double grown =
      integral(rate, exponent, e + kLeastPlasticStrain) - integral(rate, exponent, kLeastPlasticStrain);
  return sigmaInf * e - (sigmaInf - sigma0) * grown;
}

}  // namespace burnish::inline material
