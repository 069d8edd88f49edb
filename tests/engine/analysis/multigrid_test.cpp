#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <string>

#include "engine/core/error.h"
#include "engine/solver/newton.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/message_of.h"

/// Runs with multigrid against the same runs with sparse factors.
namespace burnish {
namespace {

using test::Outcome;
using testing::HasSubstr;

constexpr const char* kBlock = R"(
degree: 2
geometry:
  shape: box
  origin: [-0.5, -0.5, -1]
  size: [1, 1, 1]
  spans: [7, 6, 6]
  grading: ["s", "s", "1 - 0.3*(1 - s) - 0.7*(1 - s)^2"]
)";

constexpr const char* kHeldAtTheBack = "supports: [{face: back, fix: [x, y, z]}]\n";

constexpr const char* kElastic = "material: {law: neo-hookean, E: 1, nu: 0.3}\n";
constexpr const char* kPlastic =
    "material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.3, modulus: 2}}\n";

/// A ball that is pressed into the block and moved aside. contact: what the pair says beside tool and face.
std::string ball(const std::string& contact) {
  return R"(
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5,
     motion: {times: [0, 1, 2], x: [0, 0, 0.06], z: [0, -0.05, -0.05]}}
contact: [{tool: ball, face: front, )" +
         contact + R"(}]
steps: [{until: 1, count: 2}, {until: 2, count: 2}]
)";
}

constexpr const char* kPulled = R"yaml(
loads: [{face: front, traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}}]
steps: [{until: 1, count: 2}]
)yaml";

Outcome run(const std::string& scene, const std::string& solver) {
  return test::run(parseScene(scene + "solver: {linear: " + solver + "}\noutput: {every: 1}\n", "scene.yaml"),
                   "multigrid");
}

/// Both runs, whose histories agree within 1e-8 of the largest value of each quantity; x, y and z of a vector are one.
/// Returns the iterations that a system costs. setUp: iterations that a V-cycle takes as long as to be set up, eight at degree 2.
double costPerSystem(const std::string& scene, long setUp = 8) {
  const Outcome direct = run(scene, "direct"), multigrid = run(scene, "multigrid");
  EXPECT_TRUE(multigrid.summary.completed);
  EXPECT_EQ(multigrid.summary.steps, direct.summary.steps);
  EXPECT_EQ(multigrid.summary.cuts, direct.summary.cuts);
  EXPECT_EQ(multigrid.history.columns, direct.history.columns);
  std::map<std::string, double> largest, difference;
  for (std::size_t c = 0; c < direct.history.columns.size(); ++c) {
    const auto &a = direct.history.values[c], &b = multigrid.history.values[c];
    std::string name = direct.history.columns[c];
    if (name == "newton_iterations") continue;
    if (name.find_last_of("xyz") == name.size() - 1) name.pop_back();
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest[name] = std::max(largest[name], std::abs(a[k]));
      difference[name] = std::max(difference[name], std::abs(a[k] - b[k]));
    }
  }
  // Forces that symmetry makes vanish are rounding in both.
  for (const auto& [name, size] : largest) EXPECT_LE(difference[name], 1e-8 * size + 1e-12) << name;
  EXPECT_FALSE(direct.summary.linearIterations);
  EXPECT_EQ(multigrid.summary.linearFallbacks, 0);
  EXPECT_LT(multigrid.summary.linearSetUps.value(), multigrid.summary.linearSystems.value());
  return static_cast<double>(multigrid.summary.linearIterations.value() +
                             setUp * multigrid.summary.linearSetUps.value()) /
         static_cast<double>(multigrid.summary.linearSystems.value());
}

TEST(Multigrid, PulledBlock) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack + kElastic + kPulled), 7.2);
}

TEST(Multigrid, ContactAtPoints) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack + kPlastic +
                          ball("method: integral-augmented-lagrangian")),
            7.5);
}

TEST(Multigrid, ContactByAveragesWithFriction) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack + kElastic +
                          ball("method: augmented-lagrangian, friction: 0.3")),
            7.3);
}

