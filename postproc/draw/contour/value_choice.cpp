#include "postproc/draw/contour/value_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "engine/core/drawable_range.h"
#include "postproc/mesh/picture_planes.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

constexpr int kNoteDigits = 4;

/// What stands before the sign of equality, and behind it; all of a text without one.
std::pair<std::string, std::string_view> fieldAndRest(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {"", text};
  return {text.substr(0, equals), std::string_view(text).substr(equals + 1)};
}

std::string withUnit(const std::string& numbers, const std::string& unit) {
  return unit.empty() ? numbers : numbers + " " + unit;
}

std::string endText(double end) {
  return std::isinf(end) ? "" : fmt::format("{}", end);
}

}  // namespace

std::vector<double> ChosenValues::of(const std::optional<std::array<double, 2>>& range) const {
  if (count == 0) return values;
  if (!range) return {};
  std::vector<double> result;
  for (int k = 0; k < count; ++k)
    result.push_back(std::lerp((*range)[0], (*range)[1], (k + 1.0) / (count + 1.0)));
  return result;
}

std::optional<ValueBand> Spelling<ValueBand>::read(const std::string& text) {
  const auto [field, rest] = fieldAndRest(text);
  const auto parts = commaParts(rest);
  if (text.starts_with('=') || parts.size() != 2 || (parts[0].empty() && parts[1].empty()))
    return std::nullopt;
  ValueBand band{field, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    if (parts[k].empty()) {
      band.ends[k] = ValueBand{}.ends[k];
      continue;
    }
    const auto number = finiteNumber(parts[k]);
    if (!number || std::abs(*number) > kLargestDrawn) return std::nullopt;
    band.ends[k] = *number;
  }
  if (!(band.ends[0] < band.ends[1])) return std::nullopt;
  return band;
}

std::string Spelling<ValueBand>::write(const ValueBand& band) {
  return fmt::format("{}{}{},{}", band.field, band.field.empty() ? "" : "=", endText(band.ends[0]),
                     endText(band.ends[1]));
}

std::optional<ChosenValues> Spelling<ChosenValues>::read(const std::string& text) {
  const auto [field, rest] = fieldAndRest(text);
  const auto parts = commaParts(rest);
  std::vector<double> numbers;
  for (const std::string_view part : parts) {
    const auto number = finiteNumber(part);
    if (!number || std::abs(*number) > kLargestDrawn || (!numbers.empty() && *number <= numbers.back()))
      return std::nullopt;
    numbers.push_back(*number);
  }
  const bool isCount = text.find('=') == std::string::npos;
  if (!isCount) {
    if (field.empty() || numbers.size() > kMostSurfaces) return std::nullopt;
    return ChosenValues{0, field, numbers};
  }
  if (numbers.size() != 1 || numbers[0] != std::floor(numbers[0]) || numbers[0] < 1 ||
      numbers[0] > kMostSurfaces)
    return std::nullopt;
  return ChosenValues{static_cast<int>(numbers[0]), "", {}};
}

std::string Spelling<ChosenValues>::write(const ChosenValues& chosen) {
  if (chosen.count > 0) return fmt::format("{}", chosen.count);
  return fmt::format("{}={}", chosen.field, fmt::join(chosen.values, ","));
}

std::string bandNote(const ValueBand& band, const std::string& words, const std::string& unit) {
  const auto number = [](double end) { return numberText(end, kNoteDigits); };
  const auto& [low, high] = band.ends;
  if (std::isinf(low)) return fmt::format("shown: {} up to {}", words, withUnit(number(high), unit));
  if (std::isinf(high)) return fmt::format("shown: {} from {}", words, withUnit(number(low), unit));
  return fmt::format("shown: {} from {} to {}", words, number(low), withUnit(number(high), unit));
}

std::string surfacesNote(const std::vector<double>& values, const std::string& words,
                         const std::string& unit) {
  constexpr std::size_t kListed = 6;
  const std::size_t count = values.size();
  if (count > kListed)
    return fmt::format("{} surfaces: {} = {}, {}, …, {}", count, words, numberText(values[0], kNoteDigits),
                       numberText(values[1], kNoteDigits),
                       withUnit(numberText(values.back(), kNoteDigits), unit));
  std::string numbers;
  for (const double value : values) numbers += (numbers.empty() ? "" : ", ") + numberText(value, kNoteDigits);
  return fmt::format("surface{}: {} = {}", count == 1 ? "" : "s", words, withUnit(numbers, unit));
}

}  // namespace burnish
