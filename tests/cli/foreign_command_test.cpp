#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/text/text_file.h"
#include "tests/cli/shell.h"
#include "tests/postproc/picture.h"

/// Pictures of other programs' files as the user meets them. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ForeignCommand : public testing::Test {
 protected:
  ForeignCommand() { fs::create_directories(dir_); }
  ~ForeignCommand() override { fs::remove_all(dir_); }

  auto burnish(const std::string& arguments) { return shell(dir_, BURNISH_COMMAND " " + arguments); }

  static std::string sample(const std::string& name) {
    return std::string(BURNISH_SOURCE_DIR) + "/tests/postproc/foreign/samples/" + name;
  }

  const fs::path dir_ = fs::temp_directory_path() / ("burnish_foreign_command_" + std::to_string(::getpid()));
};

TEST_F(ForeignCommand, InfoTellsCellsAndFields) {
  const auto info = burnish("info " + sample("meshio.vtu"));
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr("49 points, 54 cells (18 quad, 36 triangle)"),
                              HasSubstr("temperature of points: 1 to 2.41953752"),
                              HasSubstr("region of cells: 0 to 1")));
}

TEST_F(ForeignCommand, InfoOfASeriesTellsTheFrame) {
  const std::string text = burnish("info " + sample("fenicsx.pvd")).out;
  EXPECT_THAT(text, HasSubstr("; what follows is of frame 2\n"));
  EXPECT_THAT(burnish("info --json " + sample("fenicsx.pvd")).out, HasSubstr("\"frame\":2"));
  EXPECT_THAT(burnish("info " + sample("meshio.vtu")).out, testing::Not(HasSubstr("what follows")));
  EXPECT_THAT(burnish("info --json " + sample("meshio.vtu")).out, HasSubstr("\"frame\":null"));
}

/// With digits enough to tell the corners of a small body from each other.
TEST_F(ForeignCommand, InfoTellsBoundsFarFromTheOrigin) {
  const auto boundsOf = [&](const std::string& points) {
    std::ofstream(dir_ / "part.vtk") << "# vtk DataFile Version 3.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                        "POINTS 3 double\n"
                                     << points << "\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n";
    return burnish("info part.vtk").out;
  };
  EXPECT_THAT(boundsOf("1000000 2000000 0 1000002 2000000 0 1000000 2000001.5 0"),
              HasSubstr("(1000000, 2000000, 0) to (1000002, 2000001.5, 0)"));
  EXPECT_THAT(boundsOf("0 0 0 0.333333333 0 0 0 2 0"), HasSubstr("(0, 0, 0) to (0.333333, 2, 0)"));
}

/// The sheet is of region 0 at the left and of region 1 at the right.
TEST_F(ForeignCommand, CellsHaveTheirColoursInTheirPlaces) {
  ASSERT_EQ(burnish("render " + sample("meshio.vtu") + " --field region --size 400,400 -o a.png").code, 0);
  const Picture picture = readPicture(dir_ / "a.png");
  const Color first{68, 1, 84}, last{253, 231, 37};  // of viridis
  constexpr int kBody = 280;                         // the colour scale is beyond
  const int middle = picture.height / 2;
  int lastOfFirst = -1, firstOfLast = kBody, ofFirst = 0, ofLast = 0;
  for (int x = 0; x < kBody; ++x) {
    const Color& color = picture.at({x + 0.5, middle + 0.5});
    if (difference(color, first) <= 2) {
      lastOfFirst = x;
      ++ofFirst;
    } else if (difference(color, last) <= 2) {
      firstOfLast = std::min(firstOfLast, x);
      ++ofLast;
    }
  }
  EXPECT_GT(ofFirst, 50);
  EXPECT_GT(ofLast, 50);
  EXPECT_LE(lastOfFirst + 1, firstOfLast);
  EXPECT_GE(lastOfFirst + 3, firstOfLast);
}

