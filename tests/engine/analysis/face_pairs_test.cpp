#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/analysis/run.h"
#include "engine/results/history.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

class FacePairs : public testing::Test {
 protected:
  FacePairs() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    dir_ = fs::temp_directory_path() / ("face_pairs_" + std::string(test->name()));
    fs::remove_all(dir_);
  }
  ~FacePairs() override { fs::remove_all(dir_); }

  HistoryTable run(const std::string& yaml) {
    RunObserver quiet;
    const RunSummary summary = runScene(parseScene(yaml, "pair.yaml"), dir_, {}, quiet);
    EXPECT_TRUE(summary.completed);
    return readHistory(dir_ / "history.csv");
  }

  static double last(const HistoryTable& history, const std::string& column) {
    return findColumn(history, column)->back();
  }

 private:
  fs::path dir_;
};

const std::array<std::string, 2> methods{"augmented-lagrangian", "integral-augmented-lagrangian"};
const std::array<std::string, 2> penalties{"penalty", "pointwise-penalty"};

/// Two blocks, one over the other, with unlike materials, between rollers.
std::string patchTest(const std::string& degree, const std::string& spans, const std::string& method,
                      const std::string& basis = "nurbs", bool segments = false) {
  return "basis: " + basis + R"(
bodies:
  - {name: lower, degree: )" +
         degree + R"(, geometry: {shape: rectangle, size: [2, 1], spans: [5, 3]},
     material: {law: neo-hookean, E: 1, nu: 0.3}}
  - {name: upper, degree: )" +
         degree + R"(, geometry: {shape: rectangle, origin: [0, 1], size: [2, 1], spans: [)" + spans +
         R"(, 2]},
     material: {law: neo-hookean, E: 4, nu: 0.2}}
supports:
  - {body: lower, face: bottom, fix: [y]}
  - {body: lower, face: left, fix: [x]}
  - {body: lower, face: right, fix: [x]}
  - {body: upper, face: left, fix: [x]}
  - {body: upper, face: right, fix: [x]}
loads:
  - {body: upper, face: top, traction: [0, -0.2], schedule: {times: [0, 1], values: [0, 1]}}
stabilise: {until: 0.1, strength: 1e-9}
contact:
  - {body: upper, face: bottom, against: {body: lower, face: top}, method: )" +
         method + ", segments: " + (segments ? "true" : "false") + R"(}
measures:
  - {name: end, kind: extent, body: upper, face: top}
  - {name: lower_error, kind: error, body: lower, displacement: ["0", "(0.8698978702291289 - 1)*Y"]}
  - {name: upper_error, kind: error, body: upper,
     displacement: ["0", "(Y - 1)*(0.9564917252398126 - 1) + 0.8698978702291289 - 1"]}
steps: [{until: 1, count: 4}]
)";
}

TEST_F(FacePairs, BlocksOfUnlikeMeshesAreCompressedAsTheirMaterialsWant) {
  // Homogeneous stretch λ in each body: μ (λ - 1/λ) + Λ ln λ / λ = -0.2.
  constexpr double lower = 0.8698978702, upper = 0.9564917253;
  for (const std::string& method : methods) {
    double before = 1.0;
    for (const char* degree : {"2", "3"}) {
      const HistoryTable history = run(patchTest(degree, "7", method));
      EXPECT_NEAR(last(history, "upper-lower.fy"), -0.4, 1e-3);
      EXPECT_NEAR(last(history, "upper-lower.pressed"), 0.4, 1e-3);
      const double error = std::abs(last(history, "end.ymax") - (lower + upper));
      EXPECT_LT(error, 1e-4) << "without segments the test is passed nearly";
      EXPECT_LT(error, before);
      before = error;
    }
  }
}

