#pragma once
#include <fmt/format.h>

#include <string>

#include "engine/core/shown_text.h"

namespace burnish {

/// A line of what `burnish info` prints.
inline std::string infoLine(const std::string& label, const std::string& text) {
  return fmt::format("{:<12}{}\n", label, text);
}

/// A text of a file as a line can show it: the file may hold more than a scene allows.
inline std::string infoWords(const std::string& text) {
  return forMessage(text, kLongestShownText);
}

}  // namespace burnish