/// A series that begins with its mesh alone: this is drawn without colours, and the rest with its field.
TEST_F(ForeignCommand, FieldOfASeriesIsThatOfItsFirstInstantWithOne) {
  const std::string series = sample("fenicsx.pvd");
  for (const char* more : {"", " --field displacement --warp 1"}) {
    ASSERT_EQ(burnish("render " + series + " --frame all --size 400,300 -o 'f{frame}.png'" + more).code, 0);
    for (int k = 0; k < 3; ++k) {
      const Picture picture = readPicture(dir_ / ("f" + std::to_string(k) + ".png"));
      int colourful = 0;
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
          const Color& c = picture.at({x + 0.5, y + 0.5});
          if (std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 30) ++colourful;
        }
      if (k == 0)
        EXPECT_LT(colourful, 4000) << more;  // those of the colour scale
      else
        EXPECT_GT(colourful, 15000) << k << more;
    }
  }
  const auto refused = burnish("render " + series + " --frame 0 --field displacement -o a.png");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("field: found \"displacement\"; frame 0 has none"));
}

/// The same along a line, which has no curve of the mesh alone.
TEST_F(ForeignCommand, BareFramesOfASeriesHaveNoCurve) {
  const std::string series = sample("fenicsx.pvd");
  const auto all = burnish("probe " + series + " --line 0.1,0.5:1.9,0.5 --points 3 --frame all -o all.csv");
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.err, HasSubstr("there are no fields in frame 0, and so no curve of it"));
  ASSERT_EQ(burnish("probe " + series + " --line 0.1,0.5:1.9,0.5 --points 3 --frame 1-2 -o two.csv").code, 0);
  EXPECT_EQ(readText(dir_ / "all.csv"), readText(dir_ / "two.csv"));
  const auto bare = burnish("probe " + series + " --line 0.1,0.5:1.9,0.5 --frame 0 -o bare.csv");
  EXPECT_EQ(bare.code, 2);
  EXPECT_THAT(bare.err, HasSubstr("there are no fields in it, and so no values"));
}

/// Two squares side by side, each with its own value at all its points.
TEST_F(ForeignCommand, BlocksKeepTheirValuesWhereTheyMeet) {
  for (const int k : {0, 1})
    std::ofstream(dir_ / ("part" + std::to_string(k) + ".vtk"))
        << "# vtk DataFile Version 3.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
        << k << " 0 0 " << k + 1 << " 0 0 " << k + 1 << " 1 0 " << k << " 1 0\n"
        << "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\nPOINT_DATA 4\nSCALARS stress double 1\n"
        << "LOOKUP_TABLE default\n"
        << k << ' ' << k << ' ' << k << ' ' << k << '\n';
  std::ofstream(dir_ / "both.pvd") << "<VTKFile type=\"Collection\"><Collection>"
                                      "<DataSet timestep=\"0\" file=\"part0.vtk\"/>"
                                      "<DataSet timestep=\"0\" file=\"part1.vtk\"/></Collection></VTKFile>";
  const auto drawn = burnish("render both.pvd --field stress --size 400,300 -o both.png");
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const Picture picture = readPicture(dir_ / "both.png");
  int ofFirst = 0, ofLast = 0, between = 0;
  for (int x = 10; x < 290; ++x) {
    const Color& color = picture.at({x + 0.5, picture.height / 2 + 0.5});
    if (difference(color, {68, 1, 84}) <= 2) ++ofFirst;
    if (difference(color, {253, 231, 37}) <= 2) ++ofLast;
    if (difference(color, {33, 145, 140}) <= 60) ++between;
  }
  EXPECT_GT(ofFirst, 50);
  EXPECT_GT(ofLast, 50);
  EXPECT_LE(between, 1);
}

