#include "postproc/draw/contour/seen_lines.h"

#include <gtest/gtest.h>
#include <vtkPolyData.h>

#include <cmath>
#include <vector>

#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

constexpr double kOfEnd = 0.02;  // pixels

/// From above on to the plane of x and y: 100 pixels a length, the origin in the middle.
View fromAbove() {
  View view;
  view.pixelsPerLength = 100.0;
  view.area = {0.0, 0.0, 1000.0, 1000.0};
  return view;
}

/// Parallel to the plane of the picture, with edges of length 2.
vtkSmartPointer<vtkPolyData> plate(double height) {
  Eigen::Matrix<double, 3, 4> corners;
  corners << -1, 1, 1, -1, -1, -1, 1, 1, height, height, height, height;
  PolyBuilder builder;
  builder.addPolygon(builder.addPoints(corners));
  return builder.finish();
}

/// From x = -3 to 3, in two segments.
vtkSmartPointer<vtkPolyData> along(double y, double z) {
  Eigen::Matrix3d points;
  points << -3, 0.3, 3, y, y, y, z, z, z;
  PolyBuilder builder;
  builder.addLine(builder.addPoints(points));
  return builder.finish();
}

struct Span {
  double begin, end, share;
};

std::vector<Span> spansOf(const SeenLines& seen, vtkPolyData& lines, double lift) {
  std::vector<Span> spans;
  for (const SeenLines::Piece& piece : seen.piecesOf(lines, lift, 1.0))
    if (piece.share > 0.0) spans.push_back({piece.places.front().x(), piece.places.back().x(), piece.share});
  return spans;
}

TEST(SeenLines, EndWhereAPlateBegins) {
  const SeenLines seen({{plate(1.0), 0.0, 1.0}}, fromAbove());
  const std::vector<Span> spans = spansOf(seen, *along(0.0, 0.0), 0.0);
  ASSERT_EQ(spans.size(), 2);
  EXPECT_NEAR(spans[0].begin, -3.0, 1e-12);
  EXPECT_NEAR(spans[0].end, -1.0, 0.01 * kOfEnd);
  EXPECT_NEAR(spans[1].begin, 1.0, 0.01 * kOfEnd);
  EXPECT_NEAR(spans[1].end, 3.0, 1e-12);
}

TEST(SeenLines, AreWholeBeforeAPlateAndWhereTheyAreLiftedOverIt) {
  const SeenLines seen({{plate(1.0), 0.25, 1.0}}, fromAbove());
  EXPECT_EQ(spansOf(seen, *along(0.0, 1.3), 0.0).size(), 1);
  EXPECT_EQ(spansOf(seen, *along(0.0, 1.2), 0.0).size(), 2);
  EXPECT_EQ(spansOf(seen, *along(0.0, 0.0), 1.3).size(), 1);
  EXPECT_EQ(spansOf(seen, *along(0.0, 0.0), 1.2).size(), 2);
}

TEST(SeenLines, AreLessDarkBehindGlass) {
  const SeenLines seen({{plate(1.0), 0.0, 0.3}, {plate(2.0), 0.0, 0.3}, {plate(3.0), 0.0, 0.0}}, fromAbove());
  const auto middleOf = [&](double z) { return spansOf(seen, *along(0.0, z), 0.0).at(1).share; };
  EXPECT_DOUBLE_EQ(middleOf(0.0), 0.7 * 0.7);
  EXPECT_DOUBLE_EQ(middleOf(1.5), 0.7);
  EXPECT_EQ(spansOf(seen, *along(0.0, 2.5), 0.0).size(), 1);
}

TEST(SeenLines, AreWholeWithWhatIsHidden) {
  const SeenLines seen({{plate(1.0), 0.0, 1.0}}, fromAbove());
  const auto hidden = seen.hiddenOf(*along(0.0, 0.0), 0.0, 1.0);
  ASSERT_EQ(hidden->GetNumberOfLines(), 1);
  EXPECT_NEAR(hidden->GetBounds()[0], -1.0, 0.01 * kOfEnd);
  EXPECT_NEAR(hidden->GetBounds()[1], 1.0, 0.01 * kOfEnd);
}

