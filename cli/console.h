#pragma once
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

/// All that the program prints goes through here. Nothing throws while a command works: what cannot be
/// printed on standard output is noted and told at the end, what cannot be printed on standard error has no
/// one to be told.
namespace burnish {

/// Gives /dev/null to those of the descriptors 0, 1 and 2 that are closed: the next files to be opened would
/// get their numbers, and lines meant for the terminal would land in them. To be called first in main().
void openStandardDescriptors();

/// What a word says: on a terminal that shows colours it is green, yellow or red.
enum class Tone { Good, Doubtful, Bad };

/// A word for standard output in its colour, if that is a terminal; not with NO_COLOR set, nor where TERM is dumb.
std::string toned(Tone tone, const std::string& word);

/// On standard output, buffered as that is.
void printText(std::string_view text);

/// On standard error, at once, behind what was printed on standard output before; on a terminal with a colour where a message
/// begins.
void printErrorText(std::string_view text);

template <class... Values>
void printOut(fmt::format_string<Values...> format, Values&&... values) {
  printText(fmt::format(format, std::forward<Values>(values)...));
}

template <class... Values>
void printError(fmt::format_string<Values...> format, Values&&... values) {
  printErrorText(fmt::format(format, std::forward<Values>(values)...));
}

/// Columns of the terminal that standard output is, or 80.
std::size_t terminalColumns();

/// Hands what was printed on standard output to the system.
void flushOutput();

/// Whether a reader of standard output that goes away, as `head` does, is a failure to print.
enum class GoneReader { Fails, IsFine };

/// To be called at the end: throws `Error` if anything could not be printed on standard output.
void requirePrinted(GoneReader reader);

}  // namespace burnish
