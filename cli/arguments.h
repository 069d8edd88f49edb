#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// Values of options that are more than a number or a word. All throw `Error` with the option, what was found
/// and what is expected.
namespace burnish {

/// `N`, `last` or `time=T` as an index into the frames with these times.
int frameIndex(const std::string& text, const std::vector<double>& times);

/// `LO,HI` with LO < HI.
std::array<double, 2> rangeFromText(const std::string& text);

/// `W,H` in pixels.
std::array<int, 2> sizeFromText(const std::string& text);

/// Creates the directory that a file given with -o goes to.
void makeDirectoryOf(const std::filesystem::path& file);

}  // namespace burnish
