#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>
#include <unistd.h>

#include <filesystem>

#include "postproc/compare/picture.h"
#include "tests/cli/browser.h"
#include "tests/cli/shell_test.h"
#include "tests/postproc/spoiled_pictures.h"

/// `burnish compare` as the user meets it, its report in a browser, and image tests in a project of the
/// user's. BURNISH_COMMAND is the program, BURNISH_BUILD_DIR what `cmake --install` takes, BURNISH_CHROMIUM a
/// browser.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class CompareCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(dir);
    for (const char* name : {"actual", "baseline"}) fs::create_directories(dir / name);
    const Picture slab = readPicture(images / "slab.png");
    write("baseline/slab.png", slab);
    write("actual/slab.png", withMark(slab, 200, 151, {40, 40, 40}));
    for (const char* folder : {"actual", "baseline"}) write(folder + std::string("/noisy's.png"), slab);
    write("actual/noisy's.png", withNoise(slab));
  }
  void TearDown() override { fs::remove_all(dir); }

  void write(const std::string& name, const Picture& picture) const {
    writeText(encodePng(picture), dir / name);
  }

  Outcome compare(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " compare " + arguments);
  }

  void expectRefused(const std::string& arguments, const std::string& part) const {
    expectRefusal(compare(arguments), arguments, part);
  }

  const fs::path images = fs::path(BURNISH_SOURCE_DIR) / "images" / "baseline";
  const fs::path dir = fs::temp_directory_path() / ("burnish_compare_command_" + std::to_string(::getpid()));
};

TEST_F(CompareCommand, ExitCodeAndOneLineSayWhatDiffersAndWhere) {
  Outcome outcome = compare("actual/slab.png baseline/slab.png");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("0.1 % of the pixels differ visibly, within 6 x 20 at (200, 129)"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
  outcome = compare("\"actual/noisy's.png\" baseline/slab.png");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("equal (ssim 0.0"));
  EXPECT_EQ(compare("\"actual/noisy's.png\" baseline/slab.png --threshold 0").code, 1);
  EXPECT_EQ(compare("actual/slab.png baseline/slab.png --metric delta-e").code, 1);
  EXPECT_EQ(compare("actual baseline").code, 1);
}

TEST_F(CompareCommand, BlankPicturesAndMissingOnesAreNoSuccess) {
  write("actual/blank.png", {40, 30, std::vector<Color>(1200, Color{255, 255, 255})});
  EXPECT_EQ(compare("actual/blank.png actual/blank.png").code, 1);
  EXPECT_EQ(compare("actual/slab.png baseline/absent.png").code, 1);
  fs::copy_file(dir / "baseline/slab.png", dir / "actual/slab.png", fs::copy_options::overwrite_existing);
  fs::remove(dir / "actual/blank.png");
  EXPECT_EQ(compare("actual baseline").code, 0);
  fs::remove(dir / "actual/slab.png");
  EXPECT_EQ(compare("actual baseline").code, 1);
}

TEST_F(CompareCommand, UnusableInputIsRefused) {
  writeText("", dir / "empty.png");
  expectRefused("empty.png baseline/slab.png", "empty.png");
  expectRefused("absent.png baseline/slab.png", "absent.png");
  expectRefused("actual baseline/slab.png", "baseline/slab.png: found a file; expected a directory");
  expectRefused("actual baseline --threshold 2", "--threshold: found 2");
  expectRefused("actual baseline --metric ssm", "Did you mean \"ssim\"?");
  expectRefused("actual baseline --diff diff.png", "--report");
  expectRefused("actual/slab.png baseline/slab.png --diff diff.jpg", "diff.jpg");
  expectRefused("actual baseline --accept slap.png", "Did you mean \"slab.png\"?");
}