/// However small a surface and however far before a line.
TEST(SeenLines, EndBehindASmallPlateFarAway) {
  const SeenLines seen({{plate(1e4), 0.0, 1.0}}, fromAbove());
  const std::vector<Span> spans = spansOf(seen, *along(0.0, -1e3), 0.0);
  ASSERT_EQ(spans.size(), 2);
  EXPECT_NEAR(spans[0].end, -1.0, 0.01 * kOfEnd);
  EXPECT_NEAR(spans[1].begin, 1.0, 0.01 * kOfEnd);
}

/// What lies beside the view, of a picture of a part, takes no time.
TEST(SeenLines, EndBesideTheView) {
  View view = fromAbove();
  view.pixelsPerLength = 1e9;
  const SeenLines seen({{plate(1.0), 0.0, 1.0}}, view);
  const std::vector<Span> spans = spansOf(seen, *along(0.0, 2.0), 0.0);
  ASSERT_EQ(spans.size(), 1);
  EXPECT_NEAR(1e9 * spans[0].begin, -501.0, 1e-3);
  EXPECT_NEAR(1e9 * spans[0].end, 501.0, 1e-3);
  EXPECT_TRUE(spansOf(seen, *along(0.0, 0.0), 0.0).empty());
}

/// As the outline of a face that is drawn over its body.
TEST(SeenLines, RoundASurfaceAreSeenFromBeyondIt) {
  const SeenLines seen({{plate(1.0), 0.0, 1.0}}, fromAbove());
  for (const double y : {-1.0, 1.0}) EXPECT_EQ(spansOf(seen, *along(y, 0.0), 0.0).size(), 1);
  EXPECT_EQ(spansOf(seen, *along(0.99, 0.0), 0.0).size(), 2);
}

/// An eye at a height h over a plate at the height 1 sees the plane of 0 beyond h/(h - 1).
TEST(SeenLines, InPerspectiveEndInTheShadowOfAnEye) {
  constexpr double kHeight = 5.0, kShadow = kHeight / (kHeight - 1.0);
  View view = fromAbove();
  view.eye = Eye{{0.0, 0.0}, 0.0, kHeight};
  const SeenLines seen({{plate(1.0), 0.0, 1.0}}, view);
  const std::vector<Span> spans = spansOf(seen, *along(0.0, 0.0), 0.0);
  ASSERT_EQ(spans.size(), 2);
  EXPECT_NEAR(spans[0].end, -kShadow, 0.01 * kOfEnd);
  EXPECT_NEAR(spans[1].begin, kShadow, 0.01 * kOfEnd);
  EXPECT_EQ(spansOf(seen, *along(0.0, 0.0), 1.1).size(), 1);
}

TEST(SeenLines, FarFromTheOriginAreTheSame) {
  constexpr double kAway = 1e4;
  View view = fromAbove();
  view.center = {kAway, 0.0};
  const auto moved = [](const vtkSmartPointer<vtkPolyData>& shape) {
    for (vtkIdType k = 0; k < shape->GetNumberOfPoints(); ++k) {
      const Eigen::Vector3d at(shape->GetPoint(k));
      shape->GetPoints()->SetPoint(k, at.x() + kAway, at.y(), at.z());
    }
    return shape;
  };
  const SeenLines seen({{moved(plate(1.0)), 0.0, 1.0}}, view);
  const std::vector<Span> spans = spansOf(seen, *moved(along(0.0, 0.0)), 0.0);
  ASSERT_EQ(spans.size(), 2);
  EXPECT_NEAR(spans[0].end, kAway - 1.0, 0.01 * kOfEnd);
}

}  // namespace
}  // namespace burnish
