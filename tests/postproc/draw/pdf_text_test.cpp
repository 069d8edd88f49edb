#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include "engine/core/error.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/chart/pdf_letters.h"

/// The text behind the outlines of a PDF chart, read as programs that search a PDF read it.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string utf8(unsigned code) {
  const auto byte = [](unsigned value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | (code >> 6)), byte(0x80 | (code & 0x3F))};
  return {byte(0xE0 | (code >> 12)), byte(0x80 | ((code >> 6) & 0x3F)), byte(0x80 | (code & 0x3F))};
}

std::string inflated(const std::string& bytes) {
  std::string out(4'000'000, '\0');
  z_stream stream{};
  inflateInit(&stream);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

/// The object that a number stands for: the last one of this number.
std::string objectOf(const std::string& pdf, const std::string& number) {
  const std::size_t begin = pdf.rfind("\n" + number + " 0 obj\n");
  if (begin == std::string::npos) throw std::logic_error("no object " + number);
  return pdf.substr(begin, pdf.find("\nendobj", begin) - begin);
}

std::string streamOf(const std::string& object) {
  const std::size_t begin = object.find("stream");
  return object.substr(object.find('\n', begin) + 1);
}

/// What a pattern captures first.
std::string found(const std::string& text, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
}

/// The letters of codes by the font's table; ASCII alone where it has none.
std::map<unsigned char, std::string> lettersOf(const std::string& pdf, const std::string& font) {
  std::map<unsigned char, std::string> letters;
  for (unsigned code = 32; code < 127; ++code) letters[static_cast<unsigned char>(code)] = utf8(code);
  const std::string number = found(objectOf(pdf, font), "/ToUnicode (\\d+) 0 R");
  if (number.empty()) return letters;
  const std::string table = objectOf(pdf, number);
  const std::regex entry("<([0-9A-F]{2})> <([0-9A-F]{4})>\n");
  for (std::sregex_iterator k(table.begin(), table.end(), entry), end; k != end; ++k)
    letters[static_cast<unsigned char>(std::stoul((*k)[1], nullptr, 16))] =
        utf8(static_cast<unsigned>(std::stoul((*k)[2], nullptr, 16)));
  return letters;
}

/// A string of a content stream without the backslashes: \\351 is a byte, \\( a bracket.
std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\\') {
      bytes += text[k];
    } else if (text[k + 1] >= '0' && text[k + 1] <= '7') {
      bytes += static_cast<char>(std::stoul(text.substr(k + 1, 3), nullptr, 8));
      k += 3;
    } else {
      bytes += text[++k];
    }
  }
  return bytes;
}

/// All texts of the page, a line each.
std::string textOf(const std::string& pdf) {
  const std::string page = objectOf(pdf, "4");
  const std::string content = inflated(streamOf(objectOf(pdf, found(page, "/Contents (\\d+) 0 R"))));
  const auto letters = lettersOf(pdf, found(page, "/F1 (\\d+) 0 R"));
  std::string text;
  for (std::size_t at = content.find(" Tj"); at != std::string::npos; at = content.find(" Tj", at + 1)) {
    const std::size_t line = content.rfind('\n', at) + 2;
    for (const char code : unescaped(content.substr(line, at - 1 - line))) {
      const auto letter = letters.find(static_cast<unsigned char>(code));
      text += letter == letters.end() ? "?" : letter->second;
    }
    text += '\n';
  }
  return text;
}

std::string readBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class PdfText : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }

  std::string drawn(const Chart& chart) const {
    drawChart(chart, file_);
    return readBytes(file_);
  }

  fs::path file_ = fs::temp_directory_path() / ("burnish_text_" + std::to_string(::getpid()) + ".pdf");
};

Chart labelled(const std::string& label) {
  Chart chart;
  chart.x.title = "plastic strain ε̄ₚ";
  chart.y.title = "force F₁ in µN·mm";
  chart.curves.push_back({label, {0, 1}, {0, 1e-6}, {}});
  return chart;
}

TEST_F(PdfText, HasItsOwnLetters) {
  const std::string text = textOf(drawn(labelled("Prüfkörper $a|b$ (1) \\ 50%")));
  EXPECT_THAT(text, HasSubstr("plastic strain ε̄ₚ\n"));
  EXPECT_THAT(text, HasSubstr("force F₁ in µN·mm"));
  EXPECT_THAT(text, HasSubstr("Prüfkörper $a|b$ (1) \\ 50%\n"));
  EXPECT_THAT(text, HasSubstr("×10⁻"));
}

TEST_F(PdfText, ListsEveryObjectWhereItIs) {
  const std::string pdf = drawn(labelled("ε"));
  std::size_t count = 0;
  for (std::size_t listed = std::stoul(pdf.substr(pdf.rfind("startxref\n") + 10)); listed != 0;) {
    ASSERT_EQ(pdf.substr(listed, 5), "xref\n");
    const std::size_t end = pdf.find("trailer", listed);
    std::size_t at = listed + 5;
    while (at < end) {
      std::size_t first = 0, entries = 0;
      ASSERT_EQ(std::sscanf(pdf.c_str() + at, "%zu %zu", &first, &entries), 2);
      at = pdf.find('\n', at) + 1;
      for (std::size_t k = 0; k < entries; ++k, at += 20) {
        if (pdf[at + 17] != 'n') continue;
        const std::string head = std::to_string(first + k) + " 0 obj";
        EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(at, 10)), head.size()), head);
        ++count;
      }
    }
    const std::string before = found(pdf.substr(end, 200), "/Prev (\\d+)");
    listed = before.empty() ? 0 : std::stoul(before);
  }
  EXPECT_GE(count, 14U);
}

TEST(PdfLetters, GivesEveryLetterACodeAndThenQuestionMarks) {
  PdfLetters letters;
  EXPECT_EQ(letters.coded("a|ε$ε"), "a\x80\x81\x82\x81");
  std::string many;
  for (unsigned k = 0; k < 126; ++k) many += utf8(0x4E00 + k);
  EXPECT_EQ(letters.coded(many).substr(124), "\xFF?");
  EXPECT_EQ(letters.coded("ε"), "\x81");
  EXPECT_THROW(letters.withTable("8 0 obj\n<<\n/Type /Font\n>>\nendobj\n"), Error);
  EXPECT_EQ(letters.withTable("no text"), "no text");
}

}  // namespace
}  // namespace burnish
