#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "postproc/draw/contour/scale_bar.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/draw/contour_fixture.h"

/// How bodies in space are seen: perspective, scale bars, hatched sections, crosses of stress.
namespace burnish {
namespace {

using samples::Sample;

class EyeImage : public ContourPictures {
 protected:
  static ContourOptions cubeAlone() {
    ContourOptions options = small("pressure");
    options.tools = false;
    options.occlusion = false;
    options.undeformed = false;
    return options;
  }

  /// The darkest pixel of the nine round a place.
  static int darkestNear(const Picture& picture, const Eigen::Vector2d& pixel) {
    int darkest = 255;
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0}) {
        const Color found = picture.at(pixel + Eigen::Vector2d(x, y));
        darkest = std::min<int>(darkest, *std::max_element(found.begin(), found.end()));
      }
    return darkest;
  }
};

/// An eye over the middle of the cube's front face sees the face at true size, and the back, at distance H + 1 instead
/// of H, smaller by H/(H+1): H = 1/2 / tan(angle/2).
TEST_F(EyeImage, PerspectiveIsThatOfAnEye) {
  ContourOptions options = cubeAlone();
  options.view.name = "xy";
  options.perspective = 60.0;
  drawn(samples::cube(), options);
  const double distance = 0.5 * std::sqrt(3.0);
  ASSERT_TRUE(view.eye);
  EXPECT_NEAR(view.eye->distance, distance, 1e-9);
  const Eigen::Vector2d middle = view.pixel(Eigen::Vector3d(0.5, 0.5, 0.3)),
                        front = view.pixel(Eigen::Vector3d(1.0, 1.0, 1.0)) - middle,
                        back = view.pixel(Eigen::Vector3d(1.0, 1.0, 0.0)) - middle;
  EXPECT_NEAR(front.x(), 0.5 * view.pixelsPerLength, 1e-6);
  EXPECT_NEAR(back.y(), front.y() * distance / (distance + 1.0), 1e-6);
}

/// What is drawn is where `View::pixel` says, also edges, marks and what a window leaves.
TEST_F(EyeImage, PerspectivePutsEverythingInItsPlace) {
  ContourOptions options = cubeAlone();
  options.perspective = 50.0;
  options.size = {600, 450};
  options.markExtremes = true;
  const Picture whole = expectBaseline(samples::cube(), options, "cube_perspective");
  const ColorScale scale("viridis", {0.0, 3.0}, 0);
  const auto expectCube = [&](const Picture& picture, double least) {
    for (double s = least; s < 0.97; s += 0.01) {
      EXPECT_LT(darkestNear(picture, view.pixel(Eigen::Vector3d(s, 1.0, 1.0))), 120) << s;
      EXPECT_LT(darkestNear(picture, view.pixel(Eigen::Vector3d(1.0, s, 1.0))), 120) << s;
    }
  };
  expectCube(whole, 0.03);
  // Isolines of the field end on edges: the sign of the largest value stands on its corner.
  EXPECT_EQ(whole.at(view.pixel(Eigen::Vector3d(1.0, 1.0, 1.0))), (Color{255, 255, 255}));
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), {1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}}) {
    const Eigen::Vector2d pixel = view.pixel(corner);
    EXPECT_GT(pixel.x(), view.area.x);
    EXPECT_LT(pixel.x(), view.area.right());
    EXPECT_GT(pixel.y(), view.area.y);
    EXPECT_LT(pixel.y(), view.area.top());
  }
  options.markExtremes = false;
  options.view.name = "xy";
  const Picture face = drawn(samples::cube(), options);
  for (const double x : {0.1, 0.4, 0.9})
    for (const double y : {0.15, 0.45, 0.9})
      expectColor(face, Eigen::Vector3d(x, y, 1.0), scale.color(1.0 + x + y));
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(1.1, 1.1));
  const Picture zoomed = drawn(samples::cube(), options);
  for (const double x : {0.6, 0.9})
    for (const double y : {0.55, 0.9})
      expectColor(zoomed, Eigen::Vector3d(x, y, 1.0), scale.color(1.0 + x + y));
}

