#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/formula.h"

/// What numbers should be like: the expectations of checks of scenes and of claims of studies, and how they
/// are judged. Texts of formulas are numbers or formulas in definitions.
namespace burnish {

/// Every number is `value` within a tolerance.
struct ExpectedValue {
  FormulaText value;
  std::optional<double> relative, absolute;  ///< exactly one of the two
};

/// Every number lies between two bounds, ends included, of which one may be missing.
struct ExpectedRange {
  std::optional<FormulaText> atLeast, atMost;
};

/// The numbers are errors, which fall with this order of the size.
struct ExpectedOrder {
  double order = 1.0;
  double tolerance = 0.2;            ///< the observed order may be lower by so much
  std::optional<FormulaText> limit;  ///< the error is |number - limit|; the number itself when left out
  double floor = 0.0;                ///< meshes with a smaller error are left out
};

/// Each number is larger, or smaller, than the one before.
struct ExpectedTrend {
  enum class Direction { Increasing, Decreasing } direction = Direction::Increasing;
};

/// All numbers are the same within a tolerance relative to the largest magnitude.
struct ExpectedSameness {
  double relative = 0.01;
};

/// The numbers are apart by more than a part of the largest magnitude.
struct ExpectedDifference {
  double relative = 0.01;
};

/// A number that is judged, of a run or a mesh; none if it could not be had.
struct Observed {
  std::optional<double> value;
  double size = 1.0;                                         ///< of a cell or a step, for orders
  const std::vector<DefinitionSpec>* definitions = nullptr;  ///< that the expectation's formulas may name
};

enum class Verdict { Holds, DoesNotHold, CannotBeTold };

/// "holds", "does not hold", "cannot be told".
std::string verdictText(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::CannotBeTold;
  std::string expected, tolerance;  ///< in words
  std::string
      relation;  ///< to the bounds: =, >=, <=, in, order; increasing, decreasing, same and different have none
  std::vector<double> bounds{};                 ///< numbers of the expectation, of the finest mesh
  std::optional<double> margin;                 ///< the tolerance
  std::optional<double> deviation;              ///< the largest one, in the measure of the tolerance
  bool isShare = false;                         ///< deviation and tolerance are parts of a value
  std::vector<std::optional<double>> errors{};  ///< of all numbers, if an order is judged
  std::vector<std::optional<double>> orders{};  ///< observed from each of them to the next
  std::string problem;                          ///< why nothing could be judged
};

/// Judges numbers in their order, meshes from coarse to fine. The verdict stands as soon as the numbers that
/// are known settle it.
Judgement judge(const ExpectedValue& expect, const std::vector<Observed>& numbers);
Judgement judge(const ExpectedRange& expect, const std::vector<Observed>& numbers);
Judgement judge(const ExpectedOrder& expect, const std::vector<Observed>& numbers);
Judgement judge(const ExpectedTrend& expect, const std::vector<Observed>& numbers);
Judgement judge(const ExpectedSameness& expect, const std::vector<Observed>& numbers);
Judgement judge(const ExpectedDifference& expect, const std::vector<Observed>& numbers);

/// The same for one of several expectations.
template <class... Expected>
Judgement judge(const std::variant<Expected...>& expectation, const std::vector<Observed>& numbers) {
  return std::visit([&](const auto& expect) { return judge(expect, numbers); }, expectation);
}

/// What the checks of a scene can expect, and the claims of a study.
using CheckExpectation =
    std::variant<ExpectedValue, ExpectedRange, ExpectedOrder, ExpectedTrend, ExpectedSameness>;
using ClaimExpectation = std::variant<ExpectedTrend, ExpectedSameness, ExpectedDifference, ExpectedRange>;

}  // namespace burnish
