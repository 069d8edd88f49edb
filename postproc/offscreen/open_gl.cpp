#include "postproc/offscreen/open_gl.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "postproc/offscreen/quiet_libraries.h"

namespace burnish {
namespace {

struct GlChoice {
  std::string_view name;
  std::unique_ptr<OpenGl> (*load)();
};

/// The first that is there is taken.
constexpr std::array<GlChoice, 2> kGlChoices{{{"osmesa", loadOsMesa}, {"egl", loadEgl}}};

std::unique_ptr<OpenGl> firstThatIsThere() {
  std::string missing;
  for (const GlChoice& choice : kGlChoices) {
    try {
      return choice.load();
    } catch (const Error& error) {
      missing += (missing.empty() ? "" : "; and ") + std::string(error.what());
    }
  }
  throw Error(missing);
}

std::unique_ptr<OpenGl> loadChosen() {
  prepareMesa();
  const char* chosen = std::getenv("BURNISH_GL");
  if (chosen == nullptr || *chosen == '\0') return firstThatIsThere();
  for (const GlChoice& choice : kGlChoices)
    if (chosen == choice.name) return choice.load();
  throw Error(fmt::format("environment variable BURNISH_GL: found '{}'; allowed: osmesa, egl", chosen));
}

std::atomic<bool> isLoaded{false};

}  // namespace

const OpenGl& openGl() {
  static const std::unique_ptr<OpenGl> chosen = loadChosen();
  isLoaded = true;
  return *chosen;
}

bool openGlIsLoaded() {
  return isLoaded;
}

}  // namespace burnish
