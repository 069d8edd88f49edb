#include "engine/analysis/scene_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"
#include "tests/engine/scene/scene_samples.h"

/// What can be seen only when the model of a scene is built, with the places of the scene's keys.
namespace burnish {
namespace {

using samples::replaced;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::StartsWith;

const std::string kPress = R"(geometry: {shape: rectangle, size: [2, 1], spans: [4, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports:
  - {face: bottom, fix: [x, y]}
tools:
  - {name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}
contact:
  - {tool: disc, face: top}
steps: [{until: 1, count: 2}]
)";

std::string net(const std::string& knots, const std::string& points) {
  return "geometry:\n  shape: control-net\n  degrees: [1, 1]\n  knots: [" + knots +
         ", [0, 0, 1, 1]]\n  points: " + points +
         "\nmaterial: {law: neo-hookean, E: 1, nu: 0.3}\nsupports: [{face: left, fix: [x, y]}]\n"
         "steps: [{until: 1, count: 1}]\n";
}
const std::string kOneSpan = "[0, 0, 1, 1]";

std::string errorOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  try {
    reportOf(parseScene(yaml, "test.yaml", overrides));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneReport, SaysWhatIsComputed) {
  const SceneReport report = reportOf(parseScene(kPress, "test.yaml"));
  EXPECT_EQ(report.summary, "2 dimensions, plane strain, NURBS of degree 2, 42 unknowns, tool disc");
  EXPECT_THAT(report.warnings, ElementsAre());
}

TEST(SceneReport, HasTheColumnsOfTheHistory) {
  const Scene scene = parseScene(
      replaced(kPress, "steps:", "measures: [{name: top, kind: face, face: top}]\nsteps:"), "test.yaml");
  const std::vector<std::string> columns = reportOf(scene).columns;
  EXPECT_THAT(columns, IsSupersetOf({"time", "disc.fy", "strain_energy", "top.fx"}));
  EXPECT_EQ(historyColumnsOf(scene), columns);
}

TEST(SceneReport, TellsWhatARunWillTake) {
  const auto costOf = [](const std::vector<std::string>& overrides) {
    return reportOf(parseScene(kPress, "test.yaml", overrides)).cost;
  };
  const CostEstimate cost = costOf({"geometry.spans=[40, 20]"}), fine = costOf({"geometry.spans=[160, 80]"});
  EXPECT_EQ(cost.steps, 2);
  EXPECT_NEAR(fine.assembly, 16.0 * cost.assembly, 1e-9 * fine.assembly);
  EXPECT_NEAR(fine.contact, 4.0 * cost.contact, 1e-9 * fine.contact);
  // Factors grow like n log n, their operations like n^1.5.
  EXPECT_GT(fine.linearSystems, 16.0 * cost.linearSystems);
  EXPECT_LT(fine.linearSystems, 64.0 * cost.linearSystems);
  // As runs have taken.
  EXPECT_NEAR(cost.bytes, 120e6, 0.3 * 120e6);
  EXPECT_NEAR(fine.bytes, 460e6, 0.3 * 460e6);
  // Friction makes the tangent unsymmetric.
  const CostEstimate rubbed = costOf({"geometry.spans=[160, 80]", "contact[0].friction=0.3"});
  EXPECT_GT(rubbed.linearSystems, 1.3 * fine.linearSystems);
  EXPECT_GT(rubbed.bytes, fine.bytes);
  EXPECT_NEAR(cost.seconds(), 2 * cost.iterationsPerStep * cost.perIteration() + cost.fieldsAndFrames, 1e-12);
}

/// Steps that follow the width of the contact are as long as `resolution` says that it is wide.
TEST(SceneReport, TellsHowManyStepsAPathWillTake) {
  const auto stepsOf = [](const std::vector<std::string>& overrides) {
    return reportOf(parseScene(R"(
geometry: {shape: rectangle, size: [4, 1.5], resolution: {along: roller, half_width: 0.12, spans_per_width: 5}}
material: {law: neo-hookean, E: 1000, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - name: roller
    shape: cylinder
    center: [1.4, 4.5]
    radius: 3
    path: {course: raster, start: [0, -0.01], stroke: [1.2, 0], passes: 2, speed: 1, clearance: [0, 0.05]}
contact: [{tool: roller, face: top}]
steps: [{until: 4, count: 4}]
)",
                               "test.yaml", overrides))
        .cost.steps;
  };
  const int corners = stepsOf({});
  // Each pass of 1.2 is 20 steps of 0.06 instead of those between whole times and its ends.
  EXPECT_GE(stepsOf({"tools[0].path.step_per_half_width=0.5"}), corners + 2 * (20 - 3));
  EXPECT_LE(stepsOf({"tools[0].path.step_per_half_width=0.5"}), corners + 2 * 22);
}

TEST(SceneReport, PlacesWhatIsWrongWithTheModel) {
  EXPECT_EQ(errorOf(replaced(kPress, "1.5]", "1.4]")),
            "test.yaml:8:5: contact[0]: tool 'disc' overlaps face 'top' by 0.1 at the start; move it away by "
            "at least that much (touching is fine)");
  EXPECT_THAT(
      errorOf(kPress, {"tools[0].motion=",
                       "tools[0].path={course: raster, start: [0, -0.2], stroke: [0.5, 0], "
                       "speed: 1, clearance: [0, 0.05]}"}),
      HasSubstr(
          "overlaps face 'top' by 0.15 at the start; its path begins there: a clearance that is larger by "
          "that much has it come down from outside"));
  EXPECT_THAT(errorOf(replaced(kPress, "[1, 1.5]", "[1, 0.5]")),
              StartsWith("test.yaml:8:5: contact[0]: tool 'disc' is behind face 'top'"));
  EXPECT_THAT(
      errorOf(replaced(kPress, "fix: [x, y]", "fix: [y]")),
      StartsWith("test.yaml:4:3: supports: they leave the body free to move as a rigid whole in 1 way"));
  EXPECT_THAT(errorOf(kPress, {"supports[0].part=[0.4, 0.45]"}),
              StartsWith("test.yaml:4:5: supports[0]: no control point belongs to this part"));
  EXPECT_THAT(errorOf(kPress, {"tools[0].motion=", "tools[0].carry={y: 0}"}),
              StartsWith("--set tools[0].carry={y: 0}: tools[0].carry: tool 'disc' carries no force"));
  EXPECT_THAT(errorOf(kPress + "measures:\n  - {name: far, kind: point, position: [9, 9]}\n"),
              StartsWith("test.yaml:11:5: measures[0]: "));
}

TEST(SceneReport, ReportsIndependentProblemsTogether) {
  EXPECT_THAT(
      errorOf(replaced(replaced(kPress, "fix: [x, y]", "fix: [y]"), "1.5]", "1.4]")),
      testing::AllOf(StartsWith("test.yaml:4:3: supports: "), HasSubstr("\ntest.yaml:8:5: contact[0]: ")));
}

TEST(SceneReport, RefusesGeometryThatIsNoBody) {
  EXPECT_EQ(errorOf(net(kOneSpan, "[[0, 0], [1, 0], [0, 1], [1, 1]]")), "no error");
  EXPECT_THAT(errorOf(net(kOneSpan, "[[1, 0], [0, 0], [1, 1], [0, 1]]")),
              StartsWith("test.yaml:2:3: geometry: the body is inside out"));
  EXPECT_THAT(
      errorOf(net(kOneSpan, "[[0, 0], [1, 0], [0, 1], [0.49, 0.49]]")),
      StartsWith("test.yaml:2:3: geometry: the map is folded near (0.49, 0.49): its determinant is -0.02"))
      << "positive at all quadrature points";
}

TEST(SceneReport, RefusesABodyThatCoversAPlaceTwice) {
  const std::string knots = "[0, 0, 1, 2, 3, 4, 4]";
  const std::string inside = ", [0, 0.5], [3.5, 0.5], [3.5, 3.5], [1.5, 3.5], ";
  const std::string open = "[[0, 0], [4, 0], [4, 4], [1, 4], [1, 1]" + inside + "[1.5, 1]]";
  const std::string crossed = "[[0, 0], [4, 0], [4, 4], [1, 4], [1, -2]" + inside + "[1.5, -2]]";
  EXPECT_EQ(errorOf(net(knots, open)), "no error");
  EXPECT_THAT(errorOf(net(knots, crossed)),
              StartsWith("test.yaml:2:3: geometry: the boundary crosses itself near (1, "));
}

TEST(SceneReport, NamesThePatchThatIsFolded) {
  EXPECT_THAT(errorOf(R"(geometry:
  shape: patches
  patches:
    - {name: a, shape: rectangle, size: [1, 1], spans: [1, 1]}
    - {name: b, shape: control-net, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]],
       points: [[1, 0], [2, 0], [1, 1], [1.4, 0.4]]}
degree: 1
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{patch: a, face: left, fix: [x, y]}]
steps: [{until: 1, count: 1}]
)"),
              StartsWith("test.yaml:5:7: geometry.patches[1]: the map is folded near"));
}

