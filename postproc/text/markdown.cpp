#include "postproc/text/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "postproc/text/ticks.h"

namespace burnish {
namespace {

constexpr int kDigits = 4;

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t k = text.find(what); k != std::string::npos; k = text.find(what, k + by.size()))
    text.replace(k, what.size(), by);
  return text;
}

/// What stands in one line of a table, between bars.
std::string cellText(const std::string& text) {
  return replaced(replaced(text, "\n", " "), "|", "\\|");
}

std::string withMinus(const std::string& text) {
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// Characters that are seen, of UTF-8.
std::size_t lengthOf(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string scientific(double value) {
  if (value == 0.0) return "0";
  const std::string text = fmt::format("{:.{}e}", value, kDigits - 2);
  const std::size_t e = text.find('e');
  return withMinus(text.substr(0, e)) + "×10" + superscript(std::stoi(text.substr(e + 1)));
}

/// Decimals that show kDigits digits of the largest magnitude, without zeros that all values end in.
int decimalsFor(const std::vector<std::optional<double>>& values, double largest) {
  int decimals = std::max(0, kDigits - 1 - static_cast<int>(std::floor(std::log10(largest))));
  const auto enough = [&](int fewer) {
    return std::all_of(values.begin(), values.end(), [&](const auto& value) {
      const double scaled = value.value_or(0.0) * std::pow(10.0, fewer);
      return std::abs(scaled - std::round(scaled)) < 1e-9 * std::max(1.0, std::abs(scaled));
    });
  };
  while (decimals > 0 && enough(decimals - 1)) --decimals;
  return decimals;
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width - std::min(width, lengthOf(text)), ' ');
  return right ? blanks + text : text + blanks;
}

std::string ruleOf(const MarkdownColumn& column, std::size_t width) {
  return column.number ? std::string(width - 1, '-') + ":" : std::string(width, '-');
}

}  // namespace

std::vector<std::string> columnTexts(const std::vector<std::optional<double>>& values) {
  constexpr double kLargestWhole = 1e7, kLargestFixed = 1e5, kSmallestFixed = 1e-3, kSmallestPlain = 1e-4,
                   kWidestFixed = 30.0;
  double largest = 0.0, smallest = HUGE_VAL;
  bool whole = true;
  for (const auto& value : values) {
    if (!value) continue;
    largest = std::max(largest, std::abs(*value));
    if (*value != 0.0) smallest = std::min(smallest, std::abs(*value));
    whole &= *value == std::round(*value);
  }
  const bool fixed =
      largest < kLargestFixed && largest >= kSmallestFixed && largest <= kWidestFixed * smallest;
  const bool plain = largest < kLargestFixed && smallest >= kSmallestPlain;
  const int decimals = fixed ? decimalsFor(values, largest) : 0;
  std::vector<std::string> texts;
  for (const auto& value : values) {
    if (!value)
      texts.emplace_back("—");
    else if (whole && largest < kLargestWhole)
      texts.push_back(withMinus(fmt::format("{:.0f}", *value)));
    else if (fixed)
      texts.push_back(withMinus(fmt::format("{:.{}f}", *value, decimals)));
    else
      texts.push_back(plain ? plainNumber(*value) : scientific(*value));
  }
  return texts;
}

std::string plainNumber(double value) {
  return numberText(value, kDigits);
}

std::string markdownTable(const std::vector<MarkdownColumn>& columns) {
  constexpr std::size_t kNarrowest = 3;
  std::vector<std::size_t> widths;
  for (const MarkdownColumn& column : columns) {
    std::size_t width = std::max(kNarrowest, lengthOf(cellText(column.title)));
    for (const std::string& cell : column.cells) width = std::max(width, lengthOf(cellText(cell)));
    widths.push_back(width);
  }
  std::string title, rule, rows;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    title += "| " + padded(cellText(columns[c].title), widths[c], columns[c].number) + " ";
    rule += "| " + ruleOf(columns[c], widths[c]) + " ";
  }
  for (std::size_t r = 0; r < columns.front().cells.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      rows += "| " + padded(cellText(columns[c].cells[r]), widths[c], columns[c].number) + " ";
    rows += "|\n";
  }
  return title + "|\n" + rule + "|\n" + rows;
}

std::string markdownPicture(const std::filesystem::path& link, const std::string& caption) {
  const std::string alternative = replaced(replaced(caption, "\n", " "), "]", "\\]");
  std::string text = fmt::format("![{}](<{}>)\n", replaced(alternative, "[", "\\["), link.generic_string());
  if (!caption.empty()) text += "\n" + caption + "\n";
  return text;
}

std::string Footnotes::mark(const std::string& note) {
  if (note.empty()) return {};
  const auto known = std::find(notes_.begin(), notes_.end(), note);
  const auto number = known - notes_.begin() + 1;
  if (known == notes_.end()) notes_.push_back(note);
  return fmt::format(" <sup>{}</sup>", number);
}

std::string Footnotes::text() const {
  std::string text;
  for (std::size_t k = 0; k < notes_.size(); ++k)
    text += fmt::format("{}<sup>{}</sup> {}", k == 0 ? "" : "; ", k + 1, notes_[k]);
  return text.empty() ? text : text + "\n";
}

}  // namespace burnish
