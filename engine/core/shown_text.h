#pragma once
#include <cstddef>
#include <string>
#include <string_view>

/// Texts that are shown: titles, labels, units, names.
namespace burnish::inline core {

/// Most letters of a title, a label or a unit, and of a name, which may become that of a file.
inline constexpr std::size_t kLongestShownText = 1000, kLongestName = 200;

/// A letter of a text in UTF-8.
struct Utf8Letter {
  char32_t code;
  std::size_t length;  ///< bytes; 0 if the byte begins no letter of UTF-8, whose code is then U+FFFD
};
Utf8Letter letterAt(std::string_view text, std::size_t at);

/// The number of letters; a byte that belongs to none counts as one.
std::size_t letterCount(std::string_view text);

/// The beginning of a text with so many letters, or all of it.
std::string_view firstLetters(std::string_view text, std::size_t count);

/// Whether a letter is a control character other than the end of a line and the tabulator, or none that text
/// may hold.
bool isControl(char32_t code);

/// Why a text cannot be shown: "found the byte 0xFF as letter 4; allowed: ...". Empty if it can.
std::string encodingFault(std::string_view text);

/// The same, also for a text of more than so many letters.
std::string shownTextFault(std::string_view text, std::size_t longest = kLongestShownText);

/// A text as a message repeats it, in one line: what cannot be shown as \n, \x1B or \xFF, and no more than
/// so many letters, then "...".
std::string forMessage(std::string_view text, std::size_t longest);

}  // namespace burnish::inline core
