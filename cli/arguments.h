#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/shown_text.h"

/// Values of options that are more than a number or a word. All throw `Error` with the option, what was found
/// and what is expected.
namespace burnish {

/// The value of a word given with an option; choices: pairs of word and value. The error tells the nearest.
template <class Choices>
auto chosen(const char* option, const std::string& word, const Choices& choices) {
  std::vector<std::string> words;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    words.emplace_back(name);
  }
  throw Error(fmt::format("{}: found \"{}\"; expected {}.{}", option, word, fmt::join(words, ", "),
                          didYouMean(word, words)));
}

/// For `CLI::Option::check`: why a title or a label cannot be shown, or nothing.
inline std::string cannotBeShown(const std::string& text) {
  return shownTextFault(text);
}

/// `N`, `last`, `end` or `time=T` as an index into the frames with these times.
int frameIndex(const std::string& text, const std::vector<double>& times);

/// The same, or `A-B` or `all`, or several of these with commas between them: indices in ascending order.
std::vector<int> frameIndices(const std::string& text, const std::vector<double>& times);

/// The names of pictures of these frames: in the pattern {frame} and {time} are replaced by index and time of
/// a frame, {frame:04} with four digits. The names differ.
std::vector<std::filesystem::path> pictureNames(const std::string& pattern, const std::vector<int>& frames,
                                                const std::vector<double>& times);

/// `LO,HI`, a range that can be drawn. words: what the option may be instead.
std::array<double, 2> rangeFromText(const char* option, const std::string& text,
                                    const std::vector<std::string>& words = {});

/// "W,H: pixels from 200 x 150 to 8000 x 8000".
std::string sizeWords();

/// `W,H` in pixels.
std::array<int, 2> sizeFromText(const std::string& text);

/// A word of a command line for the shell, in quotes where it needs them.
std::string shellWord(const std::string& word);

/// Throws `Error` if a file that an option asks for is one of those that the command reads, under whatever
/// name. Inputs that are empty stand for none.
void requireNotInput(const char* option, const std::filesystem::path& output,
                     const std::vector<std::filesystem::path>& inputs);

/// Throws `Error` if what stands for a directory is -, or an option before which the directory is missing.
void requireDirectoryName(const char* option, const std::filesystem::path& directory);

/// Throws `Error` if the document of --document is to be printed.
void requireDocumentName(const std::filesystem::path& file);

/// Creates the directory that a file given with -o goes to.
void makeDirectoryOf(const std::filesystem::path& file);

}  // namespace burnish
