#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "postproc/export/vtu_series_writer.h"
#include "tests/engine/analysis/model_samples.h"
#include "tests/postproc/export/vtu_files.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using testing::ElementsAre;
using testing::HasSubstr;

ModelRecord ringWithTools() {
  ModelRecord model = modelOf(quarterRing());
  model.subdivision = 2;
  model.lengthUnit = "mm";
  model.tools = {{"cylinder", Cylinder{{0.0, 3.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.5}},
                 {"flat table", Plane{{0.0, -0.5, 0.0}, Eigen::Vector3d::UnitY()}}};
  return model;
}

using VtuSeries = test::VtuFiles;

TEST_F(VtuSeries, IsReadBackBitForBit) {
  const ModelRecord model = ringWithTools();
  const FrameRecord frame = frameOf(model, 0, 0.0);
  VtuSeriesWriter(directory_, model).write(frame);

  const auto expected = makeGrid(Tessellation(model.mesh, model.subdivision), frame, true, "mm");
  const auto grid = readGrid("body_000000.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 6 * 8);
  ASSERT_EQ(grid->GetNumberOfPoints(), 7 * 9);
  EXPECT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(grid->GetPoint(i)[c], expected->GetPoint(i)[c]);
  ASSERT_EQ(grid->GetPointData()->GetNumberOfArrays(), 5);
  for (int a = 0; a < 5; ++a) {
    vtkDataArray* wanted = expected->GetPointData()->GetArray(a);
    vtkDataArray* found = grid->GetPointData()->GetArray(wanted->GetName());
    ASSERT_NE(found, nullptr) << wanted->GetName();
    EXPECT_EQ(found->GetDataType(), VTK_DOUBLE);
    for (vtkIdType i = 0; i < wanted->GetNumberOfTuples(); ++i)
      for (int c = 0; c < wanted->GetNumberOfComponents(); ++c)
        ASSERT_EQ(found->GetComponent(i, c), wanted->GetComponent(i, c));
  }
  ASSERT_NE(grid->GetCellData()->GetArray("patch"), nullptr);
}

TEST_F(VtuSeries, KeepsTheNamesOfComponents) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter(directory_, model).write(frameOf(model, 0, 0.0));
  const auto grid = readGrid("body_000000.vtu");
  const auto names = [&](const char* field) {
    vtkDataArray* array = grid->GetPointData()->GetArray(field);
    std::vector<std::string> result;
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) result.emplace_back(array->GetComponentName(c));
    return result;
  };
  EXPECT_THAT(names("stress [MPa]"), ElementsAre("xx", "yy", "xy", "zz"));
  EXPECT_THAT(names("displacement [mm]"), ElementsAre("X", "Y", "Z"));
}

TEST_F(VtuSeries, LeavesOutFieldsThatTheFrameHasNot) {
  const ModelRecord model = ringWithTools();
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.fields.erase("plastic_strain");
  VtuSeriesWriter(directory_, model).write(frame);
  const auto grid = readGrid("body_000000.vtu");
  EXPECT_EQ(grid->GetPointData()->GetArray("plastic_strain"), nullptr);
  EXPECT_NE(grid->GetPointData()->GetArray("pressure [MPa]"), nullptr);
}

TEST_F(VtuSeries, ToolsAreLinesAtTheirCurrentPosition) {
  const ModelRecord model = ringWithTools();
  const FrameRecord frame = frameOf(model, 3, 0.5);
  VtuSeriesWriter(directory_, model).write(frame);
  const auto circle = readPolyData("tool_cylinder_000003.vtp");
  ASSERT_EQ(circle->GetNumberOfCells(), 1);
  EXPECT_EQ(circle->GetCellType(0), VTK_POLY_LINE);
  const Eigen::Vector2d center = Eigen::Vector2d(0.0, 3.0) + frame.toolDisplacement.col(0);
  for (vtkIdType i = 0; i < circle->GetNumberOfPoints(); ++i)
    EXPECT_NEAR((Eigen::Map<const Eigen::Vector2d>(circle->GetPoint(i)) - center).norm(), 0.5, 1e-14);
  const auto table = readPolyData("tool_flat_table_000003.vtp");
  ASSERT_EQ(table->GetNumberOfPoints(), 2);
  EXPECT_NEAR(table->GetPoint(1)[1], -0.5 + frame.toolDisplacement(1, 1), 1e-14);
}

