// Tools that are given in several ways, or that are driven by displacements and by forces, press a block in
// the same way.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

/// A block of 2 x 1 below tools that touch its upper face at y = 1.
Scene block(const std::string& tools,
            const std::string& contact = "{tool: tool, face: top, method: augmented-lagrangian}",
            int steps = 4) {
  return parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: rectangle, size: [2.0, 1.0], spans: [16, 6]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports:
  - {{face: bottom, fix: [x, y]}}
tools:
{}
contact:
  - {}
steps: [{{until: 1, count: {}}}]
)",
                                tools, contact, steps),
                    "block");
}

/// The same in space, 1 x 1 wide and 0.5 high.
Scene cube(const std::string& tool) {
  return parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: box, size: [1.0, 0.5, 1.0], spans: [4, 2, 4]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports:
  - {{face: bottom, fix: [x, y, z]}}
tools:
{}
contact:
  - {{tool: tool, face: top, method: augmented-lagrangian}}
steps: [{{until: 1, count: 2}}]
)",
                                tool),
                    "cube");
}

const char* const kMotionDown = "motion: {times: [0, 1], y: [0, -0.1]}";

std::string circle(double radius, double x, double y) {
  const double s = std::sqrt(0.5);
  std::vector<std::string> points, weights;
  for (int k = 0; k <= 8; ++k) {
    const double angle = k * std::numbers::pi / 4.0, r = k % 2 == 0 ? radius : radius / s;
    points.push_back(fmt::format("[{}, {}]", x + r * std::cos(angle), y + r * std::sin(angle)));
    weights.push_back(k % 2 == 0 ? "1" : fmt::format("{}", s));
  }
  points.back() = points.front();
  return fmt::format(
      "shape: nurbs, degrees: [2], knots: [[0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]], "
      "points: [{}], weights: [{}]",
      fmt::join(points, ", "), fmt::join(weights, ", "));
}

std::string circleOfSegments(double radius, double x, double y, int segments) {
  std::vector<std::string> points;
  for (int k = 0; k < segments; ++k) {
    const double angle = 2.0 * k * std::numbers::pi / segments;
    points.push_back(fmt::format("[{}, {}]", x + radius * std::cos(angle), y + radius * std::sin(angle)));
  }
  return fmt::format("shape: polyline, points: [{}]", fmt::join(points, ", "));
}

test::Outcome runWith(const std::string& shape) {
  return test::run(block(fmt::format("  - {{name: tool, {}, {}}}", shape, kMotionDown)), "tool");
}

/// Largest difference of the displacements, over the largest displacement.
double difference(const test::Outcome& a, const test::Outcome& b) {
  return (a.lastFrame.displacement - b.lastFrame.displacement).cwiseAbs().maxCoeff() /
         b.lastFrame.displacement.cwiseAbs().maxCoeff();
}

TEST(ToolsTest, ATiltedPlateIsTheSameAsPlaneCurveAndPolyline) {
  const auto plane = runWith("shape: plane, origin: [0, 1], normal: [0.05, -1]");
  ASSERT_TRUE(plane.summary.completed);
  for (const char* shape :
       {"shape: nurbs, degrees: [1], knots: [[0, 0, 1, 1]], points: [[-4, 0.8], [6, 1.3]]",
        "shape: polyline, closed: false, points: [[-4, 0.8], [6, 1.3]]"}) {
    const auto other = runWith(shape);
    ASSERT_TRUE(other.summary.completed) << shape;
    EXPECT_LT(difference(other, plane), 1e-8) << shape;
  }
}

