#include "engine/contact/master_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/engine/contact/surface_samples.h"

namespace burnish {
namespace {

using test::kFront;
using test::kRight;
using test::kTop;

const auto kAny = [](const auto&) { return true; };

TEST(BoxTree, FindsTheBoxesThatASearchOfAllFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Eigen::Matrix3Xd low = Eigen::Matrix3Xd::NullaryExpr(3, 300, [&] { return uniform(random); });
  low.row(2).setZero();  // flat boxes of a plane
  Eigen::Matrix3Xd high = low;
  for (double& end : high.topRows(2).reshaped()) end += 0.1 * uniform(random);
  const BoxTree tree(low, high);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector3d begin(uniform(random), uniform(random), 0.0),
        end = begin + Eigen::Vector3d(0.05, 0.02, 0.0);
    std::vector<int> expected;
    for (int b = 0; b < low.cols(); ++b)
      if ((low.col(b).array() <= end.array()).all() && (high.col(b).array() >= begin.array()).all())
        expected.push_back(b);
    EXPECT_EQ(tree.meeting(begin, end), expected);
  }
  EXPECT_TRUE(BoxTree().meeting({0, 0, 0}, {1, 1, 1}).empty());
}

TEST(BoxTree, BoxesThatTouchMeet) {
  const BoxTree tree(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(tree.meeting({1, 1, 0}, {2, 2, 0}), std::vector<int>{0});
  EXPECT_TRUE(tree.meeting({1.01, 0, 0}, {2, 2, 0}).empty());
}

/// The nearest foot is at most as far as the nearest of dense samples, and none is found beyond the reach.
template <int Dim>
void expectNearest(const MasterSurface<Dim>& surface, double reach) {
  const MasterSearch<Dim> search(surface);
  const auto fine = test::samples(surface, Dim == 2 ? 100 : 20);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.5 * reach, 1.5 * reach);
  int within = 0, without = 0;
  for (int k = 0; k < 200; ++k) {
    Eigen::Vector<double, Dim> x =
        fine[std::uniform_int_distribution<std::size_t>(0, fine.size() - 1)(random)].x;
    for (double& coordinate : x) coordinate += uniform(random);
    const auto& sample = test::nearest(fine, x);
    const double distance = (sample.x - x).norm();
    if (!surface.project(x, sample.place)) continue;  // beyond a free end
    const auto foot = search.nearest(surface, x, reach, kAny);
    if (distance < reach) {
      ASSERT_TRUE(foot);
      EXPECT_LE((foot->point.x - x).norm(), distance + 1e-12);
      ++within;
    }
    if (foot) {
      EXPECT_LE((foot->point.x - x).norm(), reach);
    } else {
      ++without;
    }
  }
  EXPECT_GT(within, 50);
  EXPECT_GT(without, 10);
}

TEST(MasterSearch, FindsNearestFeetInReach) {
  for (const BasisFamily family : {BasisFamily::BSpline, BasisFamily::Lagrange})
    for (const int degree : {1, 2, 3}) {
      const Body<2> plane = makeBody(test::wavy<2>(family, degree, 8, 0.3 / degree, 5));
      expectNearest<2>(MasterSurface<2>(plane, {{0, kTop}, {0, kRight}}), 0.1);
      const Body<3> solid = makeBody(test::wavy<3>(family, degree, 4, 0.3 / degree, 7));
      expectNearest<3>(MasterSurface<3>(solid, {{0, kTop}, {0, kRight}, {0, kFront}}), 0.15);
    }
}

TEST(MasterSearch, TakesTheNearestThatSuits) {
  // A slot between two faces of one block that face away from each other: the upper one is nearer.
  const Body<2> block = makeBody(
      refined(rectangle({0.0, 0.0}, {1.0, 0.2}), {KnotVector::uniform(2, 5), KnotVector::uniform(1, 1)}));
  const MasterSurface<2> surface(block, {{0, 2}, {0, kTop}});
  const MasterSearch<2> search(surface);
  const Eigen::Vector2d x(0.5, 0.15);
  EXPECT_EQ(search.nearest(surface, x, 0.5, kAny)->point.place.face, 1);
  const auto lower =
      search.nearest(surface, x, 0.5, [](const Foot<2>& foot) { return foot.normal(1) < 0.0; });
  ASSERT_TRUE(lower);
  EXPECT_NEAR(lower->gap, -0.15, 1e-15);
}

}  // namespace
}  // namespace burnish