TEST_F(VtuSeries, BlocksInSpaceAreHexahedra) {
  ModelRecord model = modelOf(box({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}));
  model.subdivision = 2;
  model.tools = {{"ball", Sphere{{0.5, 3.0, 1.5}, 0.4}}};
  VtuSeriesWriter(directory_, model).write(frameOf(model, 0, 0.0));
  EXPECT_EQ(readGrid("body_000000.vtu")->GetCellType(7), VTK_HEXAHEDRON);
  EXPECT_GT(readPolyData("tool_ball_000000.vtp")->GetNumberOfCells(), 100);
}

TEST_F(VtuSeries, CollectionListsAllFramesAndParts) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter writer(directory_, model);
  const std::vector<double> times{0.0, 0.1, 1.0 / 3.0};
  for (int i = 0; i < 3; ++i) {
    writer.write(frameOf(model, i, times[static_cast<std::size_t>(i)]));
    ASSERT_EQ(readCollection().size(), static_cast<std::size_t>(3 * (i + 1)));
  }
  const std::vector<Entry> entries = readCollection();
  const std::vector<std::string> names{"body", "tool_cylinder", "tool_flat_table"};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry expected{
        times[i / 3], static_cast<int>(i % 3), names[i % 3],
        "frames/" + names[i % 3] + "_00000" + std::to_string(i / 3) + (i % 3 == 0 ? ".vtu" : ".vtp")};
    EXPECT_EQ(entries[i], expected) << entries[i].file;
    EXPECT_TRUE(fs::exists(directory_ / entries[i].file));
  }
  EXPECT_THAT(bytes(directory_ / "frames.pvd"), HasSubstr("timestep=\"0.1\""));
  EXPECT_EQ(filesIn(directory_ / "frames").size(), 9u);
  EXPECT_THAT(filesIn(directory_), ElementsAre("frames", "frames.pvd"));
}

TEST_F(VtuSeries, AToolThatIsTakenAwayIsInNoFrameAfterwards) {
  ModelRecord model = ringWithTools();
  model.tools[1].until = 5e-10;
  VtuSeriesWriter writer(directory_, model);
  for (const int i : {0, 1, 2}) writer.write(frameOf(model, i, 5e-10 * i));
  std::map<double, std::vector<std::string>> parts;
  for (const Entry& entry : readCollection()) parts[entry.time].push_back(entry.name);
  EXPECT_THAT(parts[0.0], ElementsAre("body", "tool_cylinder", "tool_flat_table"));
  EXPECT_EQ(parts[5e-10], parts[0.0]) << "it still presses then";
  EXPECT_THAT(parts[1e-9], ElementsAre("body", "tool_cylinder"));
  EXPECT_FALSE(fs::exists(directory_ / "frames/tool_flat_table_000002.vtp"));
}

TEST_F(VtuSeries, AFrameReplacesThoseFromItsIndexOn) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter writer(directory_, model);
  for (int i = 0; i < 4; ++i) writer.write(frameOf(model, i, i));
  writer.write(frameOf(model, 1, 0.5));
  const std::vector<Entry> entries = readCollection();
  ASSERT_EQ(entries.size(), 6u);
  EXPECT_EQ(entries.back().time, 0.5);
  EXPECT_EQ(filesIn(directory_ / "frames").size(), 6u);
}

