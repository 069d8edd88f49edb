#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/fit/rubber_test.h"

namespace burnish::inline fit {

/// A measured curve, its points as the law that is fitted has them.
struct MeasuredCurve {
  std::string name;                        ///< for accounts and legends
  RubberTest test = RubberTest::Uniaxial;  ///< of a rubber
  std::vector<double> x, y;                ///< of the same length
};

/// Tests of rubbers: columns `stretch`, or `strain` (nominal), and `stress` (nominal), or `nominal_stress`; and
/// `mode`, one of uniaxial, equibiaxial (biaxial) and planar (pure-shear), unless modes say it: one for each
/// file, or one for all. x: stretches. Throws `Error` with the place.
std::vector<MeasuredCurve> readRubberCurves(const std::vector<std::filesystem::path>& files,
                                            const std::vector<std::string>& modes);

/// Tests of flow: columns `plastic_strain` (logarithmic) and `stress` (true), or `true_stress`. With a Young's
/// modulus they are instead `strain` and `stress`, both nominal, of tension tests: converted by
/// σ = s (1 + e), e_p = ln(1 + e) − σ/E up to the largest force, where necking begins, and from a plastic strain
/// of `from` on. x: plastic strains.
std::vector<MeasuredCurve> readFlowCurves(const std::vector<std::filesystem::path>& files,
                                          const std::optional<double>& youngsModulus, double from);

/// Stabilised cycles: columns `plastic_range`, from the lowest to the highest plastic strain of a cycle, and
/// `amplitude`, half the range of the stress. x: ranges.
std::vector<MeasuredCurve> readCyclicCurves(const std::vector<std::filesystem::path>& files);

}  // namespace burnish::inline fit