TEST(SceneReport, WarnsOfToolsThatNothingTouches) {
  const auto warningsOf = [](const std::string& yaml) {
    return reportOf(parseScene(yaml, "test.yaml")).warnings;
  };
  EXPECT_THAT(warningsOf(replaced(kPress, "contact:\n  - {tool: disc, face: top}\n", "")),
              ElementsAre("test.yaml:6:5: tools[0]: no face can touch tool 'disc'; name it under contact"));
  EXPECT_THAT(warningsOf(replaced(kPress, "1.5]", "1.6]")),
              ElementsAre(StartsWith("test.yaml:6:5: tools[0]: tool 'disc' stays 0.05 or more away")));
  EXPECT_THAT(warningsOf(replaced(kPress, "1.5]", "1.54]")), ElementsAre());
}

TEST(SceneReport, WarnsOfForcesOfToolsThatGoToZero) {
  const auto warningsOf = [](const std::string& values) {
    const std::string motion = "motion: {times: [0, 1], y: [0, -0.05]}";
    return reportOf(parseScene(
                        replaced(kPress, motion,
                                 "carry: {y: -0.01, schedule: {times: [0, 0.5, 1], values: " + values + "}}"),
                        "test.yaml"))
        .warnings;
  };
  EXPECT_THAT(warningsOf("[0, 1, 0.01]"), ElementsAre());
  EXPECT_THAT(warningsOf("[0, 1, 0]"),
              ElementsAre(testing::AllOf(
                  HasSubstr("tools[0].carry.schedule.values[2]: without its force nothing holds "
                            "tool 'disc' in its place, and steps near t = 1 may"),
                  HasSubstr("`until: 0.5` of the tool"))));
}

