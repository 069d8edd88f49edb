#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/analysis/followed_surface.h"
#include "engine/core/error.h"
#include "engine/nurbs/shapes.h"
#include "engine/scene/path_of_tool.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Tools that carry a force along the normal of the face that they follow.
namespace burnish::following_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using samples::replaced;
using test::Outcome;
using testing::HasSubstr;
using Strings = std::vector<std::string>;

constexpr double kDegree = std::numbers::pi / 180.0;

Vector3d columnsOf(const HistoryTable& history, const std::string& prefix, std::size_t row) {
  const auto value = [&](const char* axis) {
    const std::vector<double>* column = findColumn(history, prefix + axis);
    return column != nullptr ? (*column)[row] : 0.0;
  };
  return {value("x"), value("y"), value("z")};
}

// ---- in the plane

/// An elastic slab that a roller is drawn along, pressed on by a force and free to turn.
const std::string kFlat = R"(
geometry: {shape: rectangle, size: [2.0, 0.5], spans: [24, 4], grading: [s, "1 - (1-s)^1.5"]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - name: roller
    shape: cylinder
    center: [0.6, 1.05]
    radius: 0.5
    carry: {normal: -0.5, moment: 0, schedule: {times: [0, 1], values: [0, 1]}}
    path: {course: polyline, points: [[0, 0], [0.5, 0]], speed: 0.5, begin: 1}
contact: [{tool: roller, face: top, friction: 0.5}]
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 2}, {until: 2, count: 6}]
output: {vtu: false}
)";

Outcome ranFlat(const std::string& name, const std::string& carry, const Strings& overrides = {}) {
  return test::run(parseScene(replaced(kFlat, "normal: -0.5", carry), "test.yaml", overrides),
                   "following_" + name);
}

