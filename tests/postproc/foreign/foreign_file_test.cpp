#include "postproc/foreign/foreign_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_surface.h"
#include "postproc/foreign/check_grid.h"
#include "tests/message_of.h"

/// Files of other programs are read as they are, and damaged ones end in one sentence.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

fs::path sampleOf(const std::string& name) {
  return fs::path(BURNISH_SOURCE_DIR) / "tests/postproc/foreign/samples" / name;
}

std::vector<char> bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeBytes(const std::vector<char>& bytes, const fs::path& file) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

class ForeignFiles : public testing::Test {
 protected:
  ForeignFiles() { fs::create_directories(dir_); }
  ~ForeignFiles() override { fs::remove_all(dir_); }

  const fs::path dir_ = fs::temp_directory_path() / ("burnish_foreign_" + std::to_string(::getpid()));
};

struct Counts {
  vtkIdType points = 0, cells = 0;
  bool operator==(const Counts&) const = default;
};

Counts countsIn(const std::vector<ForeignBlock>& blocks) {
  Counts counts;
  for (const ForeignBlock& block : blocks) {
    counts.points += block.grid->GetNumberOfPoints();
    counts.cells += block.grid->GetNumberOfCells();
  }
  return counts;
}

struct Sample {
  std::string name;
  Counts counts;
};

const std::vector<Sample>& samplesOfPrograms() {
  static const std::vector<Sample> all{
      {"meshio.vtu", {49, 54}},   {"meshio.vtk", {49, 54}},  {"a.exo", {64, 27}},
      {"h5py.vtkhdf", {27, 8}},   {"dealii.vtu", {512, 32}}, {"getfem.vtu", {91, 18}},
      {"paraview.ex2", {47, 14}}, {"cgns.cgns", {12, 2}},    {"tri.case", {4, 2}},
      {"calculix.vtu", {56, 4}},  {"meshio.avs", {49, 54}},  {"meshio.tec", {49, 54}},
      {"assimp.glb", {172, 96}}};
  return all;
}

/// With further files that they name.
const std::vector<Sample>& collectionsOfPrograms() {
  static const std::vector<Sample> all{{"fenicsx.pvd", {28, 18}},
                                       {"openfoam.vtm", {98, 36}},
                                       {"cavity/cavity.foam", {50, 16}},
                                       {"cavity.cas", {50, 16}},
                                       {"paraview.vtpc", {58, 70}}};
  return all;
}

TEST_F(ForeignFiles, OfOtherProgramsAreReadWhole) {
  for (const auto* samples : {&samplesOfPrograms(), &collectionsOfPrograms()})
    for (const auto& [name, counts] : *samples)
      EXPECT_EQ(countsIn(ForeignFile(sampleOf(name)).blocks(0)), counts) << name;
}

/// Of a scalar of a file at its points.
double largestError(const fs::path& file, double (*exact)(const Eigen::Vector3d&),
                    const std::string& field = "temperature") {
  const std::vector<ForeignBlock> blocks = ForeignFile(file).blocks(0);
  const ForeignChoice choice = chooseForeignField(foreignFieldsOf(blocks), field);
  double error = 0.0;
  for (const ForeignBlock& block : blocks) {
    const Eigen::VectorXd values = choice.valuesOf(block);
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      Eigen::Vector3d point;
      block.grid->GetPoint(k, point.data());
      error = std::max(error, std::abs(values(k) - exact(point)));
    }
  }
  return error;
}

TEST_F(ForeignFiles, HaveTheirValuesAtTheirPoints) {
  const auto distance = [](const Eigen::Vector3d& x) { return std::hypot(x(0), x(1)); };
  EXPECT_LT(largestError(sampleOf("meshio.vtu"), distance), 1e-12);
  EXPECT_LT(largestError(sampleOf("meshio.vtk"), distance), 1e-12);
  EXPECT_LT(largestError(sampleOf("meshio.avs"), distance), 1e-6) << "of single precision";
  EXPECT_LT(largestError(sampleOf("meshio.tec"), distance), 1e-6) << "of single precision";
  const auto square = [](const Eigen::Vector3d& x) { return x(0) * x(0) + x(1); };
  EXPECT_LT(largestError(sampleOf("cgns.cgns"), square, "Temperature"), 1e-12);
  EXPECT_LT(largestError(sampleOf("h5py.vtkhdf"), [](const Eigen::Vector3d& x) { return x(0) + x(1); }),
            1e-12);
}

