#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "postproc/study/evidence/expectation.h"
#include "postproc/study/evidence/quantity.h"
#include "postproc/study/figures/figure_spec.h"

/// A study as a value: which scenes are run with which settings, and what is drawn and said about them.
///
/// A *pattern* names runs; `*` stands for any part of a name. Texts in braces are replaced by parameters of
/// the run at hand: "{degree}" by the value, "{basis.label}" by its label.
namespace burnish {

/// A quantity that is varied: one run for every combination of the values of all parameters.
struct ParameterSpec {
  std::string name;
  std::vector<std::string> values;
  std::vector<std::string> labels;  ///< shown instead of the values; as many, or none
};

struct RunsSpec {
  std::string name;                  ///< "plastic-{basis}-{degree}"
  std::string scene;                 ///< file, relative to the study file
  std::vector<ParameterSpec> vary;   ///< none: one run
  std::vector<std::string> set;      ///< overrides "path=value", in braces as above
  std::optional<std::string> label;  ///< of legends and tables; the name when left out
};

/// What the values of a measure are like over some runs.
struct ClaimSpec {
  /// Growing in the order of the runs; all within a part of the largest magnitude, or not; all in a range.
  enum class Expect { Increasing, Equal, Different, Between };

  std::string text;
  std::string measure;              ///< name
  std::vector<ParameterSpec> vary;  ///< one claim for each combination
  std::vector<std::string> runs;    ///< names, in braces as above
  Expect expect = Expect::Increasing;
  std::optional<double> within;                ///< for `Equal` and `Different`
  std::optional<std::array<double, 2>> range;  ///< for `Between`

  /// The same in the language of all evidence.
  ClaimExpectation expectation() const;
};

/// A section of the document: text, a table with a row for each run and a column for each measure, and what
/// became of the claims.
struct StatementSpec {
  std::string name;
  std::string title, text;
  std::vector<std::string> runs;  ///< patterns; none: no table
  std::vector<MeasureSpec> measures;
  std::vector<ClaimSpec> claims;
  std::vector<std::string> figures;  ///< names; shown below the table
};

struct StudySpec {
  std::string title, text;
  std::vector<RunsSpec> runs;
  std::vector<FigureSpec> figures;
  std::vector<StatementSpec> statements;
};

/// One run of a study with all braces replaced.
struct StudyRun {
  std::string name, label;
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::map<std::string, std::string> parameters;  ///< values and, as "basis.label", labels
};

struct Study {
  StudySpec spec;
  std::filesystem::path file;
  std::vector<StudyRun> runs;  ///< in the order of the file

  /// Runs that the patterns name, each once: those of the first pattern in the order of the study, those of
  /// the next, … Throws `Error` for a pattern that names none.
  std::vector<const StudyRun*> matching(const std::vector<std::string>& patterns) const;
};

/// The text with "{name}" replaced; braces around anything but a name stay, so that overrides may hold YAML.
/// Throws `Error` that names the text for an unknown name or an unclosed brace.
std::string fillIn(const std::string& text, const std::map<std::string, std::string>& parameters);

/// Where a run of a study keeps its results.
inline std::filesystem::path runDirectory(const std::filesystem::path& studyDirectory, const StudyRun& run) {
  return studyDirectory / "runs" / run.name;
}

}  // namespace burnish
