#pragma once
#include <string>

#include "engine/scene/scene.h"
#include "engine/scene/yaml_tree.h"

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
  bool dimensionIsKnown() const { return clean("geometry.shape") && clean("geometry.degrees"); }
};

/// Geometry, basis and material.
void checkBody(const CheckContext& context);

/// Supports, loads, tools and contact.
void checkBoundary(const CheckContext& context);

/// Steps, output and pictures.
void checkRun(const CheckContext& context);

}  // namespace burnish
