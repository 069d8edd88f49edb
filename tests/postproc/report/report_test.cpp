#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>

#include "engine/core/error.h"
#include "postproc/draw/contour/frame_pictures.h"
#include "postproc/report/html_parts.h"
#include "postproc/report/report.h"
#include "postproc/report/run_charts.h"
#include "postproc/report/run_facts.h"
#include "postproc/report/run_warnings.h"
#include "postproc/text/markdown_html.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/study/study_samples.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A run of the slab, whose disc has a radius of 0.5 and whose contact face spans of at least 0.5.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    samples::writeRun(
        run_, [](double t) { return t; }, 2.0, 16.0);
  }

  void writeHistory(const std::vector<std::string>& columns,
                    const std::vector<std::vector<double>>& rows) const {
    HistoryWriter history(run_ / "history.csv", columns);
    for (const auto& row : rows) history.append(row);
  }

  void changeSummary(const std::function<void(RunAccount&)>& change) const {
    RunAccount summary = readSummary(run_);
    change(summary);
    writeSummary(run_, summary);
  }

  std::vector<std::string> warnings() const { return runWarnings(readRun(run_)); }

  samples::ScratchDirectory scratch_;
  fs::path run_ = scratch_.path() / "press";
};

TEST(HtmlParts, ChartsWithLettersThatJoinAreDrawingsToo) {
  CaptionedChart chart;
  chart.caption = "A chart";
  chart.chart.curves.push_back({"a", {0, 1}, {0, 1}, {}});
  for (const std::string title : {"force", "बल"}) {
    chart.chart.y.title = title;
    EXPECT_THAT(htmlCharts({chart}), testing::AllOf(HasSubstr("aria-label=\"A chart\"><g"), HasSubstr(title),
                                                    HasSubstr("</svg>")));
  }
}

TEST_F(Report, ASoundRunHasNoWarning) {
  EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(Report, WarnsOfRunsThatDidNotComeToTheirEnd) {
  changeSummary([](RunAccount& s) { s.completed = false, s.stoppedBecause = "the smallest step failed"; });
  EXPECT_THAT(warnings(), ElementsAre("The run stopped at t = 2 before its end: the smallest step failed."));
  removeSummary(run_);
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("The run has not ended: it goes on, or was killed.")));
}

TEST_F(Report, WarnsOfStepsAboveATolerance) {
  changeSummary([](RunAccount& s) {
    s.stepsAtRoundOff = 3;
    s.worstResidual = 2e-9;
    s.worstConstraint = 2e-12;
    s.constraintTolerance = 1e-12;
  });
  EXPECT_THAT(
      warnings(),
      ElementsAre("3 steps ended above the tolerance, at 2×10⁻⁹ or less, where the rounding of the forces "
                  "allows no less; this is harmless.",
                  "The largest averaged gap of 2×10⁻¹² is above the tolerance of 1×10⁻¹²."));
}

TEST_F(Report, TellsOfRezoningsAndCountsTheirWork) {
  const auto fact = [&](const std::string& name) {
    for (const auto& [key, text] : runFacts(readRun(run_)))
      if (key == name) return text;
    return std::string();
  };
  EXPECT_EQ(fact("rezonings"), "");
  writeHistory(
      {"time", "strain_energy", "contact_energy", "plastic_work", "external_work", "rezoning_gap_work"},
      {{0, 0, 0, 0, 0, 0}, {2, 1.0, 0.0, 9.0, 9.5, 0.4}});
  changeSummary([](RunAccount& s) {
    s.rezonings = {{.time = 0.5, .boundaryError = 0.002, .quality = 0.5},
                   {.time = 1.25, .boundaryError = 0.001, .quality = 0.25}};
    s.failedRezonings = 3;
    s.rezoningFailure = "t = 1.5: no mesh of the deformed body is sound";
  });
  EXPECT_EQ(
      fact("rezonings"),
      "2, the last at t = 1.25; lowest quality 0.25, largest error of a boundary 0.002; 3 attempts failed, "
      "the last at t = 1.5: no mesh of the deformed body is sound");
  EXPECT_EQ(
      fact("balance"),
      "work, that of closing gaps included, differs by 1 % from energies and plastic work; doubtful above "
      "10 %");
}