TEST(ToolsTest, APlateInSpaceIsTheSameAsPlaneSurfaceAndMesh) {
  const test::ScratchDirectory directory("mesh");
  std::filesystem::create_directories(directory.path());
  const auto file = directory.path() / "plate.off";
  std::ofstream(file) << "OFF\n4 2 0\n-4 0.5 -4\n6 0.5 -4\n6 0.5 6\n-4 0.5 6\n3 0 1 2\n3 0 2 3\n";
  const auto with = [](const std::string& shape) {
    return test::run(cube(fmt::format("  - {{name: tool, {}, {}}}", shape, kMotionDown)), "tool");
  };
  const auto plane = with("shape: plane, origin: [0, 0.5, 0], normal: [0, -1, 0]");
  ASSERT_TRUE(plane.summary.completed);
  for (const std::string& shape :
       {std::string("shape: nurbs, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], "
                    "points: [[-4, 0.5, -4], [6, 0.5, -4], [-4, 0.5, 6], [6, 0.5, 6]]"),
        fmt::format("shape: mesh, open: true, file: {}", file.string())}) {
    const auto other = with(shape);
    ASSERT_TRUE(other.summary.completed) << shape;
    EXPECT_LT(difference(other, plane), 1e-8) << shape;
  }
}

TEST(ToolsTest, ADiscIsTheSameAsCylinderAndRationalCircleAndNearlyAsPolyline) {
  const auto disc = runWith("shape: cylinder, center: [1, 1.5], radius: 0.5");
  ASSERT_TRUE(disc.summary.completed);
  const auto spline = runWith(circle(0.5, 1, 1.5));
  ASSERT_TRUE(spline.summary.completed);
  EXPECT_LT(difference(spline, disc), 1e-8);
  const auto polyline = runWith(circleOfSegments(0.5, 1, 1.5, 200));
  ASSERT_TRUE(polyline.summary.completed);
  EXPECT_LT(difference(polyline, disc), 1e-4);
  EXPECT_LE(polyline.summary.iterations, disc.summary.iterations + disc.summary.steps);
}

/// An OFF file of a sphere about the origin, of 2 n (n - 1) triangles for n parallels and n meridians.
void writeSphere(const std::filesystem::path& file, int n) {
  std::ofstream out(file);
  out << fmt::format("OFF\n{} {} 0\n0 1 0\n0 -1 0\n", 2 + n * (n - 1), 2 * n * (n - 1));
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double polar = i * std::numbers::pi / n, angle = 2.0 * j * std::numbers::pi / n;
      out << fmt::format("{} {} {}\n", std::sin(polar) * std::cos(angle), std::cos(polar),
                         std::sin(polar) * std::sin(angle));
    }
  const auto at = [n](int i, int j) { return 2 + (i - 1) * n + j % n; };
  for (int j = 0; j < n; ++j)
    out << fmt::format("3 0 {} {}\n3 1 {} {}\n", at(1, j + 1), at(1, j), at(n - 1, j), at(n - 1, j + 1));
  for (int i = 1; i + 1 < n; ++i)
    for (int j = 0; j < n; ++j)
      out << fmt::format("3 {} {} {}\n3 {} {} {}\n", at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1),
                         at(i + 1, j + 1), at(i + 1, j));
}

/// Orders log(r2/r1)/log(r1/r0) of the last three residuals of each step that are neither far from the
/// solution nor at round-off; the best of them.
double bestOrder(const Scene& scene) {
  const test::ScratchDirectory directory("order");
  RunObserver silent;
  if (!runScene(scene, directory.path(), {}, silent).completed) return 0.0;
  const HistoryTable table = readHistory(directory.path() / "convergence.csv");
  const auto& steps = table.column("step");
  const auto& residuals = table.column("residual");
  double best = 0.0;
  for (std::size_t k = 2; k < residuals.size(); ++k) {
    const double r0 = residuals[k - 2], r1 = residuals[k - 1], r2 = residuals[k];
    if (steps[k - 2] == steps[k] && r0 < 0.5 && r0 > r1 && r1 > r2 && r2 > 1e-13)
      best = std::max(best, std::log(r2 / r1) / std::log(r1 / r0));
  }
  return best;
}