TEST_F(FacePairs, SegmentsPassThePatchTestOfUnlikeMeshes) {
  for (const std::string& method : methods)
    for (const char* basis : {"nurbs", "lagrange"})
      for (const char* degree : {"1", "2", "3"}) {
        const HistoryTable history = run(patchTest(degree, "7", method, basis, true));
        EXPECT_LT(last(history, "lower_error.H1"), 1e-9) << method << basis << degree;
        EXPECT_LT(last(history, "upper_error.H1"), 1e-9) << method << basis << degree;
        EXPECT_NEAR(last(history, "upper-lower.pressed"), 0.4, 1e-9) << method << basis << degree;
      }
}

/// A block dragged over a wider one, both elastic; the upper one by its top.
std::string draggedBlock(double mu, int steps, const std::string& method = methods.front()) {
  return R"(
bodies:
  - {name: slab, geometry: {shape: rectangle, origin: [-2, -1], size: [5, 1], spans: [20, 4]},
     material: {law: neo-hookean, E: 1000, nu: 0.3}}
  - {name: block, geometry: {shape: rectangle, size: [1, 1], spans: [4, 4]}, material: {law: neo-hookean, E: 10, nu: 0.3}}
supports:
  - {body: slab, face: bottom, fix: [x, y]}
  - {body: block, face: top, move: {times: [0, 1, 2], x: [0, 0, 0.5], y: [0, -0.05, -0.05]}}
contact:
  - {body: block, face: bottom, against: {body: slab, face: top}, method: )" +
         method + R"(, friction: )" + std::to_string(mu) + R"(}
steps: [{until: 1, count: 10}, {until: 2, count: )" +
         std::to_string(steps) + R"(}]
)";
}

TEST_F(FacePairs, ForcesOfASlidingBlockAreInTheRatioOfFriction) {
  for (const auto& [mu, method] : {std::pair{0.1, methods[0]},
                                   {0.5, methods[0]},
                                   {0.3, methods[1]},
                                   {0.3, penalties[0]},
                                   {0.3, penalties[1]}}) {
    const HistoryTable history = run(draggedBlock(mu, 20, method));
    EXPECT_EQ(last(history, "block-slab.sticking"), 0.0);
    // The slab's surface is nearly flat: its Young's modulus is a hundred times the block's.
    EXPECT_NEAR(-last(history, "block-slab.fx") / last(history, "block-slab.fy"), mu, 2e-3 * mu);
    EXPECT_NEAR(last(history, "block-slab.friction"), mu * last(history, "block-slab.pressed"), 1e-12);
  }
}

TEST_F(FacePairs, AShearLimitIsAStressOnTheDeformedFace) {
  std::string scene = draggedBlock(0.5, 20);
  scene.replace(scene.find("friction: 0.5"), 8, "shear_limit: 0.06, friction");
  scene +=
      "measures:\n"
      "  - {name: left, kind: point, body: block, parameters: [0, 0]}\n"
      "  - {name: right, kind: point, body: block, parameters: [1, 0]}\n";
  const HistoryTable history = run(scene);
  const double width = 1.0 + last(history, "right.ux") - last(history, "left.ux");
  EXPECT_GT(width, 1.015);
  EXPECT_EQ(last(history, "block-slab.sticking"), 0.0);
  EXPECT_NEAR(last(history, "block-slab.friction"), 0.06 * width, 1e-3 * 0.06);
}

TEST_F(FacePairs, FrictionMayBeAFormulaInTimeAndPressure) {
  std::string scene = draggedBlock(0.5, 20);
  const auto with = [&](const std::string& law) {
    std::string changed = scene;
    return changed.replace(changed.find("friction: 0.500000"), 18, "friction: \"" + law + "\"");
  };
  const HistoryTable growing = run(with("0.1 + 0.1*t"));
  EXPECT_EQ(last(growing, "block-slab.sticking"), 0.0);
  EXPECT_NEAR(last(growing, "block-slab.friction"), 0.3 * last(growing, "block-slab.pressed"), 1e-12);

  // A true stress of 0.06, whatever the pressure.
  scene +=
      "measures:\n"
      "  - {name: left, kind: point, body: block, parameters: [0, 0]}\n"
      "  - {name: right, kind: point, body: block, parameters: [1, 0]}\n";
  const HistoryTable constant = run(with("0.06/p"));
  const double width = 1.0 + last(constant, "right.ux") - last(constant, "left.ux");
  EXPECT_EQ(last(constant, "block-slab.sticking"), 0.0);
  EXPECT_NEAR(last(constant, "block-slab.friction"), 0.06 * width, 1e-3 * 0.06);
}

