#include "engine/core/quoted.h"

namespace burnish {

std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    --end;  // keep UTF-8 characters whole
  return text.substr(0, end) + "...";
}

std::string quoted(const std::string& text) {
  return '"' + shortened(text) + '"';
}

}  // namespace burnish
