// Bodies made from curves and faces, as scenes describe them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/analysis/geometry.h"
#include "engine/core/error.h"
#include "engine/nurbs/constructions.h"
#include "engine/scene/reader.h"
#include "engine/solid/span_quadrature.h"

namespace burnish {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;
const double kHalf = std::numbers::sqrt2 / 2.0;  // weight in the middle of a quarter of a circle

Scene sceneOf(const std::string& geometry) {
  return parseScene(fmt::format("geometry: {{{}}}\nmaterial: {{law: neo-hookean, E: 1, nu: 0.3}}\n"
                                "steps: [{{until: 1, count: 1}}]\n",
                                geometry),
                    "scene.yaml");
}

template <int Dim>
Body<Dim> made(const std::string& geometry) {
  const Scene scene = sceneOf(geometry);
  EXPECT_EQ(parseScene(scene.resolvedYaml, "again.yaml").resolvedYaml, scene.resolvedYaml);
  return makeBody<Dim>(scene).body;
}

template <int Dim>
double volume(const std::string& geometry) {
  return SpanQuadrature<Dim>(made<Dim>(geometry), 12).volume();
}

std::string refusalOf(const std::string& geometry) {
  try {
    sceneOf(geometry);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::string kQuarter =
    fmt::format("{{degrees: [2], points: [[1, 0], [1, 1], [0, 1]], weights: [1, {}, 1]}}", kHalf);

/// 1 < r < 2, 0 < z < 1 in the plane y = 0, so that turning about z makes a ring.
const std::string kRectangle = "{degrees: [1, 1], points: [[1, 0, 0], [1, 0, 1], [2, 0, 0], [2, 0, 1]]}";

TEST(Extrusion, OfAnArcHasTheAreaOfTheStripAndOfADiscTheVolumeOfTheCylinder) {
  EXPECT_NEAR(volume<2>("shape: extrusion, profile: " + kQuarter + ", vector: [-3, 0], refine: [2, 2]"), 3.0,
              1e-13);
  const std::string face =
      "{degrees: [2, 1], knots: [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]], points: [[1, 0], [1, 1], [0, 1], [2, 0], [2, 2], [0, 2]], "
      "weights: [1, 0.7071067811865476, 1, 1, 0.7071067811865476, 1]}";
  EXPECT_NEAR(volume<3>("shape: extrusion, profile: " + face + ", vector: [1, 2, -5]"),
              5.0 * 0.75 * kTurn / 2, 1e-12);
}

TEST(Extrusion, BeginsWithItsProfileAndTakesUniformKnots) {
  const auto body = made<2>(
      "shape: extrusion, profile: {degrees: [2], points: [[0, 0], [1, 0.2], [2, 0.1], [3, 0]]}, vector: [0, 1]");
  const Patch<2>& patch = body.patches.at(0);
  EXPECT_EQ(patch.basis().direction(0).knots(), (std::vector<double>{0, 0, 0, 0.5, 1, 1, 1}));
  EXPECT_EQ(patch.basis().direction(1).degree(), 2) << "raised to that of the body";
  EXPECT_LT((patch.position(Vector2d(1, 0)) - Vector2d(3, 0)).norm(), 1e-15);
  EXPECT_LT((patch.position(Vector2d(0, 1)) - Vector2d(0, 1)).norm(), 1e-15);
}

TEST(Revolution, OfARectangleIsARingWithItsVolume) {
  for (const double angle : {30.0, 90.0, 200.0, 330.0})
    EXPECT_NEAR(volume<3>(fmt::format("shape: revolution, profile: {}, angle: {}", kRectangle, angle)) /
                    (0.5 * kTurn * angle / 360.0 * 3.0),
                1.0, 1e-13)
        << angle;
}

TEST(Revolution, OfALineInThePlaneIsARingOnWhoseCirclesAllPointsLie) {
  const std::string ring =
      "shape: revolution, profile: {degrees: [1], points: [[4, 2], [5, 2]]}, center: [3, 2], angle: 250";
  EXPECT_NEAR(volume<2>(ring), kTurn / 2 * 3.0 * 250.0 / 360.0, 1e-13);
  const auto body = made<2>(ring);
  const Patch<2>& patch = body.patches.at(0);
  for (const double s : {0.0, 0.1, 0.37, 0.8, 1.0}) {
    EXPECT_NEAR((patch.position(Vector2d(0, s)) - Vector2d(3, 2)).norm(), 1.0, 1e-14);
    EXPECT_NEAR((patch.position(Vector2d(1, s)) - Vector2d(3, 2)).norm(), 2.0, 1e-14);
  }
}

TEST(Revolution, IsAlikeWhereTheAxisIsTurnedWithTheProfile) {
  const std::string other = "{degrees: [1, 1], points: [[0, 1, 0], [1, 1, 0], [0, 2, 0], [1, 2, 0]]}";
  EXPECT_NEAR(volume<3>("shape: revolution, profile: " + other + ", axis: [5, 0, 0], angle: 120"), kTurn / 2,
              1e-13);
}

TEST(Sweep, AlongALineIsAnExtrusionAndAlongAnArcARevolution) {
  const std::string square = "{degrees: [1, 1], points: [[-1, -1], [1, -1], [-1, 1], [1, 1]]}";
  EXPECT_NEAR(volume<3>("shape: sweep, profile: " + square +
                        ", path: {degrees: [2], points: [[0, 0, 0], [0, 0, 1], [0, 0, 5]]}"),
              20.0, 1e-13);
  const std::string arc =
      fmt::format("{{degrees: [2], points: [[1.5, 0], [1.5, 1.5], [0, 1.5]], weights: [1, {}, 1]}}", kHalf);
  const auto body = made<2>("shape: sweep, profile: {degrees: [1], points: [[1, 0], [2, 0]]}, path: " + arc);
  EXPECT_NEAR(SpanQuadrature<2>(body, 12).volume(), kTurn / 8 * 3.0, 1e-13);
  EXPECT_NEAR(body.patches.at(0).position(Vector2d(1, 0.3)).norm(), 2.0, 1e-14);
}

TEST(Sweep, AlongACurveKeepsItsSectionsWithinTheTolerance) {
  const std::string square =
      "{degrees: [1, 1], points: [[-0.1, -0.1], [0.1, -0.1], [-0.1, 0.1], [0.1, 0.1]]}";
  const std::string path =
      "{degrees: [3], points: [[0, 0, 0], [0, 0, 1], [1, 0.5, 2], [1, 1, 3], [2, 1, 3]]}";
  Net curve;
  curve.degrees = {3};
  curve.points = {{0, 0, 0}, {0, 0, 1}, {1, 0.5, 2}, {1, 1, 3}, {2, 1, 3}};
  const Patch<1, 3> line = curve.patch<1, 3>();
  for (const double tolerance : {1e-3, 1e-6}) {
    const auto body =
        made<3>(fmt::format("shape: sweep, profile: {}, path: {}, tolerance: {}", square, path, tolerance));
    const Patch<3>& patch = body.patches.at(0);
    for (int k = 0; k <= 100; ++k) {
      const double t = k / 100.0;
      const Eigen::Matrix<double, 1, 1> at(t);
      const Vector3d center = line.position(at), tangent = line.jacobian(at).normalized();
      for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1)}) {
        const Vector3d arm = patch.position({corner.x(), corner.y(), t}) - center;
        EXPECT_NEAR(arm.norm(), 0.1 * std::numbers::sqrt2, 2.0 * tolerance);
        EXPECT_NEAR(arm.dot(tangent), 0.0, 2.0 * tolerance) << "a section is normal to the path";
        const Vector3d turning = patch.jacobian({corner.x(), corner.y(), t}).col(2) - line.jacobian(at);
        EXPECT_NEAR(turning.dot(tangent.cross(arm)), 0.0, 100.0 * tolerance) << "and does not turn about it";
      }
    }
    // A section normal to the path whose middle is on it: the volume is area times length (Pappus).
    EXPECT_NEAR(SpanQuadrature<3>(body, 6).volume(), 0.04 * lengthOf(line), tolerance);
  }
}

