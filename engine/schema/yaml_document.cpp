#include "engine/schema/yaml_document.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace burnish::inline schema {

std::string readDocument(const std::filesystem::path& file, const DocumentKind& kind) {
  constexpr std::size_t largest = 64 * 1024 * 1024;
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(fmt::format("{}: this is a directory; a {} is a {} file", name, kind.name, kind.format));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  std::string text;
  std::vector<char> block(64 * 1024);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest)
      throw Error(
          fmt::format("{}: larger than 64 MB; a {} is a small {} file", name, kind.name, kind.format));
  }
  return text;
}

YamlNode parseDocument(const std::string& yaml, const DocumentKind& kind, Diagnostics& errors) {
  auto root = parseYaml(yaml, 0, errors);
  if (root && root->kind == YamlNode::Kind::Null)
    errors.add(root->place, "", fmt::format("the file is empty; a {} has at least {}", kind.name, kind.keys));
  else if (root && root->kind != YamlNode::Kind::Mapping)
    errors.add(root->place, "",
               fmt::format("found {}; a {} is a mapping of keys such as {}", root->describe(), kind.name,
                           kind.keys));
  if (!root || root->kind != YamlNode::Kind::Mapping) errors.throwIfAny();
  return *std::move(root);
}

}  // namespace burnish::inline schema
