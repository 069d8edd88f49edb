#include <gmock/gmock.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "engine/core/error.h"
#include "engine/nurbs/shapes.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "tests/engine/analysis/model_samples.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Cuts, slices and mirrors of a body in space, and tools of every shape, as those of contour_image_test.cpp.
namespace burnish {
namespace {

using samples::Sample;

const ColorScale kCubeScale("viridis", {0.0, 3.0}, 0);  // of the cube's field x + y + z

class SpaceImage : public ContourPictures {};

/// A quarter of a block under a quarter of a ball.
Sample quarterBlock() {
  Sample sample = samples::cube();
  sample.model.title = "Block";
  sample.model.tools = {{"ball", Sphere{{0.0, 1.5, 0.0}, 0.5}}};
  Eigen::MatrixXd shear = Eigen::MatrixXd::Zero(6, sample.model.mesh.numNodes);
  shear.row(3) = sample.model.mesh.patches.front().points.row(0);
  sample.frame.fields["stress"] = {{"xx", "yy", "zz", "xy", "yz", "zx"}, "MPa", shear};
  return sample;
}

TEST_F(SpaceImage, CutShowsTheFieldInside) {
  ContourOptions options = small("pressure");
  options.cut = CutPlane{{0.0, 0.0, 0.4}, {0.0, 0.0, 1.0}};
  options.knots = true;
  const Picture picture = expectBaseline(samples::cube(), options, "cube_cut");
  options.knots = false;
  const Picture plain = drawn(samples::cube(), options);
  for (const double x : {0.1, 0.55, 0.9})
    for (const double y : {0.1, 0.45, 0.9})
      expectColor(plain, Eigen::Vector3d(x, y, 0.4), kCubeScale.color(x + y + 0.4));
  // The ball is cut too: its middle lies before the plane.
  expectColor(picture, Eigen::Vector3d(0.5, 1.25, 0.4), options.theme.tool);
}

/// One of its faces has shrunk to a point, another one to a line: there is no normal there.
TEST_F(SpaceImage, CollapsedFacesHaveLight) {
  const KnotVector knots = KnotVector::uniform(2, 2);
  const Patch<3> octant = refined(ballOctant({0, 0, 0}, 1.0, {0, 1, 0}), {knots, knots, knots});
  Sample sample{samples::modelOf(octant), {}};
  sample.frame.displacement = Eigen::MatrixXd::Zero(3, sample.model.mesh.numNodes);
  sample.frame.toolDisplacement = Eigen::MatrixXd::Zero(3, 0);
  sample.frame.fields["pressure"] = {{}, "", octant.points().row(1)};
  ContourOptions options = small("pressure");
  options.range = {0.0, 1.0};
  options.view = {.name = "xy"};
  const Picture picture = drawn(sample, options);
  const Color found = picture.at(view.area.center());
  EXPECT_NE(found, options.theme.paper);
}

/// On a face that looks at the eye, which light leaves as it is, and inside the body.
TEST_F(SpaceImage, HasTheExactColourInEveryPixelAtAnyZoom) {
  Sample sample = samples::cube(2);
  sample.frame.displacement.setZero();
  Eigen::MatrixXd& product =
      sample.frame.fields["pressure"].values;  // 4 x y z: a knot span has no better cells
  product = 4.0 * sample.model.mesh.patches.front().points.colwise().prod();
  const ColorScale scale("viridis", {0.0, 4.0}, 0);
  ContourOptions options = small("pressure");
  options.tools = options.occlusion = options.undeformed = false;
  options.view = {.name = "xy"};
  options.range = {0.0, 4.0};
  for (const double z : {1.0, 0.6}) {
    options.slice.reset();
    if (z < 1.0) options.slice = CutPlane{{0.0, 0.0, z}, {0.0, 0.0, 1.0}};
    for (const double size : {1.0, 0.1, 0.01}) {
      const Eigen::Vector2d corner(0.9 - 0.9 * size, 0.8 - 0.8 * size);
      options.window = {corner, corner + size * Eigen::Vector2d(1.0, 1.0)};
      const Picture picture = drawn(sample, options);
      const Eigen::Vector2d half(view.area.width / 2 - 3, view.area.height / 2 - 3);
      int worst = 0, looked = 0;
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
          const Eigen::Vector2d pixel(x + 0.5, y + 0.5), fromMiddle = pixel - view.area.center();
          const Eigen::Vector2d at = options.window->center() + fromMiddle / view.pixelsPerLength;
          const double margin = 3.0 / view.pixelsPerLength;
          if ((at.array() < margin).any() || (at.array() > 1.0 - margin).any()) continue;
          if ((fromMiddle.cwiseAbs().array() > half.array()).any()) continue;
          ++looked;
          worst = std::max(worst, difference(picture.at(pixel), scale.color(4.0 * at.x() * at.y() * z)));
        }
      EXPECT_GT(looked, 20000);
      EXPECT_LE(worst, 4) << z << " " << size;  // a step of the colours is up to 3 of 255
    }
  }
}

/// Before the origin and behind it, as the eye sees it.
TEST_F(SpaceImage, OfABodyFarFromTheOriginIsTheSame) {
  const Picture near = drawn(samples::cube(), small("pressure"));
  for (const double far : {-1024.0, 1024.0}) {
    Sample sample = samples::cube();
    sample.model.mesh.patches.front().points.array() += far;
    std::get<Sphere>(sample.model.tools.front().shape).center.array() += far;
    const Picture picture = drawn(sample, small("pressure"));
    int worst = 0;
    for (int y = 0; y < near.height; ++y)
      for (int x = 0; x < near.width; ++x) {
        const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
        worst = std::max(worst, difference(near.at(pixel), picture.at(pixel)));
      }
    EXPECT_LE(worst, 2) << far;
  }
}

TEST_F(SpaceImage, CutThroughTheWholeRemovesTheHalfOfTheEye) {
  ContourOptions options = small("pressure");
  options.tools = false;
  for (const double sign : {-1.0, 1.0}) {
    options.cut = CutPlane{{0.5, 0.5, 0.5}, {0.3 * sign, 0.2 * sign, sign}};
    const Picture picture = drawn(samples::cube(), options);
    expectColor(picture, Eigen::Vector3d(0.5, 0.5, 0.5), kCubeScale.color(1.5));
  }
}

TEST_F(SpaceImage, SliceIsTheFieldOnAPlane) {
  ContourOptions options = small("pressure");
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 2.0}};
  const Picture picture = expectBaseline(samples::cube(), options, "cube_slice");
  EXPECT_EQ(view.towardsEye(), Eigen::Vector3d(0, 0, 1));
  for (const double x : {0.1, 0.4, 0.9})
    for (const double y : {0.1, 0.45, 0.9})
      expectColor(picture, Eigen::Vector3d(x, y, 0.5), kCubeScale.color(x + y + 0.5));
  expectColor(picture, Eigen::Vector3d(0.5, 1.25, 0.5), options.theme.tool);
  expectColor(picture, Eigen::Vector3d(0.9, 1.25, 0.5), options.theme.paper);
}

