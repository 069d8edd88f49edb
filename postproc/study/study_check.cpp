#include "postproc/study/study_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/study/combinations.h"

namespace burnish {
namespace {

/// Where checks report.
class Reporter {
 public:
  Reporter(const YamlNode& root, Diagnostics& errors) : root_(root), errors_(errors) {}

  void report(const std::string& path, const std::string& problem) const {
    errors_.add(placeOf(root_, path), path, problem);
  }

  /// A name out of some that exist.
  void requireKnown(const std::string& path, const std::string& name,
                    const std::vector<std::string>& names) const {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    const std::string allowed = names.empty() ? "there are none" : fmt::format("{}", fmt::join(names, " | "));
    report(path, fmt::format("found {}; allowed: {}.{}", name, allowed, didYouMean(name, names)));
  }

  /// As many labels as there are things to label, or none.
  void requireSameLength(const std::string& path, std::size_t found, const std::string& of,
                         std::size_t wanted) const {
    if (found != 0 && found != wanted)
      report(path, fmt::format("found a list of {}; allowed: a list of {}, one for each of the {}, or none.",
                               found, wanted, of));
  }

  template <class List>
  void requireDifferentNames(const std::string& path, const List& list) const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!names.insert(list[i].name).second)
        report(fmt::format("{}[{}].name", path, i),
               fmt::format("found {} a second time; allowed: a name of its own for each.", list[i].name));
  }

 private:
  const YamlNode& root_;
  Diagnostics& errors_;
};

