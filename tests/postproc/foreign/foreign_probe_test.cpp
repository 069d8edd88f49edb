#include "postproc/probe/foreign_probe.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/message_of.h"

/// Values of files of other programs at places of which they are known.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path sample(const char* name) {
  return fs::path(BURNISH_SOURCE_DIR) / "tests/postproc/foreign/samples" / name;
}

ProbeSpec along(const std::string& line, const std::vector<std::string>& fields) {
  ProbeSpec spec;
  spec.line = line;
  spec.fields = fields;
  return spec;
}

/// A cantilever of curved cells, whose end was moved down by 0.1.
TEST(ForeignProbe, EndOfACantileverIsWhereItWasMovedTo) {
  const ForeignFile file(sample("calculix.vtu"));
  const ProbedRun run =
      probedInstant(file, 0, along("4,0.05,0.1:4,0.95,0.8", {"displacement.y", "displacement.z"}));
  ASSERT_GT(run.points.size(), 10U);
  for (const ProbePoint& point : run.points) {
    EXPECT_NEAR(point.values(0), -0.1, 1e-9);
    EXPECT_NEAR(point.values(1), 0.0, 2e-3);  // across it the end is free
  }
}

/// Triangles and quadrilaterals whose points have the stresses x and y, and in their cells the numbers 0 and 1.
TEST(ForeignProbe, ValuesAreThoseOfTheCells) {
  const ForeignFile file(sample("meshio.vtu"));
  ProbeSpec spec = along("0.9,0.1:2.3,0.4", {"stress.xx", "stress.yy", "region"});
  const ProbedRun run = probedInstant(file, 0, spec);
  EXPECT_EQ(run.dim, 2);
  EXPECT_TRUE(run.isForeign);
  ASSERT_EQ(run.fields.size(), 3U);
  double first = 0.0, last = 0.0;
  for (const ProbePoint& point : run.points) {
    if (point.body == ProbePoint::kOutside) {
      EXPECT_TRUE(std::isnan(point.values(0)));
      continue;
    }
    EXPECT_NEAR(point.values(0), point.current(0), 1e-9);
    EXPECT_NEAR(point.values(1), point.current(1), 1e-9);
    EXPECT_TRUE(point.values(2) == 0.0 || point.values(2) == 1.0);
    if (first == 0.0) first = point.current(0);
    last = point.current(0);
  }
  EXPECT_NEAR(first, 1.0,
              1e-8);  // where the cells begin and end, not the nearest of the equally distant points
  EXPECT_GT(last, 2.0);

  spec.mean = true;
  const ProbedRun mean = probedHistory(file, {0}, spec);
  ASSERT_EQ(mean.points.size(), 1U);
  EXPECT_NEAR(mean.points[0].values(0), 0.5 * (first + last), 1e-6);
  spec.mean = false;
  spec.window = 0.1;
  for (const ProbePoint& point : probedInstant(file, 0, spec).points) {
    const double x = point.current(0);
    if (point.body == ProbePoint::kOutside || x < first + 0.06 || x > last - 0.06) continue;
    EXPECT_NEAR(point.values(0), x, 1e-6);
  }
}

/// A beam whose end goes down with time; its first instant has no fields.
TEST(ForeignProbe, APointHasAHistory) {
  const ForeignFile file(sample("fenicsx.pvd"));
  ProbeSpec spec;
  spec.point = "2,1";
  const ProbedRun run = probedHistory(file, {0, 1, 2}, spec);
  ASSERT_EQ(run.points.size(), 3U);
  EXPECT_EQ(run.fields[0].name, "displacement");
  EXPECT_TRUE(std::isnan(run.points[0].values(0)));
  EXPECT_NEAR(run.points[2].values(0), 0.252363, 1e-6);  // the largest of the file
  EXPECT_NEAR(run.points[1].values(0), 0.5 * run.points[2].values(0), 1e-12);
  for (int instant = 0; instant < 3; ++instant)
    EXPECT_EQ(run.points[static_cast<std::size_t>(instant)].at, instant);
}

TEST(ForeignProbe, VolumesAreLookedInto) {
  const ForeignFile file(sample("cgns.cgns"));
  const ProbedRun run = probedInstant(file, 0, along("0,0,0:2,1,1", {"Temperature"}));
  EXPECT_EQ(run.dim, 3);
  EXPECT_NEAR(run.points.front().values(0), 0.0, 1e-9);
  EXPECT_NEAR(run.points.back().values(0), 5.0, 1e-9);
}

