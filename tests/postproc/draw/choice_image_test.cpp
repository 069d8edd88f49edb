#include <gmock/gmock.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/error.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/value_parts.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/mesh/mirror.h"
#include "tests/postproc/draw/contour_fixture.h"

/// Parts of bodies that values choose, whose shapes are known: planes and spheres in a cube, rings in a ring.
namespace burnish {
namespace {

using samples::Sample;

/// The cube with `pressure` = x² + y² + z², which quadratic B-splines hold exactly.
Sample radialCube(int spans = 3) {
  Sample sample = samples::cube(spans);
  const double h = 1.0 / spans;
  const auto square = [&](double greville) {
    const bool atEnd = greville < 1e-12 || greville > 1.0 - 1e-12;
    return greville * greville - (atEnd ? 0.0 : h * h / 4.0);
  };
  const Eigen::MatrixXd& points = sample.model.mesh.patches.front().points;
  sample.frame.fields["pressure"].values = points.unaryExpr(square).colwise().sum();
  return sample;
}

/// Calls with the corners of the triangles of a surface; polygons are fans of them.
template <class Visit>
void forTriangles(vtkPolyData& surface, const Visit& visit) {
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface.GetNumberOfPolys(); ++cell) {
    surface.GetPolys()->GetCellAtId(cell, ids);
    const auto corner = [&](vtkIdType k) {
      return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(ids->GetId(k))));
    };
    for (vtkIdType k = 1; k + 1 < ids->GetNumberOfIds(); ++k) visit(corner(0), corner(k), corner(k + 1));
  }
}

double areaOf(vtkPolyData& surface) {
  double area = 0.0;
  forTriangles(surface, [&](const auto& a, const auto& b, const auto& c) {
    area += 0.5 * (b - a).cross(c - a).norm();
  });
  return area;
}

/// Of a closed surface whose triangles go round counterclockwise from outside; about another point it is another
/// one if there is a gap.
double volumeOf(vtkPolyData& surface, const Eigen::Vector3d& about) {
  double volume = 0.0;
  forTriangles(surface, [&](const auto& a, const auto& b, const auto& c) {
    volume += (a - about).dot((b - about).cross(c - about)) / 6.0;
  });
  return volume;
}

struct CubeOfValues {
  explicit CubeOfValues(const Sample& ofSample)
      : sample(ofSample), field(chooseField(sample.model, sample.frame, "pressure")) {}

  ValueVolume cut(int perSpan) const {
    return {sample.model.mesh, sample.frame.displacement, perSpan, field, field};
  }

  Sample sample;
  FieldChoice field;
};

constexpr double kSingle = 1e-7;  // VTK clips and cuts with values in single precision
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(ValueVolumes, SurfaceOfARadialFieldTendsToTheSphere) {
  const CubeOfValues cube(radialCube());
  const double radius = 0.8, value = radius * radius;
  const double exactArea = std::numbers::pi * value / 2.0,
               exactVolume = std::numbers::pi * value * radius / 6.0;
  double areaError = 0.0, volumeError = 0.0;
  for (const int perSpan : {2, 4, 8, 16}) {
    const ValueVolume volume = cube.cut(perSpan);
    const auto surface = volume.surfacesAt({value}), part = volume.surfaceBetween({-kInfinite, value});
    const double area = std::abs(areaOf(*surface) / exactArea - 1.0),
                 enclosed = std::abs(volumeOf(*part, {0.0, 0.0, 0.0}) / exactVolume - 1.0);
    EXPECT_NEAR(volumeOf(*part, {3.0, -2.0, 5.0}), volumeOf(*part, {0.0, 0.0, 0.0}), kSingle)
        << "it is closed";
    if (perSpan > 2) {
      EXPECT_LT(area, 0.3 * areaError) << "second order, " << perSpan << " cells per span";
      EXPECT_LT(enclosed, 0.3 * volumeError) << perSpan;
    }
    areaError = area;
    volumeError = enclosed;
    RecordProperty("area_" + std::to_string(perSpan), std::to_string(area));
    RecordProperty("volume_" + std::to_string(perSpan), std::to_string(enclosed));
  }
  EXPECT_LT(areaError, 3e-4);
  EXPECT_LT(volumeError, 6e-4);
}

