#include "postproc/export/vtu_series_writer.h"

#include <fmt/format.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>
#include <span>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/atomic_file.h"
#include "engine/results/check_records.h"
#include "postproc/mesh/outlines.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// What all file systems and URLs accept of a name.
std::string fileStem(const std::string& name) {
  std::string stem = std::regex_replace(name, std::regex("[^A-Za-z0-9_-]"), "_");
  return stem.empty() ? "tool" : stem;
}

/// One stem per data set, no two alike even where a file system ignores case.
std::vector<std::string> fileStems(const std::vector<ToolRecord>& tools) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::vector<std::string> stems{"body"};
  for (const ToolRecord& tool : tools) {
    const std::string wanted = fileStem(tool.name);
    std::string stem = wanted;
    const auto taken = [&](const std::string& other) { return lower(other) == lower(stem); };
    for (int k = 2; std::any_of(stems.begin(), stems.end(), taken); ++k)
      stem = fmt::format("{}_{}", wanted, k);
    stems.push_back(stem);
  }
  return stems;
}

/// The same points and cells as a data set that can go into a VTU file.
vtkSmartPointer<vtkUnstructuredGrid> asGrid(vtkPolyData& outline) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(outline.GetPoints());
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < outline.GetNumberOfCells(); ++cell) {
    outline.GetCellPoints(cell, points);
    grid->InsertNextCell(outline.GetCellType(cell), points);
  }
  return grid;
}

void writeGrid(vtkUnstructuredGrid& grid, const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0)
    throw Error(fmt::format("cannot write {}: VTK failed to encode it", file.string()));
  const std::string text = writer->GetOutputString();
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

Eigen::AlignedBox3d boundingBox(vtkUnstructuredGrid& grid) {
  const double* b = grid.GetBounds();
  return {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
}

void removeFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw Error(fmt::format("cannot remove {}: {}", file.string(), error.message()));
}

}  // namespace

VtuSeriesWriter::VtuSeriesWriter(fs::path runDir, ModelRecord model)
    : runDir_(std::move(runDir)),
      model_(std::move(model)),
      stems_(fileStems(model_.tools)),
      tessellation_(model_, model_.subdivision) {
  std::error_code error;
  fs::create_directories(runDir_ / "frames", error);
  if (error)
    throw Error(
        fmt::format("cannot create the directory {}: {}", (runDir_ / "frames").string(), error.message()));
  removeEarlierSeries();
}

void VtuSeriesWriter::write(const FrameRecord& frame) {
  checkFrame(frame, model_, fmt::format("frame {} for {}", frame.index, (runDir_ / "frames").string()));
  const auto body = makeGrid(tessellation_, frame, true);
  writeGrid(*body, file(0, frame.index));
  for (std::size_t i = 0; i < model_.tools.size(); ++i) {
    const Eigen::VectorXd u = frame.toolDisplacement.col(static_cast<Eigen::Index>(i));
    writeGrid(*asGrid(*toolOutline(model_.tools[i], u, boundingBox(*body))), file(i + 1, frame.index));
  }
  const std::map<int, double> dropped(times_.upper_bound(frame.index), times_.end());
  times_.erase(times_.lower_bound(frame.index), times_.end());
  times_[frame.index] = frame.time;
  writeCollection();
  for (const auto& [index, time] : dropped)
    for (std::size_t part = 0; part < stems_.size(); ++part) removeFile(file(part, index));
}

fs::path VtuSeriesWriter::file(std::size_t part, int frame) const {
  return runDir_ / "frames" / fmt::format("{}_{:06}.vtu", stems_[part], frame);
}

void VtuSeriesWriter::removeEarlierSeries() const {
  // The collection goes first, so that it never names a file that is gone.
  removeFile(runDir_ / "frames.pvd");
  const std::regex ours(fmt::format(R"(({})_\d{{6,}}\.vtu(\.partial)?)", fmt::join(stems_, "|")));
  std::error_code error;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(runDir_ / "frames", error), end; !error && entry != end;
       entry.increment(error))
    if (std::regex_match(entry->path().filename().string(), ours)) stale.push_back(entry->path());
  if (error)
    throw Error(
        fmt::format("cannot read the directory {}: {}", (runDir_ / "frames").string(), error.message()));
  for (const fs::path& path : stale) removeFile(path);
}

void VtuSeriesWriter::writeCollection() const {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const auto& [index, time] : times_)
    for (std::size_t part = 0; part < stems_.size(); ++part)
      xml += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", time, part,
                         stems_[part], file(part, index).lexically_relative(runDir_).generic_string());
  xml += "  </Collection>\n</VTKFile>\n";
  writeFileAtomically(runDir_ / "frames.pvd", std::as_bytes(std::span(xml)));
}

}  // namespace burnish
