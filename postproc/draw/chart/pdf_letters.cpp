#include "postproc/draw/chart/pdf_letters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/shown_text.h"

namespace burnish {
namespace {

constexpr std::size_t kFirstCode = 128, kMostLetters = 128;

/// Letters that VTK takes for the marks of formulas.
bool isPlain(char32_t letter) {
  return letter >= U' ' && letter <= U'~' && letter != U'$' && letter != U'|';
}

/// UTF-16, big end first, in hexadecimal digits.
std::string utf16(char32_t letter) {
  if (letter < 0x10000) return fmt::format("{:04X}", static_cast<unsigned>(letter));
  const auto beyond = static_cast<unsigned>(letter) - 0x10000u;
  return fmt::format("{:04X}{:04X}", 0xD800u + (beyond >> 10u), 0xDC00u + (beyond & 0x3FFu));
}

/// The letters of all codes as a program of PDF (ISO 32000, 9.10.3).
std::string tableText(const std::vector<char32_t>& letters) {
  constexpr std::size_t kMostInABlock = 100;
  std::string text =
      "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
      "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
      "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
      "1 begincodespacerange\n<00> <FF>\nendcodespacerange\n"
      "1 beginbfrange\n<20> <7E> <0020>\nendbfrange\n";
  for (std::size_t begin = 0; begin < letters.size(); begin += kMostInABlock) {
    const std::size_t end = std::min(begin + kMostInABlock, letters.size());
    text += fmt::format("{} beginbfchar\n", end - begin);
    for (std::size_t k = begin; k < end; ++k)
      text += fmt::format("<{:02X}> <{}>\n", kFirstCode + k, utf16(letters[k]));
    text += "endbfchar\n";
  }
  return text + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
}

/// What stands between two texts, from a place on. Throws `Error` if it is not there.
std::string_view between(std::string_view pdf, std::string_view before, std::string_view after,
                         std::size_t from) {
  const std::size_t begin = pdf.find(before, from);
  const std::size_t end = begin == std::string_view::npos ? begin : pdf.find(after, begin + before.size());
  if (end == std::string_view::npos)
    throw Error(fmt::format("a PDF of VTK has no \"{}\"", before.substr(0, before.find('\n'))));
  return pdf.substr(begin + before.size(), end - begin - before.size());
}

/// An object of a PDF.
struct PdfObject {
  std::size_t number;
  std::string body;
};

/// The fonts of a PDF; each of their dictionaries begins with its type.
std::vector<PdfObject> fontsOf(std::string_view pdf) {
  constexpr std::string_view kHead = " 0 obj\n<<\n/Type /Font\n";
  std::vector<PdfObject> fonts;
  for (std::size_t at = pdf.find(kHead); at != std::string_view::npos; at = pdf.find(kHead, at + 1)) {
    const std::size_t line = pdf.rfind('\n', at) + 1;
    const std::string number(pdf.substr(line, at - line));
    fonts.push_back({std::stoul(number), std::string(between(pdf, " 0 obj\n", "\nendobj", at))});
  }
  return fonts;
}

}  // namespace

char PdfLetters::codeOf(char32_t letter) {
  if (isPlain(letter)) return static_cast<char>(letter);
  const auto known = std::find(letters_.begin(), letters_.end(), letter);
  const auto number = static_cast<std::size_t>(std::distance(letters_.begin(), known));
  if (number == kMostLetters) return '?';
  if (known == letters_.end()) letters_.push_back(letter);
  return static_cast<char>(kFirstCode + number);
}

std::string PdfLetters::coded(const std::string& text) {
  std::string codes;
  for (std::size_t at = 0; at < text.size();) {
    const auto [letter, length] = letterAt(text, at);
    codes += codeOf(letter);
    at += std::max<std::size_t>(1, length);
  }
  return codes;
}

std::string PdfLetters::withTable(std::string pdf) const {
  std::vector<PdfObject> objects = fontsOf(pdf);
  if (objects.empty()) return pdf;
  const std::size_t trailer = pdf.rfind("trailer\n");
  std::string_view dictionary = between(pdf, "<<\n", ">>", trailer);
  const std::string size(between(dictionary, "/Size ", "\n", 0));
  const std::string entries(dictionary.substr(0, dictionary.find("/Size ")));
  const std::string before(between(pdf, "startxref\n", "\n", trailer));

  const std::size_t table = std::stoul(size);
  for (PdfObject& font : objects) font.body.insert(3, fmt::format("/ToUnicode {} 0 R\n", table));
  const std::string letters = tableText(letters_);
  objects.push_back({table, fmt::format("<<\n/Length {}\n>>\nstream\n{}endstream", letters.size(), letters)});

  // A PDF is changed by what is written behind it: objects, where they are, and where the rest is listed.
  if (!pdf.ends_with('\n')) pdf += '\n';
  std::string list = "xref\n";
  for (const auto& [number, body] : objects) {
    list += fmt::format("{} 1\n{:010} 00000 n \n", number, pdf.size());
    pdf += fmt::format("{} 0 obj\n{}\nendobj\n", number, body);
  }
  const std::size_t listed = pdf.size();
  return pdf + list +
         fmt::format("trailer\n<<\n{}/Size {}\n/Prev {}\n>>\nstartxref\n{}\n%%EOF\n", entries, table + 1,
                     before, listed);
}

}  // namespace burnish