TEST_F(SpaceImage, SliceInAFaceOfTheBodyIsThatFace) {
  ContourOptions options = small("pressure");
  for (const double z : {0.0, 1.0 / 3.0, 1.0}) {
    options.slice = CutPlane{{0.0, 0.0, z}, {0.0, 0.0, 1.0}};
    const Picture picture = drawn(samples::cube(), options);
    expectColor(picture, Eigen::Vector3d(0.3, 0.6, z), kCubeScale.color(0.9 + z));
  }
}

TEST_F(SpaceImage, MirrorMakesAQuarterWhole) {
  ContourOptions options = small("pressure");
  options.mirror = {{0, 0.0}, {2, 0.0}};
  expectBaseline(quarterBlock(), options, "block_mirrored");
  options.slice = CutPlane{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  options.tools = false;
  const Picture picture = drawn(quarterBlock(), options);
  for (const double x : {-0.8, -0.3, 0.02, 0.7})
    expectColor(picture, Eigen::Vector3d(x, 0.5, 0.0), kCubeScale.color(std::abs(x) + 0.5));
}

TEST_F(SpaceImage, ComponentsHaveTheirSignBeyondAMirror) {
  ContourOptions options = small("stress.xy");
  options.tools = false;
  options.mirror = {{0, 0.0}};
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  const Picture picture = drawn(quarterBlock(), options);
  const ColorScale scale("coolwarm", {-1.0, 1.0}, 0);
  for (const double x : {-0.8, -0.3, 0.4, 0.7})
    expectColor(picture, Eigen::Vector3d(x, 0.5, 0.5), scale.color(x));
}

TEST_F(SpaceImage, ToolLetsTheBodyShineThroughUnlessItIsOpaque) {
  ContourOptions options = small("pressure");
  options.view.name = "0,1,0.2";
  const Eigen::Vector3d top(0.5, 1.5, 0.5);
  const Color through = drawn(samples::cube(), options).at(view.pixel(top));
  options.toolOpacity = 1.0;
  const Color solid = drawn(samples::cube(), options).at(view.pixel(top));
  const auto spread = [](const Color& c) {
    return std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]});
  };
  EXPECT_LE(spread(solid), 2);
  EXPECT_GE(spread(through), 40);
}