/// Of systems that are solved to 1e-8. what: of the scene, beside a cube of these spans that is held at its back.
double iterationsPerSystem(const std::string& spans, const std::string& what) {
  const Outcome outcome = test::run(
      parseScene("geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: " + spans + "}\n" +
                     kHeldAtTheBack + what +
                     "solver: {linear: multigrid, linear_tolerance: 1e-8}\noutput: {every: 2}\n",
                 "scene.yaml"),
      "multigrid");
  EXPECT_TRUE(outcome.summary.completed);
  EXPECT_EQ(outcome.summary.linearFallbacks, 0);
  return static_cast<double>(outcome.summary.linearIterations.value()) /
         static_cast<double>(outcome.summary.linearSystems.value());
}

/// Under a ball that slips.
TEST(Multigrid, ContactTakesHardlyMoreIterationsOnFinerSpans) {
  const std::string what =
      std::string("degree: 2\n") + kElastic + ball("method: integral-augmented-lagrangian, friction: 0.3");
  const double coarse = iterationsPerSystem("[6, 6, 6]", what),
               fine = iterationsPerSystem("[12, 12, 12]", what);
  EXPECT_LT(fine, 7.5);
  EXPECT_LT(fine, 1.35 * coarse);
}

TEST(Multigrid, PenaltyAtPoints) {
  EXPECT_LT(
      costPerSystem(std::string(kBlock) + kHeldAtTheBack + kElastic + ball("method: pointwise-penalty")),
      7.7);
}

TEST(Multigrid, LagrangeElements) {
  EXPECT_LT(costPerSystem("basis: lagrange\n" + std::string(kBlock) + kHeldAtTheBack + kElastic + kPulled),
            8.5);
}

/// The V-cycle is that of the entries, without the product that K has beside them.
TEST(Multigrid, ProjectedDilatation) {
  EXPECT_LT(costPerSystem("formulation: fbar\n" + std::string(kBlock) + kHeldAtTheBack +
                          "material: {law: neo-hookean, E: 1, nu: 0.45}\n" + kPulled),
            10.3);
}

TEST(Multigrid, NearlyIncompressible) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack +
                          "material: {law: neo-hookean, E: 1, nu: 0.49}\n" + kPulled),
            9.0);
}

/// From the second system on the finest smoother multiplies by the products, too: the entries alone take three times the
/// iterations.
TEST(Multigrid, ProjectedDilatationThatIsNearlyIncompressible) {
  const std::string what =
      "formulation: fbar\nmaterial: {law: neo-hookean, E: 1, nu: 0.49}\n"
      "loads: [{face: front, traction: [0, 0, 0.01], schedule: {times: [0, 1], values: [0, 1]}}]\n"
      "steps: [{until: 1, count: 4}]\n";
  EXPECT_LT(iterationsPerSystem("[7, 6, 6]", "degree: 2\n" + what), 11.0);
  EXPECT_LT(iterationsPerSystem("[5, 4, 4]", "degree: 3\n" + what), 19.0);
}

/// On the second level factors leave an eigenvalue of 20 with the first shift that has them, where all others are below 3: without a
/// larger one a system takes 16 iterations.
TEST(Multigrid, FactorsThatAreAlmostSingularAreMadeAnew) {
  const std::string graded = "(20^s - 1)/19";
  EXPECT_LT(
      iterationsPerSystem("[8, 8, 8], grading: [\"" + graded + "\", \"" + graded + "\", \"" + graded + "\"]",
                          "degree: 2\nformulation: fbar\nmaterial: {law: neo-hookean, E: 1, nu: 0.45}\n"
                          "loads: [{face: front, traction: [0.01, 0.02, \"-0.1*exp(-20*(X^2 + Y^2))\"], "
                          "schedule: {times: [0, 1], values: [0, 1]}}]\nsteps: [{until: 1, count: 1}]\n"),
      13.0);
}

TEST(Multigrid, DegreeThree) {
  EXPECT_LT(costPerSystem(R"(
degree: 3
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [5, 5, 4]}
)" + std::string(kHeldAtTheBack) +
                              kPlastic + ball("method: integral-augmented-lagrangian"),
                          25),
            14.5);
}

TEST(Multigrid, TwoPatches) {
  EXPECT_LT(costPerSystem(std::string(R"yaml(
degree: 2
geometry:
  shape: patches
  patches:
    - {name: a, shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 0.6], spans: [6, 6, 4]}
    - {name: b, shape: box, origin: [-0.5, -0.5, -0.4], size: [1, 1, 0.4], spans: [6, 6, 4]}
supports: [{patch: a, face: back, fix: [x, y, z]}]
loads: [{patch: b, face: front, traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}}]
steps: [{until: 1, count: 2}]
)yaml") + kElastic),
            7.2);
}