TEST_F(Report, WarnsOfDoubtfulPenetrationAndVolumeInARunWithoutAnEnd) {
  removeSummary(run_);
  writeHistory({"time", "max_penetration", "min_detJ"},
               {{0, 0, 1}, {0.5, 0.0049, 0.06}, {1, 0.0051, 0.5}, {1.5, 0.001, 0.04}, {2, 0.02, 0.5}});
  const std::vector<std::string> texts = warnings();
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_THAT(texts[0], HasSubstr("The run has not ended"));
  EXPECT_THAT(texts[1], HasSubstr("penetration above a tenth of the smallest knot span"));
  EXPECT_THAT(texts[1], HasSubstr("first at t = 1, in 50.0 % of the steps"));
  EXPECT_THAT(texts[2], HasSubstr("J below 0.05: first at t = 1.5, in 25.0 % of the steps"));
}

TEST_F(Report, JudgesEachTimeOfARunWithoutAnEndByItsMesh) {
  samples::Sample fine = samples::slab({60, 6});
  fine.frame.contact = ResultReader(run_).frame(2).contact;
  {
    const samples::Sample coarse = samples::slab();
    const ResultReader before(run_);
    const FrameRecord first = before.frame(0);
    ModelRecord model = before.model();
    model.tools.front().halfThickness = 5.0;  // knot spans decide: 0.25 before, 0.05 behind the new mesh
    ResultWriter result(run_, model);
    result.append(first);
    FrameRecord second = samples::meshedAnew({model, first}, fine).frame;
    second.index = 1;
    second.time = 1.0;
    result.append(second);
  }
  writeHistory({"time", "rezonings", "max_penetration"},
               {{0, 0, 0}, {0.25, 0, 0.02}, {0.5, 1, 0.02}, {1, 1, 0.001}, {1.5, 2, 0.02}});
  ASSERT_EQ(warnings().size(), 2U);
  EXPECT_THAT(warnings()[1], HasSubstr("first at t = 0.5, in 50.0 % of the steps"));
}

TEST_F(Report, JudgesContactOfTheBodyWithItselfInARunWithoutAnEnd) {
  {
    const ResultReader before(run_);
    FrameRecord frame = before.frame(0);
    frame.contact.front().tool.clear();
    ResultWriter(run_, before.model()).append(frame);
  }
  writeHistory({"time", "max_penetration", "max_self_penetration"},
               {{0, 0, 0}, {0.5, 0, 0.02}, {1, 0, 0.03}, {1.5, 0.004, 0.01}, {2, 0, 0}});
  ASSERT_EQ(warnings().size(), 2U);
  EXPECT_THAT(warnings()[1], HasSubstr("first at t = 1, in 25.0 % of the steps"));
}

TEST_F(Report, RepeatsWhatARunDoubtedItself) {
  changeSummary([](RunAccount& s) {
    s.steps = 4;
    s.doubts = {{.what = "tool 'disc' is too sharp",
                 .firstTime = 0.5,
                 .steps = 1,
                 .detail = "1.7 times as many spans would do"}};
  });
  EXPECT_THAT(warnings(), ElementsAre("Tool 'disc' is too sharp: first at t = 0.5, in 25.0 % of the steps; "
                                      "1.7 times as many spans would do."));
}

TEST_F(Report, ShowsWarningsOfTheScene) {
  changeSummary([](RunAccount& s) { s.warnings = {"material.nu: 0.4999 is nearly incompressible"}; });
  EXPECT_THAT(warnings(), ElementsAre("material.nu: 0.4999 is nearly incompressible."));
}

