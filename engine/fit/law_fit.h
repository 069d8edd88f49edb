#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/fit/measured_curve.h"

namespace burnish::inline fit {

/// What a fit makes small.
enum class FitResiduals {
  Relative,  ///< Σ ((y − measured)/measured)²; points without stress are left out
  Absolute   ///< Σ (y − measured)²
};

struct FitOptions {
  int terms = 0;  ///< of laws with several alike; 0: as many as are usual
  FitResiduals residuals = FitResiduals::Relative;
};

/// Constants of a law that have been fitted, with 7 digits.
struct LawFit {
  std::string yaml;                   ///< to be pasted into a scene
  std::vector<std::string> account;   ///< sentences: error, range, what follows from the constants
  std::vector<std::string> warnings;  ///< where the law goes wrong with these constants
  double rms = 0.0;                   ///< of the residuals; absolute ones relative to the largest stress
  std::function<double(RubberTest test, double x)> value;  ///< the law's curve
};

/// What a law is fitted to.
enum class FitData { RubberTests, Flow, Cycles };

/// A law that can be fitted.
struct FittableLaw {
  const char* name;   ///< in scenes
  const char* words;  ///< in charts
  FitData data;
  int usualTerms;  ///< 0: the law has no number of terms
  int mostTerms;
  /// Throws `Error` if there are fewer points than constants, or no constants that make sense.
  LawFit (*fit)(const std::vector<MeasuredCurve>& curves, const FitOptions& options);
};

const std::vector<FittableLaw>& fittableLaws();

}  // namespace burnish::inline fit