TEST_F(ForeignFiles, WhatTheReaderSaysStandsInTheSentence) {
  std::ofstream(dir_ / "narrow.vtk")
      << "# vtk DataFile Version 5.1\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
         "CELLS 2 3\nOFFSETS vtktypeint32\n0 3\nCONNECTIVITY vtktypeint32\n0 1 2\nCELL_TYPES 1\n5\n";
  EXPECT_THAT(
      messageOf([&] { ForeignFile(dir_ / "narrow.vtk").blocks(0); }),
      HasSubstr("it announces 1 cells and holds 0; its reader says: Unsupported data type: vtktypeint32"));
}

/// A part that others name is told with these, and with its time.
TEST_F(ForeignFiles, ASeriesNamesItselfAndTheTimeOfAPartThatCannotBeRead) {
  for (const char* name : {"fenicsx.pvd", "fenicsx000000.pvtu", "fenicsx000001.pvtu", "fenicsx000002.pvtu",
                           "fenicsx_p0_000000.vtu", "fenicsx_p0_000001.vtu"})
    fs::copy_file(sampleOf(name), dir_ / name);
  const ForeignFile series(dir_ / "fenicsx.pvd");
  const double last = series.times().back();
  EXPECT_EQ(
      messageOf([&] { series.blocks(series.times().size() - 1); }),
      fmt::format(
          "{0}/fenicsx.pvd: t = {1}: {0}/fenicsx000002.pvtu: {0}/fenicsx_p0_000002.vtu: there is no such "
          "file",
          dir_.string(), last));
  writeBytes({'x'}, dir_ / "fenicsx_p0_000000.vtu");
  EXPECT_THAT(messageOf([&] { ForeignFile(dir_ / "fenicsx.pvd").blocks(0); }),
              HasSubstr(fmt::format("fenicsx.pvd: t = {}: ", series.times().front())));
  EXPECT_EQ(ForeignFile(dir_ / "fenicsx.pvd").blocks(1).size(), 1U) << "the others can be read";
}

TEST_F(ForeignFiles, ACaseOfOpenFoamHasWhatItsCellsHaveAtEachTime) {
  const ForeignFile file(sampleOf("cavity/cavity.foam"));
  EXPECT_THAT(file.times(), ElementsAre(0.0, 0.1, 0.2));
  const std::vector<ForeignBlock> blocks = file.blocks(2);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks.front().grid->GetPointData()->GetNumberOfArrays(), 0);
  vtkDataArray* speed = blocks.front().grid->GetCellData()->GetArray("U");
  ASSERT_NE(speed, nullptr);
  // The first number of 0.2/U.
  std::ifstream stream(sampleOf("cavity/0.2/U"));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NEAR(speed->GetComponent(0, 0), std::stod(text.substr(text.find("\n(\n(") + 4)), 1e-7);
}

/// The first cells of cavity.dat.
TEST_F(ForeignFiles, ACaseOfFluentHasTheFieldsOfTheFileBesideIt) {
  const std::vector<ForeignBlock> blocks = ForeignFile(sampleOf("cavity.cas")).blocks(0);
  ASSERT_EQ(blocks.size(), 1U);
  vtkDataArray* pressure = blocks.front().grid->GetCellData()->GetArray("PRESSURE");
  ASSERT_NE(pressure, nullptr);
  EXPECT_NEAR(pressure->GetComponent(1, 0), 0.048604, 1e-12);
}

TEST_F(ForeignFiles, ACaseOfFluentWithoutTheFileBesideItSaysSo) {
  fs::copy_file(sampleOf("cavity.cas"), dir_ / "alone.cas");
  EXPECT_EQ(
      messageOf([&] { ForeignFile(dir_ / "alone.cas").blocks(0); }),
      (dir_ / "alone.cas").string() + ": found no alone.dat beside it, where the fields of such a case are");
}

