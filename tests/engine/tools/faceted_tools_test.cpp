#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/tools/box.h"
#include "engine/tools/faceted_shape.h"
#include "engine/tools/polyline.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/surface_file.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/tools/gap_check.h"

namespace burnish {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

struct Soup {
  std::vector<Vector3d> points;
  std::vector<std::vector<int>> faces;
};

/// Of this process, as tests run at the same time; gone at its end.
const std::filesystem::path& ownDirectory() {
  static const test::ScratchDirectory directory("faceted");
  std::filesystem::create_directories(directory.path());
  return directory.path();
}

std::filesystem::path writeText(const std::string& name, const std::string& text) {
  const auto file = ownDirectory() / name;
  std::ofstream(file) << text;
  return file;
}

std::filesystem::path writeOff(const std::string& name, const Soup& soup) {
  const auto file = ownDirectory() / (name + ".off");
  std::ofstream out(file);
  out << fmt::format("OFF\n{} {} 0\n", soup.points.size(), soup.faces.size());
  for (const auto& p : soup.points) out << fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& face : soup.faces) {
    out << face.size();
    for (const int k : face) out << ' ' << k;
    out << '\n';
  }
  return file;
}

/// An icosahedron whose faces are cut into n² triangles each, put on the sphere of radius 1.
Soup sphere(int n) {
  const double g = std::numbers::phi;
  const std::vector<Vector3d> corners{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                      {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                      {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<std::array<std::size_t, 3>> faces{
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  Soup soup;
  for (const auto& face : faces) {
    const auto point = [&](int i, int j) {
      const Vector3d p = (n - i - j) * corners[face[0]] + i * corners[face[1]] + j * corners[face[2]];
      soup.points.emplace_back(p.normalized());
      return static_cast<int>(soup.points.size()) - 1;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        soup.faces.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 2 <= n) soup.faces.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
  }
  return soup;
}

Soup cube() {
  Soup soup;
  for (int k = 0; k < 8; ++k) soup.points.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
  soup.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return soup;
}

/// A crooked sheet of n x n squares over [0, 1]², its points moved within the plane z = 0.3 x + 0.1 y.
Soup sheet(int n) {
  Soup soup;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = (i + 0.3 * std::sin(7.0 * i + 3.0 * j)) / n, y = (j + 0.3 * std::cos(5.0 * i + j)) / n;
      soup.points.emplace_back(x, y, 0.3 * x + 0.1 * y);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      soup.faces.push_back({a, a + 1, a + n + 2});
      soup.faces.push_back({a, a + n + 2, a + n + 1});
    }
  return soup;
}

TEST(MeshTool, OfAFineSphereIsASphere) {
  const SurfaceMesh surface = readSurface(writeOff("sphere", sphere(50)), 1.0, false);
  EXPECT_EQ(surface.cells.cols(), 50'000);
  EXPECT_EQ(surface.points.cols(), 25'002) << "common corners are merged";
  EXPECT_TRUE(surface.closed);
  const FacetedShape mesh = makeFacetedShape(surface);
  const Sphere ball{Vector3d::Zero(), 1.0};
  test::RandomPoints directions(Vector3d::Zero(), 1.0, 3), depths(Vector3d::Zero(), 0.03, 3, 5);
  double gap = 0.0, normal = 0.0, curvature = 0.0;
  for (int k = 0; k < 2'000; ++k) {
    const Vector3d x = (1.0 + depths.next().x()) * directions.next().normalized();
    const GapQuery found = mesh.query(x), expected = ball.query(x);
    gap = std::max(gap, std::abs(found.gap - expected.gap));
    normal = std::max(normal, (found.normal - expected.normal).norm());
    curvature = std::max(curvature, (found.dNormal - expected.dNormal).norm());
  }
  EXPECT_LT(gap, 1e-6);
  EXPECT_LT(normal, 1e-5);
  EXPECT_LT(curvature, 1e-2);
}

TEST(MeshTool, AnswersQuickly) {
  const FacetedShape mesh = makeFacetedShape(readSurface(writeOff("sphere", sphere(50)), 1.0, false));
  const Vector3d x(0.6, 0.0, 0.8);
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 100'000; ++k) static_cast<void>(mesh.query(x + 1e-7 * k * Vector3d::UnitY()));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("queries_per_second", fmt::format("{:.3g}", 1e5 / seconds));
  EXPECT_GT(1e5 / seconds, 1e4);
}

TEST(MeshTool, ThatIsPlaneIsThatPlane) {
  const FacetedShape mesh = makeFacetedShape(readSurface(writeOff("sheet", sheet(8)), 1.0, true));
  const Plane plane{Vector3d::Zero(), {-0.3, -0.1, 1.0}};
  test::RandomPoints points({0.5, 0.5, 0.2}, 0.3, 3);
  for (int k = 0; k < 300; ++k) {
    const Vector3d x = points.next();
    EXPECT_NEAR(mesh.query(x).gap, plane.query(x).gap, 1e-10);
    EXPECT_LT((mesh.query(x).normal - plane.query(x).normal).norm(), 1e-10);
    EXPECT_LT(mesh.query(x).dNormal.norm(), 1e-8);
  }
}

TEST(MeshTool, HasTheDerivativesOfItsGapAlsoOverEdges) {
  const FacetedShape mesh = makeFacetedShape(readSurface(writeOff("cube", cube()), 1.0, false), 0.04);
  const auto check =
      test::checkDerivatives(mesh, test::RandomPoints({0.5, 0.5, 0.5}, 0.6, 3), 3, -0.05, 0.05, 1e-4);
  EXPECT_EQ(check.points, 2'000);
  EXPECT_EQ(check.astray, 0);
  const RoundedBox box{{0.5, 0.5, 0.5}, Vector3d::Ones()};
  EXPECT_NEAR(mesh.query({0.4, 0.6, 1.03}).gap, 0.03, 1e-12) << "plane faces stay plane";
  EXPECT_NEAR(mesh.query({15.0, 15.0, 16.0}).gap, box.query({15.0, 15.0, 16.0}).gap, 1e-12) << "far away";
  EXPECT_NEAR(mesh.query({1.01, 1.01, 0.5}).gap, box.query({1.01, 1.01, 0.5}).gap, 0.02) << "at an edge";
  EXPECT_NEAR(mesh.halfThickness(), 0.5, 1e-12);
}

TEST(MeshTool, StandsOutOfFacesBesideItsEdgesByItsBulgeAtMost) {
  for (const double spacing : {0.04, 0.11}) {
    const RigidShape mesh = makeFacetedShape(readSurface(writeOff("cube", cube()), 1.0, false), spacing);
    double smallest = 0.0;
    for (double x = 0.0; x < 0.5; x += 0.1 * spacing)
      for (double y = 0.0; y < 0.5; y += 0.1 * spacing)
        smallest = std::min(smallest, mesh.query({x, y, 1.0}).gap);
    EXPECT_GE(smallest, -mesh.bulge());
    EXPECT_LE(smallest, -0.25 * mesh.bulge());
  }
  EXPECT_EQ(RigidShape(RoundedBox{{0.5, 0.5, 0.5}, Vector3d::Ones()}).bulge(), 0.0);
}

TEST(MeshTool, AnswersDoNotDependOnTheOrderOfQuestions) {
  const auto file = writeOff("small", sphere(4));
  const FacetedShape one = makeFacetedShape(readSurface(file, 1.0, false));
  const FacetedShape other = makeFacetedShape(readSurface(file, 1.0, false));
  const Vector3d a(1.0, 0.02, 0.03), b(0.99, 0.1, 0.01);
  const double first = one.query(a).gap;
  static_cast<void>(other.query(b));
  EXPECT_EQ(other.query(a).gap, first);
  EXPECT_EQ(one.query(b).gap, other.query(b).gap);
}

TEST(MeshTool, MayHaveCoordinatesLargerThanItsFile) {
  const auto file = ownDirectory() / "large.off";
  std::ofstream(file) << "OFF\n# a tetrahedron\n4 4 6\n0 0 0\n100000 0 0\n0 100000 0\n0 0 100000\n"
                         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  EXPECT_EQ(readSurface(file, 1.0, false).cells.cols(), 4);
  std::filesystem::remove(file);
}

TEST(MeshTool, ThatIsInsideOutIsTurned) {
  Soup soup = cube();
  for (auto& face : soup.faces) std::reverse(face.begin(), face.end());
  const FacetedShape mesh = makeFacetedShape(readSurface(writeOff("inside_out", soup), 2.0, false));
  EXPECT_GT(mesh.query({1.0, 1.0, 2.2}).gap, 0.15);
  EXPECT_LT(mesh.query({1.0, 1.0, 1.8}).gap, -0.15);
}

std::string mistakeIn(const std::filesystem::path& file, bool open = false) {
  try {
    readSurface(file, 1.0, open);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MeshTool, AFileThatWasCutOffSaysSo) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("burnish_cut_{}.stl", ::getpid());
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  std::ofstream(file) << "solid s\n" << facet << facet.substr(0, 40);
  EXPECT_THAT(mistakeIn(file), HasSubstr(".stl: the file is damaged: it announces 2 triangles and holds 1"));
  std::ofstream(file) << "solid s\n" << facet;
  EXPECT_THAT(mistakeIn(file, true), HasSubstr(".stl: the file is damaged: it has no endsolid"));
  std::string binary(84 + 50, '\0');
  binary[80] = 12;
  std::ofstream(file, std::ios::binary) << binary;
  EXPECT_THAT(mistakeIn(file), HasSubstr(".stl: the file is damaged: it announces 12 triangles and holds 1"));
  std::filesystem::remove(file);
}

TEST(MeshTool, MistakesAreCountedAndPlaced) {
  EXPECT_THAT(mistakeIn("none.stl"), HasSubstr("none.stl: there is no such file"));
  Soup rim = cube();
  rim.faces.pop_back();
  EXPECT_THAT(mistakeIn(writeOff("rim", rim)), HasSubstr("4 edges on a rim, at ("));
  EXPECT_EQ(mistakeIn(writeOff("rim", rim), true), "");
  Soup crossing = cube();
  for (const Soup& other : {cube()})
    for (const auto& face : other.faces) {
      crossing.faces.push_back(face);
      for (int& k : crossing.faces.back()) k += 8;
    }
  for (int k = 0; k < 8; ++k)
    crossing.points.push_back(crossing.points[static_cast<std::size_t>(k)] + Vector3d(0.5, 0.4, 0.3));
  EXPECT_THAT(mistakeIn(writeOff("crossing", crossing)),
              HasSubstr("pairs of triangles that intersect, at ("));
  Soup flat = sheet(1);
  flat.points[2] = 0.5 * (flat.points[0] + flat.points[3]);
  flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  flat.faces = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_THAT(mistakeIn(writeOff("flat", flat), true),
              HasSubstr("1 face without area, at (1, 0, 0), the first is number 1; their corners"));
  Soup twice = cube();  // a face that has collapsed to an edge, which would count four times
  twice.faces.push_back({0, 1, 0});
  EXPECT_THAT(mistakeIn(writeOff("twice", twice)), HasSubstr("1 face without area"));
  Soup endless = cube();
  endless.points[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(mistakeIn(writeOff("endless", endless)),
              testing::ContainsRegex("coordinate that is no number|found no surface"));
  EXPECT_THAT(mistakeIn(testing::TempDir()), HasSubstr("this is a directory; allowed: the file of a mesh"));
}

/// As CAD may give them: faces that have shrunk, and places that are no numbers.
TEST(MeshTool, TrianglesOfNothingAreNone) {
  const auto mistakeOf = [](const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& cells) -> std::string {
    try {
      soundSurface(points, cells, false);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  Eigen::Matrix3Xd points = Eigen::Matrix3d::Identity();
  EXPECT_THAT(mistakeOf(points, Eigen::Matrix3Xi(3, 0)), testing::HasSubstr("found faces without area"));
  points(1, 1) = std::nan("");
  EXPECT_THAT(mistakeOf(points, Eigen::Vector3i(0, 1, 2)), testing::HasSubstr("no number"));
}

TEST(MeshTool, PolygonsWhoseEdgesCrossAreNamed) {
  const Soup crossed{{{1, 1, 0}, {0, 0, 4}, {1, 1, 5}, {0, 0, 0}}, {{0, 1, 2, 3}}};
  EXPECT_THAT(mistakeIn(writeOff("crossed", crossed), true),
              HasSubstr("1 polygon whose edges cross, at (0.5, 0.5, 2.25); allowed"));
}

TEST(MeshTool, FilesThatPromiseMuchAreRefusedBeforeRoomIsMade) {
  EXPECT_THAT(mistakeIn(writeText("face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n"), true),
              HasSubstr("found no surface"));
  const auto ply = [](const std::string& coordinate, const std::string& length) {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty {0} x\nproperty {0} y\nproperty {0} z\n"
        "element face 1\nproperty list {1} int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        coordinate, length);
  };
  EXPECT_EQ(mistakeIn(writeText("sound.ply", ply("double", "uchar")), true), "");
  EXPECT_THAT(mistakeIn(writeText("long.ply", ply("double", "int")), true),
              HasSubstr("allowed as the type of a list's length: uchar, uint16, uint8, ushort"));
  EXPECT_THAT(mistakeIn(writeText("whole.ply", ply("int", "uchar")), true),
              HasSubstr("found points without x; allowed: x, y and z as float or double"));
}

std::vector<Eigen::Vector2d> circlePoints(int n, double radius) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.2 * std::sin(3.0 * k)) / n;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

TEST(Polyline, OfAFineCircleIsADisc) {
  auto points = circlePoints(200, 0.5);
  std::reverse(points.begin(), points.end());
  const FacetedShape line = makeFacetedShape(polyline(points, true, "points"));
  const Cylinder disc{Vector3d::Zero(), Vector3d::UnitZ(), 0.5};
  test::RandomPoints directions(Vector3d::Zero(), 1.0, 2), depths(Vector3d::Zero(), 0.02, 2, 5);
  for (int k = 0; k < 1'000; ++k) {
    const Vector3d x = (0.5 + depths.next().x()) * directions.next().normalized();
    const GapQuery found = line.query(x), expected = disc.query(x);
    EXPECT_NEAR(found.gap, expected.gap, 2e-6);
    EXPECT_LT((found.normal - expected.normal).norm(), 1e-3);
    EXPECT_EQ(found.normal.z(), 0.0);
  }
  const auto check =
      test::checkDerivatives(line, test::RandomPoints(Vector3d::Zero(), 0.6, 2), 2, -0.05, 0.05, 1e-4);
  EXPECT_EQ(check.astray, 0);
}

TEST(Polyline, ThatIsOpenHasTheToolToItsLeft) {
  const FacetedShape line = makeFacetedShape(polyline({{1.0, 0.0}, {0.5, 0.0}, {0.0, 0.0}}, false, "points"));
  EXPECT_NEAR(line.query({0.4, 0.1, 0.0}).gap, 0.1, 1e-12);
  EXPECT_NEAR(line.query({0.4, -0.1, 0.0}).gap, -0.1, 1e-12);
}

/// Lines that bend by less than rounding; the pieces of one go ever on in one direction.
TEST(Polyline, ThatIsAlmostStraightDoesNotCrossItself) {
  constexpr double kApart = 1.6e-5;
  for (const double radius : {1e3, 1e11, 1e13, 1e14})
    for (int k = 1; k < 200; ++k) {
      const Eigen::Rotation2D<double> turn(0.0157 * k);
      std::vector<Eigen::Vector2d> points;
      for (int i = 0; i < 40; ++i) {
        const double along = kApart * i;
        points.push_back(turn * Eigen::Vector2d(along, along * along / (2.0 * radius)));
      }
      EXPECT_NO_THROW(polyline(std::move(points), false, "points")) << radius << ' ' << k;
    }
}

double secondsOf(const std::function<void()>& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(Polyline, OfAHundredThousandPointsIsReadInSeconds) {
  constexpr int kPoints = 100'000;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    points.push_back((1.0 + 0.1 * std::sin(50.0 * angle)) *
                     Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  EXPECT_LT(secondsOf([&] { EXPECT_TRUE(polyline(points, true, "points").closed); }), 5.0);
  std::swap(points[10], points[kPoints / 2]);
  EXPECT_LT(secondsOf([&] { EXPECT_THROW(polyline(points, true, "points"), Error); }), 5.0);
  for (int i = 0; i < kPoints; ++i)
    points[static_cast<std::size_t>(i)] = {i % 2 == 0 ? 0.0 : 1.0, (i * 7919 % 97) / 97.0};
  EXPECT_LT(secondsOf([&] { EXPECT_THROW(polyline(points, false, "points"), Error); }), 5.0)
      << "every piece crosses all others";
}

TEST(MeshTool, OfManyLooseTrianglesIsJudgedInSeconds) {
  Soup soup;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 1.0), beside(-0.3, 0.3);
  for (int t = 0; t < 200'000; ++t) {
    const Vector3d corner(place(random), place(random), place(random));
    const auto near = [&] { return Vector3d(beside(random), beside(random), beside(random)); };
    soup.points.insert(soup.points.end(), {corner, corner + near(), corner + near()});
    soup.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto file = writeOff("loose", soup);
  EXPECT_LT(secondsOf([&] {
              try {
                readSurface(file, 1.0, true);
                ADD_FAILURE();
              } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("at least 10000 pairs of triangles that intersect"));
              }
            }),
            60.0);
}

TEST(Polyline, MistakesAreNamed) {
  const auto mistake = [](std::vector<Eigen::Vector2d> points) -> std::string {
    try {
      polyline(std::move(points), true, "points");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(mistake({{0, 0}, {1, 0}}), "points: found 2 points; allowed: at least 3");
  EXPECT_EQ(mistake({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "points: points 2 and 3 are both (1, 0)");
  EXPECT_EQ(mistake({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
            "points: the line crosses itself: its pieces 1 and 3 meet near (1, 0)");
  EXPECT_THROW(readPolyline(testing::TempDir(), false), Error);
  const auto file = writeText("line.txt", "# a line\n0 0\n1 zero\n");
  try {
    readPolyline(file, false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("line.txt:3: found '1 zero'; allowed: two numbers, x and y"));
  }
}

}  // namespace
}  // namespace burnish
