#include "engine/fit/law_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "engine/core/error.h"
#include "engine/fit/separable_fit.h"
#include "engine/material/material.h"
#include "engine/schema/mapping_writer.h"

namespace burnish::inline fit {
namespace {

/// Bulk modulus over shear modulus of rubbers: stresses differ by less than 0.1 % from those of incompressible
/// ones.
constexpr double kBulkRatio = 1000.0;

/// As many digits as a fit can mean something with.
double rounded(double value, int digits = 7) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

/// Where a curve's points are, and what they weigh.
struct Points {
  std::vector<RubberTest> tests;
  std::vector<double> x;
  Eigen::VectorXd y, weights;
  std::vector<std::size_t> curves;  ///< that the points are of
  std::size_t numLeftOut = 0;

  Points(const std::vector<MeasuredCurve>& measured, FitResiduals residuals) {
    double largest = 0.0;
    std::vector<double> values;
    for (std::size_t c = 0; c < measured.size(); ++c)
      for (std::size_t k = 0; k < measured[c].x.size(); ++k) {
        const double value = measured[c].y[k];
        if (residuals == FitResiduals::Relative && value == 0.0) {
          ++numLeftOut;
          continue;
        }
        largest = std::max(largest, std::abs(value));
        tests.push_back(measured[c].test);
        x.push_back(measured[c].x[k]);
        curves.push_back(c);
        values.push_back(value);
      }
    y = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
    weights = residuals == FitResiduals::Relative ? Eigen::VectorXd(y.cwiseInverse())
                                                  : Eigen::VectorXd::Constant(y.size(), 1.0 / largest);
  }

