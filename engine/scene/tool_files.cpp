#include "engine/scene/tool_files.h"

#include "engine/core/unit_label.h"
#include "engine/scene/cad_unit.h"
#include "engine/tools/tool_shape.h"

namespace burnish::inline scene {
namespace {

/// The unit into which lengths are converted, as the keys of tools name it.
void resolveUnit(YamlNode& tool, const std::string& path, const YamlNode& root, Diagnostics& errors) {
  if (YamlNode* given = tool.find("unit")) {
    if (const auto unit = lengthUnitOf(given->text)) given->text = labelOf(*unit);
    return;
  }
  if (auto unit = cadUnitOf(root, path, errors))
    tool.children.push_back(
        {.kind = YamlNode::Kind::Scalar, .place = tool.place, .text = *std::move(unit), .key = "unit"});
}

}  // namespace

void resolveToolFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors) {
  forEachToolShape(root, [&](YamlNode& tool, const std::string& path) {
    const YamlNode* shape = tool.find("shape");
    if (shape == nullptr || fileOf(shape->text) != ShapeFile::Read) return;
    for (YamlNode& file : tool.children)
      if (file.key == "file" && file.kind == YamlNode::Kind::Scalar && !file.text.empty())
        file.text = std::filesystem::absolute(directory / file.text).lexically_normal().string();
    if (shape->text == CadTool::kind.key) resolveUnit(tool, path, root, errors);
  });
}

}  // namespace burnish::inline scene
