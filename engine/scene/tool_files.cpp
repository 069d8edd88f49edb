#include "engine/scene/tool_files.h"

#include "engine/tools/tool_shape.h"

namespace burnish {

void resolveToolFiles(YamlNode& root, const std::filesystem::path& directory) {
  forEachToolShape(root, [&](YamlNode& tool, const std::string&) {
    const YamlNode* shape = tool.find("shape");
    if (shape == nullptr || fileOf(shape->text) != ShapeFile::Read) return;
    for (YamlNode& file : tool.children)
      if (file.key == "file" && file.kind == YamlNode::Kind::Scalar && !file.text.empty())
        file.text = std::filesystem::absolute(directory / file.text).lexically_normal().string();
  });
}

}  // namespace burnish
