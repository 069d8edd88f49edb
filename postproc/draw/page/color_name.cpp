#include "postproc/draw/page/color_name.h"

#include <charconv>
#include <map>

namespace burnish {
namespace {

const std::map<std::string, Color>& namedColors() {
  static const std::map<std::string, Color> table{
      {"white", {255, 255, 255}}, {"silver", {192, 192, 192}}, {"grey", {128, 128, 128}},
      {"gray", {128, 128, 128}},  {"black", {0, 0, 0}},        {"red", {255, 0, 0}},
      {"maroon", {128, 0, 0}},    {"orange", {255, 165, 0}},   {"yellow", {255, 255, 0}},
      {"olive", {128, 128, 0}},   {"lime", {0, 255, 0}},       {"green", {0, 128, 0}},
      {"aqua", {0, 255, 255}},    {"teal", {0, 128, 128}},     {"blue", {0, 0, 255}},
      {"navy", {0, 0, 128}},      {"fuchsia", {255, 0, 255}},  {"purple", {128, 0, 128}}};
  return table;
}

}  // namespace

std::optional<Color> colorNamed(const std::string& text) {
  constexpr std::size_t length = 7;
  if (!text.starts_with('#')) {
    const auto found = namedColors().find(text);
    return found != namedColors().end() ? std::optional(found->second) : std::nullopt;
  }
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (text.size() != length || error != std::errc() || end != text.data() + length) return std::nullopt;
  const auto channel = [&](unsigned shift) { return static_cast<unsigned char>((value >> shift) & 0xFFU); };
  return Color{channel(16), channel(8), channel(0)};
}

const std::vector<std::string>& colorNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, color] : namedColors()) list.push_back(name);
    return list;
  }();
  return names;
}

}  // namespace burnish
