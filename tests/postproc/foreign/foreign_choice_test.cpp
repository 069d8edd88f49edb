#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "postproc/draw/foreign/foreign_percentiles.h"
#include "postproc/draw/foreign/foreign_picture.h"
#include "postproc/draw/page/picture_warnings.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/message_of.h"
#include "tests/postproc/picture.h"

/// What is chosen of other programs' files by the values of their fields.
namespace burnish {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A file with points on a lattice and values there.
class LatticeFile {
 public:
  LatticeFile(const std::string& name, const std::array<std::vector<double>, 3>& along,
              const std::function<double(double, double, double)>& value)
      : directory_(name), file_(directory_.path() / "lattice.vtk") {
    std::filesystem::create_directories(directory_.path());
    std::ofstream out(file_, std::ios::binary);
    out << "# vtk DataFile Version 3.0\nvalues\nBINARY\nDATASET RECTILINEAR_GRID\nDIMENSIONS";
    for (const auto& x : along) out << ' ' << x.size();
    for (std::size_t d = 0; d < 3; ++d) {
      out << '\n' << "XYZ"[d] << "_COORDINATES " << along[d].size() << " double\n";
      for (const double x : along[d]) put(out, x);
    }
    out << "\nPOINT_DATA " << along[0].size() * along[1].size() * along[2].size()
        << "\nSCALARS value double 1\nLOOKUP_TABLE default\n";
    for (const double z : along[2])
      for (const double y : along[1])
        for (const double x : along[0]) put(out, value(x, y, z));
  }

  ForeignFile read() const { return ForeignFile(file_); }
  std::filesystem::path picture() const { return directory_.path() / "picture.png"; }

 private:
  /// The most significant byte first.
  static void put(std::ostream& out, double number) {
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    std::reverse(bytes.begin(), bytes.end());
    out.write(bytes.data(), bytes.size());
  }

  test::ScratchDirectory directory_;
  std::filesystem::path file_;
};

/// From 0 to 1, closer and closer to 0.
std::vector<double> graded(int cells) {
  std::vector<double> x;
  for (int k = 0; k <= cells; ++k) x.push_back(std::pow(static_cast<double>(k) / cells, 3.0));
  return x;
}

ForeignOptions optionsFor(const std::string& field) {
  ForeignOptions options;
  options.field = field;
  options.size = {400, 300};
  return options;
}

TEST(ForeignPercentiles, WeighByAreaAndVolumeAndNotByPoints) {
  for (const std::vector<double>& depth : {std::vector{0.0}, std::vector{0.0, 0.4, 0.5}}) {
    const LatticeFile lattice("foreign_percentiles", {graded(400), {0.0, 0.5}, depth},
                              [](double x, double, double) { return x; });
    ForeignOptions options = optionsFor("value");
    options.clip = 80.0;
    const FrameView view = foreignView(lattice.read(), 0, options);
    EXPECT_NEAR((*view.shown)[0], 0.2, 0.005);
    EXPECT_NEAR((*view.shown)[1], 0.8, 0.01);
    EXPECT_NEAR((*view.extremes)[0], 0.0, 1e-12);
    EXPECT_NEAR((*view.extremes)[1], 1.0, 1e-12);
    options.clip = 100.0;
    EXPECT_EQ(foreignView(lattice.read(), 0, options).shown, view.extremes);
    options.clip = 40.0;
    EXPECT_THAT(messageOf([&] { foreignView(lattice.read(), 0, options); }), HasSubstr("clip: found 40"));
  }
}

TEST(ForeignPercentiles, PassOverWhatIsNoNumber) {
  const auto value = [](double x, double, double) { return x == 0.0 ? std::nan("") : 5.0 + 5.0 * x; };
  const LatticeFile lattice("foreign_gaps", {graded(400), {0.0, 0.5}, {0.0}}, value);
  ForeignOptions options = optionsFor("value");
  options.clip = 99.999;
  const FrameView view = foreignView(lattice.read(), 0, options);
  EXPECT_NEAR((*view.shown)[0], 5.0, 0.01);
  EXPECT_NEAR((*view.shown)[1], 10.0, 0.1);
}

TEST(ForeignPercentiles, CellsCountByTheirSizeAndThoseOfLowerDimensionsNot) {
  vtkNew<vtkPoints> points;
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0, 3.0}) points->InsertNextPoint(x, y, z);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  for (const vtkIdType k : {0, 1}) {
    const std::array<vtkIdType, 8> corners{k, k + 1, k + 4, k + 3, k + 6, k + 7, k + 10, k + 9};
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  }
  const std::array<vtkIdType, 4> face{0, 1, 4, 3};
  grid->InsertNextCell(VTK_QUAD, 4, face.data());
  const Eigen::VectorXd ofCells = sizesIn(*grid, true);
  ASSERT_EQ(ofCells.size(), 3);
  EXPECT_NEAR(ofCells(0), 1.0, 1e-12);
  EXPECT_NEAR(ofCells(1), 2.0, 1e-12);
  EXPECT_EQ(ofCells(2), 0.0);
  EXPECT_NEAR(sizesIn(*grid, false).sum(), 3.0, 1e-12);
}