TEST_F(VtuSeries, FilesOfAnEarlierSeriesAreRemovedAndOthersKept) {
  ModelRecord earlier = ringWithTools();
  earlier.tools[0].name = "former";
  {
    VtuSeriesWriter longer(
        directory_, earlier,
        {.cells = CellKind::Bezier,
         .parts = {ExportPart::Body, ExportPart::Tools, ExportPart::Points, ExportPart::Net}});
    for (int i = 0; i < 3; ++i) longer.write(frameOf(earlier, i, i));
    ASSERT_EQ(filesIn(directory_ / "frames").size(), 15u);
  }
  std::ofstream(directory_ / "frames/tool_cylinder_000007.vtp.partial") << "cut off";
  for (const char* file : {"body_notes.vtu", "body_01.vtu", "mytool_a_000001.vtp", "tool_a_000001.csv"})
    std::ofstream(directory_ / "frames" / file) << "of the user";
  VtuSeriesWriter writer(directory_, ringWithTools());
  EXPECT_FALSE(fs::exists(directory_ / "frames.pvd"));
  EXPECT_THAT(filesIn(directory_ / "frames"),
              ElementsAre("body_01.vtu", "body_notes.vtu", "mytool_a_000001.vtp", "tool_a_000001.csv"));
}

TEST_F(VtuSeries, OnlyTheChosenPartsAreWritten) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter writer(directory_, model, {.parts = {ExportPart::Net, ExportPart::Tools}});
  writer.write(frameOf(model, 4, 1.0));
  EXPECT_THAT(filesIn(directory_ / "frames"),
              ElementsAre("net_000004.vtp", "tool_cylinder_000004.vtp", "tool_flat_table_000004.vtp"));
  EXPECT_EQ(readCollection().size(), 3u);
}

TEST_F(VtuSeries, FilesKnowTheTimeOfTheAnalysis) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter(directory_, model).write(frameOf(model, 3, 1.0 / 3.0));
  const std::vector<vtkSmartPointer<vtkDataObject>> files{readGrid("body_000003.vtu"),
                                                          readPolyData("tool_cylinder_000003.vtp")};
  for (const auto& file : files) {
    vtkDataArray* time = file->GetFieldData()->GetArray("TimeValue");
    ASSERT_NE(time, nullptr);
    EXPECT_EQ(time->GetComponent(0, 0), 1.0 / 3.0);
  }
}

TEST_F(VtuSeries, EqualFramesGiveEqualBytes) {
  const ModelRecord model = ringWithTools();
  const auto writeTo = [&](const char* name) {
    VtuSeriesWriter(directory_ / name, model).write(frameOf(model, 0, 0.25));
  };
  writeTo("a");
  writeTo("b");
  for (const char* file : {"frames.pvd", "frames/body_000000.vtu", "frames/tool_cylinder_000000.vtp",
                           "frames/tool_flat_table_000000.vtp"}) {
    EXPECT_GT(bytes(directory_ / "a" / file).size(), 100u);
    EXPECT_EQ(bytes(directory_ / "a" / file), bytes(directory_ / "b" / file)) << file;
  }
}

TEST_F(VtuSeries, DataAreCompressedBase64) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter(directory_, model).write(frameOf(model, 0, 0.0));
  const std::string xml = bytes(directory_ / "frames/body_000000.vtu");
  EXPECT_THAT(xml, HasSubstr("compressor=\"vtkZLibDataCompressor\""));
  EXPECT_THAT(xml, HasSubstr("<AppendedData encoding=\"base64\">"));
}

TEST_F(VtuSeries, NamesOfToolsNeverCollideOrLeaveTheDirectory) {
  ModelRecord model = ringWithTools();
  model.tools[0].name = "body";
  model.tools[1].name = "../Body";
  VtuSeriesWriter(directory_, model).write(frameOf(model, 0, 0.0));
  model.tools[1].name = "BODY";
  VtuSeriesWriter(directory_, model).write(frameOf(model, 0, 0.0));
  EXPECT_THAT(filesIn(directory_), ElementsAre("frames", "frames.pvd"));
  EXPECT_THAT(filesIn(directory_ / "frames"),
              ElementsAre("body_000000.vtu", "tool_BODY_2_000000.vtp", "tool_body_000000.vtp"));
}

TEST_F(VtuSeries, ErrorsNameTheFile) {
  const ModelRecord model = ringWithTools();
  std::ofstream(directory_ / "taken") << "a file";
  try {
    VtuSeriesWriter writer(directory_ / "taken", model);
    FAIL() << "a file was taken for a directory";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("taken"));
  }
  VtuSeriesWriter writer(directory_, model);
  fs::create_directories(directory_ / "frames/body_000000.vtu/in_the_way");
  try {
    writer.write(frameOf(model, 0, 0.0));
    FAIL() << "a directory was overwritten";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("body_000000.vtu"));
  }
  EXPECT_FALSE(fs::exists(directory_ / "frames.pvd"));
}

