#include "postproc/study/study_check.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "postproc/study/combinations.h"
#include "postproc/study/figures/figures.h"
#include "postproc/study/measures.h"
#include "postproc/study/study_reporter.h"

namespace burnish {
namespace {

/// What can be judged without the runs.
class NameCheck : StudyReporter {
 public:
  using StudyReporter::StudyReporter;

  void check(const StudySpec& spec) const {
    for (std::size_t i = 0; i < spec.runs.size(); ++i)
      checkParameters(fmt::format("runs[{}].vary", i), spec.runs[i].vary);
    requireDifferentNames("figures", spec.figures);
    for (std::size_t i = 0; i < spec.figures.size(); ++i)
      checkFigure(spec.figures[i], fmt::format("figures[{}]", i), *this);
    requireDifferentNames("statements", spec.statements);
    for (std::size_t i = 0; i < spec.statements.size(); ++i)
      checkStatement(fmt::format("statements[{}]", i), spec.statements[i]);
  }

 private:
  void checkParameters(const std::string& path, const std::vector<ParameterSpec>& vary) const {
    constexpr std::size_t most = 10'000;
    requireDifferentNames(path, vary);
    std::size_t count = 1;
    for (std::size_t k = 0; k < vary.size(); ++k) {
      const std::string at = fmt::format("{}[{}]", path, k);
      const ParameterSpec& parameter = vary[k];
      requireSameLength(at + ".labels", parameter.labels.size(), "values", parameter.values.size());
      std::set<std::string> values;
      for (std::size_t i = 0; i < parameter.values.size(); ++i)
        if (!values.insert(parameter.values[i]).second)
          report(fmt::format("{}.values[{}]", at, i),
                 fmt::format("found {} a second time; allowed: different values.", parameter.values[i]));
      count *= parameter.values.size();
      if (count > most) return report(path, fmt::format("found more than {} combinations.", most));
    }
  }

  void checkStatement(const std::string& path, const StatementSpec& s) const {
    requireDifferentNames(path + ".measures", s.measures);
    if (!s.measures.empty() && s.runs.empty() && s.claims.empty())
      report(path + ".runs", "missing; measures are those of runs, or of claims about them.");
    for (std::size_t i = 0; i < s.measures.size(); ++i)
      checkMeasure(fmt::format("{}.measures[{}]", path, i), s.measures[i]);
    for (std::size_t i = 0; i < s.claims.size(); ++i)
      checkClaim(fmt::format("{}.claims[{}]", path, i), s.claims[i], namesOf(s.measures));
  }

  void checkClaim(const std::string& path, const ClaimSpec& claim,
                  const std::vector<std::string>& measures) const {
    requireKnown(path + ".measure", claim.measure, measures);
    checkParameters(path + ".vary", claim.vary);
    const bool comparesSize =
        claim.expect == ClaimSpec::Expect::Equal || claim.expect == ClaimSpec::Expect::Different;
    if (comparesSize && !claim.within)
      report(path + ".within", "missing; required with equal and different: a number above 0 and at most 1.");
    if (!comparesSize && claim.within)
      report(path + ".within", "found without equal or different; allowed: only together with one of them.");
    if ((claim.expect == ClaimSpec::Expect::Between) != claim.range.has_value())
      report(path + ".range", "required with between and allowed only then: a list of 2 increasing numbers.");
    if (claim.expect != ClaimSpec::Expect::Between && claim.runs.size() < 2)
      report(path + ".runs", "found one run; allowed: 2 or more to compare, or one with `expect: between`.");
  }
};

/// What needs the runs.
class ReferenceCheck : RunReporter {
 public:
  using RunReporter::RunReporter;

  void check() const {
    const StudySpec& spec = study().spec;
    for (std::size_t i = 0; i < spec.figures.size(); ++i)
      checkReferencesOf(spec.figures[i], fmt::format("figures[{}]", i), *this);
    for (std::size_t i = 0; i < spec.statements.size(); ++i)
      checkStatement(fmt::format("statements[{}]", i), spec.statements[i]);
  }

 private:
  void checkStatement(const std::string& path, const StatementSpec& s) const {
    const Runs runs = runsOf(path + ".runs", s.runs);
    for (std::size_t i = 0; i < s.measures.size(); ++i)
      checkReferences(fmt::format("{}.measures[{}]", path, i), s.measures[i], runs);
    for (std::size_t i = 0; i < s.claims.size(); ++i)
      checkClaim(fmt::format("{}.claims[{}]", path, i), s.claims[i]);
    for (std::size_t i = 0; i < s.figures.size(); ++i)
      requireKnown(fmt::format("{}.figures[{}]", path, i), s.figures[i], namesOf(study().spec.figures));
  }

  void checkClaim(const std::string& path, const ClaimSpec& claim) const {
    for (const auto& parameters : combinations(claim.vary)) {
      if (!tryTo(path + ".text", [&] { fillIn(claim.text, parameters); })) return;
      if (!checkRunNames(path + ".runs", claim.runs, parameters)) return;
    }
  }

  bool checkRunNames(const std::string& path, const std::vector<std::string>& texts,
                     const std::map<std::string, std::string>& parameters) const {
    bool allFound = true;
    for (std::size_t i = 0; i < texts.size(); ++i)
      allFound = checkRunName(fmt::format("{}[{}]", path, i), texts[i], parameters) && allFound;
    return allFound;
  }
};

/// What needs to know of the results of the runs.
class OutlookCheck : OutlookReporter {
 public:
  using OutlookReporter::OutlookReporter;

  void check() const {
    const StudySpec& spec = study().spec;
    for (std::size_t i = 0; i < spec.figures.size(); ++i)
      checkOutlooksOf(spec.figures[i], fmt::format("figures[{}]", i), *this);
    for (std::size_t i = 0; i < spec.statements.size(); ++i)
      for (std::size_t k = 0; k < spec.statements[i].measures.size(); ++k) {
        const MeasureSpec& measure = spec.statements[i].measures[k];
        requireMeasure(fmt::format("statements[{}].measures[{}]", i, k), measure,
                       runsWith(measure, spec.statements[i]));
      }
  }

 private:
  /// The runs of which a statement tells the measure, and those that its claims compare by it.
  Runs runsWith(const MeasureSpec& measure, const StatementSpec& statement) const {
    Runs runs = study().matching(statement.runs);
    for (const ClaimSpec& claim : statement.claims)
      if (claim.measure == measure.name)
        for (const auto& parameters : combinations(claim.vary))
          for (const std::string& text : claim.runs)
            runs.push_back(&runNamed(study(), fillIn(text, parameters)));
    return runs;
  }
};

}  // namespace

void checkNames(const StudySpec& spec, const YamlNode& root, Diagnostics& errors) {
  NameCheck(root, errors).check(spec);
}

void checkReferences(const Study& study, const YamlNode& root, Diagnostics& errors) {
  ReferenceCheck(study, root, errors).check();
}

void checkOutlooks(const Study& study, const std::vector<RunOutlook>& outlooks, const YamlNode& root,
                   Diagnostics& errors) {
  OutlookCheck(study, outlooks, root, errors).check();
}

}  // namespace burnish