/// Both sides of a tool are seen through each other, whether or not something of the picture has no body behind it.
TEST_F(SpaceImage, ToolHasTheSameColourWhereABodyFillsThePicture) {
  ContourOptions options = small("pressure");
  options.view.name = "0,1,0";
  const std::vector<Eigen::Vector3d> points{{0.4, 1.0, 0.4}, {0.5, 1.0, 0.55}, {0.65, 1.0, 0.6}};
  const auto colours = [&](bool tools) {
    options.tools = tools;
    const Picture picture = drawn(samples::cube(), options);
    std::vector<Color> result;
    for (const Eigen::Vector3d& point : points) result.push_back(picture.at(view.pixel(point)));
    return result;
  };
  const std::vector<Color> whole = colours(true), bare = colours(false);
  const Eigen::Vector2d middle = view.axes * Eigen::Vector3d(0.5, 1.0, 0.5), half(0.15, 0.15);
  options.window = {middle - half, middle + half};
  const std::vector<Color> part = colours(true);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(part[k][c], whole[k][c], 2) << k;
      EXPECT_GE(std::abs(part[k][1] - bare[k][1]), 20) << k;
    }
}

/// The block shades nothing of itself but stands on the ground; a ball near it takes light from its upper face.
TEST_F(SpaceImage, OcclusionDarkensTheGroundAndWhatIsNear) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.toolOpacity = 1.0;
  options.occlusion = false;
  const Picture without = drawn(sample, options);
  options.occlusion = true;
  const Picture with = drawn(sample, options);
  const Color paper = options.theme.paper;
  const Eigen::Vector3d ground(0.4, 0.0, 1.15), front(0.4, 0.5, 1.0), nearBall(0.85, 1.0, 0.6);
  EXPECT_EQ(without.at(view.pixel(ground)), paper);
  EXPECT_LT(with.at(view.pixel(ground))[0], paper[0] - 15);
  EXPECT_EQ(with.at(view.pixel(front)), without.at(view.pixel(front)));
  const Color lit = without.at(view.pixel(nearBall)), dim = with.at(view.pixel(nearBall));
  EXPECT_LT(dim[1], lit[1] - 10);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_GE(dim[c], std::floor(0.55 * lit[c])) << "colours stay readable";
  // From below nothing stands on a ground.
  options.view.name = "1,-1,1";
  drawn(sample, options);
  EXPECT_EQ(readPicture(dir / "drawn.png").at({20.0, 150.0}), paper);
}

