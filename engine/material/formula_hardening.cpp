#include "engine/material/formula_hardening.h"

#include <muParser.h>

#include <cmath>

#include "engine/core/error.h"
#include "engine/core/formula.h"
#include "engine/core/formula_words.h"
#include "engine/core/quoted.h"

namespace burnish {
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
    throw Error(place + formulaProblem(formula, problem) + " Write the yield stress as a function of ep.");
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

FormulaHardening::FormulaHardening(const std::string& formula) : curve_(interpolateFormula(formula)) {}

}  // namespace burnish