TEST_F(Report, WarnsOfToolsThatNeverTouch) {
  changeSummary([](RunAccount& s) { s.idleTools = {"disc"}; });
  EXPECT_THAT(warnings(), ElementsAre("Tool 'disc' has never touched the body."));
}

TEST_F(Report, TellsWhatSupportsCarry) {
  changeSummary([](RunAccount& s) {
    s.reactions = {{.support = "floor",
                    .place = "bottom",
                    .force = {1e-15, -2.5},
                    .moment = {3.0},
                    .largest = 4.0,
                    .largestTime = 1.5}};
  });
  const Facts::value_type expected("floor",
                                   "force of the body on face bottom: (0, -2.5), largest 4 at t = 1.5");
  EXPECT_THAT(runFacts(readRun(run_)), testing::Contains(expected));
  writeHistory({"time", "floor.fx", "floor.fy"}, {{0, 0, 0}, {1, 0, -2.5}});
  const auto charts = stateCharts(readRun(run_));
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_THAT(charts[0].caption, HasSubstr("Force of the body on the support “floor”"));
  EXPECT_THAT(charts[0].chart.curves[0].y, ElementsAre(0, -2.5));
}

TEST_F(Report, ChartsShowWhatTheHistoryHas) {
  writeHistory({"time", "disc.fx", "disc.fy", "strain_energy", "contact_energy", "newton_iterations"},
               {{0, 0, 0, 0, 0, 0}, {0.1, 0, 2, 1, 0, 7}, {0.15, 0, 3, 2, 0, 3}});
  const RunRecord run = readRun(run_);
  const std::string tool = run.result.model().tools.front().name;
  writeHistory({"time", tool + ".fx", tool + ".fy", "strain_energy", "contact_energy", "newton_iterations"},
               {{0, 0, 0, 0, 0, 0}, {0.1, 0, 2, 1, 0, 7}, {0.15, 0, 3, 2, 0, 3}});
  const auto charts = stateCharts(readRun(run_));
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_THAT(charts[0].caption, HasSubstr("Force of the body on the tool “" + tool + "”"));
  ASSERT_EQ(charts[0].chart.curves.size(), 1U) << "fx is zero throughout";
  EXPECT_THAT(charts[0].chart.curves[0].y, ElementsAre(0, 2, 3));
  EXPECT_THAT(charts[1].caption, HasSubstr("Energies"));
}

TEST_F(Report, ConvergenceChartsShowIterationsStepsAndResiduals) {
  writeHistory({"time", "newton_iterations"}, {{0, 0}, {0.1, 7}, {0.15, 3}});
  HistoryWriter convergence(run_ / "convergence.csv", {"step", "time", "iteration", "residual"});
  for (const auto& row : std::vector<std::vector<double>>{
           {1, 0.1, 0, 1}, {1, 0.1, 1, 1e-5}, {1, 0.1, 2, 0}, {2, 0.15, 0, 1}, {2, 0.15, 1, 1e-9}})
    convergence.append(row);
  const auto charts = convergenceCharts(readRun(run_));
  ASSERT_EQ(charts.size(), 4U);
  EXPECT_THAT(charts[0].chart.curves[0].y, ElementsAre(7, 3)) << "all attempts";
  EXPECT_THAT(charts[0].chart.curves[1].y, ElementsAre(2, 1)) << "the last attempt";
  EXPECT_THAT(charts[1].caption, HasSubstr("0 cut-backs"));
  EXPECT_DOUBLE_EQ(charts[1].chart.curves[0].y[3], 0.15 - 0.1);
  EXPECT_TRUE(charts[2].chart.y.logarithmic);
  EXPECT_TRUE(std::isnan(charts[2].chart.curves[0].y[0])) << "a residual of zero has no logarithm";
  EXPECT_DOUBLE_EQ(charts[2].chart.curves[0].y[1], 1e-9);
  EXPECT_DOUBLE_EQ(charts[2].chart.curves[1].y[0], 1e-9) << "the tolerance";
  EXPECT_EQ(charts[3].chart.curves[0].label, "t = 0.1") << "the slowest step";
}