/// From the first to the last pixel that is drawn, and that is coloured, in rows with coloured ones.
std::array<double, 2> widthsIn(const std::filesystem::path& file) {
  const Picture picture = readPicture(file);
  std::array<int, 2> first{picture.width, picture.width}, last{-1, -1};
  for (int y = 0; y < picture.height; ++y) {
    std::array<std::vector<int>, 2> found;
    for (int x = 0; x < picture.width; ++x) {
      const Color& color = picture.pixels[static_cast<std::size_t>(y * picture.width + x)];
      const auto [low, high] = std::minmax({color[0], color[1], color[2]});
      if (low < 250) found[0].push_back(x);
      if (high - low > 40) found[1].push_back(x);
    }
    if (found[1].empty()) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      first[k] = std::min(first[k], found[k].front());
      last[k] = std::max(last[k], found[k].back());
    }
  }
  return {static_cast<double>(last[0] - first[0]), static_cast<double>(last[1] - first[1])};
}

TEST(ForeignSurfaces, LieWhereTheFieldHasTheirValueAndOnlyInVolumes) {
  std::vector<double> side;
  for (int k = 0; k <= 16; ++k) side.push_back(-1.0 + k / 8.0);
  const auto value = [](double x, double y, double z) { return x * x + y * y + z * z; };
  const LatticeFile cube("foreign_surfaces", {side, side, side}, value);
  ForeignOptions options = optionsFor("value");
  options.view.name = "xy";
  options.colorScale = options.occlusion = false;
  options.title = "";
  options.range = {0.0, 0.25};
  options.isosurfaces = ChosenValues{.count = 0, .field = "value", .values = {0.25}};
  drawForeign(cube.read(), {0}, options, {cube.picture()});
  const auto [body, ball] = widthsIn(cube.picture());
  EXPECT_NEAR(ball / body, 0.5, 0.02);
  options.isosurfaces->values = {4.0};
  takeWarnings();
  drawForeign(cube.read(), {0}, options, {cube.picture()});
  EXPECT_THAT(
      takeWarnings(),
      ElementsAre(HasSubstr(
          "isosurfaces: found \"value=4\", which leaves nothing to be seen; value goes from 0 to 3")));
  options.isosurfaces->field = "other";
  EXPECT_THAT(messageOf([&] { drawForeign(cube.read(), {0}, options, {cube.picture()}); }),
              HasSubstr("isosurfaces: found other"));
  options.isosurfaces = ChosenValues{.count = 3, .field = "", .values = {}};
  const LatticeFile sheet("foreign_sheet", {side, side, {0.0}}, value);
  EXPECT_THAT(messageOf([&] { drawForeign(sheet.read(), {0}, options, {sheet.picture()}); }),
              HasSubstr("has no volumes with value"));
}

}  // namespace
}  // namespace burnish