/// Lines lie on the facets whose borders they are, and no facet hides a part of them.
TEST_F(SpaceImage, EdgesAreUnbroken) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.tools = false;
  options.undeformed = true;
  const Picture picture = drawn(sample, options);
  const auto darkestNear = [&](const Eigen::Vector2d& pixel) {
    int darkest = 255;
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0}) {
        const Color found = picture.at(pixel + Eigen::Vector2d(x, y));
        darkest = std::min<int>(darkest, *std::max_element(found.begin(), found.end()));
      }
    return darkest;
  };
  const auto expectLine = [&](const Eigen::Vector3d& begin, const Eigen::Vector3d& end) {
    for (double s = 0.02; s < 0.99; s += 0.01)
      EXPECT_LT(darkestNear(view.pixel(begin + s * (end - begin))), 110) << s;
  };
  expectLine({0.0, 1.0, 1.0}, {1.0, 1.0, 1.0});
  expectLine({1.0, 1.0, 0.0}, {1.0, 1.0, 1.0});
  expectLine({1.0, 0.0, 1.0}, {1.0, 1.0, 1.0});
}

/// On a saddle, whose facets are not plane.
TEST_F(SpaceImage, KnotLinesAreUnbroken) {
  Sample sample = samples::cube();
  const auto height = [](double x, double z) { return 0.6 * (std::pow(x - 0.5, 2) - std::pow(z - 0.5, 2)); };
  const Eigen::MatrixXd& points = sample.model.mesh.patches.front().points;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    sample.frame.displacement(1, k) = height(points(0, k), points(2, k));
  ContourOptions options = small("pressure");
  options.tools = false;
  options.undeformed = false;
  const Picture without = drawn(sample, options);
  options.knots = true;
  const Picture with = drawn(sample, options);
  for (double z = 0.12; z < 0.95; z += 0.01) {  // behind it the saddle turns away from the eye
    const Eigen::Vector2d pixel = view.pixel(Eigen::Vector3d(1.0 / 3.0, 1.0 + height(1.0 / 3.0, z), z));
    int most = 0;
    for (double dy = -3.0; dy <= 3.0; ++dy)
      most = std::max(most, difference(with.at(pixel + Eigen::Vector2d(0.0, dy)),
                                       without.at(pixel + Eigen::Vector2d(0.0, dy))));
    EXPECT_GT(most, 12) << z;
  }
}

TEST_F(SpaceImage, HiddenLinesAreDashedAndLeaveTheOthersAlone) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.tools = false;
  const Picture without = drawn(sample, options);
  options.hiddenLines = HiddenLines::Dashed;
  const Picture with = drawn(sample, options);
  const auto changed = [&](const Eigen::Vector3d& begin, const Eigen::Vector3d& end) {
    int count = 0;
    for (double s = 0.05; s < 0.95; s += 0.01) {
      const Eigen::Vector2d pixel = view.pixel(begin + s * (end - begin));
      int most = 0;
      for (const double x : {-1.0, 0.0, 1.0})
        most = std::max(most, difference(with.at(pixel + Eigen::Vector2d(x, 0.0)),
                                         without.at(pixel + Eigen::Vector2d(x, 0.0))));
      if (most > 20) ++count;
    }
    return count;
  };
  const int dashes = changed({0.0, 0.0, 0.0}, {0.0, 0.99, 0.0});
  EXPECT_GT(dashes, 35);
  EXPECT_LT(dashes, 80);
  EXPECT_EQ(changed({1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}), 0);
}

/// Light, shade, layers and dashes do not know of the strips in which a large picture is drawn.
TEST_F(SpaceImage, IsTheSameInStrips) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.size = {900, 700};
  options.hiddenLines = HiddenLines::Dashed;
  expectStripsAlike(sample, options);
}

