#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <variant>

#include "engine/core/error.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A body with one tool, which is given as the keys that follow its name.
std::string sceneWith(const std::string& tool, const std::string& geometry) {
  return fmt::format(
      "geometry: {{{}}}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\nsteps: [{{until: 1, count: 1}}]\n"
      "tools:\n  - {{name: tool, {}}}\n",
      geometry, tool);
}

const std::string kPlanar = "shape: rectangle, size: [3, 1], spans: [3, 1]";
const std::string kSpatial = "shape: box, size: [3, 1, 1], spans: [3, 1, 1]";

RigidShape shapeOf(const std::string& tool, const std::string& geometry) {
  const Scene scene = parseScene(sceneWith(tool, geometry), "test.yaml");
  const Scene again = parseScene(scene.resolvedYaml, "again.yaml");
  EXPECT_EQ(again.resolvedYaml, scene.resolvedYaml) << "the resolved scene is the same scene";
  return makeShape(again.tools.at(0).shape, again.tools.at(0).inside);
}

TEST(ToolKeys, MakeTheShapesOfThePlane) {
  EXPECT_NEAR(shapeOf("shape: edge, tip: [1, 2], direction: [0, -1], angle: 90, radius: 0.1", kPlanar)
                  .query({1.0, 1.5, 0.0})
                  .gap,
              0.5, 1e-12);
  const std::string box = "shape: box, center: [0, 2], size: [2, 1], radius: 0.1, axes: [[0, 1]]";
  EXPECT_NEAR(shapeOf(box, kPlanar).query({0.0, 0.5, 0.0}).gap, 0.5, 1e-12) << "its long side is upright";
  EXPECT_NEAR(shapeOf(box + ", inside: true", kPlanar).query({0.0, 1.5, 0.0}).gap, 0.5, 1e-12);
  const std::string curve = "shape: nurbs, degrees: [1], knots: [[0, 0, 1, 1]], points: [[1, 1], [0, 1]]";
  EXPECT_NEAR(shapeOf(curve, kPlanar).query({0.5, 1.2, 0.0}).gap, 0.2, 1e-12);
  EXPECT_NEAR(shapeOf(curve + ", flip: true", kPlanar).query({0.5, 1.2, 0.0}).gap, -0.2, 1e-12);
  EXPECT_NEAR(shapeOf("shape: polyline, points: [[0, 1], [1, 1], [1, 2], [0, 2]]", kPlanar)
                  .query({0.5, 0.99, 0.0})
                  .gap,
              0.01, 1e-9);
}

TEST(ToolKeys, MakeTheShapesOfSpace) {
  const std::string cone = "shape: cone, tip: [0, 0, 2], direction: [0, 0, -1], half_angle: 70, radius: 0.1";
  EXPECT_NEAR(shapeOf(cone, kSpatial).query({0.0, 0.0, 1.5}).gap, 0.5, 1e-12);
  EXPECT_NEAR(shapeOf("shape: torus, center: [0, 0, 2], radius: 1, tube_radius: 0.25", kSpatial)
                  .query({1.0, 0.0, 1.5})
                  .gap,
              0.25, 1e-12);
  const std::string surface =
      "shape: nurbs, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], "
      "points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]";
  EXPECT_NEAR(shapeOf(surface, kSpatial).query({0.5, 0.5, 0.3}).gap, 0.3, 1e-12);
  const std::string both =
      "shape: union, blend: 0.2, parts: [{shape: sphere, center: [0, 0, 2], radius: 1}, "
      "{shape: box, center: [0, 0, 6], size: [1, 1, 8]}]";
  EXPECT_NEAR(shapeOf(both, kSpatial).query({0.0, 0.0, 0.5}).gap, 0.5, 1e-12);
  const Scene scene = parseScene(sceneWith(both, kSpatial), "test.yaml");
  EXPECT_EQ(std::get<UnionTool>(scene.tools.at(0).shape).blend, 0.2);
}

TEST(ToolKeys, TakeAConeInAxisymmetryAlongTheAxis) {
  const std::string geometry = kPlanar + "}\nkinematics: axisymmetric\nunits: {length: mm";
  const RigidShape cone = shapeOf("shape: cone, tip: [0, 2], direction: [0, -1], half_angle: 70", geometry);
  EXPECT_NEAR(cone.query({0.0, 1.5, 0.0}).gap, 0.5, 1e-12);
}