TEST(ToolsTest, NewtonConvergesQuadraticallyWithEveryShapeInThePlane) {
  for (const std::string& shape :
       {std::string("shape: plane, origin: [0, 1], normal: [0.05, -1]"),
        std::string("shape: cylinder, center: [1, 1.5], radius: 0.5"),
        std::string("shape: cylinder, center: [1, -4.1], radius: 5.2, inside: true"),
        std::string("shape: edge, tip: [1, 1], direction: [0, -1], angle: 120, radius: 0.3"),
        std::string("shape: box, center: [1, 1.4], size: [0.8, 0.8], radius: 0.2"), circle(0.5, 1, 1.5),
        circleOfSegments(0.5, 1, 1.5, 200),
        std::string("shape: union, blend: 0.1, parts: [{shape: cylinder, center: [0.8, 1.5], radius: 0.5}, "
                    "{shape: cylinder, center: [1.2, 1.5], radius: 0.5}]")})
    EXPECT_GT(bestOrder(block(fmt::format("  - {{name: tool, {}, {}}}", shape, kMotionDown))), 1.7) << shape;
  EXPECT_GT(bestOrder(block("  - {name: tool, shape: cylinder, center: [1, 1.8], radius: 0.5, carry: {y: "
                            "'-0.5*t'}}")),
            1.7)
      << "force";
}

TEST(ToolsTest, NewtonConvergesQuadraticallyWithEveryShapeInSpace) {
  for (const char* shape :
       {"shape: sphere, center: [0.5, 1.1, 0.5], radius: 0.6",
        "shape: cylinder, center: [0.5, 1.1, 0.5], radius: 0.6, axis: [1, 0, 0.3]",
        "shape: cone, tip: [0.5, 0.5, 0.5], direction: [0, -1, 0], half_angle: 70, radius: 0.3",
        "shape: torus, center: [0.5, 0.7, 0.5], axis: [0, 1, 0], radius: 0.3, tube_radius: 0.2",
        "shape: box, center: [0.5, 0.9, 0.5], size: [0.7, 0.8, 0.7], radius: 0.2"})
    EXPECT_GT(bestOrder(cube(fmt::format("  - {{name: tool, {}, {}}}", shape, kMotionDown))), 1.7) << shape;
}

TEST(ToolsTest, ABallOfFiftyThousandTrianglesPressesLikeASphere) {
  const test::ScratchDirectory directory("ball_mesh");
  std::filesystem::create_directories(directory.path());
  const auto file = directory.path() / "ball.off";
  writeSphere(file, 160);
  // A quarter of a block; the pole of the mesh is off the contact, where triangles are neither small nor
  // regular.
  const auto with = [](const std::string& shape) {
    return test::run(parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: box, origin: [0, -0.8, 0], size: [0.8, 0.8, 0.8], spans: [8, 4, 8], grading: [s^1.5, 1-(1-s)^1.5, s^1.5]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports:
  - {{face: bottom, fix: [x, y, z]}}
  - {{face: left, symmetry: true}}
  - {{face: back, symmetry: true}}
tools:
  - {{name: tool, {}, pivot: [0, 0, 0], motion: {{times: [0, 1], y: [1.001, 0.98], angle: [60, 60]}}}}
contact: [{{tool: tool, face: top, method: augmented-lagrangian}}]
steps: [{{until: 1, count: 4}}]
)",
                                            shape),
                                "ball"),
                     "ball");
  };
  const auto sphere = with("shape: sphere, center: [0, 0, 0], radius: 1");
  const auto mesh = with(fmt::format("shape: mesh, file: {}", file.string()));
  ASSERT_TRUE(sphere.summary.completed);
  ASSERT_TRUE(mesh.summary.completed) << mesh.summary.stoppedBecause;
  const double force = sphere.history.column("tool.fy").back();
  EXPECT_GT(force, 0.0);
  EXPECT_NEAR(mesh.history.column("tool.fy").back(), force, 5e-4 * force);
  EXPECT_LE(mesh.summary.iterations, sphere.summary.iterations + sphere.summary.steps);
}

