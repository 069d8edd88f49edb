#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/scene/scene_document.h"

namespace burnish {

/// A scene that a command was given: of a file, or of standard input for -, whose files are those of the working directory.
/// Throws `Error` with everything that is wrong.
SceneDocument readSceneInput(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});

/// Whether - was given.
bool isStandardInput(const std::filesystem::path& file);

}  // namespace burnish