TEST(ValueVolumes, NormalsOfSurfacesAreTheGradientDownwards) {
  const CubeOfValues cube(radialCube());
  const auto surface = cube.cut(4).surfacesAt({0.25, 0.64});
  vtkDataArray& normals = *surface->GetPointData()->GetNormals();
  ASSERT_GT(surface->GetNumberOfPoints(), 100);
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k) {
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(surface->GetPoint(k));
    const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3d>(normals.GetTuple3(k));
    EXPECT_LT((normal + x.normalized()).norm(), 0.01) << x.transpose();
  }
}

/// Beyond a plane of symmetry the field rises as it falls before it, whatever it is: no normal there points across, which patch it
/// may be of.
TEST(ValueVolumes, NormalsOnAPlaneOfSymmetryLieInIt) {
  Sample sample = samples::cube(3);
  Eigen::MatrixXd& values = sample.frame.fields["pressure"].values;
  for (Eigen::Index k = 0; k < values.cols(); ++k) values(0, k) = std::sin(3.0 * static_cast<double>(k));
  const ModelFrame whole = mirrored(sample.model, sample.frame, {{0, 0.0}});
  const FieldChoice field = chooseField(whole.model, whole.frame, "pressure");
  const ValueVolume volume(whole.model.mesh, whole.frame.displacement, 4, field, field);
  const auto surface = volume.surfacesAt({0.0});
  vtkDataArray& normals = *surface->GetPointData()->GetNormals();
  int onPlane = 0;
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
    if (std::abs(surface->GetPoint(k)[0]) < 1e-12) {
      EXPECT_NEAR(normals.GetTuple3(k)[0], 0.0, 1e-9);
      ++onPlane;
    }
  EXPECT_GT(onPlane, 50);
}

/// x + y + z = 3/2 is a regular hexagon that halves the cube, whatever the cells are.
TEST(ValueVolumes, PlaneThroughALinearFieldIsExact) {
  const CubeOfValues cube(samples::cube());
  for (const int perSpan : {1, 3}) {
    const ValueVolume volume = cube.cut(perSpan);
    EXPECT_NEAR(areaOf(*volume.surfacesAt({1.5})), 3.0 * std::sqrt(3.0) / 4.0, 1e-9);
    const auto upper = volume.surfaceBetween({1.5, kInfinite}), slab = volume.surfaceBetween({1.0, 2.0});
    EXPECT_NEAR(volumeOf(*upper, {5.0, 1.0, -3.0}), 0.5, 1e-9);
    EXPECT_NEAR(volumeOf(*slab, {5.0, 1.0, -3.0}), 1.0 - 2.0 / 6.0, 1e-9);
    EXPECT_NEAR(areaOf(*volume.sectionBetween({{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}}, {1.0, 2.0})), 0.75,
                kSingle);
  }
}

/// A body twice as long has twice the volume: parts are chosen in the body as it is drawn.
TEST(ValueVolumes, FollowTheDisplacements) {
  Sample sample = samples::cube();
  sample.frame.displacement.row(0) = sample.model.mesh.patches.front().points.row(0);
  const CubeOfValues cube(sample);
  EXPECT_NEAR(volumeOf(*cube.cut(2).surfaceBetween({-kInfinite, 1.0}), {1.0, 7.0, 0.0}), 2.0 / 6.0, 1e-9);
}