void expectSame(const Outcome& a, const Outcome& b, const Strings& columns) {
  ASSERT_TRUE(a.summary.completed) << a.summary.stoppedBecause;
  ASSERT_TRUE(b.summary.completed) << b.summary.stoppedBecause;
  ASSERT_EQ(a.history.numRows(), b.history.numRows());
  for (const std::string& column : columns)
    for (std::size_t k = 0; k < a.history.numRows(); ++k)
      EXPECT_NEAR(a.history.column(column)[k], b.history.column(column)[k], 2e-12)
          << column << " in row " << k;
  EXPECT_LT((a.lastFrame.displacement - b.lastFrame.displacement).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(FollowingTool, OnAFlatFaceIsThatWithAForceOfOneDirection) {
  expectSame(ranFlat("flat", "normal: -0.5"), ranFlat("fixed", "y: -0.5"),
             {"roller.ux", "roller.uy", "roller.fx", "roller.fy", "roller.angle", "roller.friction_work",
              "external_work"});
}

TEST(FollowingTool, OnAFlatFaceIsLiftedAsThatWithAForceOfOneDirection) {
  const Strings path{
      "tools[0].path={course: raster, start: [0, -0.09], stroke: [0.2, 0], passes: 2, speed: 0.6, clearance: [0, 0.05], "
      "ramp: 0.05}",
      "tools[0].carry.schedule={times: [0], values: [1]}", "steps=[{until: 1.5, count: 20}]"};
  const Outcome follows = ranFlat("lifted", "normal: -0.5", path);
  expectSame(follows, ranFlat("lifted_fixed", "y: -0.5", path),
             {"roller.ux", "roller.uy", "roller.fx", "roller.fy"});
  const auto& force = follows.history.column("roller.fn");
  EXPECT_NEAR(*std::ranges::max_element(force), 0.5, 1e-8 * 0.5);
  EXPECT_EQ(force.back(), 0.0);
}

/// A sector of a shaft of the radius 1, held inside, along which a roller of the radius 0.4 is led on chords.
struct Shaft {
  double turn = 0.0;  ///< of everything about the middle, degrees

  static constexpr double kForce = 0.4, kRoller = 0.4, kAway = 0.01;

  Vector2d at(double degrees) const {
    const double angle = (degrees + turn) * kDegree;
    return (1.0 + kRoller + kAway) * Vector2d(std::cos(angle), std::sin(angle));
  }

  std::string scene(const std::string& carry = "normal: -0.4, moment: 0") const {
    Strings points;
    for (int k = 0; k <= 4; ++k) {
      const Vector2d way = at(75.0 + 7.5 * k) - at(75.0);
      points.push_back(fmt::format("[{:.17g}, {:.17g}]", way.x(), way.y()));
    }
    return fmt::format(R"(
geometry: {{shape: annulus, inner_radius: 0.6, outer_radius: 1, start_angle: {}, opening_angle: 80, spans: [4, 20]}}
material: {{law: neo-hookean, E: 100, nu: 0.3}}
supports: [{{face: left, fix: [x, y]}}]
tools:
  - name: roller
    shape: cylinder
    center: [{:.17g}, {:.17g}]
    radius: {}
    carry: {{{}, schedule: {{times: [0, 1], values: [0, 1]}}}}
    path: {{course: polyline, points: [{}], speed: 0.74, begin: 1}}
contact: [{{tool: roller, face: right, friction: 0.5}}]
solver: {{tolerance: 1e-11}}
steps: [{{until: 1, count: 2}}, {{until: 2, count: 10}}]
output: {{vtu: false}}
)",
                       50.0 + turn, at(75.0).x(), at(75.0).y(), kRoller, carry, fmt::join(points, ", "));
  }

  Outcome ran(const std::string& name, const Strings& overrides = {}) const {
    return test::run(parseScene(scene(), "test.yaml", overrides), "following_" + name);
  }
};

TEST(FollowingTool, KeepsItsForceAlongTheNormalOfACurvedFace) {
  const Shaft shaft;
  const Outcome ran = shaft.ran("shaft");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto& history = ran.history;
  double turned = 0.0;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    // On its way along the normal the roller stays on the line through the middle of the shaft.
    const Vector3d place =
        Vector3d(shaft.at(75.0).x(), shaft.at(75.0).y(), 0.0) + columnsOf(history, "roller.u", k);
    const Vector3d normal = place.normalized(), force = columnsOf(history, "roller.f", k);
    const double set = Shaft::kForce * std::min(1.0, history.column("time")[k]);
    EXPECT_NEAR(force.dot(normal), set, 1e-8 * Shaft::kForce) << k;
    EXPECT_NEAR(history.column("roller.fn")[k], set, 1e-8 * Shaft::kForce) << k;
    EXPECT_LT(std::abs(history.column("roller.mz")[k]), 1e-10) << k;
    EXPECT_LT(history.column("roller.un")[k], 0.0) << k;
    turned = std::acos(normal.y());
  }
  EXPECT_NEAR(turned, 15.0 * kDegree, 0.2 * kDegree);
}

TEST(FollowingTool, TurnsWithItsBody) {
  const Outcome ran = Shaft{}.ran("upright"), turned = Shaft{.turn = -127.0}.ran("turned");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  ASSERT_TRUE(turned.summary.completed) << turned.summary.stoppedBecause;
  const Eigen::AngleAxisd R(-127.0 * kDegree, Vector3d::UnitZ());
  for (std::size_t k = 1; k < ran.history.numRows(); ++k) {
    for (const char* column : {"roller.f", "roller.u"}) {
      const Vector3d expected = R * columnsOf(ran.history, column, k);
      EXPECT_LT((columnsOf(turned.history, column, k) - expected).norm(), 1e-9 * expected.norm())
          << column << k;
    }
    EXPECT_NEAR(turned.history.column("roller.angle")[k], ran.history.column("roller.angle")[k], 1e-8) << k;
  }
}

