#include "engine/scene/tool_files.h"

#include "engine/cad/unit_label.h"
#include "engine/tools/tool_shape.h"

namespace burnish {
namespace {

/// The label of the scene's lengths, if it is a unit that CAD files know.
const YamlNode* unitOfLengths(const YamlNode& root) {
  const YamlNode* units = root.find("units");
  const YamlNode* length = units != nullptr ? units->find("length") : nullptr;
  return length != nullptr && lengthUnitOf(length->text) ? length : nullptr;
}

}  // namespace

void resolveToolFiles(YamlNode& root, const std::filesystem::path& directory) {
  const YamlNode* length = unitOfLengths(root);
  forEachToolShape(root, [&](YamlNode& tool, const std::string&) {
    const YamlNode* shape = tool.find("shape");
    if (shape == nullptr || fileOf(shape->text) != ShapeFile::Read) return;
    for (YamlNode& file : tool.children)
      if (file.key == "file" && file.kind == YamlNode::Kind::Scalar && !file.text.empty())
        file.text = std::filesystem::absolute(directory / file.text).lexically_normal().string();
    if (length != nullptr && shape->text == CadTool::kind.key && tool.find("unit") == nullptr) {
      YamlNode unit = *length;
      unit.key = "unit";
      tool.children.push_back(std::move(unit));
    }
  });
}

}  // namespace burnish