TEST(ToolsTest, AForceGivesTheStateOfTheDisplacementThatItBelongsTo) {
  const auto byDisplacement = runWith("shape: cylinder, center: [1, 1.5], radius: 0.5");
  const double force = byDisplacement.history.column("tool.fy").back();
  // The tool starts above the block and comes down to it by itself.
  const auto byForce = test::run(
      block(fmt::format("  - {{name: tool, shape: cylinder, center: [1, 1.8], radius: 0.5, carry: {{y: "
                        "'-{:.17g}*t'}}}}",
                        force)),
      "force");
  ASSERT_TRUE(byForce.summary.completed);
  EXPECT_NEAR(byForce.history.column("tool.fy").back(), force, 1e-10 * force);
  EXPECT_NEAR(byForce.history.column("tool.uy").back(), -0.4, 1e-8);
  EXPECT_LT(difference(byForce, byDisplacement), 1e-8);
  EXPECT_NEAR(byForce.history.column("tool.fy")[2] / force, 0.5, 1e-10);
}

/// Where short stiff spans make the bound for rounding large, Newton's method goes on while the residual falls.
TEST(ToolsTest, AForceIsCarriedToManyDigitsOnAGradedMesh) {
  const test::Outcome ran = test::run(parseScene(R"(
kinematics: axisymmetric
geometry:
  shape: rectangle
  origin: [0, -6]
  size: [6, 6]
  spans: [24, 18]
  grading: [0.02*s + 0.98*s^10, 1 - 0.03*(1 - s) - 0.97*(1 - s)^9]
material: {law: j2, E: 100000, nu: 0.25, hardening: {law: voce, sigma0: 300, sigma_inf: 1500, beta: 5}}
supports: [{face: left, symmetry: true}, {face: bottom, fix: [y]}]
tools:
  - name: tip
    shape: cone
    tip: [0, 0]
    direction: [0, -1]
    half_angle: 70.3
    radius: 0.05
    carry: {y: -15, schedule: {times: [0, 1, 2], values: [0.001, 1, 0.02]}}
contact: [{tool: tip, face: top}]
steps: [{until: 1, count: 5}, {until: 2, count: 8}]
output: {vtu: false}
)",
                                                 "test.yaml"),
                                      "tools_graded");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto &times = ran.history.column("time"), &forces = ran.history.column("tip.fy");
  for (std::size_t k = 1; k < ran.history.numRows(); ++k) {
    const double t = times[k],
                 force = 15.0 * (t <= 1.0 ? std::lerp(0.001, 1.0, t) : std::lerp(1.0, 0.02, t - 1.0));
    EXPECT_NEAR(forces[k], force, 1e-8 * force) << "t = " << t;
  }
}

TEST(ToolsTest, APlateWithForceAndMomentIsInEquilibrium) {
  const auto outcome = test::run(block("  - {name: tool, shape: plane, origin: [0, 1], normal: [0, -1], "
                                       "pivot: [0.9, 1.2], carry: {y: '-4*t', moment: '0.2*t'}}"),
                                 "moment");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  EXPECT_NEAR(outcome.history.column("tool.fy").back(), 4.0, 1e-9);
  EXPECT_NEAR(outcome.history.column("tool.mz").back(), -0.2, 1e-9);
  // The pressure lies off the pivot by moment over force, and the plate tilts towards it.
  EXPECT_GT(std::abs(outcome.history.column("tool.angle").back()), 0.1);
  // Work of force and moment against the stored energy, with the error of four steps.
  const auto& end = outcome.summary.end;
  EXPECT_NEAR(end.externalWork, end.strainEnergy, 0.01 * end.strainEnergy);
}

TEST(ToolsTest, ATurnedBoxIsTheSameAsABoxWithTurnedAxes) {
  const double angle = 20.0 * std::numbers::pi / 180.0;
  const auto axes =
      runWith(fmt::format("shape: box, center: [1, 1.49], size: [0.8, 0.8], radius: 0.1, axes: [[{}, {}]]",
                          std::cos(angle), std::sin(angle)));
  ASSERT_TRUE(axes.summary.completed);
  const auto turned = test::run(
      block("  - {name: tool, shape: box, center: [1, 1.49], size: [0.8, 0.8], radius: 0.1, motion: {times: "
            "[0, 1], angle: [20, 20], y: [0, -0.1]}}"),
      "turned");
  ASSERT_TRUE(turned.summary.completed);
  EXPECT_GT(axes.history.column("tool.fy").back(), 0.01);
  EXPECT_LT(difference(turned, axes), 1e-10);
}

