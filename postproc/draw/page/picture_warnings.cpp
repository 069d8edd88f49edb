#include "postproc/draw/page/picture_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace burnish {
namespace {

/// The gaps of a field in the frame that has most of them, and all frames that have some.
struct NotedGaps {
  FieldGaps most{0, 0, {}};
  std::set<std::optional<int>> frames;
};

struct Noted {
  std::vector<std::string> texts;
  std::map<GappyField, NotedGaps> gaps;
};

std::mutex& warningsMutex() {
  static std::mutex mutex;
  return mutex;
}

Noted& noted() {
  static Noted all;
  return all;
}

std::string gapsText(const GappyField& field, const NotedGaps& gaps) {
  const auto& [count, all, frame] = gaps.most;
  const bool areMany = gaps.frames.size() > 1;
  return fmt::format(
      "field {} has no finite value at {}{} of {} {}{}; where it has none it is drawn without colours",
      field.field, areMany ? "up to " : "", count, all, field.places,
      areMany ? fmt::format(" in {} frames", gaps.frames.size())
      : frame ? fmt::format(" in frame {}", *frame)
              : "");
}

}  // namespace

void noteWarning(const std::string& text) {
  const std::lock_guard lock(warningsMutex());
  std::vector<std::string>& texts = noted().texts;
  if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
}

void noteGaps(const GappyField& field, const FieldGaps& gaps) {
  const std::lock_guard lock(warningsMutex());
  NotedGaps& known = noted().gaps[field];
  known.frames.insert(gaps.frame);
  if (gaps.count > known.most.count) known.most = gaps;
}

std::vector<std::string> takeWarnings() {
  const std::lock_guard lock(warningsMutex());
  Noted taken = std::exchange(noted(), {});
  for (const auto& [field, gaps] : taken.gaps) taken.texts.push_back(gapsText(field, gaps));
  return std::move(taken.texts);
}

}  // namespace burnish