/// A row of three cells with values x of points is cut at the values; cells with values of their own stay whole.
TEST_F(ForeignCommand, ThresholdLeavesAPart) {
  const std::string head =
      "# vtk DataFile Version 3.0\nrow\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 2 1\nORIGIN 0 0 0\n"
      "SPACING 1 1 1\n";
  std::ofstream(dir_ / "points.vtk")
      << head << "POINT_DATA 8\nSCALARS x double 1\nLOOKUP_TABLE default\n0 1 2 3 0 1 2 3\n";
  std::ofstream(dir_ / "cells.vtk") << head
                                    << "CELL_DATA 3\nSCALARS x double 1\nLOOKUP_TABLE default\n1 5 3\n";
  std::ofstream(dir_ / "curved.vtk")  // between whose points x² is no straight line
      << "# vtk DataFile Version 3.0\nrow\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
         "0 0 0 3 0 0 3 1 0 0 1 0 1.5 0 0 3 .5 0 1.5 1 0 0 .5 0 1.5 .5 0\nCELLS 1 10\n9 0 1 2 3 4 5 6 7 8\n"
         "CELL_TYPES 1\n28\nPOINT_DATA 9\nSCALARS x double 1\nLOOKUP_TABLE default\n"
         "0 9 9 0 2.25 9 2.25 0 2.25\n";
  const auto colored = [&](const std::string& options) {
    const auto drawn =
        burnish("render " + options + " --field x --size 800,300 --no-knots --title '' -o a.png");
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    const Picture picture = readPicture(dir_ / "a.png");
    int count = 0;
    for (int x = 0; x < picture.width; ++x) {
      const Color& color = picture.at({x + 0.5, 0.7 * picture.height});
      if (std::max({color[0], color[1], color[2]}) - std::min({color[0], color[1], color[2]}) > 30) ++count;
    }
    return count;
  };
  const int scale = colored("points.vtk --threshold 7,"), whole = colored("points.vtk") - scale;
  ASSERT_GT(whole, 300);
  EXPECT_LT(scale, 20);
  EXPECT_NEAR(colored("points.vtk --threshold 0.75,2.25") - scale, whole / 2.0, 4.0);
  EXPECT_NEAR(colored("points.vtk --threshold 2.1,") - scale, 0.3 * whole, 4.0);
  EXPECT_NEAR(colored("cells.vtk --threshold 2,6") - scale, 2.0 * whole / 3.0, 4.0);
  EXPECT_NEAR(colored("curved.vtk --threshold 1,") - scale, 2.0 * whole / 3.0, 12.0);  // between eight parts
  const auto named = burnish("render points.vtk --threshold von_mises=1,2 -o a.png");
  EXPECT_EQ(named.code, 2);
  EXPECT_THAT(named.err,
              HasSubstr("threshold: files of other programs are parted by the field that is drawn alone"));
}

/// Three cells in a row with a value each, the largest in the middle.
TEST_F(ForeignCommand, ExtremesOfCellsAreMarkedInTheirMiddles) {
  std::ofstream(dir_ / "row.vtk")
      << "# vtk DataFile Version 3.0\nrow\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 2 1\n"
         "ORIGIN 0 0 0\nSPACING 1 1 1\nCELL_DATA 3\nSCALARS stress double 1\nLOOKUP_TABLE default\n1 5 3\n";
  const auto drawn =
      burnish("render row.vtk --field stress --size 800,300 --no-knots --mark-extremes -o a.png");
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const Picture picture = readPicture(dir_ / "a.png");
  constexpr Color kWhite{255, 255, 255}, kSmallest{68, 1, 84}, kLargest{253, 231, 37};
  std::map<bool, std::vector<Eigen::Vector2d>>
      signs;     // pixels of white, by whether they are in the cell of 5
  int cell = 0;  // its width in pixels
  for (int y = 0; y < picture.height; ++y) {
    int ofLargest = 0;
    for (int x = 0; x < 600; ++x)  // the colour scale is beyond
      if (difference(picture.at({x + 0.5, y + 0.5}), kLargest) <= 2) ++ofLargest;
    cell = std::max(cell, ofLargest);
    const auto at = [&](int x) { return picture.at({x + 0.5, y + 0.5}); };
    for (int x = 20; x + 20 < picture.width; ++x)
      for (const Color& color : {kSmallest, kLargest})
        if (difference(at(x), kWhite) <= 2 && difference(at(x - 20), color) <= 2 &&
            difference(at(x + 20), color) <= 2)
          signs[color == kLargest].emplace_back(x, y);
  }
  ASSERT_EQ(signs.size(), 2U);
  const auto middle = [](const std::vector<Eigen::Vector2d>& pixels) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& pixel : pixels) sum += pixel;
    return Eigen::Vector2d(sum / static_cast<double>(pixels.size()));
  };
  const Eigen::Vector2d apart = middle(signs[true]) - middle(signs[false]);  // by one cell
  EXPECT_NEAR(apart.x(), cell, 2.0);
  EXPECT_NEAR(apart.y(), 0.0, 3.0);
}

