#include "postproc/foreign/array_names.h"

#include <cstddef>

namespace burnish {

ArrayName arrayNameOf(const std::string& text) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || !text.ends_with("]")) return {text, ""};
  return {text.substr(0, bracket), text.substr(bracket + 2, text.size() - bracket - 3)};
}

}  // namespace burnish
