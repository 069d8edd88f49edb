#include "postproc/study/verification/verification_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/results/summary_file.h"
#include "postproc/text/text_file.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The comment at the head of a scene, without its marks.
std::string leadingComment(const std::string& yaml) {
  std::istringstream lines(yaml);
  std::string text;
  for (std::string line; std::getline(lines, line) && line.starts_with('#');)
    text += line.substr(line.starts_with("# ") ? 2 : 1) + "\n";
  return text;
}

/// Letters and digits in lower case, with a dash for whatever stands between them.
std::string directoryName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return name;
}

SizeWords wordsOf(VariantsSpec::Sizes sizes) {
  if (sizes == VariantsSpec::Sizes::Steps) return {"Δt", "size Δt of the steps"};
  return {"h", "size h of the cells"};
}

/// What no check looks at costs time; and a result stays good when only the checks change.
std::vector<std::string> overridesOf(const FamilySpec& family, const MeshVariantSpec& mesh) {
  std::vector<std::string> overrides = family.set;
  overrides.insert(overrides.end(), mesh.set.begin(), mesh.set.end());
  for (const char* nothing : {"pictures=[]", "output.vtu=false", "checks=[]", "charts=[]", "variants=null"})
    overrides.emplace_back(nothing);
  return overrides;
}

CaseVariant variantOf(const std::string& caseName, const fs::path& file, const VariantsSpec& variants,
                      const FamilySpec& family, const MeshVariantSpec& mesh, std::size_t number) {
  CaseVariant variant;
  variant.size = mesh.size;
  fs::path place = caseName;
  if (!family.name.empty()) place /= directoryName(family.name);
  if (number > 0) {
    variant.mesh = variants.sizes == VariantsSpec::Sizes::Steps ? sizeText(wordsOf(variants.sizes), mesh.size)
                                                                : fmt::format("mesh {}", number);
    place /= fmt::format("mesh-{}", number);
  }
  const std::string name = place.string();
  variant.run = {name, name, file, overridesOf(family, mesh), {}};
  try {
    variant.definitions = readSceneDocument(file, variant.run.overrides).scene.definitions;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: variant {}: {}", file.string(), name, error.what()));
  }
  return variant;
}

}  // namespace

std::string sizeText(const SizeWords& words, double size) {
  constexpr int kDigits = 4;
  return words.symbol + " = " + numberText(size, kDigits);
}

std::string labelOf(const CaseFamily& family, const CaseVariant& variant) {
  const bool both = !family.name.empty() && !variant.mesh.empty();
  return family.name + (both ? ", " : "") + variant.mesh;
}

VerificationCase readCase(const fs::path& file) {
  VerificationCase result{
      file.stem().string(), readSceneDocument(file), leadingComment(readText(file)), {}, {}};
  if (result.document.checks.empty())
    throw Error(
        fmt::format("{}: found no checks; allowed: a scene that states under checks what it must produce",
                    file.string()));
  VariantsSpec variants = result.document.variants.value_or(VariantsSpec{});
  const bool hasMeshes = !variants.meshes.empty();
  result.sizes = wordsOf(variants.sizes);
  if (variants.families.empty()) variants.families.emplace_back();
  if (!hasMeshes) variants.meshes.emplace_back();
  for (const FamilySpec& family : variants.families) {
    CaseFamily& added = result.families.emplace_back(CaseFamily{family.name, {}});
    for (std::size_t m = 0; m < variants.meshes.size(); ++m)
      added.variants.push_back(
          variantOf(result.name, file, variants, family, variants.meshes[m], hasMeshes ? m + 1 : 0));
  }
  return result;
}

Study studyOf(const std::vector<VerificationCase>& cases) {
  Study study;
  std::set<std::string> names;
  for (const VerificationCase& verified : cases)
    for (const CaseFamily& family : verified.families)
      for (const CaseVariant& variant : family.variants) {
        if (!names.insert(variant.run.name).second)
          throw Error(
              fmt::format("{}: a second run would have the name {}; allowed: scenes and families whose names "
                          "differ in letters and digits",
                          variant.run.scene.string(), variant.run.name));
        study.runs.push_back(variant.run);
      }
  return study;
}

VariantOutcome outcomeOf(const fs::path& runDirectory) {
  if (!fs::exists(runDirectory / "summary.yaml"))
    return {{}, fmt::format("the run failed, see {}", (runDirectory / "log.txt").string())};
  const RunAccount summary = readSummary(runDirectory);
  if (!summary.completed)
    return {{},
            fmt::format("the run stopped at t = {:.4g}: {}", summary.endTime, summary.stoppedBecause),
            summary.doubts,
            summary.idleTools};
  return {readHistory(runDirectory / "history.csv"), {}, summary.doubts, summary.idleTools};
}

}  // namespace burnish
