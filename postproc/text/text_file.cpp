#include "postproc/text/text_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace burnish {

void makeDirectory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error)
    throw Error(fmt::format("cannot make the directory {}: {}", directory.string(), error.message()));
}

void writeText(const std::string& text, const std::filesystem::path& file) {
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw Error(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

}  // namespace burnish
