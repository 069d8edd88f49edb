#pragma once
#include <string>
#include <vector>

namespace burnish {

/// How far a value may be from the baseline's: by `relative` times the largest magnitude of the field in the
/// baseline, over all places and times, or by `absolute`, whichever is more.
struct Tolerance {
  double relative = 1e-6;
  double absolute = 0.0;
};

/// A tolerance of the fields whose names match a pattern of the shell (*, ?).
struct FieldTolerance {
  std::string pattern{};
  Tolerance tolerance;
};

/// When data count as equal, and which are compared at all.
struct DataRule {
  Tolerance tolerance;
  std::vector<FieldTolerance> fields{};  ///< instead of `tolerance`; the last one that matches holds
  std::vector<std::string> only{};       ///< patterns of names; all fields when empty
  std::vector<std::string> skip{};       ///< patterns of names
};

/// `NAME=R` or `NAME=R,A`. Throws `Error` that names the option for anything else.
FieldTolerance fieldToleranceFromText(const char* option, const std::string& text);

/// Throws `Error` that names the option unless the number is finite and not negative.
void requireTolerance(const char* option, double value);

Tolerance toleranceOf(const DataRule& rule, const std::string& field);

/// Whether `only` and `skip` leave a field to be compared.
bool isCompared(const DataRule& rule, const std::string& field);

/// Throws `Error` for a pattern of the rule that none of the names matches: a misspelt one would be of no
/// effect.
void requireMatches(const DataRule& rule, const std::vector<std::string>& names);

}  // namespace burnish