/// From near by as from far away, a ball before a bar, which is seen smaller than the ball.
TEST_F(EyeImage, PerspectiveShowsABallWhole) {
  Sample sample = samples::cube();
  sample.model.mesh.patches.front().points =
      Eigen::Vector3d(2.0, 0.5, 0.5).asDiagonal() * sample.model.mesh.patches.front().points;
  const Sphere ball{{1.4, 0.8, 1.0}, 0.47};
  sample.model.tools = {{"ball", ball}};
  ContourOptions options = cubeAlone();
  options.tools = true;
  for (const std::optional<double> angle : {std::optional<double>(), {40.0}, {90.0}, {120.0}}) {
    options.perspective = angle;
    drawn(sample, options);
    const Eigen::AlignedBox2d seen(Eigen::Vector2d(view.area.x, view.area.y),
                                   Eigen::Vector2d(view.area.right(), view.area.top()));
    for (const Eigen::Index axis : {0, 1, 2})
      for (const double way : {-1.0, 1.0})
        EXPECT_TRUE(seen.contains(view.pixel(ball.center + way * ball.radius * Eigen::Vector3d::Unit(axis))))
            << angle.value_or(0.0) << ", axis " << axis;
  }
}

TEST_F(EyeImage, PerspectiveTendsToTheParallelProjection) {
  ContourOptions options = cubeAlone();
  const Picture parallel = drawn(samples::cube(), options);
  const Eigen::Vector2d corner = view.pixel(Eigen::Vector3d(0.0, 1.0, 0.0));
  double last = HUGE_VAL;
  for (const double angle : {30.0, 10.0, 2.0}) {
    options.perspective = angle;
    drawn(samples::cube(), options);
    const double off = (view.pixel(Eigen::Vector3d(0.0, 1.0, 0.0)) - corner).norm();
    EXPECT_LT(off, 0.5 * last);
    last = off;
  }
  EXPECT_LT(last, 3.0);
}

TEST_F(EyeImage, PerspectiveIsTheSameInStrips) {
  ContourOptions options = small("pressure");
  options.size = {900, 700};
  options.perspective = 40.0;
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(0.2, -0.3), Eigen::Vector2d(1.4, 0.9));
  options.hiddenLines = HiddenLines::Dashed;
  expectStripsAlike(samples::cube(), options);
}

TEST(ScaleBars, AreRound) {
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(1.99), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(0.03), 0.02);
  EXPECT_DOUBLE_EQ(roundLength(7e5), 5e5);
}

/// The longest run of ink in the lowest part of a picture is as long as the bar says: 0.5 of the ring of outer radius 2.
TEST_F(EyeImage, ScaleBarIsAsLongAsItSays) {
  ContourOptions options = small("von_mises");
  options.scaleBar = true;
  Sample sample = samples::ring();
  sample.model.lengthUnit = "mm";
  const Picture picture = expectBaseline(sample, options, "ring_scale_bar");
  const auto longestRun = [&](const Picture& of) {
    int longest = 0;
    for (double y = 0.5; y < view.area.y - 3.0; ++y) {
      int run = 0;
      for (double x = 0.5; x < 200.0; ++x) {
        run = of.at({x, y})[0] < 150 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    }
    return longest;
  };
  EXPECT_NEAR(longestRun(picture), 0.5 * view.pixelsPerLength, 1.5);
  drawContour(sample.model, sample.frame, options, dir / "drawn.svg");
  EXPECT_THAT(readText(dir / "drawn.svg"), testing::HasSubstr("0.5 mm"));
  options = cubeAlone();
  options.scaleBar = true;
  const Picture space = drawn(samples::cube(), options);
  EXPECT_NEAR(longestRun(space), 0.2 * view.pixelsPerLength, 1.5);
}

/// Lines that rise to the right: as many along a row of the section as fit in.
TEST_F(EyeImage, SectionIsHatched) {
  ContourOptions options = cubeAlone();
  options.cut = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  options.cutFace = CutFace::Hatch;
  options.size = {800, 600};
  const Picture picture = expectBaseline(samples::cube(), options, "cube_hatched");
  const Eigen::Vector2d begin = view.pixel(Eigen::Vector3d(0.03, 0.5, 0.5)),
                        end = view.pixel(Eigen::Vector3d(0.97, 0.5, 0.5));
  int lines = 0;
  bool onLine = false;
  const int steps = static_cast<int>(4.0 * (end - begin).norm());
  for (int k = 0; k <= steps; ++k) {
    const bool dark = picture.at(begin + (end - begin) * k / steps)[0] < 200;
    if (dark && !onLine) ++lines;
    onLine = dark;
  }
  const Eigen::Vector2d across = Eigen::Vector2d(1.0, -1.0) / std::sqrt(2.0);
  const double gap = 0.5 * 14.0;  // half of the text size
  EXPECT_NEAR(lines, std::abs(across.dot(end - begin)) / gap, 2.0);
}

/// The square under a uniform stress, undeformed.
Sample stressedSquare(double xx, double yy, double xy) {
  Sample sample = samples::square();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(4, sample.model.mesh.numNodes);
  stress.row(0).setConstant(xx);
  stress.row(1).setConstant(yy);
  stress.row(2).setConstant(xy);
  sample.frame.displacement.setZero();
  sample.frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", stress, {}};
  return sample;
}

ContourOptions crossesAlone() {
  ContourOptions options;
  options.field = "pressure";
  options.tools = false;
  options.undeformed = false;
  options.arrows = ArrowField::Principal;
  options.size = {600, 500};
  return options;
}

/// Tension along x and compression along y: white arrows that part, black ones that meet.
TEST_F(EyeImage, CrossesTellTensionFromCompression) {
  const Picture picture = expectBaseline(stressedSquare(2.0, -1.0, 0.0), crossesAlone(), "square_principal");
  int white = 0, black = 0;
  for (double x = view.area.x + 3.0; x < view.area.right() - 3.0; ++x)
    for (double y = view.area.y + 3.0; y < view.area.top() - 3.0; ++y) {
      const Color c = picture.at({x + 0.5, y + 0.5});
      white += *std::min_element(c.begin(), c.end()) > 245 ? 1 : 0;
      black += *std::max_element(c.begin(), c.end()) < 10 ? 1 : 0;
    }
  EXPECT_GT(white, 300);
  EXPECT_GT(black, 100);
}

/// The principal directions of pure shear are the diagonals: tension along one is compression along the other.
TEST_F(EyeImage, CrossesOfShearAreDiagonal) {
  const Picture picture = drawn(stressedSquare(0.0, 0.0, 1.0), crossesAlone());
  const Eigen::Vector2d middle = view.area.center();
  // The cross in the middle: bright along the rising diagonal, dark along the other.
  const auto brightest = [&](const Eigen::Vector2d& along) {
    int bright = 0;
    for (double way = 4.0; way < 30.0; ++way)
      for (const double sign : {-1.0, 1.0}) {
        const Color c = picture.at(middle + sign * way * along.normalized());
        bright = std::max<int>(bright, *std::min_element(c.begin(), c.end()));
      }
    return bright;
  };
  EXPECT_GT(brightest({1.0, 1.0}), 245);
  const Color body = picture.at(middle + Eigen::Vector2d(25.0, 0.0));
  EXPECT_LE(brightest({1.0, -1.0}), *std::max_element(body.begin(), body.end()));
}

TEST_F(EyeImage, CrossesLieOnBodiesInSpace) {
  Sample sample = samples::cube();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, sample.model.mesh.numNodes);
  stress.row(0) = sample.model.mesh.patches.front().points.row(1);
  stress.row(1).setConstant(-0.6);
  sample.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", stress, {}};
  ContourOptions options = cubeAlone();
  options.arrows = ArrowField::Principal;
  options.size = {800, 600};
  expectBaseline(sample, options, "cube_principal");
}