TEST_F(CompareCommand, JsonHasAnObjectPerPair) {
  const Outcome outcome = compare("actual baseline --json --threshold 0.2");
  EXPECT_EQ(outcome.code, 1);
  Json::Value pairs;
  ASSERT_TRUE(Json::Reader().parse(outcome.out, pairs)) << outcome.out;
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0]["verdict"], "equal");
  const Json::Value& slab = pairs[1];
  EXPECT_EQ(slab["name"], "slab.png");
  EXPECT_EQ(slab["verdict"], "different");
  EXPECT_EQ(slab["metric"], "ssim");
  EXPECT_GT(slab["value"].asDouble(), 0.9);
  EXPECT_EQ(slab["threshold"], 0.2);
  EXPECT_DOUBLE_EQ(slab["different_share"].asDouble(), 0.001);
  EXPECT_EQ(slab["box"]["x"], 200);
  EXPECT_EQ(slab["box"]["y"], 129);
  EXPECT_EQ(slab["box"]["width"], 6);
  EXPECT_EQ(slab["box"]["height"], 20);
}

TEST_F(CompareCommand, AcceptedPicturesAreBaselines) {
  const Outcome outcome = compare("actual baseline --accept '*' --diff \"\"");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("slab.png: accepted as the new baseline"));
  EXPECT_EQ(readText(dir / "actual/slab.png"), readText(dir / "baseline/slab.png"));
  EXPECT_EQ(compare("actual new --accept 'noisy*' --accept slab.png").code, 0) << "a new directory";
  EXPECT_EQ(compare("actual new").code, 0);
}

TEST_F(CompareCommand, UpdateAcceptsAllAndShowsWhatWasBefore) {
  const Outcome outcome = compare("actual baseline --update --report page");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("slab.png: accepted as the new baseline"));
  EXPECT_EQ(readText(dir / "actual/slab.png"), readText(dir / "baseline/slab.png"));
  EXPECT_THAT(readText(dir / "page/index.html"),
              testing::AllOf(HasSubstr("\"updated\":true"), HasSubstr("\"verdict\":\"different\"")));
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const Outcome page = usePage(dir, dir / "page/index.html", R"(<script>
    set = (value) => Object.assign(document.getElementById("verdict"), {value}).dispatchEvent(new Event("input"));
    set("updated");
    document.body.append(Object.assign(document.createElement("pre"), {textContent:
      document.title + "|" + document.getElementById("summary").textContent + "|" +
      [...document.querySelectorAll("article:not([hidden]) .heading")].map((each) => each.innerText).join()}));
  </script>)");
  EXPECT_THAT(page.out,
              HasSubstr("1 updated: image regression|No of 2 pictures failed. 1 differed and was updated"));
  EXPECT_THAT(page.out, testing::ContainsRegex("slab.png[^|]*different, updated"));
  EXPECT_THAT(page.out, Not(testing::ContainsRegex("noisy's.png[^|]*equal")));
}

TEST_F(CompareCommand, DifferenceIsDrawn) {
  EXPECT_EQ(compare("actual/slab.png baseline/slab.png --diff made/diff.png").code, 1);
  const Picture shown = readPicture(dir / "made/diff.png");
  EXPECT_EQ(shown.width, 400);
  EXPECT_LT(shown.at({203.5, 160.5})[2], 60);
}

/// Uses the page as a person does and writes what it finds into the page.
constexpr const char* kUser = R"(<script>{
const found = [];
const cards = () => [...document.querySelectorAll("article")].filter((card) => !card.hidden);
const names = () => cards().map((card) => card.querySelector("h2").textContent).join();
const set = (node, value, event) => { node.value = value; node.dispatchEvent(new Event(event)); };
const mode = (name) => [...cards()[0].querySelectorAll("button")].find((b) => b.textContent === name).click();
found.push("start " + names());
const style = (item) => getComputedStyle(item);
found.push("columns " + style(cards()[0].querySelector(".sides")).gridTemplateColumns.split(" ").length);
found.push("badges " + new Set(cards().map((card) => style(card.querySelector(".verdict")).backgroundColor)).size);
found.push("pressed " + style(document.querySelector("[aria-pressed=true]")).color);
set(document.getElementById("name"), "NOISY", "input");
found.push("filtered " + names());
set(document.getElementById("name"), "", "input");
set(document.getElementById("verdict"), "failed", "input");
found.push("failed " + names());
mode("Slider");
const above = cards()[0].querySelector(".stack .actual");
set(cards()[0].querySelector("input.position"), 25, "input");
const divider = above.parentNode.querySelector(".divider");
found.push("slider " + style(above).clipPath + " " + divider.style.left + " " + style(divider).position);
mode("Difference");
found.push("difference " + cards()[0].querySelectorAll(".view img.difference").length);
mode("Blink");
const seen = new Set();
const watch = setInterval(() => seen.add(cards()[0].querySelector(".showing").textContent), 50);
set(document.getElementById("verdict"), "all", "input");
document.querySelector("input.chosen").click();
found.push("command " + document.getElementById("command").value);
Promise.all([...document.images].map((image) => image.decode())).then(() => {
  found.push("decoded " + document.images.length);
  setTimeout(() => {
    clearInterval(watch);
    found.push("blinked " + [...seen].sort().join());
    document.body.append(Object.assign(document.createElement("pre"), {textContent: found.join("\n")}));
  }, 2000);
});
}</script>)";

