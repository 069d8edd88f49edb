#include "engine/analysis/contact_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/rezoning/remesh.h"
#include "engine/solid/span_quadrature.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

constexpr FaceId kTop = 3;
constexpr double kParameter = 1000.0;

/// A slab of 2 x 0.6.
Patch<2> slab(int degree) {
  return refined(rectangle({0.0, 0.0}, {2.0, 0.6}),
                 {KnotVector::uniform(degree, 60), KnotVector::uniform(degree, 8)});
}

/// A disc that overlaps the slab by 0.02.
Tool disc() {
  return {"disc", Cylinder{{0.9, 0.6 + 0.5 - 0.02, 0.0}, Eigen::Vector3d::UnitZ(), 0.5}};
}

RestingTool resting(const Tool& tool, Eigen::VectorXd multipliers) {
  return {&tool, {}, {Enforcement::AugmentedLagrangian, kParameter}, std::move(multipliers)};
}

Eigen::VectorXd gapsOf(const Patch<2>& mesh, const Tool& tool, bool axisymmetric = false) {
  Body<2> body = makeBody(mesh);
  body.axisymmetric = axisymmetric;
  return ContactTerm<2>(body, 0, kTop, tool, {Enforcement::AugmentedLagrangian, kParameter}, 0)
      .referenceGaps(gapTo(tool, {}));
}

double volumeOf(const Patch<2>& mesh, bool axisymmetric) {
  Body<2> body = makeBody(mesh);
  body.axisymmetric = axisymmetric;
  double volume = 0.0;
  const SpanQuadrature<2> quadrature(body);
  for (const auto& span : quadrature.spans()) volume += span.weights.sum();
  return volume;
}

TEST(LinearGaps, AgreeWithCentralDifferences) {
  const Body<2> body = makeBody(slab(2));
  const Tool tool = disc();
  ContactTerm<2> term(body, 0, kTop, tool, {Enforcement::AugmentedLagrangian, kParameter}, 2 * body.numNodes);
  const auto linear = term.linearReferenceGaps({});
  EXPECT_LT((linear.values - term.referenceGaps(gapTo(tool, {}))).cwiseAbs().maxCoeff(), 1e-15);
  const Eigen::VectorXd direction = test::randomState(2 * term.face().numFunctions(), 1.0, 3);
  constexpr double step = 1e-6;
  std::array<Eigen::VectorXd, 2> gaps;
  for (std::size_t side = 0; side < 2; ++side) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes + term.numMultipliers()), force = x;
    for (int a = 0; a < term.face().numFunctions(); ++a)
      x.segment<2>(2 * term.face().nodes()[static_cast<std::size_t>(a)]) =
          (side == 0 ? -step : step) * direction.segment<2>(2 * a);
    Assembly out{force};
    ASSERT_TRUE(term.evaluate(0.0, x, out));
    gaps[side] = term.state().averageGap;
  }
  const Eigen::VectorXd change = (gaps[1] - gaps[0]) / (2.0 * step);
  EXPECT_LT((change - linear.gradient * direction).norm(), 1e-7 * change.norm());
}

class FittedMeshes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degrees, FittedMeshes, testing::Values(1, 2, 3, 4));

TEST_P(FittedMeshes, ClosesEveryGapUnderTheTool) {
  const Patch<2> mesh = slab(GetParam());
  const Tool tool = disc();
  const Eigen::VectorXd before = gapsOf(mesh, tool);
  ASSERT_LT(before.minCoeff(), -0.015);
  for (const bool axisymmetric : {false, true}) {
    const auto fitted = fittedToTools(mesh, {resting(tool, Eigen::VectorXd::Zero(before.size()))},
                                      {.face = kTop, .axisymmetric = axisymmetric, .farthest = 0.1});
    ASSERT_TRUE(fitted);
    const Eigen::VectorXd after = gapsOf(*fitted, tool, axisymmetric);
    EXPECT_GT(after.minCoeff(), -1e-8);
    for (int a = 0; a < before.size(); ++a)
      if (before(a) < 0.0) {
        EXPECT_NEAR(after(a), 0.0, 1e-8) << a;
      }
    // What the disc displaces, 0.02 deep and about 0.28 wide, is found beside it, to first order.
    const double displaced = 0.02 * 0.28 * (axisymmetric ? 2.0 * std::numbers::pi * 0.9 : 1.0);
    EXPECT_NEAR(volumeOf(*fitted, axisymmetric), volumeOf(mesh, axisymmetric), 0.05 * displaced);
    EXPECT_GT(meshQuality(*fitted), 0.8 * meshQuality(mesh));
    for (const FaceId face : {0, 1, 2}) {
      const auto functions = faceFunctions(mesh.basis(), face);
      const Eigen::MatrixXd moved = fitted->points() - mesh.points();
      EXPECT_LT(moved.row(face / 2)(functions).cwiseAbs().maxCoeff(), 1e-12) << faceName(face);
    }
  }
}

TEST_P(FittedMeshes, LeavesAMeshThatWouldHaveToChangeTooMuch) {
  const Tool tool = disc();
  const Patch<2> mesh = slab(GetParam());
  const std::vector tools{resting(tool, Eigen::VectorXd::Zero(gapsOf(mesh, tool).size()))};
  EXPECT_FALSE(fittedToTools(mesh, tools, {.farthest = 0.01}));
  EXPECT_FALSE(fittedToTools(mesh, tools, {.farthest = 0.1, .smallestDeterminant = 0.999}));
}

/// A plate that rests on a part of the face, a little above it.
TEST(ContactFit, DrawsTheFaceToWhatPressesOnIt) {
  const Tool plate{"plate", Plane{{0.0, 0.6001, 0.0}, {0.0, -1.0, 0.0}}};
  const Patch<2> mesh = slab(2);
  const auto n = gapsOf(mesh, plate).size();
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(n);
  multipliers.head(20).setConstant(-100.0);
  multipliers.segment(40, 3).setConstant(-0.01);  // the edge of something that is out of touch
  const auto fitted = fittedToTools(mesh, {resting(plate, multipliers)}, {.farthest = 0.01});
  ASSERT_TRUE(fitted);
  const Eigen::VectorXd gaps = gapsOf(*fitted, plate);
  EXPECT_LT(gaps.head(20).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_GT(gaps.tail(n - 30).minCoeff(), 5e-5);

  // The corner slides along the face beside it, unless a support holds it.
  const auto corner = faceFunctions(mesh.basis(), kTop).front();
  EXPECT_NEAR(fitted->points()(1, corner), 0.6001, 1e-6);
  multipliers.tail(n - 3).setZero();
  const auto supported = fittedToTools(mesh, {resting(plate, multipliers)},
                                       {.held = {{{true, true}, {}, {}}}, .farthest = 0.01});
  ASSERT_TRUE(supported);
  EXPECT_EQ(supported->points()(1, corner), 0.6);
  EXPECT_LT(gapsOf(*supported, plate).head(3).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(ContactFit, LeavesAMeshThatNothingTouches) {
  const Tool far{"plate", Plane{{0.0, 0.7, 0.0}, {0.0, -1.0, 0.0}}};
  const Patch<2> mesh = slab(2);
  const auto fitted =
      fittedToTools(mesh, {resting(far, Eigen::VectorXd::Zero(gapsOf(mesh, far).size()))}, {.farthest = 0.1});
  ASSERT_TRUE(fitted);
  EXPECT_EQ(fitted->points(), mesh.points());
}

}  // namespace
}  // namespace burnish
