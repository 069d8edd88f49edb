#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>

#include <fstream>

#include "engine/results/history.h"
#include "tests/cli/shell_test.h"

/// `burnish compare` of results and VTK files as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

using testing::HasSubstr;

constexpr const char* kPressedBlock = R"(
units: {length: mm, stress: MPa}
geometry: {shape: rectangle, size: [2, 1], functions: [7, 4]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
loads: [{face: top, pressure: "0.01*t"}]
steps: [{until: 1, count: 2}]
output: {every: 0.5}
)";

class CompareDataCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    std::ofstream(dir / "scene.yaml") << kPressedBlock;
    ASSERT_EQ(shell(dir, BURNISH_COMMAND " run scene.yaml -o a --quiet").code, 0);
    ASSERT_EQ(shell(dir, BURNISH_COMMAND " run scene.yaml -o b --quiet --set material.E=1.0001").code, 0);
  }

  Outcome compare(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " compare " + arguments);
  }

  void expectRefused(const std::string& arguments, const std::string& part) const {
    expectRefusal(compare(arguments), arguments, part);
  }
};

TEST_F(CompareDataCommand, ExitCodeAndALinePerFieldSayWhatDiffersAndWhere) {
  Outcome outcome = compare("a a");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::MatchesRegex("([0-9]+) of ([0-9]+) fields are equal to the baseline\n"));
  outcome = compare("b a/result.h5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, testing::StartsWith("displacement: different: "));
  EXPECT_THAT(outcome.out, HasSubstr("; worst at time 1, control point "));
  EXPECT_THAT(compare("b a").out, HasSubstr("\nhistory.strain_energy: different: 2 of 3 values"));
  EXPECT_EQ(compare("b a --relative 1e-3").code, 0);
  EXPECT_EQ(compare("b a --absolute 1e-3").code, 0);
  EXPECT_EQ(compare("b a --tolerance '*=1e-3'").code, 0);
  EXPECT_EQ(compare("b a --only 'mesh.*' --only frames").code, 0);
  EXPECT_EQ(compare("b a --skip 'history.*'").code, 1);
}

TEST_F(CompareDataCommand, WhatTheProgramExportsCanBeCompared) {
  EXPECT_EQ(compare("a/frames.pvd a/frames.pvd").code, 0);
  const Outcome outcome = compare("b/frames.pvd a/frames.pvd");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("stress (body): different: "));
  EXPECT_THAT(outcome.out, HasSubstr(" MPa; worst at time 1, point "));
  ASSERT_EQ(shell(dir, BURNISH_COMMAND " export a -o curved --cells bezier --pieces 2").code, 0);
  EXPECT_EQ(compare("curved/frames.pvd curved/frames.pvd").code, 0);
  ASSERT_EQ(
      shell(dir,
            "head -c 2000 curved/frames/body_000001_0.vtu > cut && mv cut curved/frames/body_000001_0.vtu")
          .code,
      0);
  expectRefused("curved/frames.pvd curved/frames.pvd", "body_000001_0.vtu: this is no VTK file");
}

TEST_F(CompareDataCommand, JsonHasAnObjectPerField) {
  const Outcome outcome = compare("b a --json");
  EXPECT_EQ(outcome.code, 1);
  Json::Value fields;
  ASSERT_TRUE(Json::Reader().parse(outcome.out, fields)) << outcome.out;
  EXPECT_EQ(fields[0]["name"], "frames");
  EXPECT_EQ(fields[0]["verdict"], "equal");
  const auto energy = std::ranges::find_if(
      fields, [](const Json::Value& field) { return field["name"] == "history.strain_energy"; });
  ASSERT_NE(energy, fields.end());
  EXPECT_EQ((*energy)["verdict"], "different");
  EXPECT_EQ((*energy)["time"].asDouble(), 1);
  EXPECT_EQ((*energy)["actual"].asDouble(),
            readHistory(dir / "b/history.csv").column("strain_energy").back());
  EXPECT_EQ((*energy)["baseline"].asDouble(),
            readHistory(dir / "a/history.csv").column("strain_energy").back());
  EXPECT_TRUE((*energy)["position"].isNull());
}

TEST_F(CompareDataCommand, JunitHasATestPerFieldOrPicture) {
  EXPECT_EQ(compare("b a --junit made/a.xml").code, 1);
  const std::string xml = readText(dir / "made/a.xml");
  EXPECT_THAT(
      xml,
      HasSubstr(
          "name=\"history.strain_energy\">\n      <failure type=\"different\" message=\"different: 2 of 3"));
  EXPECT_THAT(xml, HasSubstr("name=\"mesh.knots\"/>"));
  ASSERT_EQ(shell(dir, BURNISH_COMMAND " render a -o a.png --size 300,200").code, 0);
  EXPECT_EQ(compare("a.png absent.png --junit b.xml").code, 1);
  EXPECT_THAT(readText(dir / "b.xml"),
              HasSubstr("<failure type=\"no-baseline\" message=\"no baseline: there is no absent.png\"/>"));
}

