#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/evidence/expectation.h"
#include "postproc/study/evidence/quantity.h"

/// What a scene must produce, and the changed copies of it in which this is looked for.
namespace burnish {

/// A change of the scene, as `burnish run --set` takes it.
struct FamilySpec {
  std::string name;
  std::vector<std::string> set;
};
struct MeshVariantSpec {
  double size = 1.0;  ///< in any unit; decreasing from mesh to mesh
  std::vector<std::string> set;
};

/// What `burnish verify` runs: every family on every mesh, coarse to fine.
struct VariantsSpec {
  std::vector<FamilySpec> families;
  std::vector<MeshVariantSpec> meshes;
  enum class Sizes { Cells, Steps } sizes = Sizes::Cells;  ///< what those of the meshes are sizes of
};

/// What a scene must produce.
struct CheckSpec {
  std::string name;
  CheckedQuantity quantity;
  std::vector<std::string> families;  ///< all when empty
  enum class Meshes { Finest, Every } meshes = Meshes::Finest;
  CheckExpectation expect;
  std::string source;  ///< where the value comes from
};

/// A chart of `burnish verify`: a curve for every family and mesh, along a face for every family on its finest mesh.
struct CurveChartSpec {
  std::string contact;  ///< tool or pair whose face the curves run along at the end; empty: the history
  std::string x, y;     ///< formulas in the columns of the history or of the points of the face
  std::string exact;    ///< y of theory along the face; not drawn when empty
  std::string xTitle, yTitle;                           ///< the formulas when left out
  std::optional<std::array<double, 2>> xRange, yRange;  ///< all of the curves when left out
};

}  // namespace burnish