// An octant of a ball, whose pole is a row of control points in one place, under a plate.
TEST(Multigrid, TwoBodiesThatRub) {
  EXPECT_LT(costPerSystem(R"yaml(
degree: 2
bodies:
  - name: ball
    geometry: {shape: ball-octant, center: [0, 0, 0], radius: 0.5, pole: [0, 1, 0], spans: [3, 4, 4]}
    material: {law: neo-hookean, E: 2, nu: 0.3}
  - name: plate
    geometry: {shape: box, origin: [0, 0.5, 0], size: [0.7, 0.3, 0.7], spans: [6, 2, 6]}
    material: {law: neo-hookean, E: 1, nu: 0.3}
supports:
  - {body: ball, face: bottom, symmetry: true}
  - {body: ball, face: back, symmetry: true}
  - {body: ball, face: top, symmetry: true}
  - {body: plate, face: left, symmetry: true}
  - {body: plate, face: back, symmetry: true}
  - {body: plate, face: top, move: {times: [0, 1], x: [0, 0], y: [0, -0.05], z: [0, 0]}}
contact: [{body: plate, face: bottom, against: {body: ball, face: right}, friction: 0.2}]
steps: [{until: 1, count: 4}]
)yaml"),
            5.6);
}

TEST(Multigrid, BodyThatTouchesItself) {
  EXPECT_LT(costPerSystem(R"yaml(
degree: 2
geometry:
  shape: control-net
  degrees: [2, 1, 1]
  knots: [[0, 0, 0, 1, 2, 3, 4, 4, 4], [0, 0, 1, 1], [0, 0, 1, 1]]
  points:
    [[2, 0.4, 0], [0.5, 0.4, 0], [-0.5, 0.4, 0], [-0.5, -0.4, 0], [0.5, -0.4, 0], [2, -0.4, 0],
     [2, 0.1, 0], [0.6, 0.1, 0], [-0.05, 0.1, 0], [-0.05, -0.1, 0], [0.6, -0.1, 0], [2, -0.1, 0],
     [2, 0.4, 1], [0.5, 0.4, 1], [-0.5, 0.4, 1], [-0.5, -0.4, 1], [0.5, -0.4, 1], [2, -0.4, 1],
     [2, 0.1, 1], [0.6, 0.1, 1], [-0.05, 0.1, 1], [-0.05, -0.1, 1], [0.6, -0.1, 1], [2, -0.1, 1]]
  refine: [4, 2, 2]
material: {law: neo-hookean, E: 10, nu: 0.3}
supports:
  - {face: back, fix: [z]}
  - {face: left, fix: [x]}
  - {face: right, fix: [x]}
  - {face: bottom, part: [0, 0.2, 0, 1], move: {times: [0, 1], y: [0, -0.12]}}
  - {face: bottom, part: [0.8, 1, 0, 1], move: {times: [0, 1], y: [0, 0.12]}}
self_contact: [{face: top, reach: 0.25}]
steps: [{until: 1, count: 5}]
)yaml"),
            8.2);
}

/// By six digits at least, and so in more iterations than others; the first systems, before contact has settled, take most.
TEST(Multigrid, ToolWithAFreeDirection) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack + kElastic + R"(
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, carry: {z: "-0.002 - 0.008*t"}}
contact: [{tool: ball, face: front}]
steps: [{until: 1, count: 2}]
)"),
            8.0);
}

TEST(Multigrid, BallThatSpins) {
  EXPECT_LT(costPerSystem(std::string(kBlock) + kHeldAtTheBack + kElastic + R"yaml(
tools:
  - name: ball
    shape: sphere
    center: [0, 0, 0.5]
    radius: 0.5
    carry: {z: -0.01, spin: true, schedule: {times: [0, 1], values: [0.1, 1]}}
    prescribe: {x: "0.06*max(t - 1, 0)", y: "0.03*max(t - 1, 0)"}
contact: [{tool: ball, face: front, friction: 0.3}]
steps: [{until: 1, count: 2}, {until: 2, count: 2}]
)yaml"),
            8.0);
}