TEST(ToolsTest, WorkOfATurningToolBalancesTheStoredEnergy) {
  // A bar that turns about its middle presses its end into the block.
  const auto outcome = test::run(
      block("  - {name: tool, shape: box, center: [0.2, 1.3], size: [1.4, 0.5], radius: 0.2, prescribe: "
            "{angle: '-14*t'}}",
            "{tool: tool, face: top, method: augmented-lagrangian}", 24),
      "turning");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  const auto& end = outcome.summary.end;
  EXPECT_GT(end.strainEnergy, 1e-4);
  EXPECT_NEAR(end.externalWork, end.strainEnergy, 0.02 * end.strainEnergy);
}

TEST(ToolsTest, ACylinderOnAStripBetweenSmoothWallsIsPlaneStrain) {
  const std::string rest = R"(
material:
  law: j2
  E: 70000
  nu: 0.3
  hardening: {law: voce, sigma0: 79.66, sigma_inf: 171.26, beta: 17.8}
contact: [{tool: tool, face: top, method: augmented-lagrangian}]
steps: [{until: 1, count: 4}, {until: 2, count: 2}]
)";
  const auto plane = test::run(parseScene("geometry: {shape: rectangle, size: [2, 1], spans: [10, 4]}\n"
                                          "supports: [{face: bottom, fix: [x, y]}]\n"
                                          "tools: [{name: tool, shape: cylinder, center: [0.7, 1.5], radius: "
                                          "0.5, motion: {times: [0, 1, 2], x: [0, 0, 0.05], y: [0, -0.02, "
                                          "-0.02]}}]" +
                                              rest,
                                          "plane"),
                               "plane");
  const auto strip = test::run(parseScene("geometry: {shape: box, size: [2, 1, 0.5], spans: [10, 4, 1]}\n"
                                          "supports: [{face: bottom, fix: [x, y]}, {face: back, symmetry: "
                                          "true}, {face: front, symmetry: true}]\n"
                                          "tools: [{name: tool, shape: cylinder, center: [0.7, 1.5, 0], "
                                          "radius: 0.5, motion: {times: [0, 1, 2], x: [0, 0, 0.05], y: [0, "
                                          "-0.02, -0.02]}}]" +
                                              rest,
                                          "strip"),
                               "strip");
  ASSERT_TRUE(plane.summary.completed);
  ASSERT_TRUE(strip.summary.completed);
  for (const char* column : {"tool.fx", "tool.fy"})
    for (std::size_t k = 1; k < plane.history.column(column).size(); ++k)
      EXPECT_NEAR(strip.history.column(column)[k], 0.5 * plane.history.column(column)[k],
                  1e-8 * plane.history.column("tool.fy")[k])
          << column << " in step " << k;
}

TEST(ToolsTest, AToolThatSlidesOverTheEndOfItsFaceIsNoticed) {
  const auto outcome = test::run(block("  - {name: tool, shape: cylinder, center: [1.7, 1.5], radius: 0.5, "
                                       "motion: {times: [0, 0.2, 1], x: "
                                       "[0, 0.6, 0.6], y: [0, 0, -0.5]}}",
                                       "{tool: tool, face: top, method: augmented-lagrangian}", 20),
                                 "over_the_end");
  const auto& doubts = outcome.summary.doubts;
  const auto inside = std::find_if(doubts.begin(), doubts.end(), [](const DoubtRecord& doubt) {
    return doubt.what == "tool 'tool' is inside the body at face 'right', which it has no contact with";
  });
  ASSERT_NE(inside, doubts.end());
  EXPECT_GT(inside->firstTime, 0.2);
}

/// The doubts about tips that the mesh is too coarse for.
std::vector<DoubtRecord> tipDoubts(const test::Outcome& outcome) {
  std::vector<DoubtRecord> found;
  std::ranges::copy_if(outcome.summary.doubts, std::back_inserter(found), [](const DoubtRecord& doubt) {
    return doubt.what.find("too sharp for the mesh") != std::string::npos;
  });
  return found;
}

