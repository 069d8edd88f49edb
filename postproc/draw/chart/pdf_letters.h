#pragma once
#include <string>
#include <vector>

namespace burnish {

/// Letters of a text in a PDF. Its fonts know codes of one byte: ASCII, and 128 others, which stand for the
/// further letters of the document in the order in which they are met. A table in the file (ToUnicode) tells
/// readers which letters these are, so that the text can be searched and copied.
class PdfLetters {
 public:
  /// The codes of a text in UTF-8; a question mark for a letter when no code is left.
  std::string coded(const std::string& text);

  /// A PDF of VTK with a table of the letters for each of its fonts. Throws `Error` for what is no such file.
  std::string withTable(std::string pdf) const;

 private:
  char codeOf(char32_t letter);

  std::vector<char32_t> letters_;  ///< of the codes from 128 on
};

}  // namespace burnish
