#include "engine/core/stl_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/core/lower_case.h"

namespace burnish::inline core {
namespace {

constexpr std::int64_t kStlHead = 84, kStlTriangle = 50;  // bytes of a binary file

std::string triangleDamage(std::int64_t announced, std::int64_t found) {
  return fmt::format("the file is damaged: it announces {} triangles and holds {}", announced, found);
}

/// In letters: facets and an end.
std::string textDamage(std::ifstream& stream) {
  std::string line;
  std::int64_t begun = 0, ended = 0;
  bool isEnded = false;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    word = inLowerCase(word);
    if (word == "facet") ++begun;
    if (word == "endfacet") ++ended;
    if (word == "endsolid") isEnded = true;
  }
  if (begun != ended) return triangleDamage(begun, ended);
  return isEnded ? "" : "the file is damaged: it has no endsolid";
}

}  // namespace

std::string stlDamage(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(kStlHead, '\0');
  stream.read(head.data(), kStlHead);
  stream.clear();
  stream.seekg(0);
  const bool isText = inLowerCase(head.substr(0, 5)) == "solid" && head.find('\0') == std::string::npos;
  if (isText) return textDamage(stream);
  // 80 bytes, the number of triangles, the triangles
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file));
  std::uint32_t announced = 0;
  std::memcpy(&announced, head.data() + kStlHead - sizeof(announced), sizeof(announced));
  const std::int64_t found = std::max<std::int64_t>(0, size - kStlHead) / kStlTriangle;
  return found >= announced && size >= kStlHead ? "" : triangleDamage(announced, found);
}

}  // namespace burnish::inline core
