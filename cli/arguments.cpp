#include "cli/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr int kSmallestPicture = 200;
constexpr int kLargestPicture = 8000;

/// The whole text as a number, or nothing.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// `A,B`, or nothing.
template <class Number>
std::optional<std::array<Number, 2>> pairFrom(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto first = numberFrom<Number>(text.substr(0, comma));
  const auto second = numberFrom<Number>(text.substr(comma + 1));
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

int frameAtTime(double time, const std::vector<double>& times) {
  const auto nearest = std::min_element(times.begin(), times.end(), [=](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  const auto index = static_cast<int>(nearest - times.begin());
  if (std::abs(*nearest - time) <= 1e-9 * std::max(1.0, std::abs(time))) return index;
  throw Error(fmt::format("--frame: there is no frame at t = {}; the nearest is frame {} at t = {}", time,
                          index, *nearest));
}

}  // namespace

int frameIndex(const std::string& text, const std::vector<double>& times) {
  if (times.empty()) throw Error("the result has no frames yet");
  const int last = static_cast<int>(times.size()) - 1;
  if (text == "last") return last;
  if (text.starts_with("time=")) {
    const auto time = numberFrom<double>(std::string_view(text).substr(5));
    if (time && std::isfinite(*time)) return frameAtTime(*time, times);
  }
  const auto index = numberFrom<int>(text);
  if (!index) throw Error(fmt::format("--frame: found \"{}\"; expected a number, last, or time=T", text));
  if (*index < 0 || *index > last)
    throw Error(fmt::format("--frame: there is no frame {}; the result has frames 0 to {}", *index, last));
  return *index;
}

std::array<double, 2> rangeFromText(const std::string& text) {
  const auto range = pairFrom<double>(text);
  if (range && std::isfinite((*range)[0]) && std::isfinite((*range)[1]) && (*range)[0] < (*range)[1])
    return *range;
  throw Error(fmt::format("--range: found \"{}\"; expected LO,HI: two numbers, the first one smaller", text));
}

std::array<int, 2> sizeFromText(const std::string& text) {
  const auto size = pairFrom<int>(text);
  const auto fits = [](int n) { return n >= kSmallestPicture && n <= kLargestPicture; };
  if (size && fits((*size)[0]) && fits((*size)[1])) return *size;
  throw Error(fmt::format("--size: found \"{}\"; expected W,H: pixels from {} to {}", text, kSmallestPicture,
                          kLargestPicture));
}

void makeDirectoryOf(const std::filesystem::path& file) {
  const auto directory = file.parent_path();
  if (directory.empty()) return;
  std::error_code status;
  std::filesystem::create_directories(directory, status);
  if (status)
    throw Error(fmt::format("-o: cannot create the directory {}: {}", directory.string(), status.message()));
}

}  // namespace burnish