TEST_F(ForeignFiles, InLettersThatWereCutOffOrAreOthersAreToldSo) {
  const std::vector<char> whole = bytesOf(sampleOf("meshio.avs"));
  for (const std::size_t size : {std::size_t{300}, std::size_t{2500}, std::size_t{4000}, whole.size() - 40}) {
    writeBytes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, dir_ / "cut.avs");
    EXPECT_THAT(messageOf([&] { ForeignFile(dir_ / "cut.avs").blocks(0); }),
                HasSubstr("cut.avs: the file is damaged: it announces"))
        << size;
  }
  std::ofstream(dir_ / "deck.ucd") << "*HEADING\na model\n*NODE\n1, 0., 0., 0.\n";
  EXPECT_THAT(messageOf([&] { ForeignFile(dir_ / "deck.ucd").blocks(0); }),
              HasSubstr("deck.ucd: this is no AVS UCD file in letters: it does not begin with five numbers"));
  std::ofstream(dir_ / "table.tec") << "# x y\n0 1\n1 2\n";
  EXPECT_EQ(messageOf([&] { ForeignFile(dir_ / "table.tec").blocks(0); }),
            (dir_ / "table.tec").string() +
                ": this is no Tecplot file in letters: none of its lines begins with ZONE");
}

/// Samples hold t + x of points at the times 0, 0.5 and 1.5.
TEST_F(ForeignFiles, OfSeveralTimesHaveTheValuesOfEach) {
  fs::copy(sampleOf("tri.geo"), dir_ / "tri.geo");
  std::ofstream(dir_ / "times.case")
      << "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: tri.geo\nVARIABLE\n"
         "scalar per node: 1 level level.**\nTIME\ntime set: 1\nnumber of steps: 3\n"
         "filename start number: 0\nfilename increment: 1\ntime values: 0 0.5 1.5\n";
  constexpr std::array kTimes{0.0, 0.5, 1.5};
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    std::ofstream level(dir_ / fmt::format("level.0{}", k));
    level << "level\npart\n         1\ncoordinates\n";
    for (const double x : {0.0, 1.0, 1.0, 0.0}) level << fmt::format("{:12.5e}\n", kTimes[k] + x);
  }
  const auto expectLevels = [&](const fs::path& name, const char* field) {
    const ForeignFile file(name);
    EXPECT_THAT(file.times(), testing::ElementsAreArray(kTimes)) << name;
    for (std::size_t k = 0; k < kTimes.size(); ++k)
      for (const ForeignBlock& block : file.blocks(k)) {
        vtkDataArray* levels = block.grid->GetPointData()->GetArray(field);
        ASSERT_NE(levels, nullptr) << name;
        for (vtkIdType i = 0; i < levels->GetNumberOfTuples(); ++i)
          EXPECT_NEAR(levels->GetComponent(i, 0), kTimes[k] + block.grid->GetPoint(i)[0], 1e-6) << name;
      }
  };
  expectLevels(dir_ / "times.case", "level");
  expectLevels(sampleOf("times.ex2"), "level");
  expectLevels(sampleOf("times.cgns"), "Temperature");
}

/// A series of JSON, as ParaView and others write it beside files of one time each.
TEST_F(ForeignFiles, ASeriesOfJsonIsOneOfItsFilesByTheirTimes) {
  for (const char* name : {"meshio.vtu", "dealii.vtu"}) fs::copy_file(sampleOf(name), dir_ / name);
  const fs::path series = dir_ / "sheet.vtu.series";
  std::ofstream(series) << R"({"file-series-version": "1.0", "files": [
    {"name": "dealii.vtu", "time": 1.5}, {"name": "meshio.vtu", "time": 0}]})";
  const ForeignFile file(series);
  EXPECT_THAT(file.times(), ElementsAre(0.0, 1.5));
  EXPECT_EQ(countsIn(file.blocks(0)), (Counts{49, 54}));
  EXPECT_EQ(countsIn(file.blocks(1)), (Counts{512, 32}));
  const auto problemOf = [&](const char* text) {
    std::ofstream(series) << text;
    return messageOf([&] { ForeignFile(series).blocks(0); });
  };
  EXPECT_EQ(problemOf("series"), series.string() + ": found no series of VTK files in it");
  EXPECT_EQ(problemOf(std::string(5000, '[').c_str()),
            series.string() + ": found no series of VTK files in it");
  EXPECT_EQ(problemOf("[1]"), series.string() + ": found no series of VTK files in it");
  EXPECT_EQ(problemOf(R"({"files": []})"), series.string() + ": the collection is empty");
  EXPECT_EQ(problemOf(R"({"files": [{"name": "meshio.vtu"}]})"),
            series.string() + ": an entry of its files has no name or no time");
  EXPECT_EQ(
      problemOf(R"({"files": [{"name": "none.vtu", "time": 2}]})"),
      fmt::format("{}: t = 2: {}: there is no such file", series.string(), (dir_ / "none.vtu").string()));
}

