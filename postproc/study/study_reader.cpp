#include "postproc/study/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "engine/core/error.h"
#include "engine/scene/end_of_run.h"
#include "engine/schema/mapping_reader.h"
#include "engine/schema/yaml_document.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/combinations.h"
#include "postproc/study/run_data.h"
#include "postproc/study/schema.h"
#include "postproc/study/study_check.h"

namespace burnish {
namespace {

const DocumentKind kStudyKind{.name = "study", .keys = "runs and figures"};

/// Whether a name can be that of a directory everywhere.
bool isSafeName(const std::string& name) {
  constexpr std::size_t longest = 200;
  return !name.empty() && name.size() <= longest && name.front() != '.' && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
         });
}

/// Replaces the parameters of the runs of a study.
class Expansion {
 public:
  Expansion(Study& study, const YamlNode& root, Diagnostics& errors)
      : study_(study), root_(root), errors_(errors) {}

  void expand() {
    for (std::size_t i = 0; i < study_.spec.runs.size(); ++i) {
      const RunsSpec& spec = study_.spec.runs[i];
      const std::string path = fmt::format("runs[{}]", i);
      for (const auto& parameters : combinations(spec.vary)) {
        if (!errors_.clean(path)) break;  // the other combinations have the same mistake
        add(spec, path, parameters);
      }
    }
  }

 private:
  void add(const RunsSpec& spec, const std::string& path,
           const std::map<std::string, std::string>& parameters) {
    StudyRun run;
    run.parameters = parameters;
    run.name = filled(spec.name, path + ".name", parameters);
    run.label = spec.label ? filled(*spec.label, path + ".label", parameters) : run.name;
    run.scene = study_.file.parent_path() / filled(spec.scene, path + ".scene", parameters);
    for (std::size_t k = 0; k < spec.set.size(); ++k)
      run.overrides.push_back(filled(spec.set[k], fmt::format("{}.set[{}]", path, k), parameters));
    if (!errors_.clean(path)) return;
    checkName(run, path + ".name");
    checkScene(run, path);
    study_.runs.push_back(std::move(run));
  }

  std::string filled(const std::string& text, const std::string& path,
                     const std::map<std::string, std::string>& parameters) {
    try {
      return fillIn(text, parameters);
    } catch (const Error& error) {
      report(path, error.what());
      return text;
    }
  }

  void checkName(const StudyRun& run, const std::string& path) {
    if (!isSafeName(run.name))
      report(path, fmt::format("found the name {}; allowed: up to 200 letters, digits, - and _ and . that "
                               "begin with a letter, a digit or _.",
                               run.name));
    for (const StudyRun& other : study_.runs)
      if (other.name == run.name)
        return report(path, fmt::format("found the name {} a second time; allowed: a name of its own for "
                                        "each run, with all parameters in braces.",
                                        run.name));
  }

  void checkScene(const StudyRun& run, const std::string& path) {
    try {
      readSceneDocument(run.scene, run.overrides);
    } catch (const Error& error) {
      report(path, fmt::format("the scene of the run {} cannot be used: {}", run.name, error.what()));
    }
  }

  void report(const std::string& path, const std::string& problem) {
    errors_.add(placeOf(root_, path), path, problem);
  }

  Study& study_;
  const YamlNode& root_;
  Diagnostics& errors_;
};

YamlNode parseStudy(const std::filesystem::path& file, Diagnostics& errors) {
  return parseDocument(readDocument(file, kStudyKind), kStudyKind, errors);
}

}  // namespace

Study readStudy(const std::filesystem::path& file) {
  Diagnostics errors(file.string(), {});
  YamlNode root = parseStudy(file, errors);
  replaceEndOfRun(root, fmt::format("{}", kEndOfRun));
  for (YamlNode& list : root.children)
    if (list.key == "figures")
      for (YamlNode& figure : list.children) resolveLookFiles(figure, file.parent_path());
  Study study{.spec = {}, .file = file, .runs = {}};
  std::vector<DimensionedList> dimensioned;  // a study has none
  MappingReader(root, "", errors, dimensioned).readInto(study.spec);
  errors.throwIfAny();
  checkNames(study.spec, root, errors);
  errors.throwIfAny();
  Expansion(study, root, errors).expand();
  errors.throwIfAny();
  checkReferences(study, root, errors);
  errors.throwIfAny();
  return study;
}

void requireOutlooks(const Study& study, const std::vector<RunOutlook>& outlooks) {
  Diagnostics errors(study.file.string(), {});
  const YamlNode root = parseStudy(study.file, errors);
  checkOutlooks(study, outlooks, root, errors);
  errors.throwIfAny();
}

}  // namespace burnish