TEST_F(VtuSeries, RefusesAFrameOfAnotherModel) {
  const ModelRecord model = ringWithTools();
  VtuSeriesWriter writer(directory_, model);
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.toolDisplacement.conservativeResize(2, 1);
  EXPECT_THROW(writer.write(frame), Error);
  EXPECT_THAT(filesIn(directory_ / "frames"), testing::IsEmpty());
}

TEST_F(VtuSeries, SeveralBodiesArePartsOfTheirOwn) {
  const samples::Sample sample = samples::twoBodies();
  VtuSeriesWriter writer(directory_, sample.model,
                         {.parts = {ExportPart::Body, ExportPart::Tools, ExportPart::Net}});
  writer.write(sample.frame);
  EXPECT_EQ(
      filesIn(directory_ / "frames"),
      (std::set<std::string>{"body_block_000000.vtu", "body_stamp_000000.vtu", "tool_cylinder_000000.vtp",
                             "net_block_000000.vtp", "net_stamp_000000.vtp", "all_000000.vtm"}));
  std::vector<std::string> names;
  for (const Entry& entry : readCollection()) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"body_block", "body_stamp", "tool_cylinder", "net_block",
                                             "net_stamp"}));

  const auto block = readGrid("body_block_000000.vtu"), stamp = readGrid("body_stamp_000000.vtu");
  EXPECT_TRUE(block->GetPointData()->HasArray("plastic_strain"));
  EXPECT_FALSE(stamp->GetPointData()->HasArray("plastic_strain"));
  EXPECT_TRUE(stamp->GetPointData()->HasArray("von_mises [MPa]"));
  double bounds[6];
  stamp->GetBounds(bounds);
  EXPECT_DOUBLE_EQ(bounds[0], 3.5);
  EXPECT_DOUBLE_EQ(bounds[1], 4.5);

  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((directory_ / "frames" / "all_000000.vtm").c_str());
  reader->Update();
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 5u);
  EXPECT_STREQ(blocks->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "body_stamp");
  EXPECT_EQ(vtkUnstructuredGrid::SafeDownCast(blocks->GetBlock(1))->GetNumberOfCells(),
            stamp->GetNumberOfCells());
}

/// Of every cell its patch, and for each of its points, in order, where it is and what it holds; but for
/// rounding.
std::multiset<std::vector<double>> contents(vtkUnstructuredGrid& grid) {
  std::multiset<std::vector<double>> all;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    std::vector<double> values{grid.GetCellData()->GetArray("patch")->GetComponent(cell, 0)};
    for (int k = 0; k < grid.GetCell(cell)->GetNumberOfPoints(); ++k) {
      const vtkIdType point = grid.GetCell(cell)->GetPointId(k);
      values.insert(values.end(), grid.GetPoint(point), grid.GetPoint(point) + 3);
      for (int a = 0; a < grid.GetPointData()->GetNumberOfArrays(); ++a) {
        vtkDataArray* array = grid.GetPointData()->GetArray(a);
        for (int c = 0; c < array->GetNumberOfComponents(); ++c)
          values.push_back(array->GetComponent(point, c));
      }
    }
    for (double& value : values) value = std::round(1e8 / std::numbers::pi * value);
    all.insert(std::move(values));
  }
  return all;
}

