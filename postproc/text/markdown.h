#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

/// A column of numbers as texts, all in one style: whole numbers; decimals that show four significant digits
/// of the largest; four significant digits of each where they are very different; powers of ten where some
/// are very large or very small. "—" where there is none.
std::vector<std::string> columnTexts(const std::vector<std::optional<double>>& values);

/// A number on its own, with up to four significant digits.
std::string plainNumber(double value);

struct MarkdownColumn {
  std::string title;
  std::vector<std::string> cells;
  bool number = true;  ///< set to the right
};

/// A table of GitHub's Markdown, its columns padded so that the source can be read; all columns have as many
/// cells.
std::string markdownTable(const std::vector<MarkdownColumn>& columns);

/// "![caption](<link>)" and the caption below, if there is one.
std::string markdownPicture(const std::filesystem::path& link, const std::string& caption);

/// Numbers the notes of a table: equal notes get one number.
class Footnotes {
 public:
  /// "<sup>1</sup>", or nothing for an empty note.
  std::string mark(const std::string& note);

  /// The notes in their order, for below the table; empty without notes.
  std::string text() const;

 private:
  std::vector<std::string> notes_;
};

}  // namespace burnish