TEST(ToolKeys, FindFilesBesideTheScene) {
  const auto directory = std::filesystem::path(testing::TempDir()) / "scene_tools";
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "line.txt") << "0 1\n1 1\n1 2\n0 2\n";
  std::ofstream(directory / "curve.yaml")
      << "degrees: [1]\nknots: [[0, 0, 1, 1]]\npoints: [[1, 1], [0, 1]]\n";
  for (const std::string tool : {"shape: polyline, file: line.txt", "shape: nurbs, file: curve.yaml"}) {
    const Scene scene = parseScene(sceneWith(tool, kPlanar), (directory / "test.yaml").string());
    const Scene elsewhere = parseScene(scene.resolvedYaml, "the scene of the result");
    EXPECT_NEAR(makeShape(elsewhere.tools.at(0).shape, false).query({0.5, 0.99, 0.0}).gap,
                tool.find("line") != std::string::npos ? 0.01 : -0.01, 1e-9);
  }
  const Scene missing = parseScene(sceneWith("shape: polyline, file: none.txt", kPlanar), "test.yaml");
  try {
    makeShape(missing.tools.at(0).shape, false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("none.txt: there is no such file"));
  }
}

struct Mistake {
  const char* name;
  std::string geometry, tool, message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class ToolMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ToolMistake, IsNamedWithItsPlace) {
  const auto& [name, geometry, tool, message] = GetParam();
  try {
    parseScene(sceneWith(tool, geometry), "test.yaml");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("test.yaml:5:"));
    EXPECT_THAT(error.what(), HasSubstr("tools[0]" + message));
  }
}

const std::string kLine = "shape: nurbs, degrees: [1], knots: [[0, 0, 1, 1]], points: ";

INSTANTIATE_TEST_SUITE_P(
    All, ToolMistake,
    testing::Values(
        Mistake{"angle", kPlanar, "shape: edge, tip: [0, 2], direction: [0, -1], angle: 180",
                ".angle: found 180; allowed: a number above 0 and below 180."},
        Mistake{"front", kPlanar, "shape: edge, tip: [0, 2], direction: [0, 0], angle: 90",
                ".direction: found a vector without length"},
        Mistake{"along", kSpatial, "shape: edge, tip: [0, 0, 2], direction: [0, 0, -1], angle: 90",
                ".along: found [0, 0, 1], parallel to direction; allowed: a direction across it."},
        Mistake{"conePlanar", kPlanar, "shape: cone, tip: [0, 2], direction: [0, -1], half_angle: 70",
                ".shape: found cone, which needs a three-dimensional or axisymmetric body"},
        Mistake{"torus", kSpatial, "shape: torus, center: [0, 0, 2], radius: 1, tube_radius: 1",
                ".tube_radius: found 1; allowed: a number below the radius 1."},
        Mistake{"boxRadius", kPlanar, "shape: box, center: [0, 2], size: [2, 1], radius: 0.6",
                ".radius: found 0.6; allowed: at most 0.5, half the smallest size."},
        Mistake{"boxAxes", kSpatial, "shape: box, center: [0, 2, 0], size: [2, 1, 1], axes: [[1, 0, 0]]",
                ".axes: found something else than two directions"},
        Mistake{"nurbsDegrees", kSpatial, kLine + "[[1, 1, 0], [0, 1, 0]]",
                ".degrees: found 1 degrees; allowed: 2, those of a surface."},
        Mistake{"nurbsPoints", kPlanar, kLine + "[[1, 1], [0, 1], [0, 2]]",
                ".points: found 3 points; allowed: 2, as many as the knots make basis functions."},
        Mistake{"nurbsCoordinates", kPlanar, kLine + "[[1, 1], [0, 1, 2]]",
                ".points[1]: found 3 coordinates; allowed: 2, one per dimension of the body."},
        Mistake{"polylineEmpty", kPlanar, "shape: polyline",
                ": found neither points nor file; allowed: exactly one of points and file."},
        Mistake{"polylineSpace", kSpatial, "shape: polyline, file: a.txt",
                ".shape: found polyline, which needs a two-dimensional body"},
        Mistake{"mesh", kPlanar, "shape: mesh, file: a.stl",
                ".shape: found mesh, which needs a three-dimensional body"},
        Mistake{"smoothing", kSpatial, "shape: mesh, file: a.stl, smoothing: 0",
                ".smoothing: found 0; allowed: a number above 0."},
        Mistake{
            "part", kPlanar,
            "shape: union, parts: [{shape: cylinder, center: [0, 2], radius: 1}, {shape: sphere, center: [0, "
            "2], radius: 1}]",
            ".parts[1].shape: found sphere, which needs a three-dimensional body"},
        Mistake{"noParts", kPlanar, "shape: union, parts: []",
                ".parts: found a list of 0 entries; allowed: a list of 1 or more mappings."}),
    [](const auto& test) { return test.param.name; });

TEST(ToolKeys, KeepAConeOnTheAxisOfRevolution) {
  const std::string scene =
      sceneWith("shape: cone, tip: [1, 2], direction: [1, -1], half_angle: 70", kPlanar) +
      "kinematics: axisymmetric\n";
  try {
    parseScene(scene, "test.yaml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("tools[0].direction: found [1, -1]; allowed in axisymmetry"));
    EXPECT_THAT(error.what(), HasSubstr("tools[0].tip: found [1, 2]; allowed in axisymmetry"));
  }
}

}  // namespace
}  // namespace burnish