/// The largest stress is that of the lower face, which the eye does not see; the longest cross is that of the upper one.
TEST_F(EyeImage, LongestCrossIsTheLargestThatIsDrawn) {
  Sample sample = samples::cube();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, sample.model.mesh.numNodes);
  stress.row(0) = 9.0 - 6.0 * sample.model.mesh.patches.front().points.row(1).array();
  sample.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", stress, {}};
  ContourOptions options = cubeAlone();
  options.arrows = ArrowField::Principal;
  options.view = ViewName{"0,1,0"};
  drawContour(sample.model, sample.frame, options, dir / "drawn.svg");
  EXPECT_THAT(readText(dir / "drawn.svg"), testing::HasSubstr("up to 3;"));
}

/// No shear stress acts on a plane of symmetry, whatever is computed there.
TEST_F(EyeImage, CrossesStandUprightOnAPlaneOfSymmetry) {
  Sample sample = samples::cube();
  sample.frame.displacement.setZero();
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, sample.model.mesh.numNodes);
  stress.row(0).setConstant(2.0);
  stress.row(3).setConstant(0.5);
  sample.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", stress, {}};
  ContourOptions options = cubeAlone();
  options.arrows = ArrowField::Principal;
  options.mirror = {{0, 0.0}};
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  options.size = {700, 420};
  const Picture picture = drawn(sample, options);
  // Arrows are white: those on the axis have as many pixels above as below it on either side.
  const Eigen::Vector2d axis = view.pixel(Eigen::Vector3d(0.0, 0.5, 0.5));
  for (double x = 2.0; x < 20.0; ++x) {
    const auto white = [&](double dx) {
      double sum = 0.0;
      for (double y = view.area.y; y < view.area.top(); ++y) {
        const Color c = picture.at({axis.x() + dx, y + 0.5});
        sum += *std::min_element(c.begin(), c.end()) > 240 ? y : 0.0;
      }
      return sum;
    };
    EXPECT_EQ(white(x), white(-x)) << x;
  }
}

}  // namespace
}  // namespace burnish