TEST(ValueVolumes, AreCutAsTheFieldAsks) {
  const Sample linear = samples::cube(), radial = radialCube();
  const auto cells = [](const Sample& sample, int least) {
    return volumeSubdivision(sample.model.mesh, sample.frame.displacement,
                             chooseField(sample.model, sample.frame, "pressure"), least);
  };
  EXPECT_EQ(cells(linear, 1), 1);
  EXPECT_EQ(cells(linear, 4), 4);
  // Off by 3 h²/4 with cells of size h = 1/(3 n), of a range of 3.
  EXPECT_EQ(cells(radial, 1), std::ceil(std::sqrt(3.0 / 4.0 / 9.0 / 3e-3)));
}

class ChoiceImage : public ContourPictures {};

/// von_mises = 100 (r - 1): from 30 to 60 is a ring of radii 1.3 and 1.6.
TEST_F(ChoiceImage, ThresholdInThePlaneEndsWhereTheFieldHasTheValue) {
  ContourOptions options = small("von_mises");
  options.size = {800, 600};
  options.threshold = ValueBand{"", {30.0, 60.0}};
  const Picture picture = expectBaseline(samples::ring(), options, "ring_threshold");
  const ColorScale scale("viridis", {0.0, 100.0}, 0);
  const double pixel = 1.0 / view.pixelsPerLength;
  for (const double angle : {0.1, 0.4, 0.8, 1.2, 1.5}) {
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    for (const double r : {1.3 + 3.0 * pixel, 1.45, 1.6 - 3.0 * pixel})
      expectColor(picture, r * along, scale.color(100.0 * (r - 1.0)));
    for (const double r : {1.1, 1.3 - 3.0 * pixel, 1.6 + 3.0 * pixel, 1.9})
      expectColor(picture, r * along, options.theme.paper);
  }
  // Coloured pixels and the half of the lines round them.
  int inside = 0;
  for (double x = view.area.x + 0.5; x < view.area.right(); ++x)
    for (double y = view.area.y + 0.5; y < view.area.top(); ++y) {
      const Eigen::Vector2d at = view.center + (Eigen::Vector2d(x, y) - view.area.center()) * pixel;
      if (at.norm() > 1.2 && at.norm() < 1.7 && at.minCoeff() > 0.02 &&
          picture.at({x, y}) != options.theme.paper)
        ++inside;
    }
  const double ring = std::numbers::pi / 4.0 * (1.6 * 1.6 - 1.3 * 1.3) - 2.0 * 0.02 * 0.3;
  const double rims =
      std::numbers::pi / 2.0 * (1.6 + 1.3) * pixel;  // a line covers half a pixel or more beyond
  EXPECT_NEAR(inside * pixel * pixel, ring + rims, 0.012 * ring);
}

TEST_F(ChoiceImage, ThresholdByAnotherFieldKeepsTheColoursOfTheDrawnOne) {
  Sample sample = samples::ring();
  const Eigen::MatrixXd& points = sample.model.mesh.patches.front().points;
  sample.frame.fields["pressure"] = {{}, "MPa", points.row(0), {}};
  ContourOptions options = small("von_mises");
  options.threshold = ValueBand{"pressure", {-kInfinite, 1.0}};
  const Picture picture = drawn(sample, options);
  const ColorScale scale("viridis", {0.0, 100.0}, 0);
  expectColor(picture, Eigen::Vector2d(0.9, 1.2), scale.color(50.0));
  expectColor(picture, Eigen::Vector2d(1.1, 1.2), options.theme.paper);
}

TEST_F(ChoiceImage, ThresholdInSpaceLeavesAPartOfTheBody) {
  ContourOptions options = small("pressure");
  options.threshold = ValueBand{"", {0.64, kInfinite}};
  options.tools = false;
  options.view.name = "-1,-0.9,-0.8";
  options.occlusion = false;
  const Picture picture = expectBaseline(radialCube(), options, "cube_threshold");
  // Where the sphere nearly looks at the eye, beside the edges that end there, it has the colour of its value.
  const Eigen::Vector3d on = 0.8 * Eigen::Vector3d(1.0, 0.95, 0.75).normalized();
  expectColor(picture, on, ColorScale("viridis", {0.0, 3.0}, 0).color(0.64));
}

