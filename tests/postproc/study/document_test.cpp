#include "postproc/study/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "postproc/text/markdown.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/study/study_samples.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(ColumnTexts, HaveOneStyle) {
  EXPECT_THAT(columnTexts({1.0, 250.0, std::nullopt}), ElementsAre("1", "250", "—"));
  EXPECT_THAT(columnTexts({0.5, 12.345}), ElementsAre("0.50", "12.35"));
  EXPECT_THAT(columnTexts({-0.012345, 0.9}), ElementsAre("−0.01235", "0.9"));
  EXPECT_THAT(columnTexts({0.1, 2.25}), ElementsAre("0.10", "2.25"));
  EXPECT_THAT(columnTexts({1.5e-7, 0.2, 0.0}), ElementsAre("1.50×10⁻⁷", "2.00×10⁻¹", "0"));
  EXPECT_THAT(columnTexts({123456.5, 2.5e5}), ElementsAre("1.23×10⁵", "2.50×10⁵"));
}

TEST(MarkdownTable, IsAlignedAndKeepsBarsApart) {
  EXPECT_EQ(markdownTable({{"run", {"a|b", "ε"}, false}, {"steps", {"1", "220"}}}),
            "| run  | steps |\n"
            "| ---- | ----: |\n"
            "| a\\|b |     1 |\n"
            "| ε    |   220 |\n");
}

TEST(Footnotes, GiveEqualNotesOneNumber) {
  Footnotes notes;
  EXPECT_EQ(notes.mark(""), "");
  EXPECT_EQ(notes.mark("stopped"), " <sup>1</sup>");
  EXPECT_EQ(notes.mark("late"), " <sup>2</sup>");
  EXPECT_EQ(notes.mark("stopped"), " <sup>1</sup>");
  EXPECT_EQ(notes.text(), "<sup>1</sup> stopped; <sup>2</sup> late\n");
}

class Document : public testing::Test {
 protected:
  Document() {
    study_.spec.text = "What it is about.";
    HistoryMeasure last;
    last.y = "value";
    last.range = {1.0, 2.0};
    ClaimSpec true_;
    true_.text = "Finer is lower";
    true_.measure = "last";
    true_.runs = {"nurbs-fine", "nurbs-middle", "nurbs-coarse"};
    ClaimSpec false_ = true_;
    false_.text = "Finer is higher";
    false_.runs = {"nurbs-coarse", "nurbs-fine"};
    ClaimSpec open = true_;
    open.text = "Both agree";
    open.runs = {"nurbs-fine", "lagrange-fine"};
    open.expect = ClaimSpec::Expect::Equal;
    open.within = 0.01;
    study_.spec.figures = {{.name = "drawn", .caption = "A picture.", .what = SetupFigure{"nurbs-fine"}},
                           {.name = "missing", .caption = "None.", .what = SetupFigure{"nurbs-fine"}}};
    study_.spec.statements = {{.name = "meshes",
                               .title = "Meshes",
                               .text = "Text of the section.",
                               .runs = {"*"},
                               .measures = {{"last", "last value", last}},
                               .claims = {true_, false_, open},
                               .figures = {"drawn", "missing"}}};
    writeText("not really a picture", directory_.path() / "figures/drawn.png");
  }

  std::string written(const fs::path& gallery = {}) const {
    writeDocument(study_, directory_.path(), {directory_.path() / "docs/study.md", gallery});
    return readText(directory_.path() / "docs/study.md");
  }

  ScratchDirectory directory_;
  Study study_ = madeUpStudy(directory_.path());
};

TEST_F(Document, SaysFirstWhichClaimsHold) {
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("1 holds, 1 does not hold, 1 cannot be told"));
  EXPECT_THAT(text, HasSubstr("| [Meshes](#meshes) |    1 |           1 |              1 |\n\n"
                              "- **does not hold**: Finer is higher ([Meshes](#meshes))\n"
                              "- **cannot be told**: Both agree ([Meshes](#meshes))\n"));
  EXPECT_LT(text.find("## Claims"), text.find("## Runs"));
  EXPECT_LT(text.find("## Runs"), text.find("## Meshes"));
}

