#include <gmock/gmock.h>
#include <json/json.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/cli/shell_test.h"

/// `burnish indentation` of runs as the user makes them.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A sphere of radius 1 on an elastic body of revolution, 40 contact radii wide and deep.
constexpr const char* kElastic = R"(
definitions: [{name: k, formula: 4.4}]
kinematics: axisymmetric
degree: 2
geometry:
  shape: rectangle
  origin: [0, -2]
  size: [2, 2]
  spans: [48, 36]
  grading: [sinh(k*s)/sinh(k), 1 - sinh(k*(1 - s))/sinh(k)]
material: {law: neo-hookean, E: 1000, nu: 0.3}
supports: [{face: left, symmetry: true}, {face: bottom, fix: [y]}]
tools: [{name: ball, shape: cylinder, center: [0, 1.001], radius: 1, motion: {times: [0, 1, 2], y: [0, -3.5e-3, 0]}}]
contact: [{tool: ball, face: top, method: integral-augmented-lagrangian}]
steps: [{until: 1, count: 8}, {until: 2, count: 20}]
output: {times: [1], vtu: false}
)";

class IndentationCommand : public ShellTest {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(dir / name) << text; }
  Outcome burnish(const std::string& arguments) const { return shell(dir, BURNISH_COMMAND " " + arguments); }
};

/// The modulus of the scene comes back. At 40 contact radii a half space has sunk by 2a/(πr) = 1.6 per cent of the depth,
/// where this body is held: P ~ E h^(3/2) takes it for a modulus 1.5 times this larger.
TEST_F(IndentationCommand, FindsTheModulusOfAnElasticBody) {
  write("scene.yaml", kElastic);
  const Outcome run = burnish("run scene.yaml -o out --quiet");
  ASSERT_EQ(run.code, 0) << run.err;
  const Outcome found = burnish("indentation out --json -o chart.svg");
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_TRUE(fs::exists(dir / "chart.svg"));
  Json::Value list;
  std::istringstream(found.out) >> list;
  ASSERT_EQ(list.size(), 1U);
  const Json::Value& values = list[0];
  EXPECT_NEAR(values["depth"].asDouble(), 2.5e-3, 1e-12) << "from the surface, not from where the tool began";
  EXPECT_NEAR(values["exponent"].asDouble(), 1.5, 0.015);
  EXPECT_NEAR(values["final_depth"].asDouble(), 0.0, 0.005 * 2.5e-3);
  EXPECT_NEAR(values["modulus"].asDouble(), 1000.0 * (1.0 + 1.5 * 0.016), 10.0);
  EXPECT_EQ(values["modulus_of_scene"].asDouble(), 1000.0);
  const Json::Value& computed = values["computed"];
  const double area = M_PI * 2.5e-3;  // a² = R h
  EXPECT_NEAR(computed["area"].asDouble(), area, computed["uncertainty_of_area"].asDouble());
  EXPECT_THAT(burnish("indentation out").out, AllOf(HasSubstr("modulus of the scene"), HasSubstr("found +")));
  expectRefusal(burnish("indentation out --tool cone"), "",
                "tool: found \"cone\"; the run has the tools ball");
  expectRefusal(burnish("indentation out --fit 0.97,0.98"), "", "the unloading has 0 steps");
  expectRefusal(burnish("indentation out --fit 0.9,0.4"), "", "--fit");
}

TEST_F(IndentationCommand, DoubtsAnUnloadingThatEndsBeforeTheFit) {
  write("scene.yaml", kElastic);
  ASSERT_EQ(burnish("run scene.yaml -o out --quiet --set tools[0].motion.y=[0,-3.5e-3,-2.9e-3]").code, 0);
  const Outcome found = burnish("indentation out");
  EXPECT_EQ(found.code, 0);
  EXPECT_THAT(found.out, HasSubstr("doubtful: the run ends at 0.6"));
  EXPECT_THAT(found.out,
              HasSubstr(" of the first force of the unloading, before the fit from 0.4 on is reached\n"));
  EXPECT_THAT(burnish("indentation out --json").out, HasSubstr("\"doubtful\":"));
  EXPECT_THAT(burnish("indentation out --fit 0.8,0.98").out, Not(HasSubstr("doubtful")));
}

TEST_F(IndentationCommand, RefusesOtherRuns) {
  write("plane.yaml", R"(
geometry: {shape: rectangle, size: [2, 1], spans: [3, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: die, shape: plane, origin: [0, 1], normal: [0, -1], motion: {times: [0, 1], y: [0, -0.01]}}]
contact: [{tool: die, face: top}]
steps: [{until: 1, count: 1}]
output: {vtu: false}
)");
  ASSERT_EQ(burnish("run plane.yaml -o plane --quiet").code, 0);
  expectRefusal(burnish("indentation plane"), "", "plane/result.h5: the body is not one of revolution");
  ASSERT_EQ(
      burnish("run plane.yaml -o round --quiet --set kinematics=axisymmetric --set 'supports=[{face: bottom, "
              "fix: [y]}, {face: left, symmetry: true}]'")
          .code,
      0);
  expectRefusal(burnish("indentation round"), "", "tool: \"die\" is neither a sphere");
}

}  // namespace
}  // namespace burnish
