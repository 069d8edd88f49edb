#include "engine/core/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace burnish::inline core {
namespace {

constexpr Utf8Letter kNone{0xFFFD, 0};

std::size_t lengthFrom(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  return first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
}

/// Where the letter after the one at `at` begins.
std::size_t next(std::string_view text, std::size_t at) {
  return at + std::max<std::size_t>(1, letterAt(text, at).length);
}

}  // namespace

Utf8Letter letterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
  const std::size_t length = lengthFrom(byte(0));
  if (length == 1) return {byte(0), 1};
  if (length == 0 || at + length > text.size()) return kNone;
  char32_t code = byte(0) & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return kNone;
    code = code << 6U | (byte(k) & 0x3FU);
  }
  const bool tooLong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return tooLong || surrogate || code > 0x10FFFF ? kNone : Utf8Letter{code, length};
}

std::size_t letterCount(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); at = next(text, at)) ++count;
  return count;
}

std::string_view firstLetters(std::string_view text, std::size_t count) {
  std::size_t at = 0;
  for (; count > 0 && at < text.size(); --count) at = next(text, at);
  return text.substr(0, at);
}

bool isControl(char32_t code) {
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code & 0xFFFEU) == 0xFFFE;
}

std::string encodingFault(std::string_view text) {
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); at = next(text, at), ++number) {
    const auto [code, length] = letterAt(text, at);
    if (length == 0)
      return fmt::format("found the byte 0x{:02X} as letter {}; allowed: text in UTF-8",
                         static_cast<unsigned char>(text[at]), number);
    if (isControl(code))
      return fmt::format(
          "found the control character U+{:04X} as letter {}; allowed: letters that can be shown",
          static_cast<std::uint32_t>(code), number);
  }
  return {};
}

std::string shownTextFault(std::string_view text, std::size_t longest) {
  if (const std::size_t letters = letterCount(text); letters > longest)
    return fmt::format("found a text of {} letters; allowed: up to {}", letters, longest);
  return encodingFault(text);
}

std::string forMessage(std::string_view text, std::size_t longest) {
  const std::string_view kept = firstLetters(text, longest);
  std::string shown;
  for (std::size_t at = 0; at < kept.size(); at = next(kept, at)) {
    const auto [code, length] = letterAt(kept, at);
    if (code == '\n')
      shown += "\\n";
    else if (code == '\t')
      shown += "\\t";
    else if (length == 0)
      shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(kept[at]));
    else if (isControl(code))
      shown += fmt::format("\\x{:02X}", static_cast<std::uint32_t>(code));
    else
      shown += kept.substr(at, length);
  }
  return kept.size() < text.size() ? shown + "..." : shown;
}

}  // namespace burnish::inline core
