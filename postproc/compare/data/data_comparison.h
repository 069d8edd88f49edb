#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/compare/data/data_rule.h"
#include "postproc/compare/data/data_series.h"

namespace burnish {

enum class FieldVerdict {
  Equal,
  Different,
  NotANumber,
  UnitsDiffer,
  ComponentsDiffer,
  SizesDiffer,
  MeshesDiffer,
  TimesDiffer,
  NoBaseline,
  NoActual,
  Unusable
};

/// "equal", "different", "not-a-number", "units-differ", ...
std::string verdictName(FieldVerdict verdict);

/// The place at which a field differs most, and both values there.
struct WorstPlace {
  std::optional<double> time{};
  std::string component{};  ///< empty for a scalar
  std::string place{};      ///< "control point", ...
  Eigen::Index number = 0;
  std::string owner{};         ///< body or patch; may be empty
  Eigen::VectorXd position{};  ///< in the baseline; may be empty
  double actual = 0.0, baseline = 0.0;
  double difference = 0.0;  ///< infinite if one of them alone is not finite
};

/// What became of one field, over all times.
struct FieldComparison {
  std::string name{};   ///< with what tells it from others of its array: "stress (body)"
  std::string array{};  ///< without: "stress"; of fields whose values were compared
  FieldVerdict verdict = FieldVerdict::Equal;
  double allowed = 0.0;               ///< difference, from the tolerance
  long long differing = 0;            ///< values that differ by more
  long long compared = 0;             ///< values
  std::optional<WorstPlace> worst{};  ///< absent if all values are the same
  std::string message{};              ///< one line: what is wrong, where and how much
};

/// Compares instants of the same time, fields of the same name, and values at the same place, and names what
/// only one side has. Times are the same if they differ by less than a billionth of the largest one. Fields of
/// the baseline come first, in its order. names: gets the names that patterns of the rule may match.
std::vector<FieldComparison> compareSeries(const DataSeries& actual, const DataSeries& baseline,
                                           const DataRule& rule, std::vector<std::string>& names);

}  // namespace burnish