template <class List>
std::vector<std::string> namesOf(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// What can be judged without the runs.
class NameCheck : Reporter {
 public:
  using Reporter::Reporter;

  void check(const StudySpec& spec) const {
    for (std::size_t i = 0; i < spec.runs.size(); ++i)
      checkParameters(fmt::format("runs[{}].vary", i), spec.runs[i].vary);
    requireDifferentNames("figures", spec.figures);
    for (std::size_t i = 0; i < spec.figures.size(); ++i)
      std::visit([&](const auto& what) { checkFigure(fmt::format("figures[{}]", i), what); },
                 spec.figures[i].what);
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

  void checkFigure(const std::string& path, const SurfaceChartSpec& s) const {
    requireSameLength(path + ".time_labels", s.timeLabels.size(), "times", s.times.size());
  }
  void checkFigure(const std::string& path, const ContourSheetSpec& s) const {
    requireSameLength(path + ".time_labels", s.timeLabels.size(), "times", s.times.size());
    checkPicture(path, s.panel, "panel_size");
  }
  void checkFigure(const std::string& path, const CompositeSpec& s) const {
    requireSameLength(path + ".captions", s.captions.size(), "figures", s.figures.size());
  }
  void checkFigure(const std::string& path, const RefinementChartSpec& s) const {
    checkMeasure(path + ".measure", s.measure);
  }
  void checkFigure(const std::string& path, const HistoryChartSpec& s) const {
    if (s.reference && !s.reference->ends_with(".png") && !s.reference->ends_with(".csv"))
      report(path + ".reference",
             fmt::format("found {}; allowed: a file with the ending .png or .csv.", *s.reference));
  }
  void checkFigure(const std::string&, const SetupSpec&) const {}
  void checkFigure(const std::string& path, const AnimationSpec& s) const {
    checkPicture(path, s.picture, "size");
  }

  void checkPicture(const std::string& path, const PictureOptions& picture, const char* sizeKey) const {
    for (const InputProblem& problem : conflictsIn(picture, {}))
      report(fmt::format("{}.{}", path, problem.path == "size" ? sizeKey : problem.path), problem.text);
  }

  void checkMeasure(const std::string& path, const MeasureSpec& measure) const {
    const auto* history = std::get_if<HistoryMeasure>(&measure.what);
    if (history == nullptr) return;
    const bool isAt = history->reduce == Reduction::At;
    if (isAt && !history->at) report(path + ".at", "missing; required with `reduce: at`: a number.");
    if (!isAt && history->at)
      report(path + ".at", "found without `reduce: at`; allowed: only together with it.");
  }

  void checkStatement(const std::string& path, const StatementSpec& s) const {
    requireDifferentNames(path + ".measures", s.measures);
    for (std::size_t i = 0; i < s.measures.size(); ++i)
      checkMeasure(fmt::format("{}.measures[{}]", path, i), s.measures[i]);
    for (std::size_t i = 0; i < s.claims.size(); ++i)
      checkClaim(fmt::format("{}.claims[{}]", path, i), s.claims[i], namesOf(s.measures));
  }

  void checkClaim(const std::string& path, const ClaimSpec& claim,
                  const std::vector<std::string>& measures) const {
    requireKnown(path + ".measure", claim.measure, measures);
    checkParameters(path + ".vary", claim.vary);
    const bool comparesSize = claim.expect == Expectation::Equal || claim.expect == Expectation::Different;
    if (comparesSize && !claim.within)
      report(path + ".within", "missing; required with equal and different: a number above 0 and at most 1.");
    if (!comparesSize && claim.within)
      report(path + ".within", "found without equal or different; allowed: only together with one of them.");
    if ((claim.expect == Expectation::Between) != claim.range.has_value())
      report(path + ".range", "required with between and allowed only then: a list of 2 increasing numbers.");
    if (claim.expect != Expectation::Between && claim.runs.size() < 2)
      report(path + ".runs", "found one run; allowed: 2 or more to compare, or one with `expect: between`.");
  }
};

/// What needs the runs.
class ReferenceCheck : Reporter {
 public:
  ReferenceCheck(const Study& study, const YamlNode& root, Diagnostics& errors)
      : Reporter(root, errors), study_(study) {}

  void check() const {
    for (std::size_t i = 0; i < study_.spec.figures.size(); ++i)
      std::visit([&](const auto& what) { checkFigure(fmt::format("figures[{}]", i), what); },
                 study_.spec.figures[i].what);
    for (std::size_t i = 0; i < study_.spec.statements.size(); ++i)
      checkStatement(fmt::format("statements[{}]", i), study_.spec.statements[i]);
  }

 private:
  using Runs = std::vector<const StudyRun*>;

  /// The runs that patterns name; every pattern is to name one.
  Runs runsOf(const std::string& path, const std::vector<std::string>& patterns) const {
    bool allFound = true;
    for (std::size_t i = 0; i < patterns.size(); ++i)
      allFound = tryTo(fmt::format("{}[{}]", path, i), [&] { study_.matching({patterns[i]}); }) && allFound;
    return allFound ? study_.matching(patterns) : Runs{};
  }

  template <class F>
  bool tryTo(const std::string& path, const F& action) const {
    try {
      action();
      return true;
    } catch (const Error& error) {
      report(path, error.what());
      return false;
    }
  }

  /// A parameter that some of the runs have.
  void requireParameter(const std::string& path, const std::optional<std::string>& name,
                        const Runs& runs) const {
    if (!name || runs.empty()) return;
    std::set<std::string> names;
    for (const StudyRun* run : runs)
      for (const auto& entry : run->parameters)
        if (!entry.first.ends_with(".label")) names.insert(entry.first);
    requireKnown(path, *name, {names.begin(), names.end()});
  }

  void checkLooks(const std::string& path, const CurveLooks& looks, const Runs& runs) const {
    requireParameter(path + ".looks.color", looks.color, runs);
    requireParameter(path + ".looks.dash", looks.dash, runs);
    requireParameter(path + ".looks.marker", looks.marker, runs);
  }

  void checkFigure(const std::string& path, const HistoryChartSpec& s) const {
    checkLooks(path, s.looks, runsOf(path + ".runs", s.runs));
    if (s.reference && !std::filesystem::exists(study_.file.parent_path() / *s.reference))
      report(path + ".reference",
             fmt::format("found {}, but there is no such file beside the study file.", *s.reference));
  }
  void checkFigure(const std::string& path, const SurfaceChartSpec& s) const {
    checkLooks(path, s.looks, runsOf(path + ".runs", s.runs));
  }
  void checkFigure(const std::string& path, const RefinementChartSpec& s) const {
    const Runs runs = runsOf(path + ".runs", s.runs);
    checkLooks(path, s.looks, runs);
    for (const StudyRun* run : runs)
      if (!run->parameters.contains(s.refine)) return requireParameter(path + ".refine", s.refine, {run});
    checkMeasure(path + ".measure", s.measure, runs);
  }
  void checkFigure(const std::string& path, const ContourSheetSpec& s) const {
    for (const StudyRun* run : runsOf(path + ".runs", s.runs)) {
      auto parameters = run->parameters;
      for (const char* name : {"letter", "label", "time"}) parameters.emplace(name, "");
      if (!tryTo(path + ".panel_caption", [&] { fillIn(s.panelCaption, parameters); })) return;
    }
  }
  void checkFigure(const std::string& path, const SetupSpec& s) const {
    requireKnown(path + ".run", s.run, namesOf(study_.runs));
  }
  void checkFigure(const std::string& path, const CompositeSpec& s) const {
    std::vector<std::string> parts;
    for (const FigureSpec& figure : study_.spec.figures)
      if (!std::holds_alternative<CompositeSpec>(figure.what)) parts.push_back(figure.name);
    for (std::size_t i = 0; i < s.figures.size(); ++i)
      requireKnown(fmt::format("{}.figures[{}]", path, i), s.figures[i], parts);
  }
  void checkFigure(const std::string& path, const AnimationSpec& s) const { runsOf(path + ".runs", s.runs); }

  void checkMeasure(const std::string& path, const MeasureSpec& measure, const Runs& runs) const {
    const auto* difference = std::get_if<DifferenceMeasure>(&measure.what);
    if (difference == nullptr) return;
    for (const StudyRun* run : runs)
      if (!checkRunName(path + ".other", difference->other, run->parameters)) return;
  }

  /// Whether a text names a run when its braces are filled in.
  bool checkRunName(const std::string& path, const std::string& text,
                    const std::map<std::string, std::string>& parameters) const {
    return tryTo(path, [&] {
      const std::string name = fillIn(text, parameters);
      const auto names = namesOf(study_.runs);
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw Error(fmt::format("found {}, which is no run.{}", name, didYouMean(name, names)));
    });
  }

  void checkStatement(const std::string& path, const StatementSpec& s) const {
    const Runs runs = runsOf(path + ".runs", s.runs);
    for (std::size_t i = 0; i < s.measures.size(); ++i)
      checkMeasure(fmt::format("{}.measures[{}]", path, i), s.measures[i], runs);
    for (std::size_t i = 0; i < s.claims.size(); ++i)
      checkClaim(fmt::format("{}.claims[{}]", path, i), s.claims[i]);
    for (std::size_t i = 0; i < s.figures.size(); ++i)
      requireKnown(fmt::format("{}.figures[{}]", path, i), s.figures[i], namesOf(study_.spec.figures));
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

  const Study& study_;
};

}  // namespace

void checkNames(const StudySpec& spec, const YamlNode& root, Diagnostics& errors) {
  NameCheck(root, errors).check(spec);
}

void checkReferences(const Study& study, const YamlNode& root, Diagnostics& errors) {
  ReferenceCheck(study, root, errors).check();
}

}  // namespace burnish