TEST_F(ForeignCommand, WhatCannotBeSeenIsToldInASentence) {
  const std::string head =
      "# vtk DataFile Version 3.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n";
  std::ofstream(dir_ / "nowhere.vtu")
      << R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 nan 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  std::ofstream(dir_ / "point.vtk") << head << "1 1 0 1 1 0 1 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n";
  std::ofstream(dir_ / "notes.txt") << "no mesh";
  for (const auto& [file, sentence] :
       {std::pair{"nowhere.vtu", "not finite"}, std::pair{"point.vtk", "at one place"},
        std::pair{"notes.txt", "found a file with the ending \".txt\"; expected the directory of a run"}}) {
    const auto drawn = burnish(std::string("render ") + file + " -o a.png");
    EXPECT_EQ(drawn.code, 2) << file;
    EXPECT_THAT(drawn.err, HasSubstr(sentence));
    EXPECT_FALSE(fs::exists(dir_ / "a.png"));
  }
}

/// The content of an array with `format="binary"`: the number of bytes and the bytes, in base 64. Texts know no numbers that are
/// not finite.
std::string binary(const std::string& numbers) {
  std::vector<double> values;
  std::istringstream words(numbers);
  for (std::string word; words >> word;) values.push_back(std::stod(word));
  const auto size = static_cast<std::uint32_t>(values.size() * sizeof(double));
  std::string bytes(sizeof(size) + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof(size));
  std::memcpy(bytes.data() + sizeof(size), values.data(), size);
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      text += k + d > bytes.size() ? '=' : digits[group >> (18 - 6 * d) & 63u];
  }
  return text;
}

/// A row of three squares with these values in the squares, y, and at the points below and above, x.
std::string rowOfSquares(const std::string& inCells, const std::string& atPoints) {
  return R"(<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="3">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 2 0 0 3 0 0 0 1 0 1 1 0 2 1 0 3 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 5 4 1 2 6 5 2 3 7 6</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8 12</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">9 9 9</DataArray></Cells>
<CellData><DataArray type="Float64" Name="y" format="binary">)" +
         binary(inCells) + R"(</DataArray></CellData>
<PointData><DataArray type="Float64" Name="x" format="binary">)" +
         binary(atPoints + ' ' + atPoints) + R"(</DataArray></PointData>
</Piece></UnstructuredGrid></VTKFile>)";
}

TEST_F(ForeignCommand, PlacesWithoutAValueAreGreyAndToldOf) {
  const Color first{68, 1, 84}, last{253, 231, 37}, grey{238, 238, 238};
  std::ofstream(dir_ / "row.vtu") << rowOfSquares("1 nan 3", "0 1 2 inf");
  const auto colorsIn = [&](const std::string& options) {
    const auto drawn = burnish("render row.vtu --title '' --size 500,300 -o a.png " + options);
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    const Picture picture = readPicture(dir_ / "a.png");
    std::array<int, 3> counts{};
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Color& color = picture.at({x + 0.5, y + 0.5});
        if (difference(color, first) <= 2) ++counts[0];
        if (difference(color, last) <= 2) ++counts[1];
        if (difference(color, grey) <= 2) ++counts[2];
      }
    return std::pair(counts, drawn.err);
  };
  const auto [ofCells, cellsSaid] = colorsIn("--field y");
  EXPECT_GT(ofCells[0], 5000);
  EXPECT_NEAR(ofCells[1], ofCells[0], 0.05 * ofCells[0]);
  EXPECT_NEAR(ofCells[2], ofCells[0], 0.05 * ofCells[0]) << "and the box in the legend";
  EXPECT_EQ(cellsSaid,
            "warning: field y of row.vtu has no finite value at 1 of 3 cells; where it has none it is "
            "drawn without colours\n");
  const auto [ofPoints, pointsSaid] = colorsIn("--field x --bands 2 --isolines 3 --mark-extremes");
  EXPECT_NEAR(ofPoints[2], ofCells[2], 0.1 * ofCells[2]) << "less marks and lines";
  EXPECT_NEAR(ofPoints[0], ofPoints[1], 0.2 * ofPoints[0]) << "the range is 0 to 2";
  EXPECT_THAT(pointsSaid, HasSubstr("at 2 of 8 points;"));
  const auto [ofThreshold, thresholdSaid] = colorsIn("--field x --bands 2 --threshold 1,");
  EXPECT_NEAR(ofThreshold[1], ofPoints[1], 0.1 * ofPoints[1]) << "without marks and lines";
  EXPECT_LT(ofThreshold[0], 0.2 * ofPoints[0]) << "in the colour scale alone";

  ASSERT_EQ(burnish("render row.vtu --field y -o a.svg").code, 0);
  EXPECT_THAT(readText(dir_ / "a.svg"), HasSubstr(">no value<"));
  EXPECT_THAT(burnish("info row.vtu").out, AllOf(HasSubstr("x of points: 0 to 2, no finite value at 2 of 8"),
                                                 HasSubstr("y of cells: 1 to 3, no finite value at 1 of 3")));
}

