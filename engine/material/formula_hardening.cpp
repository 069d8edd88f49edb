#include "engine/material/formula_hardening.h"

#include <fmt/format.h>
#include <muParser.h>

#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/formula.h"
#include "engine/core/formula_words.h"
#include "engine/core/quoted.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

std::shared_ptr<const PiecewiseChebyshev> interpolateFormula(const std::string& formula) {
  const std::string place = "hardening formula " + quoted(formula) + ": ";
  double ep = 0.0;
  double initial = 0.0;
  mu::Parser parser;
  requireSingleValue(formula);
  try {
    parser.DefineVar("ep", &ep);
    defineConstants(parser, {});
    parser.SetExpr(formula);
    initial = parser.Eval();
  } catch (const mu::ParserError& problem) {
    throw Error(place + formulaProblem(formula, problem) + "; write the yield stress as a function of ep");
  }
  if (!(initial > 0.0) || !std::isfinite(initial))
    throw Error(place + "the yield stress at ep = 0 is " + std::to_string(initial) + ", it must be positive");
  const auto evaluate = [&](double e) {
    ep = e;
    return parser.Eval();
  };
  try {
    return std::make_shared<const PiecewiseChebyshev>(evaluate);
  } catch (const Error& problem) {
    throw Error(place + problem.what());
  }
}

}  // namespace

FormulaHardening::FormulaHardening(const Parameters& law) : curve_(interpolateFormula(law.formula)) {}

void check(const FormulaHardening::Parameters& law, const Problems& problems, const std::string& key) {
  const std::string path = key + ".formula";
  if (!problems.clean(path)) return;
  try {
    const double yield = Formula({law.formula}, {}, {"ep"}).at(std::array{0.0});
    if (yield <= 0.0)
      problems.report(
          path,
          fmt::format("found a yield stress of {} at ep = 0; allowed: a formula that is positive there.",
                      yield));
  } catch (const FormulaError&) {
    problems.report(path,
                    "found no finite yield stress at ep = 0; allowed: a formula that is positive there.");
  } catch (const Error& e) {
    problems.report(path, fmt::format("{}; allowed: a formula in ep.", e.what()));
  }
}

}  // namespace burnish::inline material
