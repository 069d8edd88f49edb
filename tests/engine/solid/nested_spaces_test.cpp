#include "engine/solid/nested_spaces.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/analysis/geometry.h"
#include "engine/scene/reader.h"

/// Displacements of a coarser space are displacements of the finer one: what makes PᵀKP the coarse tangent.
namespace burnish {
namespace {

/// patch: of the support, which a body of several patches has to name.
Body<3> bodyOf(const std::string& geometry, const std::string& patch = "") {
  return makeBody<3>(parseScene(geometry + "supports: [{" + patch + R"(face: bottom, fix: [x, y, z]}]
material: {law: neo-hookean, E: 1, nu: 0.3}
steps: [{until: 1, count: 1}]
)",
                                "scene.yaml"))
      .body;
}

Eigen::MatrixXd randomDisplacements(int nodes) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(nodes, 3, [&] { return uniform(generator); });
}

/// Displacements as points of a patch. u: one row per node.
Patch<3> displacementsOn(const NestedSpaces<3>& spaces, std::size_t patch, const Eigen::MatrixXd& u) {
  return {spaces.basis(patch), u(spaces.nodes(patch), Eigen::all).transpose(), spaces.weights(patch)};
}

/// Largest difference between a random displacement of each coarser space and its prolongation.
double largestDifference(const Body<3>& body, const MergeRule& rule, int& levels) {
  NestedSpaces<3> spaces(body);
  double largest = 0.0;
  for (levels = 0;; ++levels) {
    const NestedSpaces<3> finer = spaces;
    if (!spaces.coarsen(rule)) return largest;
    const Eigen::MatrixXd coarse = randomDisplacements(spaces.numNodes()),
                          fine = spaces.prolongation() * coarse;
    for (std::size_t p = 0; p < body.patches.size(); ++p) {
      const Patch<3> before = displacementsOn(finer, p, fine), after = displacementsOn(spaces, p, coarse);
      for (const double x : {0.0, 0.13, 0.5, 0.77, 1.0})
        for (const double y : {0.02, 0.41, 0.93})
          for (const double z : {0.0, 0.35, 0.999}) {
            const Eigen::Vector3d xi(before.basis().direction(0).parameterAt(x),
                                     before.basis().direction(1).parameterAt(y),
                                     before.basis().direction(2).parameterAt(z));
            largest = std::max(largest, (before.position(xi) - after.position(xi)).norm());
          }
    }
  }
}

TEST(NestedSpaces, ProlongationIsExactOnAGradedBlock) {
  for (const char* basis : {"nurbs", "lagrange"}) {
    int levels = 0;
    const Body<3> body = bodyOf(std::string("basis: ") + basis + R"(
degree: 2
geometry: {shape: box, size: [1, 2, 1], spans: [7, 5, 6], grading: ["s^2", "s", "1 - (1 - s)^3"]}
)");
    EXPECT_LT(largestDifference(body, {}, levels), 1e-12);
    EXPECT_GE(levels, 2);
  }
}

TEST(NestedSpaces, ProlongationIsExactOnARationalTube) {
  int levels = 0;
  const Body<3> body = bodyOf(R"(
degree: 2
geometry: {shape: tube, inner_radius: 0.5, outer_radius: 1, length: 1, spans: [4, 6, 5]}
)");
  EXPECT_LT(largestDifference(body, {}, levels), 1e-12);
  EXPECT_GE(levels, 1);
}

/// Two boxes with a common face.
constexpr const char* kTwoBoxes = R"(
degree: 2
geometry:
  shape: patches
  patches:
    - {name: a, shape: box, size: [1, 1, 1], spans: [6, 4, 5]}
    - {name: b, shape: box, origin: [0, 1, 0], size: [1, 0.5, 1], spans: [6, 3, 5]}
)";

TEST(NestedSpaces, PatchesStayJoined) {
  int levels = 0;
  const Body<3> body = bodyOf(kTwoBoxes, "patch: a, ");
  EXPECT_LT(largestDifference(body, {}, levels), 1e-12);
  EXPECT_GE(levels, 1);
  NestedSpaces<3> spaces(body);
  ASSERT_TRUE(spaces.coarsen({}));
  int functions = 0;
  for (std::size_t p = 0; p < 2; ++p) functions += spaces.basis(p).numFunctions();
  const auto& first = spaces.basis(0);
  EXPECT_EQ(spaces.numNodes(),
            functions - first.direction(0).numFunctions() * first.direction(2).numFunctions());
}

TEST(NestedSpaces, CollapsedLinesStayOneNode) {
  int levels = 0;
  const Body<3> body = bodyOf(R"(
degree: 2
geometry: {shape: ball-octant, radius: 1, spans: [6, 6, 6]}
)");
  largestDifference(body, {}, levels);
  NestedSpaces<3> spaces(body);
  ASSERT_TRUE(spaces.coarsen({}));
  // A displacement that all points share is one of the coarse space, at the poles as elsewhere.
  const Eigen::MatrixXd shift = spaces.prolongation() * Eigen::MatrixXd::Ones(spaces.numNodes(), 1);
  EXPECT_LT((shift.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(NestedSpaces, HoldsWhatIsMadeOfHeldFunctionsAlone) {
  const Body<3> body = bodyOf(R"(
degree: 2
geometry: {shape: box, size: [1, 1, 1], spans: [6, 6, 6]}
)");
  std::vector<bool> held(static_cast<std::size_t>(3 * body.numNodes), false);
  for (const int a : faceFunctions(body.patches.front().basis(), 4))
    held[static_cast<std::size_t>(3 * a + 2)] = true;
  NestedSpaces<3> spaces(body);
  ASSERT_TRUE(spaces.coarsen({}));
  const auto coarse = spaces.held(held);
  std::vector<bool> expected(coarse.size(), false);
  for (const int a : faceFunctions(spaces.basis(0), 4)) expected[static_cast<std::size_t>(3 * a + 2)] = true;
  EXPECT_EQ(coarse, expected);
}

}  // namespace
}  // namespace burnish