TEST_F(ForeignCommand, FieldsWithoutAnyValueAreRefusedAndGapsOfASeriesAreToldOnce) {
  std::ofstream(dir_ / "none.vtu") << rowOfSquares("nan inf -inf", "0 1 2 3");
  const auto refused = burnish("render none.vtu --field y -o a.png");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, "burnish: field y of none.vtu has no finite value; it cannot be drawn\n");
  EXPECT_THAT(burnish("info none.vtu").out, HasSubstr("y of cells: no finite value"));
  std::ofstream(dir_ / "one.vtu") << rowOfSquares("1 nan 3", "0 1 2 3");
  std::ofstream(dir_ / "two.vtu") << rowOfSquares("nan nan 3", "0 1 2 3");
  std::ofstream(dir_ / "series.pvd") << "<VTKFile type=\"Collection\"><Collection>"
                                        "<DataSet timestep=\"0\" file=\"one.vtu\"/>"
                                        "<DataSet timestep=\"1\" file=\"two.vtu\"/></Collection></VTKFile>";
  const auto drawn = burnish("render series.pvd --field y --frame all -o 'f{frame}.png'");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(
      drawn.err,
      HasSubstr("field y of series.pvd has no finite value at up to 2 of 3 cells in 2 frames; where"));
}

/// A biquadratic Bézier square with the coefficient 4 in the middle alone has 1 there, as has a vector whose length is 4.
TEST_F(ForeignCommand, RangesOfBezierCellsAreThoseOfTheField) {
  std::ofstream(dir_ / "bump.vtk")
      << "# vtk DataFile Version 3.0\nbump\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
         "0 0 0 2 0 0 2 2 0 0 2 0 1 0 0 2 1 0 1 2 0 0 1 0 1 1 0\nCELLS 1 10\n9 0 1 2 3 4 5 6 7 8\n"
         "CELL_TYPES 1\n77\nPOINT_DATA 9\nSCALARS bump double 1\nLOOKUP_TABLE default\n"
         "0 0 0 0 0 0 0 0 4\nVECTORS v double\n"
         "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 2.4 -3.2 0\n";
  const auto info = burnish("info bump.vtk");
  EXPECT_THAT(info.out, AllOf(HasSubstr("bump of points: 0 to 1\n"), HasSubstr("of points: 0 to 1\n")))
      << info.err;
  EXPECT_THAT(info.out, testing::Not(HasSubstr("to 4")));
  EXPECT_THAT(burnish("info bump.vtk --json").out,
              HasSubstr(R"("ranges":[{"component":null,"max":1.0,"min":0.0,"not_finite":0}])"));
}

/// Of a curved cube with a value in its middle alone.
TEST_F(ForeignCommand, RangesOfCurvedCellsAreThoseOfTheirInside) {
  std::ofstream file(dir_ / "cube.vtk");
  file << "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 27 double\n"
          "0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 2 2 2 0 2 2 1 0 0 2 1 0 1 2 0 0 1 0 1 0 2 2 1 2 1 2 2 0 1 2 "
          "0 0 1 2 0 1 2 2 1 0 2 1 0 1 1 2 1 1 1 0 1 1 2 1 1 1 0 1 1 2 1 1 1\nCELLS 1 28\n27";
  for (int k = 0; k < 27; ++k) file << ' ' << k;
  file << "\nCELL_TYPES 1\n29\nPOINT_DATA 27\nSCALARS depth double 1\nLOOKUP_TABLE default\n";
  for (int k = 0; k < 27; ++k) file << (k < 26 ? "0 " : "5\n");
  file.close();
  const auto drawn = burnish("render cube.vtk --mark-extremes -o a.svg");
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(readText(dir_ / "a.svg"), AllOf(HasSubstr("max 5"), HasSubstr("max at (1, 1, 1)")));
}

