#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace burnish::inline core {

/// A number, or a formula in variables and in names that are defined elsewhere.
struct FormulaText {
  std::string text;

  bool operator==(const FormulaText&) const = default;
};

/// A name for a formula, to be used in the formulas after it.
struct DefinitionSpec {
  std::string name;
  FormulaText formula;
};

/// Throws `Error` for what muparser takes and a formula may not have: assignments, and commas outside of
/// functions, as in 0,5.
void requireSingleValue(const std::string& formula);

/// The value of a formula is not finite at a point that a run has come to.
class FormulaError : public RunError {
 public:
  using RunError::RunError;
};

/// A formula in the reference coordinates X, Y, Z and the time t, or in other variables, with the operators
/// and functions of muparser (sin, exp, ln, sqrt, ^, a ? b : c, ...) and _pi. Copies share their state: one
/// thread at a time.
class Formula {
 public:
  /// Throws `Error` that quotes the formula and says what is wrong with it, or with the definition it uses.
  explicit Formula(const FormulaText& formula, const std::vector<DefinitionSpec>& definitions = {},
                   std::vector<std::string> variables = {"X", "Y", "Z", "t"});

  /// Value at the point X and the time t. Throws `Error` if it is not finite.
  double operator()(const Eigen::Vector3d& X, double t) const;

  /// Value for the values of all variables, in their order. Throws `Error` if it is not finite.
  double at(std::span<const double> values) const;

  /// Value of a formula without coordinates and time.
  double constant() const { return (*this)(Eigen::Vector3d::Zero(), 0.0); }

  /// Whether the formula or a definition that it needs names the variable.
  bool dependsOn(const std::string& variable) const;

 private:
  struct Parsers;
  std::shared_ptr<Parsers> parsers_;
};

/// Throws `FormulaError` if a formula in X, Y, Z and t has no finite value at one of the points (columns) at
/// one of the times. Of very many pairs of the two only a part is looked at, the last time always.
void requireFinite(const std::vector<Formula>& formulas, const Eigen::Matrix3Xd& points,
                   const std::vector<double>& times);

/// One formula in X, Y, Z and t per text. Throws as the constructor does.
std::vector<Formula> makeFormulas(const std::vector<FormulaText>& texts,
                                  const std::vector<DefinitionSpec>& definitions);

}  // namespace burnish::inline core
