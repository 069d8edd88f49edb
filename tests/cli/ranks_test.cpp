#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/run_files.h"
#include "tests/cli/shell_test.h"

/// Runs of several processes that mpirun has started. BURNISH_COMMAND is the program's path.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTowardsTheFront = R"yaml(["s", "s", "1 - 0.3*(1 - s) - 0.7*(1 - s)^2"])yaml";

/// Spans that grow 1:20 in all directions: with ν = 0.49 incomplete factors need a shift.
constexpr const char* kStrongly =
    R"yaml(["s + 0.9*sin(2*pi*s)/(2*pi)", "s + 0.9*sin(2*pi*s)/(2*pi)", "1 - 0.1*(1 - s) - 0.9*(1 - s)^2"])yaml";

/// spans: in each direction.
std::string block(const std::string& spans, const std::string& tolerance = "1.0e-11",
                  const std::string& grading = kTowardsTheFront) {
  return "solver: {linear: multigrid, tolerance: " + tolerance + "}" + R"yaml(
degree: 2
supports: [{face: back, fix: [x, y, z]}]
output: {every: 0.5, vtu: false}
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], grading: )yaml" +
         grading + ", spans: " + spans + "}\n";
}

const std::string kBlock = block("[5, 4, 5]");

std::string pulled(const std::string& nu, int count) {
  return "material: {law: neo-hookean, E: 1, nu: " + nu +
         "}\nsteps: [{until: 1, count: " + std::to_string(count) + "}]" + R"yaml(
loads: [{face: front, traction: [0.01, 0.02, "-0.1*exp(-20*(X^2 + Y^2))"], schedule: {times: [0, 1], values: [0, 1]}}]
)yaml";
}

const std::string kPulled = pulled("0.3", 2);

/// A ball that is pressed into the block and dragged aside.
constexpr const char* kDragged = R"yaml(
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.3, modulus: 2}}
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, motion: {times: [0, 1, 2], x: [0, 0, 0.06], z: [0, -0.05, -0.05]}}
contact: [{tool: ball, face: front, method: integral-augmented-lagrangian, friction: 0.2}]
steps: [{until: 1, count: 2}, {until: 2, count: 2}]
)yaml";

constexpr const char* kFreeBall = R"yaml(
material: {law: neo-hookean, E: 1, nu: 0.3}
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, carry: {z: "-0.002 - 0.008*t", spin: true},
     prescribe: {x: "0.02*max(0, t - 0.5)"}}
contact: [{tool: ball, face: front, friction: 0.3}]
steps: [{until: 1, count: 2}]
)yaml";

/// A metal with stresses of its own, into which a ball is pressed that is taken away.
constexpr const char* kTakenAway = R"yaml(
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.3, modulus: 2}}
initial: {stress: {xx: "-0.1*exp(4*Z)", yy: "-0.05*exp(4*Z)"}, plastic_strain: "0.01*exp(4*Z)"}
tools:
  - {name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, motion: {times: [0, 1], z: [0, -0.05]}, until: 1, released_by: 2}
contact: [{tool: ball, face: front, friction: 0.2}]
steps: [{until: 1, count: 2}, {until: 2, count: 4}]
)yaml";

/// A block beside which a support lets go, too.
std::string lettingGo() {
  std::string scene = kBlock + kTakenAway;
  const std::string held = "supports: [{face: back, fix: [x, y, z]}";
  return scene.replace(scene.find(held), held.size(),
                       held + ", {face: left, fix: [x], until: 1, released_by: 2}");
}

/// A block whose fine spans follow a ball.
constexpr const char* kFollowed = R"yaml(
geometry: {shape: box, origin: [-0.6, -0.5, 0], size: [1.8, 0.5, 0.5], resolution: {along: ball, half_width: 0.15, spans_per_width: 3, growth: 2}}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.3, modulus: 2}}
supports: [{face: bottom, fix: [x, y, z]}, {face: back, symmetry: true}]
tools:
  - name: ball
    shape: sphere
    center: [0, 1, 0]
    radius: 1
    path: {course: raster, start: [0, -0.02, 0], stroke: [0.6, 0, 0], speed: 1, clearance: [0, 0.03, 0]}