/// Three steps of the smoother are taken from the first step on: what is known of that goes on with the run.
TEST(Multigrid, AResumedRunHasTheSameBits) {
  const std::string scene =
      std::string(kBlock) + kHeldAtTheBack + "material: {law: neo-hookean, E: 1, nu: 0.49}\n" + R"yaml(
loads: [{face: front, traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}}]
steps: [{until: 1, count: 4}]
solver: {linear: multigrid, linear_tolerance: 1e-8}
output: {vtu: false, every: 0.25}
)yaml";
  const test::ScratchDirectory whole("multigrid_whole"), part("multigrid_part");
  RunObserver silent;
  const RunSummary summary = runScene(parseScene(scene, "scene.yaml"), whole.path(), {}, silent);
  ASSERT_TRUE(summary.completed) << summary.stoppedBecause;
  const auto afterEachStep = [] {
    return RunOptions{.threads = 1, .halt = [taken = 0]() mutable { return ++taken >= 1; }};
  };
  RunSummary resumed = runScene(parseScene(scene, "scene.yaml"), part.path(), afterEachStep(), silent);
  while (resumed.halted)
    resumed = resumeRun(readResultScene(part.path()), part.path(), afterEachStep(), silent);
  ASSERT_TRUE(resumed.completed) << resumed.stoppedBecause;
  const auto bytes = [](const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(bytes(whole.path() / "history.csv"), bytes(part.path() / "history.csv"));
  EXPECT_EQ(bytes(whole.path() / "convergence.csv"), bytes(part.path() / "convergence.csv"));
  const HistoryTable convergence = readHistory(part.path() / "convergence.csv");
  const auto& ofSystems = convergence.column("linear_iterations");
  EXPECT_EQ(std::accumulate(ofSystems.begin(), ofSystems.end(), 0.0), summary.linearIterations);
  EXPECT_EQ(resumed.linearSystems, summary.linearSystems);
  EXPECT_EQ(resumed.linearIterations, summary.linearIterations);
  EXPECT_EQ(resumed.linearSetUps, summary.linearSetUps);
}

/// A spring from the first unknown to the ground whose force atan(x) saturates, and a constant force on the second one.
class Saturating final : public Term {
 public:
  CouplingGroups couplings() const override { return {{0, 1}}; }

  bool evaluate(double, const Eigen::VectorXd& x, Assembly& out) override {
    out.force(0) += std::atan(x(0));
    out.force(1) += 10.0;
    const Eigen::Vector2d stiffness(1.0 / (1.0 + x(0) * x(0)), 0.0);
    if (out.system != nullptr) out.system->add(out.term, 0, Eigen::Matrix2d(stiffness.asDiagonal()));
    return true;
  }

  void accept() override {}
};

TEST(Multigrid, CorrectionsThatGoTooFarEndWhereTheResidualDoesNoMoreWork) {
  Saturating spring;
  NewtonOptions options;
  options.linear.name = "multigrid";
  const ResidualScales scales{2, 1e-9, Eigen::VectorXd::Zero(2), Eigen::VectorXd()};
  Newton newton({&spring}, {false, true}, scales, options, Hierarchy{});
  Eigen::VectorXd x =
      3.0 * Eigen::VectorXd::Unit(2, 0);  // beyond 1.39 every whole correction leads farther away
  const NewtonReport report = newton.solve(0.0, Eigen::VectorXd::Zero(2), x);
  EXPECT_EQ(report.outcome, NewtonOutcome::Converged);
  EXPECT_NEAR(x(0), 0.0, 1e-8);
  EXPECT_LE(report.iterations, 5);
  EXPECT_EQ(report.backtracks, 2);
}

TEST(Multigrid, IsRefusedInThePlane) {
  const std::string message = messageOf([] {
    parseScene(R"(
degree: 2
geometry: {shape: rectangle, size: [1, 1], spans: [2, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
steps: [{until: 1, count: 1}]
solver: {linear: multigrid}
)",
               "plane.yaml");
  });
  EXPECT_THAT(message,
              HasSubstr("plane.yaml:7:18: solver.linear: found multigrid in a scene of two dimensions"));
}

}  // namespace
}  // namespace burnish
