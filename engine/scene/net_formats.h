#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/schema/yaml_tree.h"

/// Files of other programs that hold NURBS, as mappings of degrees, knots, points and weights, as control nets are
/// given in scenes. Numbers keep their values to the last bit, but for points with weights in g2, which are stored
/// multiplied by these.
namespace burnish::inline scene {

/// Curves, surfaces and volumes of a g2 file of GoTools (100, 200, 700), in their order; one after the other. What is
/// wrong is added to `errors`, and nothing is returned. source, path: of the file, for places.
std::optional<std::vector<YamlNode>> netsOfG2(const std::string& text, int source, const std::string& path,
                                              Diagnostics& errors);

/// Whether a text is JSON; what is not is added to `errors`.
bool isJson(const std::string& text, int source, const std::string& path, Diagnostics& errors);

/// The same as of g2 of JSON as geomdl (NURBS-Python) and `burnish export` write it. document: as read; it has a key `shape`. Trimmed surfaces are
/// refused.
std::optional<std::vector<YamlNode>> netsOfJson(const YamlNode& document, const std::string& path,
                                                Diagnostics& errors);

}  // namespace burnish::inline scene