/// Warnings of the press with another Poisson's ratio, degree, formulation.
std::vector<std::string> lockingOf(double nu, int degree, const std::string& formulation) {
  return reportOf(parseScene(kPress, "test.yaml",
                             {fmt::format("material.nu={}", nu), fmt::format("degree={}", degree),
                              "formulation=" + formulation}))
      .warnings;
}

TEST(SceneReport, WarnsOfLockingFromAPoissonsRatioOnThatGrowsWithTheDegree) {
  EXPECT_THAT(lockingOf(0.4999, 2, "displacement"),
              ElementsAre(HasSubstr("material.nu: 0.4999 is nearly incompressible: the displacement "
                                    "formulation of degree 2 locks from 0.49 on")));
  const std::array<std::pair<double, double>, 4> ratios{
      {{0.44, 0.45}, {0.48, 0.49}, {0.495, 0.499}, {0.4995, 0.4999}}};
  for (int degree = 1; degree <= 5; ++degree) {
    const auto& [sound, locking] = ratios[std::min<std::size_t>(static_cast<std::size_t>(degree), 4) - 1];
    EXPECT_THAT(lockingOf(sound, degree, "displacement"), ElementsAre()) << degree;
    EXPECT_THAT(lockingOf(locking, degree, "displacement"), ElementsAre(HasSubstr("add formulation: fbar")))
        << degree;
    EXPECT_THAT(lockingOf(locking, degree, "fbar"), ElementsAre()) << degree;
  }
}

