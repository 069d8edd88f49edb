#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "postproc/text/text_file.h"
#include "tests/cli/shell.h"
#include "tests/postproc/study/study_samples.h"

/// `burnish verify` as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A block that is pressed by a tenth of its height, on three meshes.
constexpr const char* kVerifiedScene = R"(title: Block
degree: 1
geometry: {shape: rectangle, size: [2, 1], spans: [2, 1]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}, {face: top, move: {times: [0, 1], y: [0, -0.1]}}]
steps: [{until: 1, count: 2}]
variants:
  meshes: [{size: 1}, {size: 0.5, set: ["geometry.spans=[4, 2]"]}, {size: 0.25, set: ["geometry.spans=[8, 4]"]}]
checks:
  - {name: energy, quantity: strain_energy, expect: range, at_least: LOW}
  - {name: energy falls, quantity: strain_energy, expect: monotone, direction: decreasing}
)";

class VerifyCommand : public testing::Test {
 protected:
  Outcome verify(const std::string& low, const std::string& arguments) const {
    std::string yaml = kVerifiedScene;
    writeText(yaml.replace(yaml.find("LOW"), 3, low), scratch_.path() / "scenes/verification/block.yaml");
    return shell(scratch_.path(), BURNISH_COMMAND " verify " + arguments);
  }

  samples::ScratchDirectory scratch_;
};

TEST_F(VerifyCommand, ChecksTheScenesOfADirectoryAndKeepsTheirResults) {
  const Outcome first = verify("0", "");
  ASSERT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("runs: 3, of which to compute: 3\n"));
  EXPECT_THAT(first.out, HasSubstr("\n2 of 2 checks hold\n"));

  const Outcome second = verify("1000", "scenes/verification/block.yaml --document v.md");
  EXPECT_EQ(second.code, 1) << second.out << second.err;
  EXPECT_THAT(second.out, HasSubstr("runs: 3, of which to compute: 0\n"));
  EXPECT_THAT(second.out, HasSubstr("≥ 1000"));
  EXPECT_THAT(second.out, HasSubstr("\n1 of 2 checks hold\n"));
  EXPECT_THAT(readText(scratch_.path() / "v.md"), HasSubstr("1 of 2 checks hold."));
}

TEST_F(VerifyCommand, BadInputIsOneMessageAndComputesNothing) {
  const Outcome outcome = verify("unknown", "");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("block.yaml:10:"));
  EXPECT_THAT(outcome.err, HasSubstr("checks[0].at_least"));
  EXPECT_EQ(verify("0", "nowhere").code, 2);
  EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
}

}  // namespace
}  // namespace burnish
