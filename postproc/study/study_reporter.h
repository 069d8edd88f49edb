#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/schema/yaml_tree.h"
#include "postproc/study/study.h"

namespace burnish {

/// Where checks of a study report what is wrong with its values. Paths are those of keys, such as
/// `figures[0].times`.
class StudyReporter {
 public:
  StudyReporter(const YamlNode& root, Diagnostics& errors) : root_(root), errors_(errors) {}

  void report(const std::string& path, const std::string& problem) const {
    errors_.add(placeOf(root_, path), path, problem);
  }

  /// A name out of some that exist.
  void requireKnown(const std::string& path, const std::string& name,
                    const std::vector<std::string>& names) const;

  /// As many labels as there are things to label, or none.
  void requireSameLength(const std::string& path, std::size_t found, const std::string& of,
                         std::size_t wanted) const;

  template <class List>
  void requireDifferentNames(const std::string& path, const List& list) const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!names.insert(list[i].name).second)
        report(fmt::format("{}[{}].name", path, i),
               fmt::format("found {} a second time; allowed: a name of its own for each.", list[i].name));
  }

  /// Options of a picture that cannot be; sizeKey: what their size is called.
  void checkPicture(const std::string& path, const PictureOptions& picture, const char* sizeKey) const;

  void checkMeasure(const std::string& path, const MeasureSpec& measure) const;

 private:
  const YamlNode& root_;
  Diagnostics& errors_;
};

/// The same for what refers to the runs of a study.
class RunReporter : public StudyReporter {
 public:
  using Runs = std::vector<const StudyRun*>;

  RunReporter(const Study& study, const YamlNode& root, Diagnostics& errors)
      : StudyReporter(root, errors), study_(study) {}

  const Study& study() const { return study_; }

  /// The runs that patterns name; every pattern is to name one.
  Runs runsOf(const std::string& path, const std::vector<std::string>& patterns) const;

  /// Whether an action does not throw `Error`, which is reported.
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
                        const Runs& runs) const;

  void checkLooks(const std::string& path, const CurveLooks& looks, const Runs& runs) const;

  void checkReferences(const std::string& path, const MeasureSpec& measure, const Runs& runs) const;

  /// Whether a text names a run when its braces are filled in.
  bool checkRunName(const std::string& path, const std::string& text,
                    const std::map<std::string, std::string>& parameters) const;

 private:
  const Study& study_;
};

template <class List>
std::vector<std::string> namesOf(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

}  // namespace burnish
