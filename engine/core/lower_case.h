#pragma once
#include <cctype>
#include <string>

namespace burnish::inline core {

/// For words that programs write in capitals or not; letters beyond ASCII stay.
inline std::string inLowerCase(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace burnish::inline core
