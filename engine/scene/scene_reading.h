#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/schema/mapping_reader.h"
#include "engine/schema/yaml_document.h"

namespace burnish::inline scene {

inline const DocumentKind kSceneKind{.name = "scene", .keys = "geometry, material and steps"};

/// The steps in which a scene is read, for documents that have keys of their own beside those of the scene:
/// `read`, `check`, what the document has to check itself, `finish`.
class SceneReading {
 public:
  /// Arguments of `parseScene`. Throws `Error` if the text is no mapping.
  SceneReading(const std::string& yaml, std::string name, const std::vector<std::string>& overrides);

  /// Fills a struct by its `describe`, which names every key but those that are left to others.
  template <class Document>
  void read(Document& document, const std::vector<std::string>& leftToOthers = {}) {
    MappingReader(root_, "", errors_, dimensioned_).readInto(document, leftToOthers);
    if (errors_.full()) errors_.throwIfAny();
  }

  /// Fills in what follows from other values, and notes what is wrong between them.
  void check(Scene& scene);

  /// The file as a tree, with all overrides applied; what it says of files may be resolved before it is read.
  YamlNode& root() { return root_; }
  Diagnostics& errors() { return errors_; }

  /// Throws one `Error` with everything that is wrong, or lets the scene know where it comes from. The
  /// reading is used up.
  void finish(Scene& scene, std::string resolvedYaml);

 private:
  std::string name_;
  Diagnostics errors_;
  YamlNode root_;
  std::vector<DimensionedList> dimensioned_;
};

}  // namespace burnish::inline scene
