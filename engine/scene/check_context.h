#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// What every check looks at, and where it reports.
struct CheckContext {
  const Scene& scene;
  const YamlNode& root;
  Diagnostics& errors;

  bool clean(const std::string& path) const { return errors.clean(path); }
  void report(const std::string& path, const std::string& problem) const {
    errors.add(placeOf(root, path), path, problem);
  }
  /// Whether a key of a body, or what stands for it at the top of the scene, is clean.
  bool cleanOf(std::size_t body, const std::string& key) const {
    return clean(scene.bodyKey(body, key)) && clean(key);
  }
  /// False for a list of bodies that is none.
  bool bodiesAreRead() const { return !scene.bodies.empty() || root.find("bodies") == nullptr; }
  /// Whether the number of dimensions is known.
  bool dimensionIsKnown() const { return bodiesAreRead() && dimensionIsKnownOf(0); }
  bool dimensionIsKnownOf(std::size_t body) const;
};

/// The body by name, and its patch: they exist, and are named if there are several. path: of the mapping that
/// holds both. Returns whether the body is known.
bool checkBodyName(const CheckContext& context, const std::string& path, const std::string& body);
void checkPatch(const CheckContext& context, const std::string& path, const std::string& body,
                const std::string& patch);

/// A face of a patch that the dimension has, and its part. pointsToo: of which begin and end may be alike.
void checkFace(const CheckContext& context, const std::string& path, const FaceSpec& face,
               bool pointsToo = false);

/// A formula in X, Y, Z, t and the definitions; constant: in the definitions alone.
void checkFormula(const CheckContext& context, const std::string& path, const FormulaText& formula,
                  bool constant = false);

/// The coefficient of friction: at least 0, or a formula in the variables of `FrictionLaw` and the definitions.
void checkFrictionFormula(const CheckContext& context, const std::string& path,
                          const ContactOptions& options);

/// A formula in t and the definitions.
void checkTimeFormula(const CheckContext& context, const std::string& path, const FormulaText& formula);

/// Names and formulas of the definitions.
void checkDefinitions(const CheckContext& context);

/// All patches of all bodies have one dimension; those of another one are not looked at any further.
void checkPatchDimensions(const CheckContext& context);

/// Shapes and meshes of a body.
void checkGeometry(const CheckContext& context, std::size_t body);

/// Names of the bodies; geometry, basis and material of each.
void checkBodies(const CheckContext& context);

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

}  // namespace burnish::inline scene
