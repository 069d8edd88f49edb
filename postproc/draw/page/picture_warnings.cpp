#include "postproc/draw/page/picture_warnings.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace burnish {
namespace {

std::mutex& warningsMutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<std::string>& warningsOfPictures() {
  static std::vector<std::string> warnings;
  return warnings;
}

}  // namespace

void noteWarning(const std::string& text) {
  const std::lock_guard lock(warningsMutex());
  std::vector<std::string>& warnings = warningsOfPictures();
  if (std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(text);
}

std::vector<std::string> takeWarnings() {
  const std::lock_guard lock(warningsMutex());
  return std::exchange(warningsOfPictures(), {});
}

}  // namespace burnish