/// Rings of a tube in a tube between rollers, the inner one made too large by 0.002.
const std::string kShrinkFit = R"(
kinematics: axisymmetric
bodies:
  - {name: inner, geometry: {shape: rectangle, origin: [1, 0], size: [1.002, 1], spans: [8, 3]},
     material: {law: neo-hookean, E: 1000, nu: 0.3}}
  - {name: outer, geometry: {shape: rectangle, origin: [2, 0], size: [1, 1], spans: [8, 2]},
     material: {law: neo-hookean, E: 2000, nu: 0.25}}
supports:
  - {body: inner, face: bottom, fix: [y]}
  - {body: inner, face: top, fix: [y]}
  - {body: outer, face: bottom, fix: [y]}
  - {body: outer, face: top, fix: [y]}
contact: [{body: inner, face: right, against: {body: outer, face: left}, interference: resolve}]
measures:
  - {name: bore, kind: point, body: inner, parameters: [0, 0.5], fields: [stress]}
  - {name: middle, kind: point, body: outer, parameters: [0, 0.5], fields: [stress]}
steps: [{until: 1, count: 2}]
)";

TEST_F(FacePairs, AnInterferenceIsResolvedAsLameSays) {
  const HistoryTable history = run(kShrinkFit);
  // Pressure and hoop stresses of linear theory, p = δ / (u₂ - u₁ per unit pressure).
  constexpr double area = 2.0 * 3.14159265358979 * 2.002;
  EXPECT_NEAR(last(history, "inner-outer.pressed") / area, 0.399734, 0.003 * 0.399734);
  EXPECT_NEAR(last(history, "bore.stress_zz"), -1.06596, 0.003 * 1.06596);
  EXPECT_NEAR(last(history, "middle.stress_zz"), 1.03931, 0.003 * 1.03931);
}

TEST_F(FacePairs, WorkOfFrictionClosesTheBalanceOfEnergy) {
  // With friction of 0.1 the block slides over more than a span of the slab.
  for (const auto& [mu, method] : {std::pair{0.1, methods[0]},
                                   {0.5, methods[0]},
                                   {0.1, methods[1]},
                                   {0.1, penalties[0]},
                                   {0.5, penalties[1]}}) {
    const HistoryTable history = run(draggedBlock(mu, 20, method));
    const double found = last(history, "strain_energy") + last(history, "contact_energy") +
                         last(history, "friction_work"),
                 error = std::abs(found / last(history, "external_work") - 1.0);
    EXPECT_LT(error, 1e-3);
  }
}

/// Penetration and elastic slip halve when parameters are doubled. A block that touches exactly at the start
/// takes no more iterations with large ones.
TEST_F(FacePairs, PenaltiesConvergeToTheAugmentedLagrangian) {
  const auto with = [](const std::string& method) {
    std::string scene = draggedBlock(0.9, 2, method);
    return scene.replace(scene.find("x: [0, 0, 0.5]"), 14, "x: [0, 0, 0.01]");
  };
  const HistoryTable exact = run(with("augmented-lagrangian"));
  EXPECT_EQ(last(exact, "block-slab.slipping"), 0.0);
  for (const char* column : {"block-slab.fx", "block-slab.fy", "strain_energy"}) {
    double before = 0.0;
    for (const int parameter : {20000, 40000, 80000}) {
      const HistoryTable history = run(with("penalty, parameter: " + std::to_string(parameter)));
      EXPECT_LE(std::ranges::max(*findColumn(history, "newton_iterations")), 4.0);
      const double error = std::abs(last(history, column) - last(exact, column));
      if (before > 0.0) {
        EXPECT_NEAR(before / error, 2.0, 0.03) << column;
      }
      before = error;
    }
    EXPECT_LT(before, 1e-3 * std::abs(last(exact, column))) << column;
  }
}