contact: [{tool: ball, face: top, friction: 0.1}]
rezoning: {travel: 0.3}
formulation: fbar
steps: [{until: 0.66, count: 8}]
solver: {linear: multigrid, tolerance: 1.0e-12}
output: {every: 0.33, vtu: false}
)yaml";

/// A nearly incompressible block whose front is moved.
constexpr const char* kStretched = R"yaml(
degree: 2
formulation: fbar
geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [4, 4, 6]}
material: {law: neo-hookean, E: 1, nu: 0.45}
supports:
  - {face: back, fix: [x, y, z]}
  - {face: front, move: {times: [0, 1], x: [0, 0.02], y: [0, 0], z: [0, 0.1]}}
steps: [{until: 1, count: 2}]
solver: {linear: multigrid, tolerance: 1.0e-11}
output: {every: 0.5, vtu: false}
)yaml";

/// A metal that is sheared to and fro between two faces, with an unsymmetric tangent.
constexpr const char* kSheared = R"yaml(
degree: 2
geometry: {shape: box, size: [1, 1, 1], spans: [4, 4, 5]}
material:
  law: chaboche
  E: 200000
  nu: 0.3
  hardening: {law: linear, sigma0: 200, modulus: 500}
  back_stresses: [{modulus: 50000, recovery: 250}]
  rate: {law: norton, K: 50, N: 5}
  substeps: 2
supports:
  - {face: bottom, fix: [x, y, z]}
  - {face: top, move: {times: [0, 1, 2], x: [0, 0.01, 0.01], y: [0, 0, -0.01], z: [0, 0, 0]}}
steps: [{until: 1, count: 1}, {until: 2, count: 1}]
solver: {linear: multigrid, tolerance: 1.0e-11}
output: {every: 0.5, vtu: false}
)yaml";

class Ranks : public ShellTest {
 protected:
  void write(const std::string& scene) const { std::ofstream(dir / "scene.yaml") << scene; }

  /// The line that starts the program with so many processes. Memory that a rank reads without having set it is full of
  /// rubbish, large numbers on some ranks and negative ones on the others.
  static std::string line(int ranks, const std::string& arguments) {
    if (ranks == 1) return fmt::format("{} {}", BURNISH_COMMAND, arguments);
    return fmt::format(
        "mpirun --oversubscribe --bind-to none --allow-run-as-root -n {} sh -c "
        "'MALLOC_PERTURB_=$((128 - OMPI_COMM_WORLD_RANK % 2 * 127)) exec \"$0\" \"$@\"' {} {}",
        ranks, BURNISH_COMMAND, arguments);
  }
  Outcome burnish(int ranks, const std::string& arguments) const {
    return shell(dir, line(ranks, arguments));
  }

  /// Two processes compute the scene in "part"; one of them gets a signal when a frame has been written. Where a
  /// busy machine sends it only when the run has ended, this is done again.
  Outcome signalled(const std::string& signal, int which, int frame = 1) const {
    constexpr int kMostTries = 5;
    for (int tries = 1;; ++tries) {
      const Outcome outcome = shell(
          dir, fmt::format("{} & mpirun=$!; while [ ! -e part/result/frame_{:06}.h5 ] && kill -0 $mpirun; do "
                           "sleep 0.01; done; "
                           "set -- $(cat /proc/$mpirun/task/*/children); kill -{} ${}; wait $mpirun",
                           line(2, "run scene.yaml -o part --quiet"), frame, signal, which));
      if (outcome.code != 0 || tries == kMostTries) return outcome;
      fs::remove_all(dir / "part");
    }
  }