TEST_F(SpaceImage, MistakesAreTold) {
  ContourOptions options = small("pressure");
  options.cut = CutPlane{{0.0, 0.0, 1.5}, {0.0, 0.0, 1.0}};
  expectRefused(samples::cube(), options,
                "cut: its plane misses the body, which in frame 0 reaches from (0, 0, 0)");
  options.slice = options.cut;
  expectRefused(samples::cube(), options, "exclude each other");
  options = small("pressure");
  options.cut = CutPlane{{0.5, 0.5, 0.5}, {0.0, 0.0, 1.0}};
  options.view.name = "yz";
  expectRefused(samples::cube(), options, "edge-on");
  options = small("pressure");
  options.mirror = {{0, 0.5}};
  expectRefused(samples::cube(), options,
                "mirror: found the plane x = 0.5; the undeformed body goes from x = 0");
  options.mirror = {{2, 0.0}};
  expectRefused(samples::square(), options,
                "mirror: found \"z\"; allowed in two dimensions: planes of x and y.");
  options.mirror = {{0, 1.0}};
  expectRefused(samples::square(), options, "no plane of symmetry");  // it is sheared
  options = small("von_mises");
  options.hiddenLines = HiddenLines::Dashed;
  expectRefused(samples::ring(), options, "hidden_lines: a plane body hides none of its lines");
  options = small("von_mises");
  options.slice = CutPlane{};
  expectRefused(samples::ring(), options, "slice: found a plane through a plane body");
}

/// A pyramid that stands on its tip in the middle of the cube's upper face.
SurfaceMesh pyramid() {
  SurfaceMesh mesh;
  mesh.points.resize(3, 5);
  mesh.points << 0.5, 0.1, 0.9, 0.9, 0.1,  //
      1.0, 1.5, 1.5, 1.5, 1.5,             //
      0.5, 0.1, 0.1, 0.9, 0.9;
  mesh.cells.resize(3, 6);
  mesh.cells << 0, 0, 0, 0, 1, 1,  //
      1, 2, 3, 4, 4, 3,            //
      2, 3, 4, 1, 3, 2;
  mesh.closed = true;
  return mesh;
}

TEST_F(SpaceImage, ToolOfTrianglesHasItsEdgesAndSections) {
  Sample sample = samples::cube();
  sample.model.tools = {{"pyramid", pyramid()}};
  ContourOptions options = small("pressure");
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  const Picture section = drawn(sample, options);
  expectColor(section, Eigen::Vector3d(0.5, 1.3, 0.5), options.theme.tool);
  expectColor(section, Eigen::Vector3d(0.7, 1.4, 0.5), options.theme.tool);
  expectColor(section, Eigen::Vector3d(0.75, 1.2, 0.5), options.theme.paper);

  options.slice.reset();
  const Picture whole = expectBaseline(sample, options, "cube_pyramid");
  for (const double s : {0.3, 0.7}) {
    const Eigen::Vector3d edge(0.5 + 0.4 * s, 1.0 + 0.5 * s, 0.5 + 0.4 * s);
    EXPECT_LT(whole.at(view.pixel(edge))[0], 150) << s;
  }
}

/// The tool of the slab as segments in no order, the tool on their left: a frame of x0 ... x1, y0 ... y1.
SurfaceMesh frameMesh(bool closed) {
  SurfaceMesh mesh;
  mesh.points.resize(3, 8);
  mesh.points << 1.0, 2.0, 2.0, 1.0, 1.3, 1.7, 1.7, 1.3,  //
      0.9, 0.9, 1.5, 1.5, 1.1, 1.1, 1.3, 1.3,             //
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  mesh.cells.resize(2, 8);
  mesh.cells << 2, 0, 4, 3, 1, 7, 5, 6,  //
      3, 1, 7, 0, 2, 6, 4, 5;
  mesh.closed = closed;
  return mesh;
}