TEST_F(ChoiceImage, SurfacesOfEqualValueStandInTheGhostOfTheBody) {
  ContourOptions options = small("pressure");
  options.isosurfaces = ChosenValues{3, "", {}};
  options.tools = false;
  expectBaseline(radialCube(), options, "cube_isosurfaces");
  options.isosurfaces = ChosenValues{0, "pressure", {1.5}};
  options.view.name = "iso";
  const Picture plane = drawn(samples::cube(), options);
  const ColorScale scale("viridis", {0.0, 3.0}, 0);
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.35, 0.5, 0.65), {0.2, 0.5, 0.8}, {0.8, 0.3, 0.4}})
    expectColor(plane, x, scale.color(1.5));
  options.view.name = "auto";
  options.knots = true;
  options.cut = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  options.isosurfaces = ChosenValues{0, "pressure", {0.4, 0.8, 1.2}};
  expectBaseline(radialCube(), options, "cube_isosurfaces_cut");
}

/// Surfaces of equal value lie within one another: what takes their light there would make all of them dark.
TEST_F(ChoiceImage, SurfacesOfEqualValueKeepTheirColoursWithinOneAnother) {
  ContourOptions options = small("pressure");
  options.isosurfaces = ChosenValues{0, "pressure", {0.5, 1.0, 1.5}};
  options.view.name = "-1,-1,2";  // into the bowls
  options.tools = false;
  const Picture with = drawn(radialCube(), options);
  options.occlusion = false;
  const Picture without = drawn(radialCube(), options);
  int numColored = 0;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 250; ++y) {
      const Color color = without.at({x + 0.5, y + 0.5});
      const auto [least, most] = std::minmax({color[0], color[1], color[2]});
      if (most - least < 40) continue;  // ground and ghost are grey
      ++numColored;
      EXPECT_LE(difference(with.at({x + 0.5, y + 0.5}), color), 1) << "at " << x << ", " << y;
    }
  EXPECT_GT(numColored, 5000);
}

TEST_F(ChoiceImage, ThresholdHoldsForSections) {
  ContourOptions options = small("pressure");
  options.tools = false;
  options.threshold = ValueBand{"", {1.0, 2.0}};
  options.slice = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  const Picture slice = drawn(samples::cube(), options);
  const ColorScale scale("viridis", {0.0, 3.0}, 0);
  expectColor(slice, Eigen::Vector3d(0.3, 0.3, 0.5), scale.color(1.1));
  expectColor(slice, Eigen::Vector3d(0.2, 0.2, 0.5), options.theme.paper);
  expectColor(slice, Eigen::Vector3d(0.9, 0.9, 0.5), options.theme.paper);
  options.slice.reset();
  options.cut = CutPlane{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};
  options.occlusion = false;
  const Picture cut = drawn(samples::cube(), options);
  expectColor(cut, Eigen::Vector3d(0.3, 0.3, 0.5), scale.color(1.1));
}

/// Nothing is between the ends in a frame of a series: the ghost alone is drawn, with a warning.
TEST_F(ChoiceImage, NothingMayBeLeft) {
  for (const bool inSpace : {false, true}) {
    ContourOptions options = small(inSpace ? "pressure" : "von_mises");
    options.threshold = ValueBand{"", {1e3, kInfinite}};
    const Sample sample = inSpace ? samples::cube() : samples::ring();
    takeWarnings();
    const Picture picture = drawn(sample, options);
    const std::vector<std::string> warnings = takeWarnings();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings.front(),
                testing::AllOf(
                    testing::StartsWith("threshold: found \"1000,\", at t = "),
                    testing::HasSubstr(inSpace ? "which leaves nothing to be seen; pressure goes from 0 to 3"
                                               : "which leaves nothing to be seen; von_mises goes from ")));
    options.threshold = ValueBand{"", {0.1, kInfinite}};
    contourImage(sample.model, sample.frame, options);
    EXPECT_THAT(takeWarnings(), testing::IsEmpty());
    if (inSpace) {  // the ghost of the body, without colours
      const Color ghost = picture.at(view.pixel(Eigen::Vector3d(0.5, 0.5, 1.0)));
      EXPECT_LE(*std::max_element(ghost.begin(), ghost.end()) - *std::min_element(ghost.begin(), ghost.end()),
                8);
    } else {
      expectColor(picture, Eigen::Vector2d(1.0, 1.0), options.theme.paper);
    }
  }
}