/// A block that is thrown at another one in one step of ten times the reach, from farther than that.
TEST_F(FacePairs, AFaceThatComesFastIsCaught) {
  for (const std::string& method : methods) {
    const HistoryTable history = run(R"(
bodies:
  - {name: lower, geometry: {shape: rectangle, size: [2, 1], spans: [6, 3]}, material: {law: neo-hookean, E: 100, nu: 0.3}}
  - {name: upper, geometry: {shape: rectangle, origin: [0.5, 1.45], size: [1, 1], spans: [3, 3]},
     material: {law: neo-hookean, E: 100, nu: 0.3}}
supports:
  - {body: lower, face: bottom, fix: [x, y]}
  - {body: upper, face: top, move: {times: [0, 1], x: [0, 0], y: [0, -0.5]}}
contact: [{body: upper, face: bottom, against: {body: lower, face: top}, reach: 0.05, method: )" +
                                     method + R"(}]
steps: [{until: 1, count: 1}]
)");
    EXPECT_LT(last(history, "upper-lower.fy"), -1.0);
    EXPECT_LT(last(history, "upper-lower.penetration"), 0.01);
  }
}

/// A block that slides over the joint of two patches, of degree 1: what they make is one patch of that degree.
TEST_F(FacePairs, SeveralFacesWithACommonEdgeAreOneSurface) {
  const auto scene = [](const std::string& geometry, const std::string& support, const std::string& against,
                        const std::string& method) {
    return R"(
bodies:
  - {name: block, degree: 2, geometry: {shape: rectangle, size: [1, 1], spans: [4, 4]}, material: {law: neo-hookean, E: 10, nu: 0.3}}
  - {name: slab, degree: 1, geometry: )" +
           geometry + R"(, material: {law: neo-hookean, E: 4000, nu: 0.3}}
supports:
  - {body: block, face: top, move: {times: [0, 1, 2], x: [0, 0, 0.5], y: [0, -0.03, -0.03]}}
)" + support +
           R"(
contact:
  - {body: block, face: bottom, against: )" +
           against + ", friction: 0.1, reach: 0.1, method: " + method + R"(}
steps: [{until: 1, count: 3}, {until: 2, count: 10}]
)";
  };
  for (const std::string& method : methods) {
    const HistoryTable one =
        run(scene("{shape: rectangle, origin: [-1, -1], size: [3.2, 1], spans: [16, 3]}",
                  "  - {body: slab, face: bottom, fix: [x, y]}", "{body: slab, face: top}", method));
    const HistoryTable two =
        run(scene("{shape: patches, patches: ["
                  "{name: a, shape: rectangle, origin: [-1, -1], size: [2.4, 1], spans: [12, 3]}, "
                  "{name: b, shape: rectangle, origin: [1.4, -1], size: [0.8, 1], spans: [4, 3]}]}",
                  "  - {body: slab, patch: a, face: bottom, fix: [x, y]}\n"
                  "  - {body: slab, patch: b, face: bottom, fix: [x, y]}",
                  "[{body: slab, patch: a, face: top}, {body: slab, patch: b, face: top}]", method));
    for (const char* column : {"block-slab.fx", "block-slab.fy", "block-slab.friction_work", "strain_energy"})
      EXPECT_NEAR(last(two, column), last(one, column), 1e-8 * std::abs(last(one, column))) << column;
  }
}