TEST_F(ForeignFiles, LatticesInPiecesAreReadWhole) {
  for (int k = 0; k < 2; ++k)
    std::ofstream(dir_ / fmt::format("half_{}.vti", k)) << fmt::format(
        R"(<VTKFile type="ImageData" version="0.1"><ImageData WholeExtent="{0} {1} 0 1 0 1" Origin="0 0 0" Spacing="1 1 1">
<Piece Extent="{0} {1} 0 1 0 1"><PointData/><CellData><DataArray type="Float64" Name="h" format="ascii">{0} {1}</DataArray>
</CellData></Piece></ImageData></VTKFile>)",
        2 * k, 2 * k + 2);
  std::ofstream(dir_ / "whole.pvti")
      << R"(<VTKFile type="PImageData" version="0.1"><PImageData WholeExtent="0 4 0 1 0 1" GhostLevel="0" Origin="0 0 0"
Spacing="1 1 1"><PCellData><PDataArray type="Float64" Name="h"/></PCellData><Piece Extent="0 2 0 1 0 1" Source="half_0.vti"/>
<Piece Extent="2 4 0 1 0 1" Source="half_1.vti"/></PImageData></VTKFile>)";
  const std::vector<ForeignBlock> blocks = ForeignFile(dir_ / "whole.pvti").blocks(0);
  EXPECT_EQ(countsIn(blocks), (Counts{24, 4}));
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[1].grid->GetCellData()->GetArray("h")->GetComponent(0, 0), 2.0);
}

TEST(ForeignFields, HaveNamesOfTheirOwnThatOneCanGive) {
  vtkNew<vtkUnstructuredGrid> grid;
  const auto add = [](vtkDataSetAttributes& data, const char* name, int components = 1) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    data.AddArray(array);
  };
  for (const char* name : {"a [m]", "a [mm]", "a [s]", "S, Mises [MPa]", "line\nbreak", "caf\xE9"})
    add(*grid->GetPointData(), name);
  add(*grid->GetPointData(), "u", 3);
  add(*grid->GetPointData(), "u.x");
  for (const char* name : {"a [m]", "u"}) add(*grid->GetCellData(), name);
  const auto fields = foreignFieldsOf({{"", grid.Get()}});
  std::vector<std::string> names;
  for (const ForeignField& field : fields) names.push_back(field.name);
  EXPECT_THAT(names, ElementsAre("a", "points.a", "points.a_2", "S Mises", "line\\nbreak", "caf\\xE9", "u",
                                 "points.u.x", "cells.a", "cells.u"));
  for (const ForeignField& field : fields)
    EXPECT_EQ(chooseForeignField(fields, field.name).field.array, field.array);
  EXPECT_EQ(chooseForeignField(fields, "S, Mises").field.name, "S Mises");
  EXPECT_EQ(chooseForeignField(fields, "S, Mises [MPa]").field.unit, "MPa");
  EXPECT_EQ(chooseForeignField(fields, "points.a_2").field.unit, "s");
  EXPECT_EQ(chooseForeignField(fields, "u.x").component, 0);

  vtkNew<vtkUnstructuredGrid> tensors;  // whose names mean nothing without a component
  add(*tensors->GetPointData(), "S", 6);
  add(*tensors->GetPointData(), "T");
  add(*tensors->GetCellData(), "S");
  add(*tensors->GetCellData(), "T", 6);
  const auto ofBoth = foreignFieldsOf({{"", tensors.Get()}});
  EXPECT_TRUE(chooseForeignField(ofBoth, "cells.S").field.ofCells);
  EXPECT_TRUE(chooseForeignField(ofBoth, "cells.T.xx").field.ofCells);
}