TEST(ToolsTest, ATipBetweenControlPointsIsNoticed) {
  // In the middle of a knot span of 0.125, where no averaged gap feels it: it would press without any force.
  const auto wedge = runWith("shape: edge, tip: [0.96, 1.08], direction: [0, -1], angle: 40");
  EXPECT_EQ(wedge.history.column("tool.fy").back(), 0.0);
  EXPECT_LT(wedge.summary.largestPenetration, 0.1 * 0.125) << "the other limit does not see it";
  const auto doubts = tipDoubts(wedge);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].what.find("tool 'tool'"), std::string::npos) << doubts[0].what;
  EXPECT_NE(doubts[0].what.find("face 'top'"), std::string::npos) << doubts[0].what;

  const auto cone = test::run(cube("  - {name: tool, shape: cone, tip: [0.6, 0.56, 0.4], direction: [0, -1, "
                                   "0], half_angle: 30, motion: {times: [0, 1], y: [0, -0.1]}}"),
                              "cone");
  EXPECT_EQ(cone.history.column("tool.fy").back(), 0.0);
  EXPECT_EQ(tipDoubts(cone).size(), 1u);

  const auto onAxis = test::run(parseScene(R"(
kinematics: axisymmetric
geometry: {shape: rectangle, size: [2, 1], spans: [8, 4]}
material: {law: neo-hookean, E: 10.0, nu: 0.3}
supports: [{face: bottom, fix: [y]}, {face: left, symmetry: true}]
tools: [{name: tool, shape: cone, tip: [0, 1], direction: [0, -1], half_angle: 40, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: tool, face: top, method: augmented-lagrangian}]
steps: [{until: 1, count: 2}]
)",
                                           "cone"),
                                "cone");
  EXPECT_EQ(tipDoubts(onAxis).size(), 1u);
}

TEST(ToolsTest, ToolsThatTheMeshResolvesAreNotDoubted) {
  for (const char* shape : {"shape: edge, tip: [0.96, 1], direction: [0, -1], angle: 120, radius: 0.3",
                            "shape: cylinder, center: [0.96, 1.5], radius: 0.5",
                            "shape: box, center: [0.96, 1.4], size: [0.8, 0.8], radius: 0.2"}) {
    const auto outcome = runWith(shape);
    EXPECT_GT(outcome.history.column("tool.fy").back(), 0.1) << shape;
    EXPECT_TRUE(tipDoubts(outcome).empty()) << shape;
  }
}

TEST(ToolsTest, AFreeTurnNeverGoesRoundAndRound) {
  // A box on the round of which one control point alone holds it at first: its turn is next to undetermined.
  for (const int spans : {8, 16}) {
    Scene scene = block(
        "  - {name: tool, shape: box, center: [1, 1.4], size: [0.8, 0.8], radius: 0.1, carry: {y: "
        "'-0.5*t', moment: 0}}");
    scene.body.geometry.mesh.spans = {spans, 4};
    const auto outcome = test::run(scene, "free_turn");
    for (const double angle : outcome.history.column("tool.angle")) EXPECT_LT(std::abs(angle), 5.0);
    if (outcome.summary.completed) {
      EXPECT_NEAR(outcome.summary.end.externalWork, outcome.summary.end.strainEnergy,
                  0.05 * outcome.summary.end.strainEnergy);
    }
  }
}