/// The corner of a block that stands on it is pressed into a slab: both sides of it touch alike.
TEST_F(FacePairs, FeetGoOverAConvexCornerOfTwoFaces) {
  for (const std::string& method : methods) {
    const HistoryTable history = run(R"(
bodies:
  - {name: slab, geometry: {shape: rectangle, origin: [-1, -1], size: [2, 1], spans: [21, 8]}, material: {law: neo-hookean, E: 1, nu: 0.3}}
  - name: punch
    geometry: {shape: control-net, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]],
      points: [[0, 0.01], [0.8, 0.41], [-0.8, 0.41], [0, 0.81]], refine: [4, 4]}
    material: {law: neo-hookean, E: 100, nu: 0.3}
supports:
  - {body: slab, face: bottom, fix: [x, y]}
  - {body: punch, face: top, move: {times: [0, 1], x: [0, 0], y: [0, -0.08]}}
  - {body: punch, face: right, move: {times: [0, 1], x: [0, 0], y: [0, -0.08]}}
contact:
  - {body: slab, face: top, against: [{body: punch, face: bottom}, {body: punch, face: left}], reach: 0.3, method: )" +
                                     method + R"(}
steps: [{until: 1, count: 8}]
)");
    EXPECT_GT(last(history, "slab-punch.fy"), 0.01);
    EXPECT_NEAR(last(history, "slab-punch.fx"), 0.0, 1e-8);
    EXPECT_LT(last(history, "slab-punch.penetration"), 0.01);
  }
}

/// A narrow punch is dragged over a slab of the same stiffness that has kinks under it: over the joint of two
/// patches, or over spans of degree 1. Where a step leaves a point on a kink both sides of it hold the point.
TEST_F(FacePairs, APunchIsDraggedOverKinksWithFriction) {
  const std::array<std::array<std::string, 4>, 2> slabs{
      {{"1", "{shape: rectangle, origin: [-0.5, -0.3], size: [1, 0.3], spans: [10, 3]}",
        "  - {body: slab, face: bottom, fix: [x, y]}\n", "{body: slab, face: top}"},
       {"2",
        "{shape: patches, patches: ["
        "{name: a, shape: rectangle, origin: [-0.5, -0.3], size: [0.5, 0.3], spans: [5, 3]}, "
        "{name: b, shape: rectangle, origin: [0, -0.3], size: [0.5, 0.3], spans: [5, 3]}]}",
        "  - {body: slab, patch: a, face: bottom, fix: [x, y]}\n"
        "  - {body: slab, patch: b, face: bottom, fix: [x, y]}\n",
        "[{body: slab, patch: a, face: top}, {body: slab, patch: b, face: top}]"}}};
  for (const auto& [degree, geometry, supports, against] : slabs)
    for (const auto& [method, steps] : {std::pair{methods[0], "10"}, {methods[1], "12"}}) {
      const HistoryTable history =
          run(R"(
bodies:
  - {name: punch, geometry: {shape: rectangle, origin: [-0.28, 0], size: [0.2, 0.2], spans: [4, 2]},
     material: {law: neo-hookean, E: 1, nu: 0.3}}
  - {name: slab, degree: )" +
              degree + ", geometry: " + geometry + R"(, material: {law: neo-hookean, E: 1, nu: 0.3}}
supports:
)" + supports +
              R"(  - {body: punch, face: top, move: {times: [0, 1, 2], x: [0, 0, 0.3], y: [0, -0.02, -0.02]}}
contact:
  - {body: punch, face: bottom, against: )" +
              against + ", friction: 0.3, method: " + method + R"(}
steps: [{until: 1, count: 2}, {until: 2, count: )" +
              steps + "}]\n");
      EXPECT_EQ(findColumn(history, "time")->size(), 3u + std::stoul(steps)) << "no step is made smaller";
      EXPECT_LE(std::ranges::max(*findColumn(history, "newton_iterations")), 10.0);
      EXPECT_NEAR(last(history, "punch-slab.friction"), 0.3 * last(history, "punch-slab.pressed"), 1e-12);
    }
}

}  // namespace
}  // namespace burnish