TEST_F(ForeignFiles, FieldsHaveNamesUnitsAndComponents) {
  const auto fields = foreignFieldsOf(ForeignFile(sampleOf("meshio.vtu")).blocks(0));
  EXPECT_EQ(chooseForeignField(fields, "stress.xy").component, 3);
  EXPECT_EQ(chooseForeignField(fields, "stress.3").component, 3);
  EXPECT_TRUE(chooseForeignField(fields, "region").field.ofCells);
  EXPECT_THAT(messageOf([&] { chooseForeignField(fields, "temprature"); }),
              HasSubstr("Did you mean \"temperature\"?"));
  EXPECT_EQ(chooseForeignField(fields, "stress.xy").signInMirror(0), -1.0);
  EXPECT_EQ(chooseForeignField(fields, "stress.xx").signInMirror(0), 1.0);
  ForeignField named;
  named.components = {"axial", "yx"};
  EXPECT_EQ((ForeignChoice{named, 0}.signInMirror(0)), 1.0);
  EXPECT_EQ((ForeignChoice{named, 1}.signInMirror(0)), -1.0);
}

TEST_F(ForeignFiles, OfSolidsShowTheirOutsideAlone) {
  const auto blocks = ForeignFile(sampleOf("h5py.vtkhdf")).blocks(0);
  const auto cells = shownCells({blocks.front().grid});
  EXPECT_EQ(outerFaces(*cells)->GetNumberOfCells(), 24);
  EXPECT_FALSE(isPlane(*cells));
}

/// Cells that have points of their own each, as discontinuous elements have, still have no faces inside.
TEST_F(ForeignFiles, OfCellsApartShowNoFacesInside) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int cell = 0; cell < 2; ++cell)
    for (int corner = 0; corner < 8; ++corner)
      points->InsertNextPoint(cell + ((corner ^ (corner >> 1)) & 1), (corner >> 1) & 1, corner >> 2);
  grid->SetPoints(points);
  for (vtkIdType cell = 0; cell < 2; ++cell) {
    std::array<vtkIdType, 8> corners{};
    for (vtkIdType k = 0; k < 8; ++k) corners[static_cast<std::size_t>(k)] = 8 * cell + k;
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  }
  EXPECT_EQ(outerFaces(*shownCells({grid.Get()}))->GetNumberOfCells(), 10);
}

/// Gmsh writes triangles and lines on the surface of its tetrahedra, too.
TEST_F(ForeignFiles, FacesOfVolumesAreNoCellsOfTheirOwn) {
  const auto blocks = ForeignFile(sampleOf("gmsh.vtk")).blocks(0);
  const auto cells = shownCells({blocks.front().grid});
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    ASSERT_EQ(cells->GetCellType(cell), VTK_TETRA);
}

TEST_F(ForeignFiles, NumbersOfPointsThatAreNotThereAreNotSound) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 3; ++k) points->InsertNextPoint(k, k * k, 0);
  grid->SetPoints(points);
  std::array<vtkIdType, 3> corners{0, 1, 2};
  grid->InsertNextCell(VTK_TRIANGLE, 3, corners.data());
  EXPECT_TRUE(isSound(*grid));
  corners[2] = 3;
  grid->InsertNextCell(VTK_TRIANGLE, 3, corners.data());
  EXPECT_FALSE(isSound(*grid));
}

TEST_F(ForeignFiles, OfWrongSizeOfCellsAreNotSound) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 3; ++k) points->InsertNextPoint(k, k * k, 0);
  grid->SetPoints(points);
  const std::array<vtkIdType, 3> corners{0, 1, 2};
  grid->InsertNextCell(VTK_HEXAHEDRON, 3, corners.data());
  EXPECT_FALSE(isSound(*grid));
}