TEST(Sweep, DoesNotTurnAboutItsPath) {
  // Rotation-minimising: where the path is plane the normal of its plane stays where it is.
  const auto body = made<3>(
      "shape: sweep, profile: {degrees: [1, 1], points: [[0, -1, -1], [0, 1, -1], [0, -1, 1], [0, 1, 1]]}, "
      "path: {degrees: [3], points: [[0, 0, 0], [4, 0, 0], [8, 0, 4], [12, 0, -9]]}, tolerance: 1e-7");
  for (const double t : {0.0, 0.33, 0.71, 1.0}) {
    const Patch<3>& patch = body.patches.at(0);
    const Vector3d across = patch.position({1, 0.5, t}) - patch.position({0, 0.5, t});
    EXPECT_LT((across - Vector3d(0, 2, 0)).norm(), 1e-6) << t;
  }
}

const std::string kLines =
    "bottom: {degrees: [1], points: [[0, 0], [3, 0]]}, right: {degrees: [1], points: [[3, 0], [4, 2]]}, ";

TEST(Coons, BetweenFourLinesIsTheBilinearQuadrilateral) {
  const auto body = made<2>(
      "shape: coons, " + kLines +
      "top: {degrees: [2], knots: [[0, 0, 0, 0.5, 1, 1, 1]], points: [[0, 1], [1, 1.25], [3, 1.75], [4, 2]]}, "
      "left: {degrees: [1], points: [[0, 0], [0, 1]]}, refine: [2, 3]");
  EXPECT_NEAR(SpanQuadrature<2>(body, 6).volume(), 0.5 * (3.0 * 2.0 + 4.0 * 1.0 - 0.0), 1e-13)
      << "shoelace formula";
  EXPECT_LT((body.patches.at(0).position(Vector2d(0.5, 0.5)) - Vector2d(1.75, 0.75)).norm(), 1e-14);
}