  HistoryTable history(const std::string& name) const { return readHistory(dir / name / "history.csv"); }

  double linearIterations(const std::string& name) const {
    const HistoryTable convergence = readHistory(dir / name / "convergence.csv");
    const auto& ofSystems = convergence.column("linear_iterations");
    return std::accumulate(ofSystems.begin(), ofSystems.end(), 0.0);
  }

  /// Largest difference of the histories of two runs over the largest value of its column; columns x, y, z of a
  /// vector are one.
  double largestDifference(const std::string& one, const std::string& other) const {
    const HistoryTable a = history(one), b = history(other);
    EXPECT_EQ(a.columns, b.columns);
    std::map<std::string, double> largest, difference;
    for (std::size_t c = 0; c < a.columns.size(); ++c) {
      EXPECT_EQ(a.values[c].size(), b.values[c].size());
      std::string name = a.columns[c];
      if (name == "newton_iterations") continue;
      // ball.fx, ball.angle_x
      if (name.size() > 3 && name.find_last_of("xyz") == name.size() - 1 &&
          (name[name.size() - 3] == '.' || name[name.size() - 2] == '_'))
        name.pop_back();
      for (std::size_t k = 0; k < std::min(a.values[c].size(), b.values[c].size()); ++k) {
        largest[name] = std::max(largest[name], std::abs(a.values[c][k]));
        difference[name] = std::max(difference[name], std::abs(a.values[c][k] - b.values[c][k]));
      }
    }
    // The energy lost in a new mesh is a small difference of two like this one.
    if (const auto lost = largest.find("rezoning_energy_lost"); lost != largest.end())
      lost->second = largest.at("strain_energy");
    double worst = 0.0;
    for (const auto& [name, size] : largest)
      if (size > 1e-13)
        worst = std::max(worst, difference[name] / size);  // not what symmetry or a free turn makes vanish
    return worst;
  }

  /// As `largestDifference`, of the fields of the last frames, over the largest value of each.
  double largestDifferenceOfFields(const std::string& one, const std::string& other) const {
    const ResultReader a(dir / one), b(dir / other);
    const FrameRecord last = a.frame(a.numFrames() - 1), same = b.frame(b.numFrames() - 1);
    double worst = 0.0;
    const auto compare = [&](const auto& fields, const auto& others) {
      EXPECT_EQ(fields.size(), others.size());
      for (const auto& [name, field] : fields)
        worst = std::max(worst, (field.values - others.at(name).values).cwiseAbs().maxCoeff() /
                                    field.values.cwiseAbs().maxCoeff());
    };
    compare(last.fields, same.fields);
    compare(last.quadrature.fields, same.quadrature.fields);
    return worst;
  }

  /// Runs of several numbers of processes have the same histories and fields.
  void expectSameResults(const std::string& scene, const std::vector<int>& numbers = {1, 2, 3}) {
    write(scene);
    for (const int ranks : numbers) {
      const Outcome outcome = burnish(ranks, fmt::format("run scene.yaml -o on{} --quiet", ranks));
      ASSERT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_LT(largestDifference("on1", fmt::format("on{}", ranks)), 1e-10) << ranks;
      EXPECT_LT(largestDifferenceOfFields("on1", fmt::format("on{}", ranks)), 1e-9) << ranks;
    }
    EXPECT_EQ(shell(dir, "ls on1 | sort > 1; ls on3 | sort > 3; diff 1 3").out, "");
  }
};

TEST_F(Ranks, ElasticBlock) {
  expectSameResults(kBlock + kPulled);
}

TEST_F(Ranks, PlasticBlockUnderABallThatRubs) {
  expectSameResults(kBlock + kDragged);
  // Wherever ranks solve contact's zone wrongly they still find the solution, in more iterations.
  const double alone = linearIterations("on1");
  EXPECT_LT(linearIterations("on2"), 1.5 * alone);
  EXPECT_LT(linearIterations("on3"), 1.7 * alone);
  EXPECT_GT(history("on3").column("plastic_work").back(), 0.0);
  EXPECT_LT(history("on3").column("ball.fx").back(), -1e-3);
}