TEST_F(ForeignFiles, ThatAnnounceMoreThanTheyHoldAreDamaged) {
  std::vector<char> bytes = bytesOf(sampleOf("gmsh.stl"));
  bytes.resize(bytes.size() - 70);
  writeBytes(bytes, dir_ / "cut.stl");
  EXPECT_THAT(messageOf([&] { ForeignFile(dir_ / "cut.stl").blocks(0); }), HasSubstr("it announces"));
}

TEST_F(ForeignFiles, OfTrianglesMayBeWrittenInCapitals) {
  std::ofstream(dir_ / "CAPITALS.STL")
      << "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\n"
         "VERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID A\n";
  EXPECT_EQ(ForeignFile(dir_ / "CAPITALS.STL").blocks(0).front().grid->GetNumberOfCells(), 1);
}

TEST_F(ForeignFiles, ThatAreNotThereAreNamed) {
  EXPECT_THAT(messageOf([&] { ForeignFile(dir_ / "absent.exo"); }),
              HasSubstr("absent.exo: there is no such file"));
}

/// Writes samples of VTK's own writers.
std::vector<fs::path> writtenByVtk(const fs::path& dir) {
  const auto blocks = ForeignFile(sampleOf("h5py.vtkhdf")).blocks(0);
  const auto faces = outerFaces(*blocks.front().grid);
  const auto write = [&](auto& writer, vtkDataObject* data, const char* name) {
    writer.SetInputDataObject(data);
    writer.SetFileName((dir / name).c_str());
    writer.Write();
    return dir / name;
  };
  vtkNew<vtkXMLUnstructuredGridWriter> grid, plain;
  plain->SetDataModeToAscii();
  vtkNew<vtkXMLPolyDataWriter> poly;
  vtkNew<vtkUnstructuredGridWriter> legacy, binary;
  binary->SetFileTypeToBinary();
  vtkNew<vtkPLYWriter> ply;
  vtkNew<vtkOBJWriter> obj;
  return {write(*grid, blocks.front().grid, "a.vtu"),
          write(*plain, blocks.front().grid, "plain.vtu"),
          write(*poly, faces, "a.vtp"),
          write(*legacy, blocks.front().grid, "a.vtk"),
          write(*binary, blocks.front().grid, "bin.vtk"),
          write(*ply, faces, "a.ply"),
          write(*obj, faces, "a.obj")};
}

/// Cut and changed files: a sentence that names the file, or something sound; never an end of this process.
TEST_F(ForeignFiles, DamagedInAnyWayEndInASentence) {
  std::vector<fs::path> files = writtenByVtk(dir_);
  for (const Sample& sample : samplesOfPrograms()) files.push_back(sampleOf(sample.name));
  for (const char* name : {"gmsh.vtk", "gmsh.stl", "paraview.vtpc", "times.ex2", "times.cgns"})
    files.push_back(sampleOf(name));
  fs::copy(sampleOf("paraview"), dir_ / "paraview");
  fs::copy(sampleOf("tri.geo"), dir_ / "tri.geo");
  fs::copy(sampleOf("tri.temp"), dir_ / "tri.temp");
  unsigned seed = 12345;
  int refused = 0, read = 0;
  const auto random = [&seed] { return (seed = seed * 1664525U + 1013904223U) >> 8U; };
  for (const fs::path& file : files) {
    const std::vector<char> whole = bytesOf(file);
    const fs::path damaged = dir_ / ("damaged" + file.extension().string());
    for (int k = 0; k < 20; ++k) {
      std::vector<char> bytes = whole;
      if (k < 8)
        bytes.resize(whole.size() * static_cast<std::size_t>(k) / 8);
      else
        for (int change = 0; change < 1 + k % 4; ++change) {
          const std::size_t at =
              random() % (k % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 2000));
          bytes[at] = static_cast<char>(random());
        }
      writeBytes(bytes, damaged);
      const auto begin = std::chrono::steady_clock::now();
      const std::string message = messageOf([&] {
        for (const ForeignBlock& block : ForeignFile(damaged).blocks(0)) EXPECT_TRUE(isSound(*block.grid));
      });
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << file << " " << k;
      ++(message.empty() ? read : refused);
      EXPECT_TRUE(message.empty() || message.find("damaged") != std::string::npos)
          << file << " " << k << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
  EXPECT_GT(refused, read);
}

}  // namespace
}  // namespace burnish