/// Why a block with these tools cannot be computed.
std::string refusalOf(const std::string& tools) {
  const test::ScratchDirectory directory("refused");
  RunObserver silent;
  try {
    runScene(block(tools), directory.path(), {}, silent);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ToolsTest, WaysInWhichAToolMovesInItselfAreNamed) {
  const auto expect = [](const std::string& tool, const std::string& what) {
    const std::string message = refusalOf(fmt::format("  - {{name: tool, {}}}", tool));
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  const std::string inItself = ": tool 'tool' moves in itself";
  expect("shape: cylinder, center: [1, 1.5], radius: 0.5, carry: {y: '-t', moment: 0}",
         "tools[0].carry.moment" + inItself);
  expect("shape: cylinder, center: [1, 1.5], radius: 0.5, pivot: [1, 1.2], carry: {x: 0, y: '-t', moment: 0}",
         "tools[0].carry.x" + inItself + " in this way, together with tools[0].carry.moment,");
  expect("shape: plane, origin: [0, 1], normal: [0, -1], carry: {x: 1, y: '-t'}",
         "tools[0].carry.x" + inItself);
  expect("shape: nurbs" + circle(0.5, 1, 1.5).substr(12) + ", carry: {y: '-t', moment: '0.1*t'}",
         "tools[0].carry.moment" + inItself);
}

TEST(ToolsTest, AFreeWayInWhichNothingResistsIsNamedWhenTheRunStops) {
  const auto outcome = test::run(
      block("  - {name: tool, shape: cylinder, center: [1, 1.5], radius: 0.5, carry: {x: '0.2*t', y: '-t'}}"),
      "sliding");
  EXPECT_FALSE(outcome.summary.completed);
  EXPECT_NE(outcome.summary.stoppedBecause.find("tools[0].carry.x"), std::string::npos)
      << outcome.summary.stoppedBecause;
}

TEST(ToolsTest, PointwisePenaltyStartsWithoutAForceAndItsWorkIsStored) {
  const auto outcome = test::run(
      block("  - {name: tool, shape: cylinder, center: [1, 1.6], radius: 0.5, carry: {y: '-0.5*t'}}",
            "{tool: tool, face: top, method: pointwise-penalty}", 10),
      "pointwise_force");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  EXPECT_LT(std::abs(outcome.history.column("tool.fy").front()), 1e-4);
  const auto& end = outcome.summary.end;
  EXPECT_NEAR(end.externalWork, end.strainEnergy + end.contactEnergy, 0.1 * end.strainEnergy);
}

TEST(ToolsTest, AFileMayHaveUnusedPoints) {
  const test::ScratchDirectory directory("unused_points");
  std::filesystem::create_directories(directory.path());
  const auto file = directory.path() / "pyramid.off";
  std::ofstream(file)
      << "OFF\n5 4 0\n0 0.6 0\n2 0.6 0\n1 0.6 2\n1 2.6 0.6\n9 9 9\n3 0 1 2\n3 0 3 1\n3 1 3 2\n"
         "3 2 3 0\n";
  const auto outcome = test::run(
      cube(fmt::format("  - {{name: tool, shape: mesh, file: {}, motion: {{times: [0, 1], y: [0, -0.2]}}}}",
                       file.string())),
      "unused");
  EXPECT_TRUE(outcome.summary.completed);
  EXPECT_GT(outcome.history.column("tool.fy").back(), 0.0);
}

TEST(ToolsTest, AToolThatNeverTouchesIsNamed) {
  const auto away =
      test::run(block("  - {name: tool, shape: cylinder, center: [1, 1.6], radius: 0.5}"), "away");
  EXPECT_EQ(away.summary.idleTools, std::vector<std::string>{"tool"});
  const auto pressed = runWith("shape: cylinder, center: [1, 1.5], radius: 0.5");
  EXPECT_TRUE(pressed.summary.idleTools.empty());
  EXPECT_TRUE(std::none_of(
      pressed.summary.doubts.begin(), pressed.summary.doubts.end(),
      [](const DoubtRecord& doubt) { return doubt.what.find("inside the body") != std::string::npos; }));
}

TEST(ToolsTest, AToolThatIsPulledOffStopsTheRunAndSaysSo) {
  const auto outcome = test::run(
      block("  - {name: tool, shape: cylinder, center: [1, 1.5], radius: 0.5, carry: {y: 't < 0.6 ? -0.5*t : "
            "0.1'}}"),
      "pulled");
  EXPECT_FALSE(outcome.summary.completed);
  EXPECT_NE(outcome.summary.stoppedBecause.find("tool 'tool'"), std::string::npos)
      << outcome.summary.stoppedBecause;
  EXPECT_LT(outcome.history.column("time").back(), 0.6);
}

}  // namespace
}  // namespace burnish