/// A square beside which another one has shrunk to their common edge.
TEST_F(ForeignCommand, ShrunkCellsLeaveTheOutlineOfTheirNeighbours) {
  const auto outlineOf =
      [&](const std::string& cells) {
        std::ofstream(dir_ / "part.vtk")
            << "# vtk DataFile Version 3.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
               "0 0 0 1 0 0 1 1 0 0 1 0 1 .5 0 1 .25 0\n"
            << cells;
        EXPECT_EQ(burnish("render part.vtk --size 300,300 --title '' -o a.png").code, 0);
        return readText(dir_ / "a.png");
      };
  const std::string whole = outlineOf("CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n");
  EXPECT_EQ(outlineOf("CELLS 2 10\n4 0 1 2 3\n4 1 2 2 1\nCELL_TYPES 2\n9\n9\n"), whole);
  EXPECT_EQ(outlineOf("CELLS 2 10\n4 0 1 2 3\n4 1 2 4 5\nCELL_TYPES 2\n9\n9\n"), whole);
  // Triangles that are written as quadrilaterals have no edges between them.
  EXPECT_EQ(outlineOf("CELLS 2 10\n4 0 1 2 2\n4 0 0 2 3\nCELL_TYPES 2\n9\n9\n"),
            outlineOf("CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\n"));
}

TEST_F(ForeignCommand, NormalsAreDrawnWhenTheyAreAskedForAlone) {
  ASSERT_EQ(burnish("render " + sample("assimp.glb") + " -o plain.svg").code, 0);
  ASSERT_EQ(burnish("render " + sample("assimp.glb") + " --field NORMAL.x -o normal.svg").code, 0);
  EXPECT_THAT(readText(dir_ / "plain.svg"), Not(HasSubstr("NORMAL")));
  EXPECT_THAT(readText(dir_ / "normal.svg"), HasSubstr("NORMAL"));
}

/// A cube whose corners are in the order of an image in a mirror, and one with a triangle on half of its face: both are
/// lit from outside, and colours are those of what is drawn.
TEST_F(ForeignCommand, VolumesAreLitFromOutside) {
  const auto drawn =
      [&](const std::string& cells, const std::string& values) {
        std::ofstream(dir_ / "cube.vtk")
            << "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
               "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
            << cells << "CELL_DATA " << values.size() / 2 << "\nSCALARS part double 1\nLOOKUP_TABLE default\n"
            << values << "\n";
        EXPECT_EQ(burnish("render cube.vtk --size 300,300 --title '' -o a.png").code, 0);
        return readPicture(dir_ / "a.png");
      };
  const Picture whole = drawn("CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n", "1 ");
  const auto differing = [&](const Picture& other) {
    constexpr int kVisible = 4;
    int count = 0;
    for (int y = 0; y < whole.height; ++y)
      for (int x = 0; x < whole.width; ++x) {
        const Eigen::Vector2d at(x + 0.5, y + 0.5);
        count += difference(other.at(at), whole.at(at)) > kVisible ? 1 : 0;
      }
    return count;
  };
  EXPECT_LE(differing(drawn("CELLS 1 9\n8 4 5 6 7 0 1 2 3\nCELL_TYPES 1\n12\n", "1 ")), 5)
      << "of pixels on edges, which run the other way";
  EXPECT_EQ(differing(drawn("CELLS 2 13\n8 0 1 2 3 4 5 6 7\n3 4 5 6\nCELL_TYPES 2\n12\n5\n", "1 2 ")), 0);
}

/// The same value at opposite corners: a square that is its own image in both middles has such a picture.
TEST_F(ForeignCommand, QuadrilateralsHaveNoDiagonal) {
  std::ofstream(dir_ / "saddle.vtk")
      << "# vtk DataFile Version 3.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
         "0 0 0 1 0 0 1 1 0 0 1 0\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\nPOINT_DATA 4\n"
         "SCALARS saddle double 1\nLOOKUP_TABLE default\n0 1 0 1\n";
  ASSERT_EQ(burnish("render saddle.vtk --bands 4 --title '' --size 400,400 -o a.png").code, 0);
  const Picture picture = readPicture(dir_ / "a.png");
  const Color quarter = ColorScale("viridis", {0.0, 1.0}, 4).color(0.45),
              half = ColorScale("viridis", {0.0, 1.0}, 4).color(0.55);
  int ofQuarter = 0, ofHalf = 0;
  for (int x = 0; x < 300; ++x)
    for (int y = 0; y < picture.height; ++y) {
      ofQuarter += difference(picture.at({x + 0.5, y + 0.5}), quarter) <= 2 ? 1 : 0;
      ofHalf += difference(picture.at({x + 0.5, y + 0.5}), half) <= 2 ? 1 : 0;
    }
  EXPECT_GT(ofHalf, 5000);
  EXPECT_NEAR(ofQuarter, ofHalf, 0.03 * ofHalf);
}

