#include "postproc/foreign/foreign_source.h"

#include "engine/core/module_function.h"
#include "postproc/foreign/foreign_formats.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

using Opener = ForeignSource*(const fs::path& file);

Opener* opener() {
  static auto* const open = reinterpret_cast<Opener*>(
      moduleFunction({"burnish_readers.so"}, "burnishOpenForeign", "a file of another program"));
  return open;
}

}  // namespace

std::string foreignKind(const fs::path& file) {
  const ForeignFormat* format = foreignFormat(file);
  return format != nullptr ? format->words : "";
}

std::vector<std::string> foreignEndings() {
  std::vector<std::string> endings;
  for (const ForeignFormat& format : kForeignFormats) endings.emplace_back(format.ending);
  return endings;
}

void loadReaders() {
  opener();
}

std::unique_ptr<ForeignSource> openForeign(const fs::path& file) {
  return std::unique_ptr<ForeignSource>(opener()(file));
}

}  // namespace burnish
