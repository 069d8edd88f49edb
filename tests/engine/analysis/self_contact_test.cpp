#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/analysis/run_scene.h"
#include "tests/message_of.h"

/// Bodies whose face touches itself.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::bytes;
using test::ScratchDirectory;

/// A hairpin whose legs are squeezed until they touch. basis: lines of the scene; refine: parts of a knot
/// span.
std::string hairpin(const std::string& basis, int refine) {
  return basis + fmt::format(R"(
geometry:
  shape: control-net
  degrees: [2, 1]
  knots: [[0, 0, 0, 1, 2, 3, 4, 4, 4], [0, 0, 1, 1]]
  points:
    - [2, 0.4]
    - [0.5, 0.4]
    - [-0.5, 0.4]
    - [-0.5, -0.4]
    - [0.5, -0.4]
    - [2, -0.4]
    - [2, 0.1]
    - [0.6, 0.1]
    - [-0.05, 0.1]
    - [-0.05, -0.1]
    - [0.6, -0.1]
    - [2, -0.1]
  refine: [{}, 4]
material: {{law: neo-hookean, E: 1000, nu: 0.3}}
output: {{vtu: false}}
)",
                             refine);
}

/// gaps: further keys of the contact.
std::string squeezed(const std::string& basis, int refine, const std::string& gaps) {
  return hairpin(basis, refine) + fmt::format(R"(
supports:
  - {{face: left, fix: [x]}}
  - {{face: right, fix: [x]}}
  - {{face: bottom, part: [0, 0.2], move: {{times: [0, 1], y: [0, -0.12]}}}}
  - {{face: bottom, part: [0.8, 1], move: {{times: [0, 1], y: [0, 0.12]}}}}
self_contact: [{{face: top{}}}]
steps: [{{until: 1, count: 10}}]
)",
                                              gaps);
}

/// The upper half of the same on a plane of symmetry, which its leg touches as a rigid tool.
std::string half(const std::string& basis, int refine, const std::string& gaps) {
  return basis + fmt::format(R"(
geometry:
  shape: control-net
  degrees: [2, 1]
  knots: [[0, 0, 0, 1, 2, 2, 2], [0, 0, 1, 1]]
  points: [[2, 0.4], [0.5, 0.4], [-0.5, 0.4], [-0.5, 0], [2, 0.1], [0.6, 0.1], [-0.05, 0.1], [-0.05, 0]]
  refine: [{}, 4]
material: {{law: neo-hookean, E: 1000, nu: 0.3}}
supports:
  - {{face: left, fix: [x]}}
  - {{face: right, fix: [y]}}
  - {{face: bottom, part: [0, 0.4], move: {{times: [0, 1], y: [0, -0.12]}}}}
tools: [{{name: plane, shape: plane, origin: [0, 0], normal: [0, 1]}}]
contact: [{{tool: plane, face: top{}}}]
steps: [{{until: 1, count: 10}}]
output: {{vtu: false}}
)",
                             refine,
                             gaps.find("method:") == std::string::npos
                                 ? ", method: augmented-lagrangian" + gaps
                                 : gaps);
}

/// A roller that presses one leg on the other and moves along it. keys: further ones of the contact of the
/// legs.
std::string rolled(const std::string& options, int refine, const std::string& keys = {}) {
  return hairpin(options, refine) + fmt::format(R"(
supports:
  - {{face: right, fix: [x, y]}}
  - {{face: left, fix: [x]}}
tools:
  - name: roller
    shape: cylinder
    center: [1, 0.9]
    radius: 0.5
    motion: {{times: [0, 1, 2], x: [0, 0, 0.3], y: [0, -0.25, -0.25]}}
contact: [{{tool: roller, face: bottom, method: augmented-lagrangian}}]
self_contact: [{{face: top{}}}]
steps: [{{until: 1, count: 5}}, {{until: 2, count: 5}}]
)",
                                                keys);
}