/// On spheres about a corner the height is drawn with lines, which lie where it has their values.
TEST_F(ChoiceImage, SurfacesOfOneFieldHaveIsolinesOfAnother) {
  Sample sample = radialCube();
  sample.frame.fields["height"] = {{}, "", sample.model.mesh.patches.front().points.row(1), {}};
  ContourOptions options = small("height");
  options.isosurfaces = ChosenValues{0, "pressure", {0.64}};
  options.tools = false;
  options.undeformed = false;
  options.view.name = "1,1,1";
  const Picture without = drawn(sample, options);
  options.isolines = 3;
  const Picture with = drawn(sample, options);
  for (const double height : {0.1, 0.25, 0.35, 0.5, 0.6, 0.7}) {
    // Of a quarter circle on the sphere, from one face of the cube to the other.
    double darkest = 0.0;
    for (const double angle : {0.2, 0.5, 0.8, 1.1, 1.3}) {
      const double radius = std::sqrt(0.64 - height * height);
      const Eigen::Vector2d at =
          view.pixel(Eigen::Vector3d(radius * std::cos(angle), height, radius * std::sin(angle)));
      darkest = std::max<double>(darkest, difference(with.at(at), without.at(at)));
    }
    const auto range = std::array{0.0, 1.0};  // of the body
    const bool isLine = std::abs(4.0 * (height - range[0]) - std::round(4.0 * height)) < 1e-9;
    EXPECT_EQ(darkest > 40.0, isLine) << height;
  }
}

/// Which differ by rounding alone: there is nothing between them, and no place where they are largest.
TEST_F(ChoiceImage, OfAFieldOfOneValueHasNoLinesSurfacesAndSigns) {
  Sample sample = samples::cube();
  ContourOptions options = small("pressure");
  const auto one = [&](double rounding) {
    Eigen::MatrixXd& values = sample.frame.fields["pressure"].values;
    values.setConstant(0.75);
    values(0, values.cols() / 3) += rounding;
    return drawn(sample, options);
  };
  const auto expectAlike = [&] {
    const Picture plain = one(0.0), rounded = one(1e-13);
    int different = 0;
    for (int y = 0; y < plain.height; ++y)
      for (int x = 0; x < plain.width; ++x)
        different +=
            difference(plain.at({x + 0.5, y + 0.5}), rounded.at({x + 0.5, y + 0.5})) > kColorTolerance ? 1
                                                                                                       : 0;
    EXPECT_EQ(different, 0);
  };
  const Picture bare = one(0.0);
  options.isolines = 3;
  expectAlike();
  const Picture lined = one(0.0);
  EXPECT_EQ(difference(bare.at(view.area.center()), lined.at(view.area.center())), 0);
  options.markExtremes = true;
  expectAlike();
  options.isolines = 0;
  options.markExtremes = false;
  options.isosurfaces = Spelling<ChosenValues>::read("3");
  expectAlike();
  EXPECT_THAT(takeWarnings(), testing::Contains(testing::HasSubstr("leaves nothing to be seen")));
}

