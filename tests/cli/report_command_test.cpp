#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "tests/cli/browser.h"

/// `burnish report` as the user meets it, with its page in a browser. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kReportedScene = R"(
title: A <press> & more
geometry: {shape: rectangle, size: [2, 1], functions: [7, 4]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 4}]
output: {every: 0.25, vtu: false}
)";

class ReportCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(dir);
    writeText(kReportedScene, dir / "press.yaml");
    ASSERT_EQ(shell(dir, BURNISH_COMMAND " run press.yaml -o out --quiet").code, 0);
  }
  void TearDown() override { fs::remove_all(dir); }

  Outcome report(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " report " + arguments);
  }

  const fs::path dir = fs::temp_directory_path() / ("burnish_report_command_" + std::to_string(::getpid()));
};

TEST_F(ReportCommand, WritesAPageThatNeedsNothingElse) {
  const Outcome outcome = report("out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "report out/report.html\n");
  const std::string page = readText(dir / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<h1>A &lt;press&gt; &amp; more</h1>"));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
  EXPECT_LT(page.size(), 1'000'000U);
  ASSERT_EQ(report("out -o again.html").code, 0);
  EXPECT_EQ(readText(dir / "again.html"), page) << "equal results give equal pages";
}

/// Asks the page to turn, which stands within, what it shows.
constexpr const char* kTurner = R"(<script>addEventListener("load", () => setTimeout(() => {
const within = document.querySelector("iframe").contentDocument;
document.body.insertAdjacentHTML("beforeend", `<pre>
when ${within.querySelector("#when").textContent}
fields ${[...within.querySelectorAll("#field option")].map((o) => o.textContent)}
fallback ${within.querySelector("#fallback").hidden}
</pre>`);
}, 2000));</script>)";

TEST_F(ReportCommand, HasABodyToTurnInIt) {
  ASSERT_EQ(report("out --turn").code, 0);
  EXPECT_FALSE(fs::exists(dir / "out/report.view.html"));
  EXPECT_THAT(readText(dir / "out/report.html"),
              testing::AllOf(HasSubstr("<iframe"), HasSubstr("&quot;name&quot;:&quot;von_mises&quot;")));
  ASSERT_EQ(report("out -o plain.html").code, 0);
  EXPECT_THAT(readText(dir / "plain.html"), Not(HasSubstr("<iframe")));
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const Outcome page = usePage(dir, dir / "out/report.html", kTurner, kWebGl);
  EXPECT_EQ(complaintsOf(page), "");
  EXPECT_THAT(page.out, HasSubstr("fallback true")) << "it draws";
  EXPECT_THAT(page.out, HasSubstr("when t = 1"));
  EXPECT_THAT(page.out, HasSubstr("fields von Mises stress\n"));
}

TEST_F(ReportCommand, RefusesWhatIsNoRunAndNoStudy) {
  const auto expectRefused = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = report(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, testing::AllOf(testing::StartsWith("burnish: "), HasSubstr(part)));
  };
  expectRefused(".", "found neither result.h5 nor runs/");
  expectRefused("absent", "absent: found neither");
  expectRefused("out -o page.pdf", "expected the name of a page that ends in .html");
  expectRefused("out --field strain", "strain");
  expectRefused("out --clip 20", "--clip: found \"20\"");
  EXPECT_FALSE(fs::exists(dir / "out/report.html"));
}

/// Uses the page as a person does and writes what it finds into the page.
constexpr const char* kUser = R"(<script>{
const found = [];
const shown = () => [...document.querySelectorAll("#frames img")].filter((image) => image.offsetWidth > 0);
const slider = document.getElementById("frame");
const look = (word) => found.push(word + " " + document.getElementById("time").textContent + "; " +
  shown().map((image) => image.alt).join());
look("start");
slider.value = 1;
slider.dispatchEvent(new Event("input"));
look("moved");
found.push("frames " + document.querySelectorAll("#frames img").length);
const charts = [...document.querySelectorAll(".charts svg")].filter((chart) => chart.getBBox().height > 100);
found.push("charts " + charts.map((chart) => chart.getAttribute("aria-label")).join("; "));
found.push("links " + [...document.querySelectorAll("nav a")].every((a) => document.querySelector(a.hash)));
found.push("wide " + (document.documentElement.scrollWidth > innerWidth));
addEventListener("load", () => {
  found.push("loaded " + [...document.images].filter((image) => image.naturalWidth === 960).length);
  document.body.append(Object.assign(document.createElement("pre"), {textContent: found.join("\n")}));
});
}</script>)";

TEST_F(ReportCommand, PageWorksInABrowser) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  ASSERT_EQ(report("out").code, 0);
  const Outcome page = usePage(dir, dir / "out/report.html", kUser);
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_THAT(page.err, Not(HasSubstr("CONSOLE"))) << "errors and warnings of the page";
  EXPECT_THAT(page.out,
              HasSubstr("start t = 1 (frame 5 of 5, step 4); von_mises, t = 1 (frame 5 of 5, step 4)\n"));
  EXPECT_THAT(
      page.out,
      HasSubstr("moved t = 0.25 (frame 2 of 5, step 1); von_mises, t = 0.25 (frame 2 of 5, step 1)\n"));
  EXPECT_THAT(page.out, HasSubstr("frames 5\n"));
  for (const char* chart :
       {"Force of the body on the tool “disc”", "Energies and work", "penetration", "volume ratio J",
        "Newton iterations of each step", "Step size; 0 cut-backs", "Relative residual", "most iterations"})
    EXPECT_THAT(page.out, HasSubstr(chart));
  EXPECT_THAT(page.out, HasSubstr("links true\n"));
  EXPECT_THAT(page.out, HasSubstr("wide false\n"));
  EXPECT_THAT(page.out, HasSubstr("loaded 5<"));
}

/// Tries what a page must not let happen.
constexpr const char* kIntruder = R"(<script>{
const found = [...document.querySelectorAll("#document a")].map((a) => a.textContent + " " + a.href);
document.body.insertAdjacentHTML("beforeend", "<img src='data:,' onerror='window.hit = 1'>");
location.href = "javascript:window.hit = 1";
document.body.append(Object.assign(document.createElement("script"), {textContent: "window.hit = 1"}));
setTimeout(() => {
  found.push("hit " + window.hit);
  document.body.append(Object.assign(document.createElement("pre"), {textContent: found.join("\n")}));
}, 500);
}</script>)";

TEST_F(ReportCommand, PageRunsNoScriptButItsOwn) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  fs::create_directories(dir / "study/runs");
  fs::rename(dir / "out", dir / "study/runs/press");
  writeText(
      "# Press\n\n[a](javascript:window.hit=1) [b](https://b.c/d) [e](#runs)\n\n"
      "<script>window.hit = 1</script> <b onclick=\"window.hit = 1\">f</b>\n",
      dir / "study/study.md");
  ASSERT_EQ(report("study").code, 0);
  const Outcome page = usePage(dir, dir / "study/report.html", kIntruder);
  EXPECT_THAT(page.out, HasSubstr("<pre>b https://b.c/d\ne file://"));
  EXPECT_THAT(page.out, HasSubstr("#runs\nhit undefined<"));
  EXPECT_THAT(readText(dir / "study/report.html"), HasSubstr("&lt;script&gt;window.hit = 1&lt;/script&gt;"));
}

}  // namespace
}  // namespace burnish
