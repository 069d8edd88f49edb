#pragma once
#include <filesystem>
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline schema {

/// What a kind of YAML document is called in messages.
struct DocumentKind {
  std::string name;             ///< "scene"
  std::string keys;             ///< the most important ones: "geometry, material and steps"
  std::string format = "YAML";  ///< of its files
};

/// Throws `Error` if the file cannot be read or is larger than 64 MB.
std::string readDocument(const std::filesystem::path& file, const DocumentKind& kind);

/// The tree of a document, a mapping. Throws everything that is wrong so far if it is none.
YamlNode parseDocument(const std::string& yaml, const DocumentKind& kind, Diagnostics& errors);

}  // namespace burnish::inline schema
