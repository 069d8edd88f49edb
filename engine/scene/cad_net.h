#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// A face of a CAD file as a mapping of degrees, knots, points and weights, all of it at the place where the file is named, as `shape`, a
/// mapping at a path, has it by its keys `face`, `unit` and `flip`. ∂1 x ∂2 points out of the face's solid; a plane body is in the
/// plane z = 0, in which its directions are turned counterclockwise. root: of the scene, for its units. What is wrong is added to
/// `errors`, and nothing is returned.
std::optional<YamlNode> netOfCad(const std::filesystem::path& file, const YamlNode& shape,
                                 const YamlNode& root, const std::string& path, bool isPlaneBody,
                                 Diagnostics& errors);

}  // namespace burnish::inline scene