/// Opposite vectors at the ends of a cell: in its middle nothing is left of them.
TEST(ForeignProbe, TheLengthOfAVectorIsThatOfWhatLiesBetween) {
  const fs::path name =
      fs::temp_directory_path() / ("burnish_between_" + std::to_string(::getpid()) + ".vtk");
  std::ofstream(name)
      << "# vtk DataFile Version 3.0\nbetween\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 1\n"
         "POINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\nPOINT_DATA 4\nVECTORS v double\n"
         "3 4 0 -3 -4 0 3 4 0 -3 -4 0\n";
  const ProbedRun run = probedInstant(ForeignFile(name), 0, along("0,0.5:1,0.5", {"v", "v.x"}));
  for (const ProbePoint& point : run.points) {
    const double rest = 1.0 - 2.0 * point.current(0);
    EXPECT_NEAR(point.values(0), 5.0 * std::abs(rest), 1e-9);
    EXPECT_NEAR(point.values(1), 3.0 * rest, 1e-9);
  }
  fs::remove(name);
}

/// Two rows of cells whose border is rounded to one side or the other: values are those of one row.
TEST(ForeignProbe, ALineAlongABorderStaysOnOneSide) {
  constexpr int kCount = 40;
  const fs::path name = fs::temp_directory_path() / ("burnish_rows_" + std::to_string(::getpid()) + ".vtk");
  std::ofstream stream(name);
  stream.precision(17);
  stream << "# vtk DataFile Version 3.0\nrows\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << 3 * (kCount + 1)
         << " double\n";
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= kCount; ++i) {
      const double x = 0.1 * i, y = 0.1 * j, angle = 0.3;
      stream << x * std::cos(angle) - y * std::sin(angle) << " " << x * std::sin(angle) + y * std::cos(angle)
             << " 0\n";
    }
  stream << "CELLS " << 2 * kCount << " " << 10 * kCount << "\n";
  for (int i = 0; i < kCount; ++i)
    for (int j = 0; j < 2; ++j) {  // the rows in turn
      const int corner = j * (kCount + 1) + i;
      stream << "4 " << corner << " " << corner + 1 << " " << corner + kCount + 2 << " "
             << corner + kCount + 1 << "\n";
    }
  stream << "CELL_TYPES " << 2 * kCount << "\n";
  for (int k = 0; k < 2 * kCount; ++k) stream << "9\n";
  stream << "CELL_DATA " << 2 * kCount << "\nSCALARS row double 1\nLOOKUP_TABLE default\n";
  for (int k = 0; k < 2 * kCount; ++k) stream << k % 2 << "\n";
  stream.close();
  const ForeignFile file(name);
  const double x = std::cos(0.3), y = std::sin(0.3);
  const ProbedRun run = probedInstant(
      file, 0,
      along(fmt::format("{},{}:{},{}", -0.1 * y, 0.1 * x, 4.0 * x - 0.1 * y, 4.0 * y + 0.1 * x), {"row"}));
  fs::remove(name);
  ASSERT_GT(run.points.size(), 10U);
  for (const ProbePoint& point : run.points) EXPECT_EQ(point.values(0), run.points.front().values(0));
}

/// A ring of curved cells, in which VTK finds places in straight parts alone.
TEST(ForeignProbe, CurvedCellsHaveNoGaps) {
  const ForeignFile file(sample("dealii.vtu"));
  const Eigen::Vector2d begin(-0.9, -0.83), way(1.77, 1.73);
  for (const ProbePoint& point : probedInstant(file, 0, along("-0.9,-0.83:0.87,0.9", {"potential"})).points) {
    const double radius = point.current.norm();
    if (std::abs(radius - 0.5) < 0.01 || std::abs(radius - 1.0) < 0.02) continue;  // the edges are chords
    EXPECT_EQ(std::isfinite(point.values(0)), radius > 0.5 && radius < 1.0) << radius;
    const Eigen::Vector2d from = point.current - begin;
    EXPECT_LT(std::abs(from.x() * way.y() - from.y() * way.x()), 1e-8);  // it is where it should be
  }
}

TEST(ForeignProbe, SaysWhatTheFileDoesNotHave) {
  const ForeignFile file(sample("meshio.vtu"));
  const auto message = [&](ProbeSpec spec) { return messageOf([&] { probedInstant(file, 0, spec); }); };
  EXPECT_THAT(message(along("1,0:2,0", {"heat"})), HasSubstr("field: found \"heat\""));
  EXPECT_THAT(message(along("5,5:6,6", {"temperature"})), HasSubstr("line: no point of it is in a cell of"));
  EXPECT_THAT(message(along("1,1:1,1", {"temperature"})), HasSubstr("twice"));
  EXPECT_THAT(message(along("1,0:1e9,0", {"temperature"})), HasSubstr("line: found a length of"));
  EXPECT_THAT(message(along("1,0,0:2,0,0", {"temperature"})), HasSubstr("X0,Y0:X1,Y1"));
  ProbeSpec face;
  face.face = "top";
  EXPECT_THAT(message(face), HasSubstr("face: only runs of burnish have faces with names"));
  ProbeSpec point;
  point.point = "9,9";
  EXPECT_THAT(messageOf([&] { probedHistory(file, {0}, point); }), HasSubstr("point: 9,9 is in no cell of"));
}

}  // namespace
}  // namespace burnish