TEST_F(SpaceImage, PlaneToolOfSegmentsIsFilledAroundItsHole) {
  Sample sample = samples::slab();
  sample.model.tools.front().shape = frameMesh(true);
  const ContourOptions options = small("plastic_strain");
  const Picture picture = expectBaseline(sample, options, "slab_frame");
  const double lowered = -0.15;
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(1.15, 1.2), {1.85, 1.2}, {1.5, 1.06}, {1.5, 1.4}})
    expectColor(picture, x + Eigen::Vector2d(0.0, lowered), options.theme.tool);
  expectColor(picture, Eigen::Vector2d(1.5, 1.2 + lowered), options.theme.paper);
  expectColor(picture, Eigen::Vector2d(0.8, 1.2 + lowered), options.theme.paper);
}

TEST_F(SpaceImage, OpenToolIsHatchedOnItsSide) {
  Sample sample = samples::slab();
  SurfaceMesh die;  // goes to the left, then up: the tool is below, then at the left
  die.points = Eigen::Matrix3d{{3.4, -0.2, -0.2}, {0.0, 0.0, 1.4}, {0.0, 0.0, 0.0}};
  die.cells = Eigen::Matrix2i{{0, 1}, {1, 2}};
  sample.model.tools.front().shape = die;
  sample.frame.toolDisplacement.setZero();
  ContourOptions options = small("plastic_strain");
  options.undeformed = false;
  const Picture picture = expectBaseline(sample, options, "slab_die");
  const auto inkAlong = [&](const Eigen::Vector2d& begin, const Eigen::Vector2d& end) {
    int ink = 0;
    for (double s = 0.0; s <= 1.0; s += 1.0 / 256)
      ink += picture.at(view.pixel(begin + s * (end - begin)))[0] < 225 ? 1 : 0;
    return ink;
  };
  EXPECT_GT(inkAlong({0.0, -0.05}, {3.0, -0.05}), 10);
  EXPECT_EQ(inkAlong({-0.15, 0.2}, {-0.15, 1.3}), 0);
  // A pixel and a half from where the strokes end: they are four pixels long.
  EXPECT_GT(inkAlong({-0.235, 0.2}, {-0.235, 1.3}), 5);
}