/// The legs squeezed as in `squeezed` by degree 2, in space: a unit wide and held so that they stay as wide.
std::string wide(int refine) {
  return fmt::format(R"(
degree: 2
geometry:
  shape: control-net
  degrees: [2, 1, 1]
  knots: [[0, 0, 0, 1, 2, 3, 4, 4, 4], [0, 0, 1, 1], [0, 0, 1, 1]]
  points:
{}  refine: [{}, 4, 1]
material: {{law: neo-hookean, E: 1000, nu: 0.3}}
supports:
  - {{face: back, fix: [z]}}
  - {{face: front, fix: [z]}}
  - {{face: left, fix: [x]}}
  - {{face: right, fix: [x]}}
  - {{face: bottom, part: [0, 0.2, 0, 1], move: {{times: [0, 1], y: [0, -0.12]}}}}
  - {{face: bottom, part: [0.8, 1, 0, 1], move: {{times: [0, 1], y: [0, 0.12]}}}}
self_contact: [{{face: top}}]
steps: [{{until: 1, count: 10}}]
output: {{vtu: false}}
)",
                     [] {
                       constexpr double kNet[12][2]{{2, 0.4},     {0.5, 0.4},    {-0.5, 0.4}, {-0.5, -0.4},
                                                    {0.5, -0.4},  {2, -0.4},     {2, 0.1},    {0.6, 0.1},
                                                    {-0.05, 0.1}, {-0.05, -0.1}, {0.6, -0.1}, {2, -0.1}};
                       std::string lines;
                       for (const int z : {0, 1})
                         for (const auto& [x, y] : kNet)
                           lines += fmt::format("    - [{}, {}, {}]\n", x, y, z);
                       return lines;
                     }(),
                     refine);
}

/// A ring with a slit, of which one end is moved against the other and then along it. contact: lines of it;
/// steps: of either phase.
std::string slitRing(const std::string& contact, int steps = 8) {
  std::string points;
  // The first end is narrower than the last one, so that it does not reach over it.
  for (const bool inner : {false, true})
    for (int k = 0; k <= 12; ++k) {
      const double angle = 0.1 + (2.0 * std::numbers::pi - 0.2) * k / 12.0;
      const double share = k / 12.0, radius = inner ? 0.78 - 0.1 * share : 0.92 + 0.08 * share;
      const double shift =
          k == 0 || k == 12 ? 0.1 - radius * std::abs(std::sin(angle)) : 0.0;  // parallel ends
      points += fmt::format("    - [{}, {}]\n", radius * std::cos(angle),
                            radius * std::sin(angle) + (k == 0 ? shift : -shift));
    }
  return fmt::format(R"(
degree: 2
geometry:
  shape: control-net
  degrees: [2, 1]
  knots: [[0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 11, 11], [0, 0, 1, 1]]
  points:
{0}  refine: [2, 6]
material: {{law: neo-hookean, E: 1000, nu: 0.3}}
supports:
  - {{face: bottom, part: [0.85, 1], fix: [x, y]}}
  - {{face: bottom, part: [0, 0.15], move: {{times: [0, 1, 2], x: [0, 0, 0.04], y: [0, -0.22, -0.22]}}}}
{1}
steps: [{{until: 1, count: {2}}}, {{until: 2, count: {2}}}]
output: {{vtu: false}}
)",
                     points, contact, steps);
}

const std::string kRezoning = "rezoning: {travel: 0.12, growth: 0.02}";

test::Outcome outcomeOf(const std::string& scene) {
  return test::run(parseScene(scene, "test.yaml"), "self_contact");
}

double last(const test::Outcome& outcome, const std::string& column) {
  return outcome.history.column(column).back();
}

struct Legs {
  std::string name, options;
  double forces = 2e-4;                    ///< how well they agree
  std::string gaps = {}, gapsOfHalf = {};  ///< further keys of the contact
};

class SelfContactRuns : public testing::TestWithParam<Legs> {};

// By symmetry each leg meets the other one as if it were a plane.
TEST_P(SelfContactRuns, TwoLegsTouchEachOtherAsOneTouchesAPlane) {
  const Legs& legs = GetParam();
  const test::Outcome whole = outcomeOf(squeezed(legs.options, 10, legs.gaps)),
                      part = outcomeOf(half(legs.options, 10, legs.gapsOfHalf));
  ASSERT_TRUE(whole.summary.completed) << whole.summary.stoppedBecause;
  ASSERT_TRUE(part.summary.completed) << part.summary.stoppedBecause;
  EXPECT_GE(last(whole, "self_active_control_points"), 5.0);
  EXPECT_NEAR(last(whole, "self_contact_force") / -last(part, "plane.fy"), 1.0, legs.forces);
  EXPECT_NEAR(last(whole, "strain_energy") / (2.0 * last(part, "strain_energy")), 1.0, 2e-4);
  EXPECT_LT(last(whole, "max_self_penetration"), 4e-3);  // between two points, of spans of 0.1 to 0.2
  EXPECT_TRUE(whole.summary.doubts.empty());

  const ContactRecord& pressed = part.lastFrame.contact.at(0);
  const ContactRecord& slave = whole.lastFrame.contact.at(0);
  EXPECT_EQ(slave.tool, "");
  EXPECT_EQ(slave.face, "top");
  const Eigen::Index n = pressed.quadraturePressure.size();  // the upper leg comes first
  ASSERT_EQ(slave.quadraturePressure.size(), 2 * n);
  const double highest = pressed.quadraturePressure.maxCoeff();
  EXPECT_LT((slave.quadraturePressure.head(n) - pressed.quadraturePressure).cwiseAbs().maxCoeff(),
            0.02 * highest);
  EXPECT_EQ(slave.quadraturePressure.tail(n).maxCoeff(), 0.0) << "the lower leg carries none";
  for (Eigen::Index q = 0; q < n; ++q)
    if (slave.quadraturePressure(q) > 0.0) {
      EXPECT_GT(slave.quadratureNormal(1, q), 0.9) << "upwards";
    }
}

