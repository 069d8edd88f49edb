#include "postproc/offscreen/quiet_libraries.h"

#include <pwd.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace burnish {
namespace {

/// Where Mesa keeps compiled shaders, or nothing.
std::filesystem::path shaderCache() {
  for (const char* variable : {"MESA_SHADER_CACHE_DIR", "XDG_CACHE_HOME"})
    if (const char* place = std::getenv(variable)) return place;
  const passwd* user = ::getpwuid(::getuid());
  return user != nullptr ? std::filesystem::path(user->pw_dir) / ".cache" : "";
}

}  // namespace

void prepareMesa() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver != nullptr && std::string_view(driver) != "softpipe") ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  ::setenv("EGL_LOG_LEVEL", "fatal", 1);
  std::error_code problem;
  const std::filesystem::path place = shaderCache();
  std::filesystem::create_directories(place / "mesa_shader_cache", problem);
  if (place.empty() || problem) ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

}  // namespace burnish