TEST(SceneReport, WarnsOfPlasticFlowWithoutFbar) {
  const std::string flows = replaced(kPress, "{law: neo-hookean, E: 1, nu: 0.3}",
                                     "{law: j2, E: 1, nu: 0.3, hardening: {law: linear, sigma0: 0.01, "
                                     "modulus: 0.1}}");
  const auto warningsOf = [&](const std::vector<std::string>& overrides) {
    return reportOf(parseScene(flows, "test.yaml", overrides)).warnings;
  };
  EXPECT_THAT(warningsOf({}),
              ElementsAre(StartsWith("test.yaml:2:17: material.law: plastic flow is nearly incompressible")));
  EXPECT_THAT(warningsOf({"formulation=fbar"}), ElementsAre());
}

TEST(SceneReport, APartOfAFaceMayBeAPointOrALength) {
  const std::string oneWay = "supports: they leave the body free to move as a rigid whole in 1 way";
  for (const char* point :
       {"part=[0.45, 0.45]", "part=[0, 0]", "part=[1, 1]", "length=[0.9, 0.9]", "length=[2, 2]"})
    EXPECT_THAT(errorOf(kPress, {std::string("supports[0].") + point}), HasSubstr(oneWay)) << point;
  EXPECT_EQ(errorOf(kPress, {"supports[0].length=[0.4, 1.6]"}), "no error");
  EXPECT_THAT(errorOf(kPress, {"supports[0].length=[0.6, 0.7]"}),
              HasSubstr("no control point belongs to this part"));
  EXPECT_EQ(errorOf(kPress, {"supports[0].length=[1, 3]"}),
            "--set supports[0].length=[1, 3]: supports[0].length[1]: found 3; allowed: up to 2, the length "
            "of the face");
  EXPECT_THAT(errorOf(kPress, {"supports[0].length=[1, 2]", "supports[0].part=[0, 1]"}),
              HasSubstr("supports[0].length: found beside part; allowed: one of the two."));
  EXPECT_THAT(errorOf(kPress, {"loads=[{face: left, pressure: 1, length: [0.3, 0.3]}]"}),
              HasSubstr("loads[0].length[1]: found 0.3 after 0.3; allowed: an end after the beginning."));
  EXPECT_EQ(errorOf(kPress, {"loads=[{face: left, pressure: 1, length: [0.3, 0.6]}]"}), "no error");
}

TEST(SceneReport, AFaceOnTheAxisOfRevolutionStaysThere) {
  const std::vector<std::string> revolved{"kinematics=axisymmetric", "tools[0].center=[0, 1.5]"};
  EXPECT_THAT(
      errorOf(kPress, revolved),
      StartsWith("test.yaml:4:3: supports: face 'left' lies on the axis of revolution, and nothing keeps it "
                 "there: a hole would open; add a support of this face with symmetry: true"));
  EXPECT_EQ(
      errorOf(replaced(kPress, "fix: [x, y]}", "fix: [x, y]}\n  - {face: left, symmetry: true}"), revolved),
      "no error");
  EXPECT_THAT(
      errorOf(replaced(kPress, "fix: [x, y]}", "fix: [x, y]}\n  - {face: left, fix: [x], until: 0.5}"),
              revolved),
      HasSubstr("face 'left' lies on the axis"));
  EXPECT_EQ(errorOf(kPress, {"kinematics=axisymmetric", "geometry.origin=[0.1, 0]"}), "no error");
}