TEST_F(CompareCommand, ReportWorksInABrowser) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  ASSERT_EQ(compare("actual baseline --report report").code, 1);
  const Outcome outcome = usePage(dir, dir / "report/index.html", kUser);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("CONSOLE"))) << "errors and warnings of the page";
  const std::string& found = outcome.out;
  EXPECT_THAT(found, HasSubstr("start slab.png,noisy's.png\n")) << "failures first";
  EXPECT_THAT(found, HasSubstr("filtered noisy's.png\n"));
  EXPECT_THAT(found, HasSubstr("failed slab.png\n"));
  EXPECT_THAT(found, HasSubstr("slider inset(0px 0px 0px 25%) 25% absolute\n"));
  EXPECT_THAT(found, HasSubstr("columns 2\nbadges 2\npressed rgb(255, 255, 255)\n")) << "style sheet";
  EXPECT_THAT(found, HasSubstr("difference 1\n"));
  EXPECT_THAT(found, HasSubstr("command burnish compare actual baseline --accept 'slab.png'\n"));
  EXPECT_THAT(found, HasSubstr("decoded 5\n"));
  EXPECT_THAT(found, HasSubstr("blinked actual,baseline<"));
}

constexpr const char* kUserProject = R"(
cmake_minimum_required(VERSION 3.25)
project(press LANGUAGES NONE)
find_package(burnish 0.2 REQUIRED)
enable_testing()
burnish_add_image_test(press SCENE press.yaml BASELINE baseline/press.png THRESHOLD 0.1
  RENDER --field von_mises --size 400,300)
burnish_add_image_test(deeper SCENE press.yaml BASELINE baseline/press.png
  SET "tools[0].motion.y=[0,-0.06]" RENDER --field von_mises --size 400,300)
)";

constexpr const char* kComparedScene = R"(
geometry: {shape: rectangle, size: [2, 1], functions: [7, 4]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 4}]
)";

TEST_F(CompareCommand, ImageTestsInAProjectOfTheUser) {
  writeText(kUserProject, dir / "CMakeLists.txt");
  writeText(kComparedScene, dir / "press.yaml");
  const auto expectFine = [&](const std::string& line) {
    const Outcome outcome = shell(dir, line);
    ASSERT_EQ(outcome.code, 0) << line << "\n" << outcome.out << outcome.err;
  };
  expectFine("cmake --install " BURNISH_BUILD_DIR " --prefix installed");
  EXPECT_TRUE(fs::exists(dir / "installed/share/doc/burnish/docs/image-regression.md"));
  expectFine("cmake -S . -B build -DCMAKE_PREFIX_PATH=$PWD/installed");

  Outcome outcome = shell(dir, "ctest --test-dir build --output-on-failure -L image -R press");
  EXPECT_EQ(outcome.code, 8);
  EXPECT_THAT(outcome.out, HasSubstr("no baseline: there is no "));
  const std::string picture = "build/image-tests/press/press.png";
  expectFine("installed/bin/burnish compare " + picture + " baseline/press.png --accept press.png");
  expectFine("ctest --test-dir build -R press");
  EXPECT_TRUE(fs::exists(dir / "build/image-tests/press/report/index.html"));
  outcome = shell(dir, "ctest --test-dir build --output-on-failure -R deeper");
  EXPECT_EQ(outcome.code, 8);
  EXPECT_THAT(outcome.out, HasSubstr("press.png: different (ssim"));
}

}  // namespace
}  // namespace burnish
