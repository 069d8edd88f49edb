#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/formula.h"
#include "engine/results/history.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/probe/section_numbers.h"
#include "postproc/surface/face_roughness.h"

/// What is read off a run: the quantities of checks of scenes and of measures of studies.
namespace burnish {

/// The number that is made of a curve y(x). `oscillation`: standard deviation about the least-squares
/// quartic; `at`: linear interpolation.
enum class Reduction { First, Last, Max, Min, Mean, At, Oscillation };

/// A number from the history: y(x) restricted to a range of x and reduced. Expressions are formulas in the
/// columns.
struct HistoryMeasure {
  std::string x = "time", y;
  std::string where = "1";
  std::optional<std::array<double, 2>> range;
  Reduction reduce = Reduction::Last;
  std::optional<double> at;
};

/// A number of `summary.yaml`, such as iterations, cut_backs, seconds.
struct SummaryMeasure {
  std::string entry;
};

enum class LineReduction { Variation, Max, Min };

/// A projected field along a line of constant second parameter of the first patch, on which it is sampled at
/// 11 points per knot span. Variation: the sum of |differences|.
struct LineMeasure {
  std::string field;
  double time = 0.0;
  double height = 0.5;  ///< second parameter as a part of its range, 0 to 1
  LineReduction reduce = LineReduction::Variation;
};

/// How far y(x) is from that of another run, at the x that both have: the largest |difference| as a part of
/// the other run's largest |y|; with `tolerance`, the first x at which the difference exceeds this part.
struct DifferenceMeasure {
  std::string other;  ///< name of a run, in braces as above
  std::string x = "time", y;
  std::string where = "1";
  std::optional<std::array<double, 2>> range;
  std::optional<double> tolerance;
};

/// Median over all steps of the order log(r_k+1/r_k) / log(r_k/r_k-1) that the last residuals above rounding
/// show, from `convergence.csv`.
struct ConvergenceMeasure {};

/// A number of `DepthNumbers`, of a place with `depth`, at a time or at the end.
struct DepthMeasure {
  ProbeSpec place;
  std::string number;
  std::optional<double> time;
};

/// A number of `SectionNumbers`, at a time or at the end.
struct SectionMeasure {
  CutPlane plane;
  std::vector<std::string> bodies;  ///< all when empty
  std::string number;
  std::optional<double> time;
};

/// How far a depth profile of a field is from that of another run at the same time: the largest |difference|, of depths in a
/// range, as a part of the other's largest magnitude at any depth.
struct ProfileMeasure {
  ProbeSpec place;  ///< with one field
  std::string other;
  std::optional<std::array<double, 2>> range;  ///< all depths when left out
  std::optional<double> time;
};

/// Ra, Rq or Rz of a face of a plane body, Sa, Sq or Sz of one in space, at a time or at the end.
struct RoughnessMeasure {
  enum class Number { A, Q, Z };

  RoughnessSpec face;
  Number number = Number::A;
  std::optional<double> time;
};

using Quantity =
    std::variant<HistoryMeasure, SummaryMeasure, LineMeasure, DifferenceMeasure, ConvergenceMeasure,
                 DepthMeasure, SectionMeasure, ProfileMeasure, RoughnessMeasure>;

/// A quantity of a study, with a name.
struct MeasureSpec {
  std::string name;   ///< for claims
  std::string title;  ///< column of the table
  Quantity what;
};

/// Which row of a history counts: those of the reductions that choose one.
enum class RowReduction {
  Last = static_cast<int>(Reduction::Last),
  Max = static_cast<int>(Reduction::Max),
  Min = static_cast<int>(Reduction::Min)
};

/// The quantity of a check: a formula in columns of a history and definitions without coordinates.
struct CheckedQuantity {
  std::string formula;
  RowReduction reduction = RowReduction::Last;
  std::optional<double> time;  ///< the row of this time instead

  friend bool operator==(const CheckedQuantity&, const CheckedQuantity&) = default;
};

/// A table with the definitions that a formula mentions as further columns; `time` is one of its columns. Throws
/// `Error` for definitions that depend on coordinates or have the name of a column.
HistoryTable withDefinitions(HistoryTable table, const std::string& formula,
                             const std::vector<DefinitionSpec>& definitions);

/// The value of a checked quantity. Throws `Error` for columns that do not exist, values that are not finite,
/// and a time that has no row, with the nearest one.
double valueOf(const CheckedQuantity& quantity, const HistoryTable& history,
               const std::vector<DefinitionSpec>& definitions);

}  // namespace burnish