TEST(Coons, WithAnArcHasTheAreaBelowItAndTheArcOnItsFace) {
  const auto body = made<2>(fmt::format(
      "shape: coons, bottom: {{degrees: [1], points: [[-1, -1], [1, -1]]}}, "
      "right: {{degrees: [1], points: [[1, -1], [1, 0]]}}, left: {{degrees: [1], points: [[-1, -1], [-1, 0]]}}, "
      "top: {{degrees: [2], knots: [[3, 3, 3, 4, 4, 5, 5, 5]], points: [[-1, 0], [-1, 1], [0, 1], [1, 1], [1, 0]], "
      "weights: [1, {0}, 1, {0}, 1]}}",
      kHalf));
  EXPECT_NEAR(SpanQuadrature<2>(body, 20).volume(), 2.0 + kTurn / 4, 1e-12);
  for (const double s : {0.1, 0.45, 0.9})
    EXPECT_NEAR(body.patches.at(0).position(Vector2d(s, 1)).norm(), 1.0, 1e-14);
}

TEST(MadeBodies, SayWhereTheirCurvesDoNotFit) {
  const std::string open = refusalOf(
      "shape: coons, " + kLines +
      "top: {degrees: [1], points: [[0, 1], [4, 2.5]]}, left: {degrees: [1], points: [[0, 0], [0, 1]]}");
  EXPECT_THAT(
      open, HasSubstr("geometry.top: found a curve that ends at (4, 2.5), 0.5 from (4, 2), where right ends; "
                      "allowed: curves that meet in the corner of right and top."));
  EXPECT_THAT(
      refusalOf("shape: extrusion, profile: {degrees: [2], points: [[0, 0], [1, 0]]}, vector: [0, 1]"),
      HasSubstr("geometry.profile.points: found 2 points; allowed for degree 2: at least 3."));
  EXPECT_THAT(
      refusalOf("shape: extrusion, profile: {degrees: [1], points: [[0, 0], [1, 0]]}, vector: [0, 0, 1]"),
      HasSubstr("geometry.vector: found a list of 3; allowed: a list of 2"));
  EXPECT_THAT(
      refusalOf(
          "shape: extrusion, profile: {degrees: [1], points: [[0, 0], [1, 0]]}, vector: [0, 1], spans: [2, 2]"),
      HasSubstr("geometry.spans: found spans, but an extrusion brings its own knots; allowed: refine."));
  EXPECT_THAT(
      refusalOf("shape: revolution, profile: {points: [[0, 0], [1, 0]]}, angle: 90"),
      HasSubstr(
          "geometry.profile.degrees: missing; required: degrees and points, or a file that holds them."));
  EXPECT_THAT(
      refusalOf(
          "shape: revolution, profile: {degrees: [1], points: [[1, 0], [2, 0]]}, axis: [1, 0, 0], angle: 90"),
      HasSubstr("geometry.axis: found an axis in the plane; allowed in two dimensions: [0, 0, 1]."));
  EXPECT_THAT(
      refusalOf(
          "shape: sweep, profile: {degrees: [1], points: [[1, 0], [2, 0]]}, path: {degrees: [1], points: [[0, 0], [0, 1], [1, 1]]}"),
      HasSubstr("geometry: the path has a corner at its parameter 0.5; allowed: a smooth path"));
  EXPECT_THAT(
      refusalOf(
          "shape: coons, " + kLines +
          "top: {degrees: [1], points: [[0, 1], [4, 2]]}, left: {degrees: [1, 1], points: [[0, 0], [0, 1], [1, 0], [1, 1]]}"),
      HasSubstr("geometry.left.degrees: found a face; allowed: a curve, of one degree."));
}

}  // namespace
}  // namespace burnish