/// An elastic body stores the work of the tool, and led round it the tool does none, although its force turns.
TEST(FollowingTool, WorksAsMuchAsItsBodyStores) {
  constexpr std::size_t kLoading = 32;
  const Outcome ran =
      Shaft{}.ran("work", {"contact[0].friction=null", "tools[0].carry.moment=null", "geometry.spans=[4, 60]",
                           fmt::format("steps[0].count={}", kLoading), "steps[1].count=32"});
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto &work = ran.history.column("external_work"), &energy = ran.history.column("strain_energy");
  EXPECT_NEAR(work.back() / energy.back(), 1.0, 2e-3);
  EXPECT_NEAR(work.back() / work[kLoading], 1.0, 2e-4);
}

// ---- in space

/// A sector of a tube along which a ball goes round on a helix: it comes down, is pressed on with a force that comes
/// and goes, and is lifted off. In the axes of another frame: x' = R x with R a rotation that takes z to x, x to y.
std::string helix(bool otherAxes = false) {
  const double deep = 1.0 + 0.3 - 0.08, begin = 80.0 * kDegree;
  const auto vector = [&](double x, double y, double z) {
    return otherAxes ? fmt::format("[{:.17g}, {:.17g}, {:.17g}]", z, x, y)
                     : fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x, y, z);
  };
  const double c = std::cos(begin), s = std::sin(begin);
  return fmt::format(R"(
degree: 2
geometry: {{shape: tube, axis: {}, inner_radius: 0.7, outer_radius: 1, length: 0.8, start_angle: 60, opening_angle: 60, spans: [2, 8, 5]}}
material: {{law: neo-hookean, E: 100, nu: 0.3}}
supports: [{{face: left, fix: [x, y, z]}}]
tools:
  - name: ball
    shape: sphere
    center: {}
    radius: 0.3
    carry: {{normal: -0.2, spin: true}}
    path: {{course: helix, center: [0, 0, 0], axis: {}, pitch: 2, turns: 0.05, speed: 0.5, clearance: {}, ramp: 0.1}}
contact: [{{tool: ball, face: right, friction: 0.3}}]
solver: {{tolerance: 1e-11}}
steps: [{{until: 1.4, count: 20}}]
output: {{vtu: false}}
)",
                     vector(0, 0, 1), vector(deep * c, deep * s, 0.35), vector(0, 0, 1),
                     vector(0.12 * c, 0.12 * s, 0.0));
}

Outcome ranHelix(const std::string& name, bool otherAxes = false) {
  return test::run(parseScene(helix(otherAxes), "test.yaml"), "following_" + name);
}

TEST(FollowingTool, GoesRoundOnAHelixAndIsLifted) {
  const Outcome ran = ranHelix("helix");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto& history = ran.history;
  const ToolPath path = pathOf(parseScene(helix(), "test.yaml").tools[0]);
  const ToolPath::Pass touch = path.touches().front();
  int full = 0, lifted = 0;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    const double t = history.column("time")[k], force = history.column("ball.fn")[k];
    for (const char* moment : {"ball.mx", "ball.my", "ball.mz"})
      EXPECT_LT(std::abs(history.column(moment)[k]), 1e-10) << moment << " at " << t;
    if (t > touch.begin + 1e-9 && t < touch.end - 1e-9) {
      EXPECT_NEAR(force, 0.2 * path.forceShare(t), 1e-8 * 0.2) << t;
      full += path.hasFullForce(t) ? 1 : 0;
    }
    const Vector3d f = columnsOf(history, "ball.f", k);
    if (t >= path.end()) {
      ++lifted;
      EXPECT_EQ(f.norm(), 0.0) << t;
    }
  }
  EXPECT_GE(full, 3);
  EXPECT_GE(lifted, 2);
}

TEST(FollowingTool, TurnsWithItsBodyInSpace) {
  const Outcome ran = ranHelix("axes"), turned = ranHelix("other_axes", true);
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  ASSERT_TRUE(turned.summary.completed) << turned.summary.stoppedBecause;
  for (std::size_t k = 1; k < ran.history.numRows(); ++k) {
    const Vector3d f = columnsOf(ran.history, "ball.f", k), expected(f.z(), f.x(), f.y());
    EXPECT_LT((columnsOf(turned.history, "ball.f", k) - expected).norm(), 1e-9 * 0.2) << k;
  }
}

