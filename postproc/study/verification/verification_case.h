#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/summary_file.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/study.h"

namespace burnish {

/// A run of a case: one family on one mesh.
struct CaseVariant {
  std::string mesh;                         ///< "mesh 2" or "Δt = 0.1"; empty if the scene has no meshes
  double size = 1.0;                        ///< of a cell or a step
  StudyRun run;                             ///< its name is a path: of the case, the family and the mesh
  std::vector<DefinitionSpec> definitions;  ///< those of the changed scene
};

/// All runs that differ by nothing but the mesh, coarse to fine.
struct CaseFamily {
  std::string name;  ///< empty if the scene has no families
  std::vector<CaseVariant> variants;
};

/// "FAMILY, mesh 2", of which a part may be missing.
std::string labelOf(const CaseFamily& family, const CaseVariant& variant);

/// How tables and charts name the sizes of meshes.
struct SizeWords {
  std::string symbol;  ///< h, Δt
  std::string title;   ///< "size h of the cells"
};

/// "h = 0.25", "Δt = 0.1".
std::string sizeText(const SizeWords& words, double size);

/// A scene that states what it must produce, and what is to be run for it.
struct VerificationCase {
  std::string name;         ///< that of the file
  SceneDocument document;   ///< unchanged
  std::string explanation;  ///< the comment that the file begins with, as Markdown
  SizeWords sizes;
  std::vector<CaseFamily> families;
};

/// Reads a scene and all of its changed copies. Throws `Error` if one of them is wrong or nothing is checked.
VerificationCase readCase(const std::filesystem::path& file);

/// The runs of all cases, as those of a study. Throws `Error` if two would share a directory.
Study studyOf(const std::vector<VerificationCase>& cases);

/// What became of a variant: its history, or why there is none that reaches the end of the scene.
struct VariantOutcome {
  std::optional<HistoryTable> history;
  std::string failure{};
  std::vector<DoubtRecord> doubts{};
  std::vector<std::string> idleTools{};  ///< that have never touched the body
};

/// The outcome of a run in its directory.
VariantOutcome outcomeOf(const std::filesystem::path& runDirectory);

}  // namespace burnish