TEST_F(CompareDataCommand, DirectoriesOfResultsAreComparedAtOnce) {
  ASSERT_EQ(
      shell(dir, "mkdir new old && cp -r a old/one && cp -r b new/one && cp -r a old/two && cp -r a new/two")
          .code,
      0);
  Outcome outcome = compare("new old --report page --diff worst.png");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("one: displacement: different: "));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("two: ")));
  EXPECT_THAT(outcome.out,
              testing::ContainsRegex(" fields of 2 results are equal to the baseline\n"
                                     "worst.png: difference of one: [a-z_.]+(, component [a-z]+)?\n"
                                     "report: page/index.html\n"));
  EXPECT_THAT(readText(dir / "page/index.html"), testing::AllOf(HasSubstr("\"name\":\"one: displacement\""),
                                                                Not(HasSubstr("\"updated\":true"))));
  EXPECT_TRUE(readText(dir / "worst.png").starts_with("\x89PNG"));
  outcome = compare("new old --annotations github --code-quality made/q.json");
  EXPECT_THAT(outcome.out, testing::StartsWith("::error title=one%3A "));
  EXPECT_THAT(readText(dir / "made/q.json"), HasSubstr("\"path\":\"old\""));
  outcome = compare("new old --json");
  EXPECT_THAT(outcome.out, HasSubstr("\"result\":\"two\""));

  outcome = compare("new old --update --report page");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              testing::StartsWith("one: the new baseline; of the former one are left: frames.pvd, frames\n"));
  EXPECT_THAT(readText(dir / "page/index.html"), HasSubstr("\"updated\":true,\"verdict\":\"different\""));
  EXPECT_EQ(compare("new old").code, 0);
  EXPECT_EQ(compare("new/one old/one --relative 0").code, 0);
  EXPECT_EQ(compare("new first --update").code, 0) << "a new directory";
  EXPECT_EQ(compare("new first").code, 0);
}

TEST_F(CompareDataCommand, PicturesOfRunsAreComparedWhereTheyAreMeant) {
  ASSERT_EQ(shell(dir, BURNISH_COMMAND
                  " render a -o a/pictures/a.png --size 300,200 && mkdir -p base b/pictures && "
                  "cp -r a/pictures base && cp a/pictures/a.png b/pictures")
                .code,
            0);
  EXPECT_THAT(compare("a base").out, HasSubstr("pictures/a.png: equal (ssim"));
  EXPECT_THAT(compare("a b --threshold 0.1").out, HasSubstr("pictures/a.png: equal (ssim 0, threshold 0.1)"));
  EXPECT_THAT(compare("a b").out, HasSubstr("fields are equal to the baseline"));
}

TEST_F(CompareDataCommand, UnusableInputIsRefused) {
  expectRefused("a absent", "absent: there is no such file or directory");
  expectRefused("a scene.yaml", "a is a result, scene.yaml is no data");
  expectRefused("a a/frames.pvd", "a is a result, a/frames.pvd is a collection of VTK files");
  expectRefused("a/result.h5 b/result.h5 --threshold 0.1",
                "--threshold: is for pictures; ACTUAL and BASELINE are results or VTK files");
  expectRefused("a.png b.png --relative 0.1",
                "--relative: is for results and VTK files; ACTUAL and BASELINE are pictures");
  expectRefused("a b --relative=-1", "--relative: found -1; expected a number of at least 0");
  expectRefused("a b --tolerance stress", "--tolerance: found \"stress\"; expected NAME=R or NAME=R,A");
  expectRefused("a b --tolerance stres=1", ". Did you mean \"stress\"?");
  expectRefused("a b --junit b/history.csv",
                "--junit: found \"b/history.csv\"; expected the name of a file that ends in .xml");
  expectRefused("a b --annotations gitlab", "--annotations: found \"gitlab\"; expected github");
  expectRefused("a b --annotations github --json", "--annotations: found beside --json");
  expectRefused("a b --code-quality q.xml", "expected the name of a file that ends in .json");
  expectRefused("a b --diff worst.jpg", "expected the name of a picture that ends in .png");
  expectRefused("b/frames.pvd a/frames.pvd --update",
                "--update: b/frames.pvd: it names other files; copy it together with them");
  expectRefused("a b --update --accept '*'", "--update: found beside --accept");
  expectRefused("a b --skip '*'", "--only, --skip: they leave no field to compare");
  writeText("no data", dir / "c.vtu");
  expectRefused("c.vtu a/frames/body_000000.vtu", "c.vtu: this is no VTK file");
  expectRefused("a/frames/body_000000.vtu d.vtu", "d.vtu: there is no such file");
  writeText("no data", dir / "c.pvd");
  expectRefused("c.pvd a/frames.pvd", "c.pvd: found no collection of VTK files in it");
  EXPECT_EQ(shell(dir, "head -c 3000 a/result/frame_000001.h5 > cut && mv cut a/result/frame_000001.h5").code,
            0);
  expectRefused("b a", "a/result/frame_000001.h5");
}

}  // namespace
}  // namespace burnish
