#pragma once
#include <string>
#include <vector>

namespace burnish {

enum class Script { Normal, Sub, Super };

/// A piece of text on the line or as a smaller index or exponent.
struct TextRun {
  std::string text;
  Script script = Script::Normal;
};

/// A line of text, UTF-8: there are no Unicode characters for most indices, so they are set like this.
using RichText = std::vector<TextRun>;

}  // namespace burnish
