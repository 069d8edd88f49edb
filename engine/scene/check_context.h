#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/schema/yaml_tree.h"

namespace burnish {

/// What every check looks at, and where it reports.
struct CheckContext {
  const Scene& scene;
  const YamlNode& root;
  Diagnostics& errors;

  bool clean(const std::string& path) const { return errors.clean(path); }
  void report(const std::string& path, const std::string& problem) const {
    errors.add(placeOf(root, path), path, problem);
  }
  /// Whether the number of dimensions is known.
  bool dimensionIsKnown() const {
    return clean("geometry.shape") && clean("geometry.degrees") && clean("geometry.patches[0].shape") &&
           clean("geometry.patches[0].degrees") && scene.dim() > 0;
  }
};

/// The patch of a scene by name: it exists, and is named if there are several.
void checkPatch(const CheckContext& context, const std::string& path, const std::string& patch);

/// A face of a patch that the dimension has, and its part. pointsToo: of which begin and end may be alike.
void checkFace(const CheckContext& context, const std::string& path, const FaceSpec& face,
               bool pointsToo = false);

/// A formula in X, Y, Z, t and the definitions; constant: in the definitions alone.
void checkFormula(const CheckContext& context, const std::string& path, const FormulaText& formula,
                  bool constant = false);

/// A formula in t and the definitions.
void checkTimeFormula(const CheckContext& context, const std::string& path, const FormulaText& formula);

/// Names and formulas of the definitions.
void checkDefinitions(const CheckContext& context);

/// The patches have one dimension; those of another one are not looked at any further.
void checkPatchDimensions(const CheckContext& context);

/// Shapes and meshes.
void checkGeometry(const CheckContext& context);

/// Geometry, basis and material.
void checkBody(const CheckContext& context);

/// Tools; returns the names of those that could be read.
std::vector<std::string> checkTools(const CheckContext& context);

/// Supports, loads, tools and contact.
void checkBoundary(const CheckContext& context);

/// What a scene with rezoning may have.
void checkRezoning(const CheckContext& context);

/// Measures.
void checkMeasures(const CheckContext& context);

/// None of the times is behind the end of the run.
void checkTimes(const CheckContext& context, const std::string& path, const std::vector<double>& times);

/// Steps and output.
void checkRun(const CheckContext& context);

}  // namespace burnish
