#include "postproc/foreign/array_names.h"

#include <cstddef>

#include "engine/core/shown_text.h"

namespace burnish {

ArrayName arrayNameOf(const std::string& text) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || !text.ends_with("]")) return {text, ""};
  return {text.substr(0, bracket), text.substr(bracket + 2, text.size() - bracket - 3)};
}

std::string typedName(const std::string& text) {
  std::string name;
  for (char letter : forMessage(text, kLongestName)) {
    if (letter == ',') letter = ' ';
    if (letter != ' ' || (!name.empty() && name.back() != ' ')) name += letter;
  }
  if (name.ends_with(' ')) name.pop_back();
  return name.empty() ? "unnamed" : name;
}

}  // namespace burnish
