#include "engine/core/quoted.h"

#include "engine/core/shown_text.h"

namespace burnish::inline core {

std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 60;
  return forMessage(text, longest);
}

std::string quoted(const std::string& text) {
  return '"' + shortened(text) + '"';
}

}  // namespace burnish::inline core