TEST_F(ForeignCommand, WhatFilesDoNotHaveIsRefused) {
  const auto refused = [&](const std::string& arguments, const std::string& sentence) {
    const auto outcome = burnish("render " + arguments + " -o b.png");
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_FALSE(fs::exists(dir_ / "b.png")) << arguments;
  };
  refused(sample("openscad.stl") + " --cut 0,0,0,1,0,0 --cut-face hatch",
          "openscad.stl has no volumes, whose section could be hatched; draw it without");
  refused(sample("a.exo") + " --mirror x=5",
          "mirror: found the plane x = 5; " + sample("a.exo") + " goes from x = 0 to x = ");
  EXPECT_EQ(burnish("render " + sample("a.exo") + " --mirror x,z --size 300,200 -o c.png").code, 0);
  EXPECT_EQ(burnish("render " + sample("meshio.vtu") + " --mirror x --size 300,200 -o c.png").code, 0);
}

TEST_F(ForeignCommand, PageForPrintHasItsTexts) {
  ASSERT_EQ(burnish("render " + sample("meshio.vtu") + " --field temperature --dpi 100 -o a.pdf").code, 0);
  EXPECT_THAT(shell(dir_, "pdftotext a.pdf -").out,
              AllOf(HasSubstr("temperature"), HasSubstr("max 2.42"), HasSubstr("min 1")));
}

TEST_F(ForeignCommand, EveryFormatMakesAPicture) {
  for (const char* name :
       {"meshio.vtu", "meshio.vtk", "gmsh.vtk", "gmsh.stl", "h5py.vtkhdf", "a.exo", "tri.case", "dealii.vtu",
        "getfem.vtu", "fenicsx.pvd", "openfoam.vtm", "paraview.ex2", "openscad.stl", "cgns.cgns",
        "meshio.avs", "meshio.tec", "cavity.cas", "assimp.glb", "paraview.vtpc"})
    EXPECT_EQ(burnish("render " + sample(name) + " --size 300,200 -o " + name + ".png").code, 0) << name;
}

TEST_F(ForeignCommand, ColoursEndAtPercentilesAndSurfacesHaveGivenValues) {
  const std::string draw = "render " + sample("a.exo") + " --field von_mises -o a.png ";
  EXPECT_EQ(burnish(draw + "--clip 90").code, 0);
  EXPECT_EQ(burnish(draw + "--isosurfaces 3 --cut x=0.4").code, 0);
  EXPECT_EQ(burnish(draw + "--isosurfaces von_mises=0,0.5").code, 0);
  const auto other = burnish(draw + "--isosurfaces pressureX=3");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err,
              HasSubstr("--isosurfaces: found pressureX; of files of other programs they are those of the "
                        "field that is drawn, von_mises"));
  EXPECT_THAT(burnish("render " + sample("a.exo") + " --field layer --isosurfaces 3 -o b.png").err,
              HasSubstr("one value per cell"));
}

TEST_F(ForeignCommand, FieldsWithNamesOfContactFieldsAreDrawnLikeOthers) {
  std::ofstream(dir_ / "own.vtk") << "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET STRUCTURED_POINTS\n"
                                     "DIMENSIONS 2 2 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 4\n"
                                     "SCALARS contact_pressure double 1\nLOOKUP_TABLE default\n0 1 2 3\n";
  const auto drawn = burnish("render own.vtk --field contact_pressure --clip 90 -o a.png");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
}

TEST_F(ForeignCommand, WhatBelongsToRunsIsRefused) {
  for (const char* option :
       {"--control-net", "--subdivision 3", "--vectors displacement", "--clip 40", "--tool-opacity 1",
        "--warp 2", "--body nothing", "--field region --isolines 3"}) {
    const auto refused = burnish("render " + sample("meshio.vtu") + " -o b.png " + option);
    EXPECT_EQ(refused.code, 2) << option;
    EXPECT_FALSE(fs::exists(dir_ / "b.png")) << option;
  }
}

}  // namespace
}  // namespace burnish
