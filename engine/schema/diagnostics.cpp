#include "engine/schema/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/shown_text.h"

namespace burnish::inline schema {
namespace {

constexpr std::size_t kLongestOverride = 200;  ///< letters of one in a message

/// Whether a path is the outer one or leads through it.
bool isWithin(const std::string& path, const std::string& outer) {
  if (!path.starts_with(outer)) return false;
  return path.size() == outer.size() || path[outer.size()] == '.' || path[outer.size()] == '[';
}

}  // namespace

Diagnostics::Diagnostics(std::string file, std::vector<std::string> overrides)
    : file_(std::move(file)), overrides_(std::move(overrides)) {}

int Diagnostics::addFile(std::string file) {
  furtherFiles_.push_back(std::move(file));
  return static_cast<int>(overrides_.size() + furtherFiles_.size());
}

void Diagnostics::add(const Place& place, const std::string& key, const std::string& problem) {
  if (!full()) entries_.push_back({place, key, problem});
}

bool Diagnostics::clean(const std::string& key) const {
  return std::none_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return !entry.key.empty() && (isWithin(entry.key, key) || isWithin(key, entry.key));
  });
}

std::string Diagnostics::line(const Entry& entry) const {
  const auto& [source, row, column] = entry.place;
  const auto number = static_cast<std::size_t>(source);
  const bool inOverride = number > 0 && number <= overrides_.size();
  const std::string& file = number == 0 || inOverride ? file_ : furtherFiles_[number - overrides_.size() - 1];
  const std::string place =
      inOverride ? fmt::format("--set {}", forMessage(overrides_[number - 1], kLongestOverride))
                 : fmt::format("{}:{}:{}", file, row, column);
  return entry.key.empty() ? fmt::format("{}: {}", place, entry.problem)
                           : fmt::format("{}: {}: {}", place, entry.key, entry.problem);
}

std::string Diagnostics::text() const {
  constexpr std::size_t shown = 20;

  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  std::string message;
  for (std::size_t i = 0; i < std::min(shown, sorted.size()); ++i)
    message += (i > 0 ? "\n" : "") + line(sorted[i]);
  if (sorted.size() > shown)
    message += fmt::format("\n{} and {}{} more", file_, full() ? "at least " : "", sorted.size() - shown);
  return message;
}

void Diagnostics::throwIfAny() const {
  if (!entries_.empty()) throw Error(text());
}

}  // namespace burnish::inline schema