  Eigen::Index size() const { return y.size(); }
};

/// A law with constants of which some are factors of its stress: what `make` makes of unit factors are the
/// functions that the stress is a sum of.
template <class Law>
struct Fitting {
  const char* name;
  int numFactors;
  int numShapes;
  std::vector<double> starts;
  std::function<Law(const Eigen::VectorXd& factors, const Eigen::VectorXd& shapes)> make;
  double (*value)(const Law& law, RubberTest test, double x);
  bool (*admits)(const Law& law);
};

template <class Law>
SeparableModel modelOf(const Fitting<Law>& fitting, const Points& points) {
  SeparableModel model;
  model.numShapes = fitting.numShapes;
  model.starts = fitting.starts;
  model.functions = [&](const Eigen::VectorXd& shapes) {
    Eigen::MatrixXd functions(points.size(), fitting.numFactors);
    for (int k = 0; k < fitting.numFactors; ++k) {
      const Law unit = fitting.make(Eigen::VectorXd::Unit(fitting.numFactors, k), shapes);
      for (Eigen::Index i = 0; i < points.size(); ++i) {
        const auto p = static_cast<std::size_t>(i);
        functions(i, k) = fitting.value(unit, points.tests[p], points.x[p]);
      }
    }
    return functions;
  };
  model.admits = [&](const Eigen::VectorXd& factors, const Eigen::VectorXd& shapes) {
    return factors.allFinite() && fitting.admits(fitting.make(factors, shapes));
  };
  return model;
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

/// The law with 7 digits, and what is told of any fit.
template <class Law>
std::pair<Law, LawFit> fitted(const Fitting<Law>& fitting, const std::vector<MeasuredCurve>& curves,
                              const FitOptions& options, const char* xName) {
  const Points points(curves, options.residuals);
  const int numConstants = fitting.numFactors + fitting.numShapes;
  if (points.size() < numConstants)
    throw Error(fmt::format("found {} points for {} constants of {}; allowed: as many or more{}",
                            points.size(), numConstants, fitting.name,
                            points.numLeftOut > 0 ? " (those without stress say nothing)" : ""));
  const auto fit = fitSeparable(modelOf(fitting, points), points.y, points.weights);
  if (!fit)
    throw Error(fmt::format(
        "{}: no constants that make sense fit these points; {}do the columns hold what the law is about, in "
        "consistent units?",
        fitting.name, fitting.numShapes > 1 ? "do they tell so many terms apart, and " : ""));
  const auto round = [](double value) { return rounded(value); };
  Law law = fitting.make(fit->factors.unaryExpr(round), fit->shapes.unaryExpr(round));
  LawFit result;
  result.rms = fit->rms();
  result.value = [law, value = fitting.value](RubberTest test, double x) { return value(law, test, x); };
  const char* of = options.residuals == FitResiduals::Relative ? "relative" : "of the largest stress";
  Eigen::Index worst = 0;
  const double largest = fit->residuals.cwiseAbs().maxCoeff(&worst);
  const auto w = static_cast<std::size_t>(worst);
  result.account.push_back(fmt::format("{}: rms error {} ({}), largest {} at {} {:.4g}", fitting.name,
                                       percent(result.rms), of, percent(largest), xName, points.x[w]));
  for (std::size_t c = 0; c < curves.size(); ++c) {
    double sum = 0.0, count = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      if (points.curves[i] != c) continue;
      sum += std::pow(fit->residuals[static_cast<Eigen::Index>(i)], 2);
      count += 1.0;
      low = std::min(low, points.x[i]);
      high = std::max(high, points.x[i]);
    }
    if (count > 0.0)
      result.account.push_back(fmt::format("{}: {} points from {} {:.4g} to {:.4g}, rms error {}",
                                           curves[c].name, count, xName, low, high,
                                           percent(std::sqrt(sum / count))));
  }
  if (points.numLeftOut > 0)
    result.account.push_back(fmt::format("{} points without stress left out", points.numLeftOut));
  return {std::move(law), std::move(result)};
}

/// The first stretch on the way from 1 to `end` from which on the stress no longer grows with the stretch.
template <class Energy>
std::optional<double> endOfStability(const Energy& energy, RubberTest test, double end) {
  const auto grows = [&](double stretch) {
    const double h = 1e-5 * stretch;
    return nominalStress(energy, test, stretch + h) > nominalStress(energy, test, stretch - h);
  };
  constexpr int kPlaces = 400;
  const auto at = [&](double share) { return std::exp(share * std::log(end)); };
  double stable = 0.0;
  for (int k = 1; k <= kPlaces; ++k) {
    double unstable = static_cast<double>(k) / kPlaces;
    if (grows(at(unstable))) {
      stable = unstable;
      continue;
    }
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (stable + unstable);
      (grows(at(middle)) ? stable : unstable) = middle;
    }
    return at(stable);
  }
  return std::nullopt;
}

/// Tells how far the stress grows with the stretch, beyond the points too.
template <class Energy>
void judgeStability(const Energy& energy, const std::vector<MeasuredCurve>& curves, LawFit& fit) {
  double largest = 5.0, low = 1.0, high = 1.0;
  for (const MeasuredCurve& curve : curves)
    for (const double stretch : curve.x) {
      largest = std::max({largest, stretch, 1.0 / stretch});
      low = std::min(low, stretch);
      high = std::max(high, stretch);
    }
  const double end = 2.0 * largest;
  bool isStable = true;
  for (const RubberTest test : kRubberTests)
    for (const double way : {end, 1.0 / end})
      if (const auto stretch = endOfStability(energy, test, way)) {
        isStable = false;
        const bool isTension = way > 1.0;
        const bool isWithin = isTension ? *stretch < high : *stretch > low;
        fit.warnings.push_back(fmt::format(
            "{} {}: {} the stretch {:.4g} the stress no longer {} with it{}; a body that goes there is unstable",
            wordOf(test), isTension ? "tension" : "compression", isTension ? "beyond" : "below", *stretch,
            isTension ? "grows" : "falls", isWithin ? ", within the range of the points" : ""));
      }
  if (isStable)
    fit.account.push_back(
        fmt::format("stable in all three tests, for stretches from {:.3g} to {:.3g}: the stress "
                    "grows with the stretch",
                    1.0 / end, end));
}

/// What a scene says of its material.
struct MaterialBlock {
  MaterialParameters material;
};

template <class Visitor>
void describe(Visitor& v, MaterialBlock& s) {
  v.field("material", s.material, {}, "");
}

struct HardeningBlock {
  HardeningParameters hardening;
};

template <class Visitor>
void describe(Visitor& v, HardeningBlock& s) {
  v.field("hardening", s.hardening, {}, "");
}

/// Constants of cyclic plasticity, as a scene has them below `material`.
struct CyclicLaw {
  LinearHardening yield;  ///< that stays the same
  std::vector<BackStress> backStresses;

