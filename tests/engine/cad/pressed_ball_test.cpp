// A ball from a STEP file presses like the shape that it is.
#include <BRepPrimAPI_MakeSphere.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

/// Force on the tool at the end of a run in which it goes 0.1 into a block; `tool`: its keys, `length`: label of lengths.
double forceOf(const std::string& tool, const std::filesystem::path& directory,
               const std::string& length = "") {
  const Scene scene =
      parseScene(fmt::format("geometry: {{shape: box, size: [2, 2, 1], spans: [6, 6, 3]}}\n"
                             "material: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
                             "supports: [{{face: back, fix: [x, y, z]}}]\n"
                             "tools: [{{name: ball, {}, motion: {{times: [0, 1], z: [0, -0.1]}}}}]\n"
                             "contact: [{{tool: ball, face: front}}]\n"
                             "steps: [{{until: 1, count: 2}}]\noutput: {{vtu: false}}\n"
                             "units: {{length: '{}'}}\n",
                             tool, length),
                 (directory / "scene.yaml").string());
  const auto outcome = test::run(scene, "pressed_ball");
  EXPECT_TRUE(outcome.summary.completed);
  return outcome.history.column("ball.fz").back();
}

TEST(PressedBall, HasTheForceOfTheSphere) {
  const test::ScratchDirectory directory("step_ball");
  std::filesystem::create_directories(directory.path());
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", "INCH");
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeSphere(gp_Pnt(1.0, 0.9, 1.8), 0.8).Solid(), STEPControl_AsIs);
  ASSERT_EQ(writer.Write((directory.path() / "ball.step").c_str()), IFSelect_RetDone);
  const double exact = forceOf("shape: sphere, center: [1, 0.9, 1.8], radius: 0.8", directory.path());
  const double fromCad = forceOf("shape: cad, file: ball.step", directory.path());
  EXPECT_GT(exact, 0.01);
  EXPECT_NEAR(fromCad, exact, 1e-7 * exact);

  // The scene's own label is the unit that lengths are converted into, unless the tool says another.
  const std::string thousandth = "shape: cad, file: ball.step, scale: 0.001";
  EXPECT_NEAR(forceOf(thousandth + ", unit: um", directory.path(), "m"), exact, 1e-7 * exact);
  EXPECT_NEAR(forceOf(thousandth, directory.path(), "um"), exact, 1e-7 * exact);
  EXPECT_NEAR(forceOf(thousandth, directory.path(), "micron"), exact, 1e-7 * exact);
}

TEST(PressedBall, FaultsAreThoseOfTheKeyThatIsToBlame) {
  const test::ScratchDirectory directory("step_faults");
  std::filesystem::create_directories(directory.path());
  STEPControl_Controller::Init();
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeSphere(gp_Pnt(1.0, 0.9, 1.8), 0.8).Solid(), STEPControl_AsIs);
  ASSERT_EQ(writer.Write((directory.path() / "ball.step").c_str()), IFSelect_RetDone);
  const auto errorOf = [&](const std::string& tool) -> std::string {
    try {
      forceOf(tool, directory.path());
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(errorOf("shape: cad, file: none.step"), HasSubstr("scene.yaml:4:40: tools[0].file: "));
  EXPECT_THAT(errorOf("shape: cad, file: ball.step, face: top"),
              HasSubstr("scene.yaml:4:57: tools[0].face: "));
  EXPECT_THAT(errorOf("shape: cad, file: ball.step, solid: 2"), HasSubstr("tools[0].solid: "));
  EXPECT_THAT(errorOf("shape: cad, file: ball.step, shell: none"), HasSubstr("tools[0].shell: "));
  EXPECT_THAT(errorOf("shape: cad, file: ball.step, face: 1, shell: 1"),
              HasSubstr("tools[0].shell: found shell beside face; allowed: one of face, shell and solid"));
  EXPECT_THAT(errorOf("shape: union, parts: [{shape: cad, file: ball.step, face: top}]"),
              HasSubstr("tools[0].parts[0].face: "));
}

}  // namespace
}  // namespace burnish
