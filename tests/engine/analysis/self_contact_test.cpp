#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/engine/analysis/run_scene.h"

/// Bodies whose face touches itself.
namespace burnish {
namespace {

namespace fs = std::filesystem;
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
                             refine, gaps);
}

/// A roller that presses one leg on the other and moves along it.
std::string rolled(const std::string& options, int refine) {
  return hairpin(options, refine) + R"(
supports:
  - {face: right, fix: [x, y]}
  - {face: left, fix: [x]}
tools:
  - name: roller
    shape: cylinder
    center: [1, 0.9]
    radius: 0.5
    motion: {times: [0, 1, 2], x: [0, 0, 0.3], y: [0, -0.25, -0.25]}
contact: [{tool: roller, face: bottom}]
self_contact: [{face: top}]
steps: [{until: 1, count: 5}, {until: 2, count: 5}]
)";
}

const std::string kRezoning = "rezoning: {travel: 0.12, growth: 0.02}";

test::Outcome outcomeOf(const std::string& scene) {
  return test::run(parseScene(scene, "test.yaml"), "self_contact");
}

double last(const test::Outcome& outcome, const std::string& column) {
  return outcome.history.column(column).back();
}

std::string bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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
                                         // Gaps between the legs are twice those to the plane.
                                         Legs{"LimitedGaps", "degree: 2", 5e-5, ", gap_limit: 0.04",
                                              ", gap_limit: 0.02"}),
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

TEST(SelfContactAcrossMeshes, ResumeWithTheSameBits) {
  const std::string scene = rolled("degree: 2\n" + kRezoning, 12);
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

}  // namespace
}  // namespace burnish
