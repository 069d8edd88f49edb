#pragma once
#include <string>
#include <utility>

#include "engine/schema/diagnostics.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline schema {

/// Where the checks of a part of a document report what is wrong with its keys.
class Problems {
 public:
  /// path: of the mapping that holds the keys. Refers to `root` and `errors`.
  Problems(const YamlNode& root, Diagnostics& errors, std::string path)
      : root_(&root), errors_(&errors), path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  std::string pathOf(const std::string& key) const { return path_ + "." + key; }

  /// Whether nothing is wrong with a key, such as "radius" or "points[3]".
  bool clean(const std::string& key) const { return errors_->clean(pathOf(key)); }

  /// Whether nothing is wrong with the mapping.
  bool clean() const { return errors_->clean(path_); }

  void report(const std::string& key, const std::string& problem) const { add(pathOf(key), problem); }

  /// What is wrong with the mapping as a whole.
  void report(const std::string& problem) const { add(path_, problem); }

 protected:
  /// The same for another mapping.
  Problems at(std::string path) const { return {*root_, *errors_, std::move(path)}; }

 private:
  void add(const std::string& path, const std::string& problem) const {
    errors_->add(placeOf(*root_, path), path, problem);
  }

  const YamlNode* root_;
  Diagnostics* errors_;
  std::string path_;
};

}  // namespace burnish::inline schema
