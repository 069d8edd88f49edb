#include "postproc/draw/font.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "engine/core/error.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string findFont(const std::string& name) {
  constexpr std::array roots{"/usr/share/fonts", "/usr/local/share/fonts", "/usr/share/texmf/fonts"};
  for (const char* root : roots) {
    std::error_code unreadable;
    const auto options = fs::directory_options::skip_permission_denied;
    for (auto it = fs::recursive_directory_iterator(root, options, unreadable);
         !unreadable && it != fs::recursive_directory_iterator(); it.increment(unreadable))
      if (it->path().filename() == name) return it->path().string();
  }
  throw Error(
      fmt::format("the font {} is not in /usr/share/fonts; install the package fonts-dejavu-core", name));
}

}  // namespace

const std::string& fontFile(FontWeight weight) {
  static const std::string regular = findFont("DejaVuSans.ttf");
  if (weight == FontWeight::Regular) return regular;
  static const std::string bold = findFont("DejaVuSans-Bold.ttf");
  return bold;
}

}  // namespace burnish