TEST_F(Document, SaysWhichRunsAreDoubtful) {
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("1 of the 4 runs are doubtful from some time on"));
  EXPECT_THAT(text, HasSubstr("| 1.2 <sup>2</sup> |"));
  EXPECT_THAT(text, HasSubstr("<sup>1</sup> the smallest step failed; <sup>2</sup> deep penetration"));
  EXPECT_THAT(text, HasSubstr("| Lagrange, fine <sup>1</sup> |"));
  EXPECT_THAT(text, HasSubstr("<sup>1</sup> doubtful from t = 1.2 on"));
}

TEST_F(Document, HasATableOfAllRuns) {
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("| lagrange-fine | stopped at t = 1.4 <sup>1</sup> |    14 |         7 |"));
  EXPECT_THAT(text, HasSubstr("<sup>1</sup> the smallest step failed"));
  EXPECT_THAT(text, HasSubstr("tolerance of the force residual: 1×10⁻⁹. Contact parameter: 40000."));
}

TEST_F(Document, MarksValuesThatAreMissing) {
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr(" 1.250 |"));
  EXPECT_THAT(text, HasSubstr("| — <sup>2</sup> |"));
  EXPECT_THAT(text, HasSubstr("<sup>2</sup> stopped at t = 1.4"));
}

TEST_F(Document, GoesOnWhereAMeasureAsksForWhatResultsDoNotHave) {
  HistoryMeasure none;
  none.y = "none";
  StatementSpec& statement = study_.spec.statements.front();
  statement.measures.push_back({"none", "no value", none});
  statement.claims.push_back(statement.claims.front());
  statement.claims.back().measure = "none";
  const auto faults = writeDocument(study_, directory_.path(), {directory_.path() / "study.md", {}});
  EXPECT_THAT(faults, Not(IsEmpty()));
  EXPECT_THAT(faults, Each(HasSubstr(": measure none of statement meshes: ")));
  const std::string text = readText(directory_.path() / "study.md");
  EXPECT_THAT(text, HasSubstr("1 holds, 1 does not hold, 2 cannot be told"));
  EXPECT_THAT(text, HasSubstr("the results have no such thing"));
  EXPECT_THAT(text, Not(HasSubstr(directory_.path().string()))) << "the same wherever the study lies";
  statement.runs.clear();  // so that the claim alone asks
  EXPECT_EQ(writeDocument(study_, directory_.path(), {directory_.path() / "study.md", {}}).size(), 3u);
}

TEST_F(Document, ShowsPicturesWhereTheyAreOrFromTheGallery) {
  EXPECT_THAT(written(), HasSubstr("![A picture.](<../figures/drawn.png>)"));
  EXPECT_THAT(written(), HasSubstr("(The figure missing has not been drawn.)"));
  EXPECT_THAT(written(directory_.path() / "docs/gallery"), HasSubstr("![A picture.](<gallery/drawn.png>)"));
  EXPECT_EQ(readText(directory_.path() / "docs/gallery/drawn.png"), "not really a picture");
}

TEST_F(Document, SaysWhereColoursOfSheetsEndWithAndWithoutACaption) {
  SheetFigure sheet;
  sheet.panel.clip = 99.0;
  sheet.scale = SheetShare::Sheet;
  for (const auto& [caption, shown] :
       {std::pair{"A picture.", "![A picture. (Colours end at the percentiles 1 and 99 of the values.)]("},
        std::pair{"", "![Colours end at the percentiles 1 and 99 of the values.]("}}) {
    study_.spec.figures.front() = {.name = "drawn", .caption = caption, .what = sheet};
    EXPECT_THAT(written(), HasSubstr(shown));
  }
}

TEST_F(Document, IsTheSameForTheSameResults) {
  EXPECT_EQ(written(), written());
}

TEST_F(Document, NamesRunsWithoutResults) {
  fs::remove_all(directory_.path() / "runs/nurbs-coarse");
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("| nurbs-coarse  | no results"));
  EXPECT_THAT(text, HasSubstr("- **cannot be told**: Finer is lower"));
}

}  // namespace
}  // namespace burnish