TEST_F(SpaceImage, DieIsHatchedAroundTheBody) {
  Sample sample = samples::slab();
  SurfaceMesh die;  // clockwise, each segment with points of its own
  die.points = Eigen::Matrix<double, 3, 8>{{-0.5, -0.5, -0.5, 3.5, 3.5, 3.5, 3.5, -0.5},
                                           {-0.3, 1.4, 1.4, 1.4, 1.4, -0.3, -0.3, -0.3},
                                           {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
  die.cells = Eigen::Matrix<int, 2, 4>{{0, 2, 4, 6}, {1, 3, 5, 7}};
  die.closed = true;
  sample.model.tools.front().shape = die;
  sample.frame.toolDisplacement.setZero();
  const ContourOptions options = small("plastic_strain");
  const Picture picture = drawn(sample, options);
  expectColor(picture, Eigen::Vector2d(-0.25, 0.5), options.theme.paper);
  for (const double y : {-0.33, 1.43}) {
    int ink = 0;
    for (double x = 0.0; x <= 3.0; x += 0.01)
      ink += picture.at(view.pixel(Eigen::Vector2d(x, y)))[0] < 225 ? 1 : 0;
    EXPECT_GT(ink, 10) << y;
  }
}

TEST_F(SpaceImage, DiscThatHasTurnedShowsItsRadius) {
  Sample sample = samples::slab();
  sample.model.tools.front().pivot = {1.5, 1.5, 0.0};
  sample.frame.toolAngle = Eigen::VectorXd::Constant(1, -0.7);
  const ContourOptions options = small("plastic_strain");
  const Picture picture = expectBaseline(sample, options, "slab_turned");
  const Eigen::Vector2d center(1.5, 1.35), upright(std::sin(0.7), std::cos(0.7));
  EXPECT_LT(picture.at(view.pixel(center + 0.3 * upright))[0], 190);
  expectColor(picture, center - 0.3 * upright, options.theme.tool);
  sample.frame.toolAngle.setZero();
  expectColor(drawn(sample, options), center + 0.3 * upright, options.theme.tool);
}

TEST_F(SpaceImage, OnlyTheNearPartOfALargeToolMustBeSeen) {
  Sample sample = samples::slab();
  SurfaceMesh wedge;
  wedge.points = Eigen::Matrix3d{{-60.0, 1.5, 60.0}, {60.0, 1.0, 60.0}, {0.0, 0.0, 0.0}};
  wedge.cells = Eigen::Matrix<int, 2, 3>{{0, 1, 2}, {1, 2, 0}};
  wedge.closed = true;
  sample.model.tools.front().shape = wedge;
  const ContourOptions options = small("plastic_strain");
  const Picture picture = drawn(sample, options);
  EXPECT_GT(view.pixelsPerLength, 60.0);
  expectColor(picture, Eigen::Vector2d(1.5, 1.2), options.theme.tool);
}

/// Whether a tool is shown whole does not depend on the signs beside the body, however far it reaches.
TEST_F(SpaceImage, SignsOfExtremesLeaveTheScaleAsItIs) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.occlusion = options.undeformed = false;
  for (double radius = 0.2; radius < 0.8; radius *= 1.04) {
    sample.model.tools = {{"ball", Sphere{{0.5, 1.0 + radius, 0.5}, radius}}};
    options.markExtremes = false;
    const double without = contourImage(sample.model, sample.frame, options).view.pixelsPerLength;
    options.markExtremes = true;
    EXPECT_NEAR(contourImage(sample.model, sample.frame, options).view.pixelsPerLength / without, 1.0, 0.12)
        << radius;
  }
}

/// The front has bulged towards the eye by some hundredths, and the edge along its top has gone up.
TEST_F(SpaceImage, UndeformedEdgesOverABulgingFaceAreWhole) {
  Sample sample = samples::cube();
  const Eigen::MatrixXd& points = sample.model.mesh.patches.front().points;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    sample.frame.displacement(1, k) = 0.3 * points(1, k);
    sample.frame.displacement(2, k) = 0.12 * points(0, k) * (1.0 - points(0, k)) * points(2, k);
  }
  ContourOptions options = small("pressure");
  options.tools = options.occlusion = false;
  options.undeformed = false;
  const Picture without = drawn(sample, options);
  options.undeformed = true;
  const Picture with = drawn(sample, options);
  for (double x = 0.05; x < 0.96; x += 0.01) {
    const Eigen::Vector2d pixel = view.pixel(Eigen::Vector3d(x, 1.0, 1.0));
    int most = 0;
    for (double dy = -2.0; dy <= 2.0; ++dy)
      most = std::max(most, difference(with.at(pixel + Eigen::Vector2d(0.0, dy)),
                                       without.at(pixel + Eigen::Vector2d(0.0, dy))));
    EXPECT_GT(most, 12) << x;
  }
}

/// What is symmetric about the middle of the picture looks so.
TEST_F(SpaceImage, LeftAndRightAreLitAlike) {
  Sample sample = samples::cube();
  sample.frame.displacement *= 0.0;
  sample.model.tools = {{"ball", Sphere{{0.5, 1.6, 0.5}, 0.5}}};
  ContourOptions options = small("pressure");
  options.undeformed = options.occlusion = false;
  options.toolOpacity = 1.0;
  options.view.name = "0,0.5,1";
  const Picture picture = drawn(sample, options);
  for (const double x : {0.1, 0.2, 0.35})
    for (const double y : {1.4, 1.6, 1.9}) {
      const double depth = 0.5 + std::sqrt(0.25 - x * x - std::pow(y - 1.6, 2));
      const auto at = [&](double side) {
        return picture.at(view.pixel(Eigen::Vector3d(0.5 + side * x, y, depth)));
      };
      EXPECT_LE(difference(at(-1.0), at(1.0)), 1) << x << " " << y;
    }
}