TEST(FollowingTool, GoesOnWithTheSameBitsWhenHaltedAfterEveryStep) {
  const Scene scene = parseScene(Shaft{}.scene(), "test.yaml", {"steps[1].count=4"});
  const test::HaltedHistory found = test::haltedAfterEveryStep(scene, "following");
  EXPECT_GE(found.halts, 4);
  EXPECT_EQ(found.halted, found.whole);
}

// ---- the surface

TEST(FollowedSurface, HasTheNormalsOfACircle) {
  const Body<2> body = makeBody(annulus({0.2, 0.1}, 1.0, 2.0, 0.3, 1.5));
  const FollowedSurface<2> outside(body, {{0, faceFromName<2>("right")}}),
      inside(body, {{0, faceFromName<2>("left")}});
  for (const double angle : {0.4, 0.9, 1.7})
    for (const double distance : {0.0, 0.1, 3.0}) {
      const Vector3d normal(std::cos(angle), std::sin(angle), 0.0), middle(0.2, 0.1, 0.0);
      EXPECT_LT((outside.normalNextTo(middle + (2.0 + distance) * normal) - normal).norm(), 1e-14)
          << distance;
      EXPECT_LT((inside.normalNextTo(middle + (1.0 - 0.3 * distance) * normal) + normal).norm(), 1e-14)
          << distance;
    }
}

TEST(FollowedSurface, TurnsSteadilyRoundAnEdge) {
  const Body<2> body = makeBody(rectangle({0.0, 0.0}, {1.0, 1.0}));
  const FollowedSurface<2> surface(body, {{0, faceFromName<2>("top")}, {0, faceFromName<2>("right")}});
  for (const double angle : {0.1, 0.7, 1.5}) {
    const Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_LT((surface.normalNextTo(Vector3d(1.0, 1.0, 0.0) + 0.3 * normal) - normal).norm(), 1e-14) << angle;
  }
  EXPECT_EQ(surface.normalNextTo({0.4, 1.2, 0.0}), Vector3d::UnitY());
}

// ---- what is refused

std::string errorOf(const std::string& scene, const Strings& overrides) {
  try {
    test::run(parseScene(scene, "test.yaml", overrides), "following_refused");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FollowingTool, RefusesWhatContradictsIt) {
  EXPECT_THAT(errorOf(kFlat, {"tools[0].carry.y=-1"}),
              HasSubstr("tools[0].carry.normal: found beside y; allowed: normal alone, or x, y and z"));
  EXPECT_THAT(
      errorOf(kFlat, {"kinematics=axisymmetric"}),
      HasSubstr("tools[0].carry.normal: found in axisymmetry, where tools move along the axis; allowed: y"));
  EXPECT_THAT(errorOf(kFlat, {"tools[0].carry.normal=0.5"}), HasSubstr("does not meet its face"));
  EXPECT_THAT(
      errorOf(helix(), {"tools[0].carry={z: -1}", "tools[0].path.ramp=0"}),
      HasSubstr("tools[0].carry.z: found although the helix moves the tool in this way; allowed: normal"));
  EXPECT_THAT(
      errorOf(helix(), {"tools[0].path.clearance=[0, 0, 0.1]", "tools[0].center=[0.2, 1.4, 0.35]"}),
      HasSubstr("tools[0].path.clearance: found one that does not lead away from the face at t = 0.2"));
  EXPECT_THAT(
      errorOf(helix(), {"tools[0].carry.normal=0.2"}),
      HasSubstr("tools[0].carry.normal: found 0.01 at t = 0, a force along clearance that lifts the tool"));
}

}  // namespace
}  // namespace burnish::following_test