TEST(SceneReport, ADiscAwayFromTheAxisIsARing) {
  const std::string ring = replaced(replaced(kPress, "{shape: rectangle, size: [2, 1], spans: [4, 2]}",
                                             "{shape: disc, center: [10, 0], radius: 1, spans: [4, 4]}"),
                                    "shape: cylinder, center: [1, 1.5], radius: 0.5",
                                    "shape: plane, origin: [0, 1], normal: [0, -1]");
  const SceneReport report = reportOf(parseScene(ring, "test.yaml", {"kinematics=axisymmetric"}));
  EXPECT_EQ(report.summary, "2 dimensions, axisymmetric, NURBS of degree 2, 66 unknowns, tool disc");
  EXPECT_THAT(report.warnings, ElementsAre());
  EXPECT_THAT(errorOf(ring, {"kinematics=axisymmetric", "geometry.center=[0.9, 0]"}),
              HasSubstr("crosses the axis of revolution"));
}

TEST(SceneReport, RefusesFormulasThatHaveNoValueWhereStepsLand) {
  const auto with = [](const std::string& more) { return errorOf(kPress + more); };
  EXPECT_EQ(with("loads: [{face: left, pressure: 1/(t - 0.3)}]\n"), "no error");
  EXPECT_EQ(with("loads: [{face: left, pressure: 1/(t - 0.5)}]\n"),
            "test.yaml:10:32: loads[0].pressure: the formula \"1/(t - 0.5)\" has no finite value at X = 0, "
            "Y = 0.0563508, Z = 0, t = 0.5");
  EXPECT_THAT(with("loads: [{face: left, traction: [ln(0*Y), 0]}]\n"),
              StartsWith("test.yaml:10:32: loads[0].traction: the formula \"ln(0*Y)\" has no finite value"));
  EXPECT_THAT(with("loads: [{body_force: [0, sqrt(0.2 - X*t)]}]\n"),
              StartsWith("test.yaml:10:22: loads[0].body_force: "));
  EXPECT_THAT(
      with("loads: [{face: left, shear: \"ln(-1)\"}, {face: right, pressure: 1/(1 - t)}]\n"),
      testing::AllOf(HasSubstr("loads[0].shear: "), HasSubstr("\ntest.yaml:10:64: loads[1].pressure: ")));
  EXPECT_THAT(errorOf(replaced(kPress, "fix: [x, y]", "prescribe: {x: 1/(t - 1), y: 0}")),
              StartsWith("test.yaml:4:31: supports[0].prescribe: the formula \"1/(t - 1)\" has no finite"));
  EXPECT_THAT(
      errorOf(replaced(kPress, "motion: {times: [0, 1], y: [0, -0.05]}", "prescribe: {y: 0.01*t/(t - 1)}")),
      StartsWith("test.yaml:6:81: tools[0].prescribe.y: the formula"));
}

TEST(SceneReport, WarnsOfSoftening) {
  const auto warningsOf = [](const std::string& hardening) {
    return reportOf(parseScene(replaced(kPress, "{law: neo-hookean, E: 1, nu: 0.3}",
                                        "{law: j2, E: 1, nu: 0.3, hardening: {law: " + hardening + "}}"),
                               "test.yaml", {"formulation=fbar"}))
        .warnings;
  };
  EXPECT_THAT(warningsOf("table, ep: [0, 1], stress: [2, 2]"), ElementsAre());
  EXPECT_THAT(warningsOf("formula, formula: 2*(0.01 + ep)^0.2"), ElementsAre());
  EXPECT_THAT(warningsOf("table, ep: [0, 1, 2], stress: [1, 3, 2]"),
              ElementsAre(StartsWith("test.yaml:2:47: material.hardening: the body softens: its yield stress "
                                     "falls from 3 at the plastic strain ep = 1 to 2 at ep = 2;")));
  EXPECT_THAT(warningsOf("voce, sigma0: 2, sigma_inf: 1, beta: 20"),
              ElementsAre(HasSubstr("the body softens")));
  EXPECT_THAT(warningsOf("formula, formula: 1 - 2*ep"),
              ElementsAre(HasSubstr("the yield stress is -0.002 at the plastic strain ep = 0.501, from 1")));
}

}  // namespace
}  // namespace burnish
