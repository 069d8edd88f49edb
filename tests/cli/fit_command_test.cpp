#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "postproc/text/text_file.h"
#include "tests/cli/shell_test.h"

/// `burnish fit` as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class FitCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    fs::copy_file(fs::path(BURNISH_SOURCE_DIR) / "scenes/fits/treloar.csv", dir / "treloar.csv");
  }

  Outcome burnish(const std::string& arguments) const { return shell(dir, BURNISH_COMMAND " " + arguments); }
};

/// What is written is the material of a scene.
TEST_F(FitCommand, WritesConstantsThatASceneCanHave) {
  for (const std::string law : {"neo-hookean", "mooney-rivlin", "yeoh", "ogden"}) {
    const Outcome outcome = burnish("fit treloar.csv --law " + law + " -o " + law + ".yaml");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, AllOf(StartsWith(law + ": rms error "), HasSubstr("initial shear modulus")));
    const std::string written = readText(dir / (law + ".yaml"));
    EXPECT_THAT(written, HasSubstr("\nmaterial:\n  law: " + law + "\n"));
    std::ofstream(dir / "scene.yaml") << written
                                      << "formulation: fbar\n"
                                         "geometry: {shape: rectangle, size: [1, 1], spans: [1, 1]}\n"
                                         "supports: [{face: bottom, fix: [x, y]}]\n"
                                         "steps: [{until: 1, count: 1}]\n";
    EXPECT_EQ(burnish("validate scene.yaml").code, 0) << burnish("validate scene.yaml").err;
  }
}

TEST_F(FitCommand, PrintsThemWithoutAFile) {
  const Outcome outcome = burnish("fit treloar.csv --law yeoh");
  EXPECT_THAT(outcome.out, AllOf(StartsWith("# Fitted by burnish to treloar.csv\n# yeoh: rms error 12 %"),
                                 HasSubstr("\n  C10: 1.9469")));
}

TEST_F(FitCommand, DrawsPointsAndCurves) {
  const Outcome outcome = burnish(
      "fit treloar.csv --law mooney-rivlin --chart a/chart.pdf --csv - --label pulled --label inflated");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(dir / "a/chart.pdf"));
  EXPECT_THAT(outcome.out,
              StartsWith("\"pulled, measured x\",\"pulled, measured y\",\"pulled, Mooney-Rivlin x\","));
  EXPECT_NE(outcome.out.find("\n1.02,0.26,1,0,1.03,0.95,1,0\n"), std::string::npos);
}

/// Points of a law that gives way: a warning says where, and the constants are written all the same.
TEST_F(FitCommand, WarnsOfConstantsThatAreUnstable) {
  std::ofstream(dir / "soft.csv") << "stretch,stress\n1.1,0.52\n1.3,1.3\n1.6,1.95\n2,2.2\n2.2,2.1\n";
  const Outcome outcome = burnish("fit soft.csv --mode uniaxial --law yeoh -o soft.yaml");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: yeoh: uniaxial tension: beyond the stretch"));
  EXPECT_THAT(readText(dir / "soft.yaml"), HasSubstr("# Warning: uniaxial tension"));
}

}  // namespace
}  // namespace burnish