TEST_F(Ranks, ToolWithAFreeDirection) {
  // Friction is a small part of the force that tolerances go by.
  expectSameResults(block("[7, 6, 6]", "1.0e-12") + kFreeBall);
}

TEST_F(Ranks, ProjectedVolumeChangeOfAPlasticBlock) {
  expectSameResults(kBlock + "formulation: fbar\n" + kDragged);
  EXPECT_GT(history("on3").column("plastic_work").back(), 0.0);
}

TEST_F(Ranks, StressesAtTheStartAndWhatIsLeftWhenSupportsAndToolsLetGo) {
  expectSameResults(lettingGo(), {1, 3});
  EXPECT_GT(history("on3").column("plastic_work").back(), 0.0);
  expectSameResults("formulation: fbar\n" + lettingGo());
}

TEST_F(Ranks, MeshesThatFollowATool) {
  expectSameResults(kFollowed, {1, 3});
  EXPECT_GT(history("on3").column("rezonings").back(), 0.0);
}

TEST_F(Ranks, ARunThatHasLetGoIsResumedByOtherNumbers) {
  write(lettingGo());
  ASSERT_EQ(burnish(1, "run scene.yaml -o whole --quiet").code, 0);
  const Outcome stopped = signalled("TERM", 2, 2);  // t = 1
  EXPECT_EQ(stopped.code, 143) << stopped.err;
  fs::copy(dir / "part", dir / "again", fs::copy_options::recursive);
  ASSERT_EQ(burnish(3, "run --resume part --quiet").code, 0);
  ASSERT_EQ(burnish(1, "run --resume again --quiet").code, 0);
  EXPECT_LT(largestDifference("whole", "part"), 1e-10);
  EXPECT_LT(largestDifference("whole", "again"), 1e-10);
}

TEST_F(Ranks, ProjectedVolumeChangeBetweenSupportsThatMove) {
  expectSameResults(kStretched);
}

TEST_F(Ranks, NearlyIncompressibleGradedBlock) {
  expectSameResults(block("[8, 8, 8]", "1.0e-11", kStrongly) + pulled("0.49", 4));
  EXPECT_LT(linearIterations("on2"), 130.0);  // above 200 without a shift
}

TEST_F(Ranks, MetalThatIsShearedToAndFro) {
  expectSameResults(kSheared, {1, 2, 3, 4});
  EXPECT_GT(history("on4").column("plastic_work").back(), 0.0);
}

TEST_F(Ranks, TheSameNumberHasTheSameBits) {
  write(kBlock + kDragged);
  for (const char* name : {"one", "other"})
    ASSERT_EQ(burnish(4, fmt::format("run scene.yaml -o {} --quiet", name)).code, 0);
  EXPECT_EQ(shell(dir, "diff -rq --exclude=summary.yaml one other").out, "");
}

TEST_F(Ranks, OnlyTheFirstOnePrints) {
  write(kBlock + kPulled);
  const Outcome outcome = burnish(2, "run scene.yaml -o out --timings");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out.find("results in out"), outcome.out.rfind("results in out"));
  EXPECT_THAT(outcome.out, HasSubstr("rank 1"));
  EXPECT_THAT(outcome.out, HasSubstr("spans assembled"));
}

