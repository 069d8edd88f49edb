#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/draw/chart/chart.h"
#include "tests/cli/shell.h"

/// The text of a PDF chart, read as programs that search a PDF read it.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class PdfText : public testing::Test {
 protected:
  PdfText() { fs::create_directories(dir_); }
  ~PdfText() override { fs::remove_all(dir_); }

  /// What a program prints of the chart.
  std::string told(const Chart& chart, const std::string& line) const {
    drawChart(chart, dir_ / "a.pdf");
    const Outcome outcome = shell(dir_, line);
    EXPECT_EQ(outcome.code, 0) << line << ": " << outcome.err;
    return outcome.out;
  }

  const fs::path dir_ = fs::temp_directory_path() / ("burnish_text_" + std::to_string(::getpid()));
};

Chart labelled(const std::string& label) {
  Chart chart;
  chart.x.title = "plastic strain ε̄ₚ";
  chart.y.title = "force F₁ in µN·mm";
  chart.curves.push_back({label, {0, 1}, {0, 1e-6}, {}});
  return chart;
}

TEST_F(PdfText, HasItsOwnLetters) {
  const std::string text = told(labelled("Prüfkörper $a|b$ (1) \\ 50%"), "pdftotext a.pdf -");
  EXPECT_THAT(text, AllOf(HasSubstr("plastic strain ε̄ₚ\n"), HasSubstr("force F₁ in µN·mm"),
                          HasSubstr("Prüfkörper $a|b$ (1) \\ 50%\n"), HasSubstr("×10⁻")));
}

TEST_F(PdfText, HasMoreLettersThanAByteTells) {
  const std::vector<std::string> labels{"АБВГДЕЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдежзийкл",
                                        "ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩαβγδεζηθικλμνξοπρστυφχψω",
                                        "ĀāĂăĄąĆćĈĉĊċČčĎďĐđĒēĔĕĖėĘęĚěĜĝĞğĠġĢģĤĥĦħĨĩĪī"};
  Chart chart = labelled(labels[0]);
  for (const std::size_t k : {1U, 2U}) chart.curves.push_back({labels[k], {0, 1}, {0, 1e-6}, {}});
  chart.size = {2400, 900};
  const std::string text = told(chart, "pdftotext a.pdf -");
  for (const std::string& label : labels) EXPECT_THAT(text, HasSubstr(label));
}

TEST_F(PdfText, HasTheLettersOfGlyphsThatJoin) {
  const std::string text = told(labelled("शक्ति और क्षमता"), "pdftotext a.pdf -");
  EXPECT_THAT(text, HasSubstr("शक्ति और क्षमता"));
}

/// And not those of the forms that Arabic letters have in a word; lam and alef are drawn as one.
TEST_F(PdfText, HasTheLettersOfScriptsFromRightToLeft) {
  EXPECT_THAT(told(labelled("قوة الضغط שלום"), "pdftotext a.pdf -"), HasSubstr("قوة الضغط שלום"));
  // One by one pdftotext turns the two letters that the glyph stands for as well.
  EXPECT_THAT(told(labelled("سلام"), "pdftotext a.pdf -"), HasSubstr("سالم"));
  EXPECT_THAT(told(labelled("س\uFEFBم"), "pdftotext a.pdf -"), HasSubstr("س\uFEFBم"));
}

/// What reads SVG turns them.
TEST_F(PdfText, LettersFromRightToLeftAreWrittenInTheirOrderInSvg) {
  Chart chart = labelled("a");
  chart.y.title = "قوة الضغط";
  drawChart(chart, dir_ / "a.svg");
  EXPECT_THAT(readText(dir_ / "a.svg"), HasSubstr(">قوة الضغط</text>"));
}

/// What reads SVG has them join: a text stands there in one piece, and turned where the picture has it turned.
TEST_F(PdfText, LettersThatJoinAreNoOutlinesInSvg) {
  Chart chart = labelled("a");
  chart.y.title = "बल और क्षमता";
  drawChart(chart, dir_ / "a.svg");
  EXPECT_THAT(readText(dir_ / "a.svg"), testing::ContainsRegex("rotate.-90.[^>]*>बल और क्षमता</text>"));
}

TEST_F(PdfText, FontsAreEmbeddedAndBytesTheSame) {
  EXPECT_THAT(told(labelled("ε"), "pdffonts a.pdf"), HasSubstr(" yes yes yes "));
  const std::string first = readText(dir_ / "a.pdf");
  told(labelled("ε"), "true");
  EXPECT_EQ(readText(dir_ / "a.pdf"), first);
}

}  // namespace
}  // namespace burnish
