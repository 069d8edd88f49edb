#include "postproc/mesh/same_points.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <random>
#include <vector>

namespace burnish {
namespace {

/// Four points, a little apart, at every place of a lattice, in disorder.
TEST(SamePoints, AreTheFirstOfTheirPlaceAtEveryCall) {
  constexpr int kPerSide = 20, kCopies = 4;
  constexpr double kApart = 1e-10, kDistance = 1e-9;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-kApart, kApart);
  std::vector<int> places;
  for (int place = 0; place < kPerSide * kPerSide * kPerSide; ++place)
    places.insert(places.end(), kCopies, place);
  std::ranges::shuffle(places, random);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<vtkIdType> expected, seen(places.size(), -1);
  for (const int place : places) {
    const int i = place % kPerSide, j = place / kPerSide % kPerSide, k = place / kPerSide / kPerSide;
    const vtkIdType id = points->InsertNextPoint(i + off(random), j + off(random), k + off(random));
    vtkIdType& first = seen[static_cast<std::size_t>(place)];
    if (first < 0) first = id;
    expected.push_back(first);
  }
  for (int call = 0; call < 20; ++call) ASSERT_EQ(firstOfSame(*points, kDistance), expected) << call;
}

TEST(SamePoints, OfNoneAreNone) {
  EXPECT_TRUE(firstOfSame(*vtkNew<vtkPoints>(), 1.0).empty());
}

}  // namespace
}  // namespace burnish