/// How often a text is in another one.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(Ranks, BadInputIsToldOnce) {
  write(kBlock + kPulled);
  const auto expectRefusal = [&](const std::string& arguments, const std::string& sentence) {
    const Outcome outcome = burnish(2, arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(count(outcome.err, "burnish: "), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
  };
  expectRefusal("run nowhere.yaml -o out", "nowhere.yaml");
  expectRefusal("run scene.yaml -o out --set material.nu=0.7", "material.nu");
  expectRefusal("run scene.yaml -o out --set solver.linear=direct", "solver.linear: found direct");
  expectRefusal("run scene.yaml -o /dev/null/out", "/dev/null/out");
  expectRefusal("figures study.yaml -o out", "figures is not done by several processes");
  EXPECT_FALSE(fs::exists(dir / "out"));
}

TEST_F(Ranks, AStoppedRunGoesOnWithOtherNumbers) {
  write(kBlock + kDragged);
  ASSERT_EQ(burnish(1, "run scene.yaml -o whole --quiet").code, 0);
  const Outcome stopped = signalled("TERM", 2);  // which halts both
  EXPECT_EQ(stopped.code, 143) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("go on with: burnish run --resume part"));
  ASSERT_TRUE(canBeResumed(dir / "part"));
  fs::copy(dir / "part", dir / "again", fs::copy_options::recursive);
  ASSERT_EQ(burnish(3, "run --resume part --quiet").code, 0);
  ASSERT_EQ(burnish(1, "run --resume again --quiet").code, 0);
  EXPECT_LT(largestDifference("whole", "part"), 1e-10);
  EXPECT_LT(largestDifference("whole", "again"), 1e-10);
}

/// PETSc takes SIGTERM for itself when it starts.
TEST_F(Ranks, ASignalFinishesTheStepOfOneProcessWithMultigridToo) {
  write(kBlock + kDragged);
  ASSERT_EQ(burnish(1, "run scene.yaml -o whole --quiet").code, 0);
  for (const char* signal : {"TERM", "HUP"}) {
    const Outcome stopped = shell(
        dir, fmt::format("{} & process=$!; until [ -e part/result/frame_000001.h5 ]; do sleep 0.005; done; "
                         "kill -{} $process; wait $process",
                         line(1, "run scene.yaml -o part --quiet"), signal));
    EXPECT_EQ(stopped.code, 143) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("go on with: burnish run --resume part")) << signal;
    EXPECT_EQ(burnish(1, "run --resume part --quiet").code, 0);
    EXPECT_EQ(shell(dir, "diff -rq --exclude=summary.yaml whole part").out, "") << signal;
    fs::remove_all(dir / "part");
  }
}

TEST_F(Ranks, AStoppedRunOfAMetalOfRatesGoesOn) {
  write(kSheared);
  ASSERT_EQ(burnish(1, "run scene.yaml -o whole --quiet").code, 0);
  const Outcome stopped = signalled("TERM", 2);
  EXPECT_EQ(stopped.code, 143) << stopped.err;
  ASSERT_EQ(burnish(3, "run --resume part --quiet").code, 0);
  EXPECT_LT(largestDifference("whole", "part"), 1e-10);
}

TEST_F(Ranks, OneThatIsKilledEndsAllAndWhatWasSavedIsWhole) {
  write(kBlock + kDragged);
  for (const int which : {1, 2}) {
    const Outcome killed = signalled("KILL", which);
    EXPECT_NE(killed.code, 0);
    const ResultReader result(dir / "part");
    ASSERT_GE(result.numFrames(), 2);
    for (int k = 0; k < result.numFrames(); ++k) EXPECT_NO_THROW(result.frame(k));
    EXPECT_EQ(burnish(2, "run --resume part --quiet").code, 0);
    fs::remove_all(dir / "part");
  }
}

TEST_F(Ranks, WhatTheFirstOneAloneFindsIsToldOnceAndEndsAll) {
  write(kBlock + kDragged);
  const Outcome outcome = shell(
      dir, line(2, "run scene.yaml -o part --quiet") +
               " & mpirun=$!; while [ ! -e part/result/frame_000001.h5 ] && kill -0 $mpirun; do sleep 0.01; "
               "done; rm -f part/history.csv; wait $mpirun");
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(count(outcome.err, "part/history.csv was removed while it was being written"), 1) << outcome.err;
}

}  // namespace
}  // namespace burnish