TEST_F(Report, PagesAreMadeOfRunsWithoutResiduals) {
  writeHistory({"time", "newton_iterations"}, {{0, 0}, {1, 1}, {2, 1}});
  HistoryWriter convergence(run_ / "convergence.csv", {"step", "time", "iteration", "residual"});
  for (const auto& row :
       std::vector<std::vector<double>>{{1, 1, 0, 0}, {1, 1, 1, 0}, {2, 2, 0, 0}, {2, 2, 1, 0}})
    convergence.append(row);
  writeReport(run_, {}, scratch_.path() / "page.html");
  EXPECT_EQ(convergenceCharts(readRun(run_)).size(), 2U) << "iterations and step sizes";
}

TEST_F(Report, ChoosesFramesEvenly) {
  EXPECT_THAT(evenlyChosen(3, 40), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenlyChosen(101, 5), ElementsAre(0, 25, 50, 75, 100));
  EXPECT_THAT(evenlyChosen(1, 2), ElementsAre(0));
}

TEST_F(Report, PagesAreMadeOfRunsInAnyState) {
  removeSummary(run_);
  fs::remove(run_ / "convergence.csv");
  writeHistory({"time", "min_detJ", "newton_iterations"}, {{0, 1, 0}});
  writeReport(run_, {}, scratch_.path() / "page.html");
  EXPECT_THAT(readText(scratch_.path() / "page.html"), HasSubstr("The run has not ended"));
  fs::remove(run_ / "history.csv");
  writeReport(run_, {}, scratch_.path() / "page.html");
  EXPECT_THROW(writeReport(scratch_.path(), {}, scratch_.path() / "page.html"), Error);
  ReportOptions unknown;
  unknown.picture.field = "strain";
  EXPECT_THROW(writeReport(run_, unknown, scratch_.path() / "page.html"), Error);
}

TEST_F(Report, PagesAreMadeOfRunsWithoutTools) {
  samples::Sample ring = samples::ring();
  const RunAccount summary = readSummary(run_);
  ResultWriter(run_, ring.model).append(ring.frame);
  writeSummary(run_, summary);
  writeHistory({"time", "max_penetration", "min_detJ"}, {{0, 0, 1}, {1, 0, 0.9}});
  EXPECT_THAT(warnings(), IsEmpty());
  writeReport(run_, {}, scratch_.path() / "page.html");
  EXPECT_THAT(readText(scratch_.path() / "page.html"),
              HasSubstr("alt=\"von_mises, t = 0 (frame 1 of 1, step 0)\""));
}

TEST_F(Report, TextsCannotBecomeElements) {
  EXPECT_EQ(escaped("a < \"b\" & c>"), "a &lt; &quot;b&quot; &amp; c&gt;");
  EXPECT_THAT(htmlText({"<t>", "S", "B /*script*/", "J", "00ff"}),
              testing::AllOf(HasSubstr("<title>&lt;t&gt;</title>"), HasSubstr("B /*script*/"),
                             HasSubstr("<script>J</script>"), HasSubstr("script-src 'sha256-AP8=';")));
  EXPECT_THAT(htmlText({"t", "", "", "", ""}), HasSubstr("script-src 'none';"));
  EXPECT_THAT(htmlWarnings({"<b>"}), HasSubstr("<li>&lt;b&gt;</li>"));
}

TEST_F(Report, DocumentsBecomeHtml) {
  const std::string text =
      "# T\n\n## Runs\n\n| a |\n\n<a id=\"s\"></a>\n\n## S\n\n- **holds**: x\n\n![c](<figures/f.png>)\n";
  const std::string html = markdownHtml(withoutSection(text, "Runs"), [](const std::string& address) {
    EXPECT_EQ(address, "figures/f.png");
    return "data:,f";
  });
  EXPECT_THAT(html, HasSubstr("<a id=\"s\"></a>"));
  EXPECT_THAT(html, HasSubstr("<li><strong>holds</strong>: x</li>"));
  EXPECT_THAT(html, HasSubstr("<img src=\"data:,f\" alt=\"c\">"));
  EXPECT_THAT(html, Not(HasSubstr("Runs")));
  EXPECT_EQ(withoutSection(text, "Absent"), text);
}