TEST_F(VtuSeries, PiecesTogetherAreTheBody) {
  samples::Sample twoPatches = samples::twoBodies();
  twoPatches.model.bodies.clear();
  twoPatches.frame.fields.erase("plastic_strain");  // of one of the bodies
  for (const samples::Sample& sample : {samples::ring(), samples::cube(), twoPatches})
    for (const CellKind cells : {CellKind::Linear, CellKind::Lagrange, CellKind::Bezier}) {
      VtuSeriesWriter(directory_, sample.model, {.cells = cells}).write(sample.frame);
      const auto whole = readGrid("body_000000.vtu");
      VtuSeriesWriter(directory_, sample.model, {.cells = cells, .pieces = 3}).write(sample.frame);
      const auto pieces = readPieces("body_000000.pvtu");
      EXPECT_EQ(filesIn(directory_ / "frames").count("body_000000.vtu"), 0u);
      EXPECT_EQ(readCollection().front().file, "frames/body_000000.pvtu");
      EXPECT_TRUE(contents(*pieces) == contents(*whole));
      EXPECT_GT(pieces->GetNumberOfPoints(),
                whole->GetNumberOfPoints());  // both pieces have those between them
      vtkDataArray *stresses = whole->GetPointData()->GetArray(0),
                   *found = pieces->GetPointData()->GetArray(0);
      EXPECT_STREQ(found->GetName(), stresses->GetName());
      EXPECT_STREQ(found->GetComponentName(1), stresses->GetComponentName(1));
      EXPECT_EQ(pieces->GetPointData()->GetRationalWeights() != nullptr, cells == CellKind::Bezier);
      EXPECT_EQ(pieces->GetCellData()->GetHigherOrderDegrees() != nullptr, cells != CellKind::Linear);
    }
}

TEST_F(VtuSeries, PiecesAreSlabsOfWholeSpans) {
  const ModelRecord model = modelOf(quarterRing());  // 3 x 4 spans
  const auto numPieces = [&](int count) {
    VtuSeriesWriter(directory_, model, {.pieces = count}).write(frameOf(model, 0, 0.0));
    return filesIn(directory_ / "frames").size() - 1;
  };
  EXPECT_EQ(numPieces(3), 3u);
  EXPECT_EQ(numPieces(100), 4u);
  int cells = 0;
  for (int piece = 0; piece < 4; ++piece) {
    const auto grid = readGrid("body_000000_" + std::to_string(piece) + ".vtu");
    EXPECT_EQ(grid->GetNumberOfCells(), 3 * model.subdivision * model.subdivision);
    cells += static_cast<int>(grid->GetNumberOfCells());
  }
  EXPECT_EQ(readPieces("body_000000.pvtu")->GetNumberOfCells(), cells);
  EXPECT_EQ(numPieces(1), 0u);  // a file for the body alone, and none of those before is left
}

TEST_F(VtuSeries, PiecesOfSeveralBodiesAreNamedByTheFileOfAFrame) {
  const samples::Sample sample = samples::twoBodies();
  VtuSeriesWriter writer(directory_, sample.model, {.parts = {ExportPart::Body}, .pieces = 2});
  writer.write(sample.frame);
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((directory_ / "frames" / "all_000000.vtm").c_str());
  reader->Update();
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 2u);
  for (unsigned block = 0; block < 2; ++block) {
    const auto alone = readPieces(block == 0 ? "body_block_000000.pvtu" : "body_stamp_000000.pvtu");
    auto* pieces = vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(block));
    ASSERT_NE(pieces, nullptr);
    EXPECT_EQ(pieces->GetNumberOfCells(), alone->GetNumberOfCells());
  }
  FrameRecord again = sample.frame;
  again.index = 0;
  writer.write(again);
  EXPECT_EQ(filesIn(directory_ / "frames").size(),
            7u);  // the blocks; of each body two pieces and what names them
}

/// The limit on the size of a file stands in for a full disk.
TEST_F(VtuSeries, AFullDiskIsAnErrorAndLeavesNoPart) {
  const ModelRecord model = ringWithTools();
  const FrameRecord frame = frameOf(model, 0, 0.0);
  VtuSeriesWriter writer(directory_, model);
  const auto writeOnFullDisk = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = 2000, .rlim_max = 2000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writer.write(frame);
    } catch (const Error& error) {
      const std::string expected = "cannot write " + (directory_ / "frames/body_000000.vtu").string();
      std::exit(std::string(error.what()).starts_with(expected) ? 3 : 1);
    }
  };
  EXPECT_EXIT(writeOnFullDisk(), testing::ExitedWithCode(3), "");
  EXPECT_THAT(filesIn(directory_ / "frames"), testing::IsEmpty());
}

}  // namespace
}  // namespace burnish
