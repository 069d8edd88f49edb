#pragma once
#include <filesystem>
#include <string>

namespace burnish {

/// Makes a directory with those above it. Throws `Error` naming it.
void makeDirectory(const std::filesystem::path& directory);

/// Writes a text into a file, whose directory is made if needed; the file appears under its name only when it
/// is complete. Throws `Error` naming it.
void writeText(const std::string& text, const std::filesystem::path& file);

/// The bytes of a file as they are. Throws `Error` naming it.
std::string readText(const std::filesystem::path& file);

}  // namespace burnish