TEST_F(Report, DocumentsLeadNowhereElse) {
  const auto html = [](const std::string& markdown) {
    return markdownHtml(markdown, [](const std::string&) { return "data:,"; });
  };
  for (const char* address : {"https://a.b/c?d=e:f", "HTTP://a.b", "page.html#x", "#x", "a/b:c", "../x"})
    EXPECT_THAT(html(fmt::format("[t]({})", address)),
                HasSubstr(fmt::format("<a href=\"{}\">t</a>", address)));
  for (const char* address :
       {"javascript:alert(1)", "JaVaScript:alert(1)", "<java&#115;cript:alert(1)>", "< javascript:alert(1)>",
        "data:text/html,x", "file:///etc/passwd", "//host/x", "vbscript:x", "mailto:a@b.c"})
    EXPECT_EQ(html(fmt::format("[t]({})", address)), "<p>t</p>\n") << address;
  EXPECT_EQ(html("[*a* ![b](c)](javascript:d \"e>f\") [g](h)\n"),
            "<p><em>a</em> <img src=\"data:,\" alt=\"b\"> <a href=\"h\">g</a></p>\n");
  for (const char* element : {"<script>alert(1)</script>", "<img src=x onerror=alert(1)>",
                              "<a href=\"javascript:alert(1)\">x</a>", "<a id=\"x\" onclick=\"y\">"})
    EXPECT_THAT(html(std::string("a ") + element), Not(HasSubstr(std::string(element).substr(0, 7))))
        << element;
  EXPECT_EQ(html("x<sup>2</sup>"), "<p>x<sup>2</sup></p>\n");
}

TEST_F(Report, StudiesShowRunsDocumentAndFigures) {
  const fs::path study = scratch_.path() / "study";
  samples::madeUpStudy(study);
  fs::create_directories(study / "runs/broken");
  writeText("run,state\nnurbs-fine,completed\nnurbs-coarse,completed\n", study / "runs.csv");
  writeText("# Blocks\n\n- **does not hold**: A claim.\n\n![f](<figures/f.png>)\n", study / "study.md");
  const ResultReader result(study / "runs/nurbs-fine");
  ContourOptions options;
  options.field = "plastic_strain";
  for (const char* name : {"f.png", "f_a.png", "g.png"}) {
    fs::create_directories(study / "figures");
    drawContour(result.model(), result.frame(2), options, study / "figures" / name);
  }
  ReportOptions unknown;
  unknown.picture.field = "strain";
  writeReport(study, unknown, study / "report.html");
  EXPECT_THAT(readText(study / "report.html"), HasSubstr("<div class=\"absent\">"));
  writeReport(study, {}, study / "report.html");
  const std::string page = readText(study / "report.html");
  EXPECT_THAT(page, HasSubstr("<h1>Blocks</h1>"));
  EXPECT_THAT(page, HasSubstr("alt=\"plastic_strain of nurbs-fine at t = 2\""));
  EXPECT_THAT(page, HasSubstr("<strong class=\"does-not-hold\">does not hold</strong>: A claim."));
  EXPECT_LT(page.find("#run-nurbs-fine"), page.find("#run-nurbs-coarse")) << "the order of runs.csv";
  EXPECT_THAT(page, HasSubstr("<article id=\"run-lagrange-fine\" class=\"bad\">"));
  EXPECT_THAT(page, HasSubstr("before its end: the smallest step failed."));
  EXPECT_THAT(page, HasSubstr("runs/broken holds no result.h5"));
  EXPECT_THAT(page, HasSubstr("<figcaption>g</figcaption>"));
  EXPECT_THAT(page, Not(HasSubstr("<figcaption>f")));
}

}  // namespace
}  // namespace burnish
