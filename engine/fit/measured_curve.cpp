#include "engine/fit/measured_curve.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/measured_table.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"

namespace burnish::inline fit {
namespace {

constexpr std::array<std::pair<const char*, RubberTest>, 6> kModes{{{"uniaxial", RubberTest::Uniaxial},
                                                                    {"equibiaxial", RubberTest::Equibiaxial},
                                                                    {"biaxial", RubberTest::Equibiaxial},
                                                                    {"planar", RubberTest::Planar},
                                                                    {"pure-shear", RubberTest::Planar},
                                                                    {"plane-strain", RubberTest::Planar}}};

/// place: begins the message.
RubberTest rubberTest(const std::string& word, const std::string& place) {
  std::vector<std::string> words;
  for (const auto& [name, test] : kModes) {
    if (word == name) return test;
    words.emplace_back(name);
  }
  throw Error(fmt::format("{}: found {}; allowed: {}.{}", place, quoted(word), fmt::join(words, ", "),
                          didYouMean(word, words)));
}

/// Appends to the curve of this name and test, or a new one.
MeasuredCurve& curveOf(std::vector<MeasuredCurve>& curves, std::size_t first, const std::string& name,
                       RubberTest test) {
  for (std::size_t k = first; k < curves.size(); ++k)
    if (curves[k].test == test) return curves[k];
  return curves.emplace_back(MeasuredCurve{name, test, {}, {}});
}

/// Names that say the test alone, or the file too where several have the same test.
void nameCurves(std::vector<MeasuredCurve>& curves) {
  for (MeasuredCurve& curve : curves) {
    const auto sameTest = [&](const MeasuredCurve& other) { return other.test == curve.test; };
    curve.name = std::ranges::count_if(curves, sameTest) > 1
                     ? fmt::format("{}, {}", wordOf(curve.test), curve.name)
                     : wordOf(curve.test);
  }
}

void requirePositive(const MeasuredTable& table, std::size_t row, std::size_t column, double value) {
  if (!(value > 0.0))
    throw Error(fmt::format("{}: found {}; allowed: a positive number", table.place(row, column), value));
}

/// Two columns of positive stresses and of strains that are not negative.
MeasuredCurve plainCurve(const MeasuredTable& table, std::size_t xColumn, std::size_t yColumn) {
  MeasuredCurve curve{table.path().stem().string(), {}, {}, {}};
  for (std::size_t row = 0; row < table.numRows(); ++row) {
    curve.x.push_back(table.number(row, xColumn));
    curve.y.push_back(table.number(row, yColumn));
    if (curve.x.back() < 0.0)
      throw Error(fmt::format("{}: found {}; allowed: a number that is not negative",
                              table.place(row, xColumn), curve.x.back()));
    requirePositive(table, row, yColumn, curve.y.back());
  }
  return curve;
}

/// True stress over plastic strain of a tension test.
MeasuredCurve convertedCurve(const MeasuredTable& table, double youngsModulus, double from) {
  const std::size_t strainColumn = table.require({"strain"}, "the nominal strain of a tension test");
  const std::size_t stressColumn =
      table.require({"stress", "nominal_stress"}, "the nominal stress of a tension test");
  std::vector<double> strain, stress;
  for (std::size_t row = 0; row < table.numRows(); ++row) {
    strain.push_back(table.number(row, strainColumn));
    stress.push_back(table.number(row, stressColumn));
    requirePositive(table, row, strainColumn, 1.0 + strain.back());
  }
  MeasuredCurve curve{table.path().stem().string(), {}, {}, {}};
  const auto end = std::ranges::max_element(stress) - stress.begin();
  for (std::size_t k = 0; k <= static_cast<std::size_t>(end); ++k) {
    const double trueStress = stress[k] * (1.0 + strain[k]);
    const double plastic = std::log1p(strain[k]) - trueStress / youngsModulus;
    if (plastic < from || !(trueStress > 0.0)) continue;
    curve.x.push_back(plastic);
    curve.y.push_back(trueStress);
  }
  if (curve.x.empty())
    throw Error(
        fmt::format("{}: no point before the largest force has a plastic strain of {} or more; is Young's "
                    "modulus in the unit of the stresses, and is strain no percentage?",
                    table.path().string(), from));
  return curve;
}

}  // namespace

std::vector<MeasuredCurve> readRubberCurves(const std::vector<std::filesystem::path>& files,
                                            const std::vector<std::string>& modes) {
  if (modes.size() > 1 && modes.size() != files.size())
    throw Error(fmt::format("--mode: found {} for {} files; allowed: one for all, or one for each",
                            modes.size(), files.size()));
  std::vector<MeasuredCurve> curves;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const MeasuredTable table(files[f]);
    const bool isStrain = !table.find({"stretch"});
    const std::size_t xColumn = table.require({"stretch", "strain"}, "the stretch or the nominal strain");
    const std::size_t yColumn = table.require({"stress", "nominal_stress"}, "the nominal stress");
    const auto modeColumn = table.find({"mode"});
    if (modeColumn && !modes.empty())
      throw Error(fmt::format("--mode: {} has a column mode; leave one of them out", files[f].string()));
    if (!modeColumn && modes.empty())
      throw Error(
          fmt::format("{}: nothing says how the rubber was pulled; add a column mode, or --mode with "
                      "uniaxial, equibiaxial or planar",
                      files[f].string()));
    const std::size_t first = curves.size();
    for (std::size_t row = 0; row < table.numRows(); ++row) {
      const RubberTest test = modeColumn
                                  ? rubberTest(table.text(row, *modeColumn), table.place(row, *modeColumn))
                                  : rubberTest(modes[modes.size() > 1 ? f : 0], "--mode");
      const double stretch = table.number(row, xColumn) + (isStrain ? 1.0 : 0.0);
      if (!(stretch > 0.0))
        throw Error(fmt::format("{}: found a stretch of {}; allowed: a positive one",
                                table.place(row, xColumn), stretch));
      MeasuredCurve& curve = curveOf(curves, first, files[f].stem().string(), test);
      curve.x.push_back(stretch);
      curve.y.push_back(table.number(row, yColumn));
    }
  }
  nameCurves(curves);
  return curves;
}

std::vector<MeasuredCurve> readFlowCurves(const std::vector<std::filesystem::path>& files,
                                          const std::optional<double>& youngsModulus, double from) {
  std::vector<MeasuredCurve> curves;
  for (const std::filesystem::path& file : files) {
    const MeasuredTable table(file);
    curves.push_back(youngsModulus
                         ? convertedCurve(table, *youngsModulus, from)
                         : plainCurve(table,
                                      table.require({"plastic_strain"},
                                                    "the logarithmic plastic strain (--nominal E converts "
                                                    "nominal strains)"),
                                      table.require({"stress", "true_stress"}, "the true stress")));
  }
  return curves;
}

std::vector<MeasuredCurve> readCyclicCurves(const std::vector<std::filesystem::path>& files) {
  std::vector<MeasuredCurve> curves;
  for (const std::filesystem::path& file : files) {
    const MeasuredTable table(file);
    curves.push_back(plainCurve(
        table, table.require({"plastic_range"}, "the range of the plastic strain in a stable cycle"),
        table.require({"amplitude"}, "half the range of the stress")));
  }
  return curves;
}

}  // namespace burnish::inline fit