TEST_F(ChoiceImage, MistakesAreTold) {
  ContourOptions options = small("pressure");
  options.threshold = ValueBand{"presure", {0.0, 1.0}};
  expectRefused(samples::cube(), options,
                "threshold: found the field \"presure\"; allowed: a field of bodies");
  options.threshold = ValueBand{"plastic_strain", {0.0, 1.0}};
  expectRefused(samples::cube(), options, "threshold: found \"plastic_strain\"; available in frame 0:");
  options.threshold = ValueBand{"", {0.0, 1.0}};
  options.arrows = ArrowField::Displacement;
  expectRefused(samples::cube(), options, "vectors: arrows belong to the whole body");
  options.arrows = ArrowField::None;
  options.isosurfaces = ChosenValues{3, "", {}};
  expectRefused(samples::cube(), options, "isosurfaces: found beside threshold");
  options.threshold.reset();
  options.slice = CutPlane{};
  expectRefused(samples::cube(), options, "isosurfaces: found beside slice, on which they are lines");
  options.slice.reset();
  options.isolines = 5;
  expectRefused(samples::cube(), options, "isolines: found beside isosurfaces of the same field");
  options.isosurfaces->field = "pressure";
  expectRefused(samples::cube(), options, "isolines: found beside isosurfaces of the same field");
  options.isolines = 0;
  options.cut = CutPlane{};
  options.cutFace = CutFace::Hatch;
  expectRefused(samples::cube(), options, "cut_face: found hatch beside isosurfaces");
  options.cut.reset();
  options.cutFace = CutFace::Field;
  options.field = "von_mises";
  expectRefused(samples::ring(), options, "isosurfaces: found in a plane body");
  options = small("plastic_strain");
  options.threshold = ValueBand{"plastic_strain", {0.0, 1.0}};
  options.field = "von_mises";
  expectRefused(samples::twoBodies(), options,
                "threshold: stamp has no plastic_strain; draw the others with body");
}

TEST(ValueChoices, AreSpelled) {
  const auto band = [](const char* text) { return Spelling<ValueBand>::read(text); };
  EXPECT_EQ(band("von_mises=0.5,2")->field, "von_mises");
  EXPECT_EQ(band("-1,2")->ends, (std::array{-1.0, 2.0}));
  EXPECT_EQ(band(",0.1")->ends, (std::array{-kInfinite, 0.1}));
  EXPECT_EQ(band("p=0.1,")->ends, (std::array{0.1, kInfinite}));
  for (const char* text :
       {"", ",", "1", "2,1", "1,1", "1,2,3", "=1,2", "nan,1", "1,inf", "a", "0,2e300", "x=", "0:1"})
    EXPECT_FALSE(band(text)) << text;
  for (const char* text : {"von_mises=0.5,2", "-1,2", ",0.1", "p=0.1,"})
    EXPECT_EQ(Spelling<ValueBand>::write(*band(text)), text);
  const auto values = [](const char* text) { return Spelling<ChosenValues>::read(text); };
  EXPECT_EQ(values("3")->of(std::array{1.0, 5.0}), (std::vector{2.0, 3.0, 4.0}));
  EXPECT_EQ(values("p=1.5")->of(std::array{0.0, 9.0}), std::vector{1.5});
  for (const char* text : {"", "0", "21", "1.5", "1,2", "=1", "p=", "p=2,1", "p=1,nan", "x"})
    EXPECT_FALSE(values(text)) << text;
  for (const char* text : {"3", "von_mises=0.5,2"})
    EXPECT_EQ(Spelling<ChosenValues>::write(*values(text)), text);
  EXPECT_EQ(bandNote(*band("0.5,2"), "Pressure", "MPa"), "shown: Pressure from 0.5 to 2 MPa");
  EXPECT_EQ(bandNote(*band("0.5,"), "Pressure", ""), "shown: Pressure from 0.5");
  EXPECT_EQ(surfacesNote({1.0, 2.0}, "Pressure", "MPa"), "surfaces: Pressure = 1, 2 MPa");
  EXPECT_EQ(surfacesNote({0.5}, "Pressure", ""), "surface: Pressure = 0.5");
  EXPECT_EQ(surfacesNote({1, 2, 3, 4, 5, 6, 7}, "Pressure", "MPa"), "7 surfaces: Pressure = 1, 2, …, 7 MPa");
}

}  // namespace
}  // namespace burnish