/// On a white page the edge of a picture whose corners are grey would be seen.
TEST_F(SpaceImage, ShadowsEndBeforeTheBorderOfThePicture) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  options.size = {300, 200};
  options.tools = options.undeformed = options.colorScale = false;
  const Picture picture = drawn(sample, options);
  for (int x = 0; x < 300; ++x)
    for (const double y : {0.5, 199.5}) EXPECT_EQ(picture.at({x + 0.5, y}), options.theme.paper) << x;
  for (int y = 0; y < 200; ++y)
    for (const double x : {0.5, 299.5}) EXPECT_EQ(picture.at({x, y + 0.5}), options.theme.paper) << y;
}

/// Edges before and after: a wavy one is drawn from where it leaves itself to where it meets itself again, in one piece; one that has
/// moved little is not drawn at all.
TEST(MovedLines, AreDrawnInOnePiece) {
  constexpr int kCount = 41;
  const auto edges = [&](double amplitude) {
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, kCount), moved = points;
    for (int k = 0; k < kCount; ++k) {
      points(0, k) = k;
      moved(1, k) = k < 10 ? 0.0 : amplitude * std::sin(0.7 * (k - 10));
    }
    PolyBuilder builder;
    builder.addLine(builder.addPoints(points));
    const auto lines = builder.finish();
    lines->GetPointData()->AddArray(makeArray(kMoved, moved, {}));
    return lines;
  };
  View view;
  view.axes << 1, 0, 0, 0, 1, 0;
  view.pixelsPerLength = 1.0;
  const auto drawn = movedLines(*edges(8.0), view, 1.5);
  ASSERT_EQ(drawn->GetNumberOfLines(), 1);
  EXPECT_EQ(drawn->GetLines()->GetNumberOfConnectivityIds(), kCount - 10);
  EXPECT_EQ(movedLines(*edges(4.0), view, 1.5)->GetNumberOfLines(), 0);
}

/// A line through both arms of a U in its plane.
TEST(LinesOfBodies, EndWhereASurfaceLiesBeforeThem) {
  PolyBuilder shape, through;
  Eigen::Matrix2Xd corners(2, 8), ends(2, 3);
  corners << 100, 200, 200, 160, 160, 140, 140, 100, 0, 0, 60, 60, 20, 20, 60, 60;
  ends << 0, 170, 300, 40, 40, 40;
  shape.addPolygon(shape.addPoints(corners));
  through.addLine(through.addPoints(ends));
  View view;
  view.axes << 1, 0, 0, 0, 1, 0;
  view.pixelsPerLength = 1.0;
  view.area = {-1000.0, -1000.0, 2000.0, 2000.0};  // about 0
  const auto drawn = besideSurfaces(*through.finish(), {shape.finish()}, view);
  vtkNew<vtkIdList> ids;
  std::vector<double> places;
  for (vtkIdType line = 0; line < drawn->GetNumberOfLines(); ++line) {
    drawn->GetLines()->GetCellAtId(line, ids);
    for (const vtkIdType end : {ids->GetId(0), ids->GetId(ids->GetNumberOfIds() - 1)})
      places.push_back(drawn->GetPoint(end)[0]);
  }
  EXPECT_THAT(places, testing::Pointwise(testing::DoubleNear(1.0), {0.0, 100.0, 140.0, 160.0, 200.0, 300.0}));
  view.pixelsPerLength = 1e6;  // what is not seen takes no time
  for (const auto& [x, numLines] : {std::pair(150.0, 1), {120.0, 0}}) {
    view.center = {x, 40.0};
    EXPECT_EQ(besideSurfaces(*through.finish(), {shape.finish()}, view)->GetNumberOfLines(), numLines) << x;
  }
}

}  // namespace
}  // namespace burnish