std::string nameOf(const testing::TestParamInfo<Legs>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Bases, SelfContactRuns,
                         testing::Values(Legs{"Nurbs2", "degree: 2"}, Legs{"Nurbs3", "degree: 3"},
                                         Legs{"Lagrange2", "degree: 2\nbasis: lagrange"},
                                         Legs{"Projected", "degree: 2\nformulation: fbar"},
                                         // Legs that close alike do not slip.
                                         Legs{"Friction", "degree: 2", 2e-4, ", friction: 0.3"},
                                         // Gaps between the legs are twice those to the plane.
                                         Legs{"LimitedGaps", "degree: 2", 5e-5, ", gap_limit: 0.04",
                                              ", gap_limit: 0.02"},
                                         Legs{"AtPoints", "degree: 2", 2e-4,
                                              ", method: integral-augmented-lagrangian, parameter: 5000",
                                              ", method: integral-augmented-lagrangian, parameter: 10000"}),
                         nameOf);

// Slaves slide over the corners between elements.
TEST(SelfContactOfElements, PassesTheirCorners) {
  const test::Outcome smooth = outcomeOf(rolled("degree: 2", 40));
  for (const char* basis : {"degree: 1", "degree: 2\nbasis: lagrange"}) {
    const test::Outcome outcome = outcomeOf(rolled(basis, 40));
    ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
    EXPECT_NEAR(last(outcome, "self_contact_force") / last(smooth, "self_contact_force"), 1.0, 0.15) << basis;
  }
}

TEST(SelfContactAcrossMeshes, ForceIsThatOfOneFineMesh) {
  const test::Outcome rezoned = outcomeOf(rolled("degree: 2\n" + kRezoning, 24)),
                      fixed = outcomeOf(rolled("degree: 2", 80));
  ASSERT_TRUE(rezoned.summary.completed) << rezoned.summary.stoppedBecause;
  ASSERT_TRUE(fixed.summary.completed) << fixed.summary.stoppedBecause;
  EXPECT_GE(rezoned.summary.rezonings.size(), 3u);
  EXPECT_GT(last(fixed, "self_contact_force"), 2.0);
  EXPECT_NEAR(last(rezoned, "self_contact_force") / last(fixed, "self_contact_force"), 1.0, 0.01);
  EXPECT_NEAR(last(rezoned, "roller.fy") / last(fixed, "roller.fy"), 1.0, 0.01);
  EXPECT_EQ(last(rezoned, "crosses_itself"), 0.0);
}

TEST(SelfContactAcrossMeshes, FrictionIsThatOfOneFineMesh) {
  const test::Outcome rezoned = outcomeOf(rolled("degree: 2\n" + kRezoning, 16, ", friction: 0.3")),
                      fixed = outcomeOf(rolled("degree: 2", 40, ", friction: 0.3"));
  ASSERT_TRUE(rezoned.summary.completed) << rezoned.summary.stoppedBecause;
  ASSERT_TRUE(fixed.summary.completed) << fixed.summary.stoppedBecause;
  EXPECT_GE(rezoned.summary.rezonings.size(), 3u);
  EXPECT_GT(last(fixed, "self_contact.slipping"), 3.0);
  for (const char* column : {"self_contact_force", "self_contact.friction", "roller.fy"})
    EXPECT_NEAR(last(rezoned, column) / last(fixed, column), 1.0, 0.02) << column;
}