  /// Amplitude of the stress in a stable cycle of plastic strain: σ_y + Σ C/γ tanh(γ Δ/2).
  double amplitude(double range) const {
    double stress = yield.sigma0;
    for (const auto& [C, gamma, exponent] : backStresses)
      stress += C / gamma * std::tanh(0.5 * gamma * range);
    return stress;
  }
};

template <class Visitor>
void describe(Visitor& v, CyclicLaw& s) {
  HardeningParameters hardening = s.yield;
  v.field("hardening", hardening, {}, "");
  v.field("back_stresses", s.backStresses, {}, "");
}

template <class Energy>
std::pair<Energy, LawFit> fitRubber(const Fitting<Energy>& fitting, const std::vector<MeasuredCurve>& curves,
                                    const FitOptions& options) {
  auto [energy, fit] = fitted(fitting, curves, options, "stretch");
  fit.account.push_back(fmt::format("initial shear modulus {:.6g}", energy.shearModulus()));
  judgeStability(energy, curves, fit);
  return {std::move(energy), std::move(fit)};
}

template <class Energy>
LawFit fitNearlyIncompressible(const Fitting<Energy>& fitting, const std::vector<MeasuredCurve>& curves,
                               const FitOptions& options) {
  auto [energy, fit] = fitRubber(fitting, curves, options);
  const double kappa = rounded(kBulkRatio * energy.shearModulus(), 4);
  fit.account.push_back(
      "kappa is not measured: a thousand times the shear modulus; with `formulation: fbar` in the "
      "scene");
  fit.yaml = yamlOf(MaterialBlock{HyperelasticParameters<Energy>{std::move(energy), {}, kappa}});
  return fit;
}

template <class Energy>
bool hasStiffness(const Energy& energy) {
  return energy.shearModulus() > 0.0;
}

LawFit fitNeoHookean(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  // The limit of the compressible law is that of Mooney and Rivlin with one constant.
  const Fitting<MooneyRivlin> fitting{.name = "neo-hookean",
                                      .numFactors = 1,
                                      .numShapes = 0,
                                      .starts = {},
                                      .make =
                                          [](const Eigen::VectorXd& c, const Eigen::VectorXd&) {
                                            return MooneyRivlin{c[0], 0.0};
                                          },
                                      .value = nominalStress<MooneyRivlin>,
                                      .admits = hasStiffness<MooneyRivlin>};
  auto [energy, fit] = fitRubber(fitting, curves, options);
  const double nu = rounded(0.5 * (3.0 * kBulkRatio - 2.0) / (3.0 * kBulkRatio + 1.0), 4);
  fit.account.push_back(
      "nu is not measured: a bulk modulus of a thousand times the shear modulus; with "
      "`formulation: fbar` in the scene");
  fit.yaml = yamlOf(MaterialBlock{
      NeoHookean::Parameters{.E = rounded(2.0 * energy.shearModulus() * (1.0 + nu)), .nu = nu}});
  return fit;
}

LawFit fitMooneyRivlin(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  return fitNearlyIncompressible<MooneyRivlin>({.name = "mooney-rivlin",
                                                .numFactors = 2,
                                                .numShapes = 0,
                                                .starts = {},
                                                .make =
                                                    [](const Eigen::VectorXd& c, const Eigen::VectorXd&) {
                                                      return MooneyRivlin{c[0], c[1]};
                                                    },
                                                .value = nominalStress<MooneyRivlin>,
                                                .admits = hasStiffness<MooneyRivlin>},
                                               curves, options);
}

LawFit fitYeoh(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  return fitNearlyIncompressible<Yeoh>({.name = "yeoh",
                                        .numFactors = 3,
                                        .numShapes = 0,
                                        .starts = {},
                                        .make =
                                            [](const Eigen::VectorXd& c, const Eigen::VectorXd&) {
                                              return Yeoh{c[0], c[1], c[2]};
                                            },
                                        .value = nominalStress<Yeoh>,
                                        .admits = hasStiffness<Yeoh>},
                                       curves, options);
}

/// Whether the terms are of their own: with more terms than the points can tell apart, exponents draw near to one
/// another, and factors without bound cancel.
bool isOgden(const Ogden& energy) {
  constexpr double kLargestShare = 10.0;  // of a term in the shear modulus
  const double mu = energy.shearModulus();
  if (!(mu > 0.0)) return false;
  for (std::size_t p = 0; p < energy.mu.size(); ++p)
    if (energy.alpha[p] == 0.0 || std::abs(energy.mu[p] * energy.alpha[p]) > kLargestShare * mu) return false;
  return true;
}

LawFit fitOgden(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  LawFit fit = fitNearlyIncompressible<Ogden>(
      {.name = "ogden",
       .numFactors = options.terms,
       .numShapes = options.terms,
       .starts = {-8.0, -6.0, -5.0, -4.0, -3.0, -2.0, -1.0, -0.5, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0,
                  10.0, 12.0},
       .make =
           [](const Eigen::VectorXd& mu, const Eigen::VectorXd& alpha) {
             return Ogden{{mu.begin(), mu.end()}, {alpha.begin(), alpha.end()}};
           },
       .value = nominalStress<Ogden>,
       .admits = isOgden},
      curves, options);
  fit.account.push_back("form of the energy: sum of mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)");
  return fit;
}

/// From 10^from to 10^to, `perDecade` values in each decade.
std::vector<double> decades(int from, int to, int perDecade) {
  std::vector<double> values;
  for (int k = from * perDecade; k <= to * perDecade; ++k)
    values.push_back(std::pow(10.0, static_cast<double>(k) / perDecade));
  return values;
}

LawFit fitVoce(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  auto [law, fit] = fitted<VoceHardening>(
      {.name = "voce",
       .numFactors = 2,
       .numShapes = 1,
       .starts = decades(-1, 4, 8),
       .make =
           [](const Eigen::VectorXd& c, const Eigen::VectorXd& shapes) {
             VoceHardening voce;
             voce.sigma0 = c[0];
             voce.sigmaInf = c[1];
             voce.beta = shapes[0];
             return voce;
           },
       .value = [](const VoceHardening& voce, RubberTest, double ep) { return voce.sigma_y(ep); },
       .admits =
           [](const VoceHardening& voce) {
             return voce.sigma0 > 0.0 && voce.sigmaInf > 0.0 && voce.beta > 0.0;
           }},
      curves, options, "plastic strain");
  double largest = 0.0;
  for (const MeasuredCurve& curve : curves) largest = std::max(largest, *std::ranges::max_element(curve.x));
  if (law.beta * largest < 1.0)
    fit.warnings.push_back(
        fmt::format("the points end at a plastic strain of {:.3g}, before the stress saturates: "
                    "sigma_inf = {} is extrapolated",
                    largest, law.sigmaInf));
  fit.yaml = yamlOf(HardeningBlock{law});
  return fit;
}

LawFit fitChaboche(const std::vector<MeasuredCurve>& curves, const FitOptions& options) {
  const auto make = [](const Eigen::VectorXd& factors, const Eigen::VectorXd& gamma) {
    CyclicLaw law{{.sigma0 = factors[0], .modulus = 0.0}, {}};
    for (Eigen::Index k = 0; k < gamma.size(); ++k) law.backStresses.push_back({factors[k + 1], gamma[k]});
    return law;
  };
  const auto admits = [](const CyclicLaw& law) {
    return law.yield.sigma0 > 0.0 && std::ranges::all_of(law.backStresses, [](const BackStress& part) {
             return part.modulus > 0.0 && part.recovery > 0.0;
           });
  };
  auto [law, fit] = fitted<CyclicLaw>(
      {.name = "chaboche",
       .numFactors = options.terms + 1,
       .numShapes = options.terms,
       .starts = decades(0, 5, 4),
       .make = make,
       .value = [](const CyclicLaw& cyclic, RubberTest, double range) { return cyclic.amplitude(range); },
       .admits = admits},
      curves, options, "plastic range");
  double largest = 0.0;
  for (const MeasuredCurve& curve : curves) largest = std::max(largest, *std::ranges::max_element(curve.x));
  for (const auto& [C, gamma, exponent] : law.backStresses) {
    fit.account.push_back(fmt::format("back stress with recovery {}: saturates at {:.4g}", gamma, C / gamma));
    if (0.5 * gamma * largest < 1.0)
      fit.warnings.push_back(
          fmt::format("the ranges end at {:.3g}, before the back stress with recovery {} saturates: "
                      "its limit {:.4g} is extrapolated",
                      largest, gamma, C / gamma));
  }
  fit.account.push_back(
      "for `law: chaboche`, with E and nu; the yield stress stays the same in a stable cycle");
  fit.yaml = yamlOf(std::move(law));
  return fit;
}

}  // namespace

const std::vector<FittableLaw>& fittableLaws() {
  static const std::vector<FittableLaw> laws{
      {"neo-hookean", "neo-Hookean", FitData::RubberTests, 0, 0, fitNeoHookean},
      {"mooney-rivlin", "Mooney-Rivlin", FitData::RubberTests, 0, 0, fitMooneyRivlin},
      {"yeoh", "Yeoh", FitData::RubberTests, 0, 0, fitYeoh},
      {"ogden", "Ogden", FitData::RubberTests, 3, 4, fitOgden},
      {"voce", "Voce", FitData::Flow, 0, 0, fitVoce},
      {"chaboche", "Chaboche", FitData::Cycles, 2, 4, fitChaboche},
  };
  return laws;
}

}  // namespace burnish::inline fit
