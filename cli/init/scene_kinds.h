#pragma once
#include <string>
#include <vector>

namespace burnish {

/// A scene to begin with, one file of `cli/init/kinds` each.
struct SceneKind {
  std::string name;  ///< of the file, without its ending
  std::string text;  ///< YAML, whose first comment says what it is

  /// Its first comment, without #.
  std::string sentence() const;
};

/// All of them, the simplest one first.
std::vector<SceneKind> sceneKinds();

}  // namespace burnish