// The slab's end is held, and control points share multipliers there.
TEST(SelfContactAcrossMeshes, AtPointsWhereASupportHoldsAnEnd) {
  const std::string atPoints = ", method: integral-augmented-lagrangian";
  const test::Outcome rezoned = outcomeOf(rolled("degree: 2\n" + kRezoning, 16, atPoints)),
                      fixed = outcomeOf(rolled("degree: 2", 40, atPoints));
  ASSERT_TRUE(rezoned.summary.completed) << rezoned.summary.stoppedBecause;
  ASSERT_TRUE(fixed.summary.completed) << fixed.summary.stoppedBecause;
  EXPECT_GE(rezoned.summary.rezonings.size(), 3u);
  EXPECT_EQ(rezoned.summary.failedRezonings, 0) << rezoned.summary.rezoningFailure;
  for (const char* column : {"self_contact_force", "roller.fy"})
    EXPECT_NEAR(last(rezoned, column) / last(fixed, column), 1.0, 0.02) << column;
}

class SelfContactResumed : public testing::TestWithParam<const char*> {};

TEST_P(SelfContactResumed, HasTheSameBits) {
  const std::string scene = rolled("degree: 2\n" + kRezoning, 12, GetParam());
  const ScratchDirectory whole("self_whole"), part("self_part");
  RunObserver silent;
  const RunSummary summary = runScene(parseScene(scene, "test.yaml"), whole.path(), {}, silent);
  ASSERT_TRUE(summary.completed) << summary.stoppedBecause;
  const auto afterEachStep = [] {
    return RunOptions{.threads = 1, .halt = [taken = 0]() mutable { return ++taken >= 1; }};
  };
  RunSummary resumed = runScene(parseScene(scene, "test.yaml"), part.path(), afterEachStep(), silent);
  while (resumed.halted)
    resumed = resumeRun(readResultScene(part.path()), part.path(), afterEachStep(), silent);
  ASSERT_TRUE(resumed.completed) << resumed.stoppedBecause;
  EXPECT_EQ(bytes(whole.path() / "history.csv"), bytes(part.path() / "history.csv"));
}

INSTANTIATE_TEST_SUITE_P(Friction, SelfContactResumed, testing::Values("", ", friction: 0.3"));

// What the ends lose by rubbing is what is missing of the work done.
TEST(SelfContactWithFriction, BalancesWorkAndRubbing) {
  const test::Outcome outcome =
      outcomeOf(slitRing("self_contact: [{faces: [left, right], friction: 0.3, reach: 0.3}]", 80));
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  const double work = last(outcome, "external_work"), rubbing = last(outcome, "friction_work");
  EXPECT_GT(last(outcome, "self_contact.slipping"), 3.0);
  EXPECT_GT(rubbing, 0.02 * work);
  EXPECT_EQ(rubbing, last(outcome, "self_contact.friction_work"));
  EXPECT_NEAR(last(outcome, "strain_energy") + rubbing, work, 5e-3 * work);
}

// A pair of two faces of a body, in which one is the slave, is the contact of both as one surface.
TEST(SelfContactOfFaces, IsContactOfOneWithTheOther) {
  const test::Outcome
      one = outcomeOf(slitRing("self_contact: [{faces: [left, right], friction: 0.3, reach: 0.3}]")),
      pair = outcomeOf(slitRing(
          "contact: [{face: left, against: {face: right}, friction: 0.3, reach: 0.3, method: augmented-lagrangian}]"));
  ASSERT_TRUE(one.summary.completed) << one.summary.stoppedBecause;
  ASSERT_TRUE(pair.summary.completed) << pair.summary.stoppedBecause;
  EXPECT_GT(last(one, "self_contact.slipping"), 3.0);
  for (const char* column : {"strain_energy", "external_work", "friction_work"})
    EXPECT_NEAR(last(one, column) / last(pair, column), 1.0, 1e-8) << column;
  EXPECT_NEAR(last(one, "self_contact.friction") / last(pair, "left-right.friction"), 1.0, 1e-8);
}

TEST(SelfContactInSpace, IsThatOfThePlaneInAStripThatStaysAsWide) {
  const test::Outcome strip = outcomeOf(wide(8)), plane = outcomeOf(squeezed("degree: 2", 8, ""));
  ASSERT_TRUE(strip.summary.completed) << strip.summary.stoppedBecause;
  EXPECT_GT(last(plane, "self_contact_force"), 1.0);
  for (const char* column : {"strain_energy", "external_work", "self_contact_force", "max_self_penetration"})
    EXPECT_NEAR(last(strip, column) / last(plane, column), 1.0, 1e-8) << column;
}

}  // namespace
}  // namespace burnish
