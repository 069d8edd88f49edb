#include "postproc/compare/data/vtk_series.h"

#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "postproc/foreign/array_names.h"
#include "postproc/foreign/foreign_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

DataArray arrayOf(vtkDataArray& array, const std::string& prefix) {
  const auto [name, unit] = arrayNameOf(array.GetName());
  DataArray result{prefix + name, unit, componentsOf(array), {}};
  result.values.resize(array.GetNumberOfComponents(), array.GetNumberOfTuples());
  for (int k = 0; k < array.GetNumberOfComponents(); ++k) {
    for (vtkIdType place = 0; place < array.GetNumberOfTuples(); ++place)
      result.values(k, place) = array.GetComponent(place, k);
  }
  return result;
}

/// Arrays of numbers with names; texts are left out.
void addArrays(DataPart& part, vtkDataSetAttributes& data, const std::string& prefix) {
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    vtkDataArray* numbers = data.GetArray(k);
    if (!numbers || !numbers->GetName() || numbers->GetNumberOfTuples() != part.numPlaces) continue;
    DataArray array = arrayOf(*numbers, prefix);
    while (std::ranges::count(part.arrays, array.name, &DataArray::name)) array.name += "_2";
    part.arrays.push_back(std::move(array));
  }
}

DataPart pointPart(vtkDataSet& data) {
  DataPart part{.name = "points", .place = "point", .numPlaces = data.GetNumberOfPoints()};
  part.positions.resize(3, part.numPlaces);
  for (vtkIdType point = 0; point < part.numPlaces; ++point)
    data.GetPoint(point, part.positions.col(point).data());
  part.arrays.push_back({"points", "", {"x", "y", "z"}, part.positions});
  addArrays(part, *data.GetPointData(), "");
  return part;
}

DataPart cellPart(vtkDataSet& data, const std::vector<std::vector<vtkIdType>>& corners,
                  const Eigen::MatrixXd& points) {
  DataPart part{.name = "cells", .place = "cell", .numPlaces = data.GetNumberOfCells()};
  part.positions = Eigen::MatrixXd::Zero(3, part.numPlaces);
  Eigen::MatrixXd types(1, part.numPlaces), sizes(1, part.numPlaces);
  for (vtkIdType cell = 0; cell < part.numPlaces; ++cell) {
    const std::vector<vtkIdType>& own = corners[static_cast<std::size_t>(cell)];
    types(0, cell) = data.GetCellType(cell);
    sizes(0, cell) = static_cast<double>(own.size());
    if (!own.empty()) part.positions.col(cell) = points(Eigen::all, own).rowwise().mean();
  }
  part.arrays = {{"cells.type", "", {}, std::move(types), true},
                 {"cells.size", "", {}, std::move(sizes), true}};
  addArrays(part, *data.GetCellData(), "cells.");
  return part;
}

DataPart cornerPart(const std::vector<std::vector<vtkIdType>>& corners) {
  DataPart part{.name = "cells.corners", .place = "corner"};
  std::vector<double> points;
  for (std::size_t cell = 0; cell < corners.size(); ++cell) {
    part.owners.push_back(fmt::format("cell {}", cell));
    part.ownerOf.insert(part.ownerOf.end(), corners[cell].size(), static_cast<int>(cell));
    points.insert(points.end(), corners[cell].begin(), corners[cell].end());
  }
  part.numPlaces = std::ssize(points);
  part.arrays = {
      {"cells.corners", "", {}, Eigen::Map<Eigen::RowVectorXd>(points.data(), part.numPlaces), true}};
  return part;
}

std::vector<std::vector<vtkIdType>> cornersOf(vtkUnstructuredGrid& data) {
  std::vector<std::vector<vtkIdType>> corners;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    data.GetCellPoints(cell, ids);
    corners.emplace_back(ids->begin(), ids->end());
  }
  return corners;
}

DataFrame frameOf(const std::vector<ForeignBlock>& blocks) {
  DataFrame frame;
  for (const ForeignBlock& block : blocks) {
    const std::vector<std::vector<vtkIdType>> corners = cornersOf(*block.grid);
    const std::size_t first = frame.size();
    frame.push_back(pointPart(*block.grid));
    frame.push_back(cellPart(*block.grid, corners, frame.back().positions));
    frame.push_back(cornerPart(corners));
    for (std::size_t k = first; k < frame.size(); ++k) frame[k].detail = block.name;
  }
  return frame;
}

}  // namespace

DataSeries foreignSeries(const fs::path& path) {
  const auto file = std::make_shared<const ForeignFile>(path);
  // The time of a file that holds one instant is no matter of its numbers.
  const bool isTimed = file->times().size() > 1 || path.extension() == ".pvd";
  return {.name = isTimed ? "times" : "files",
          .times = isTimed ? file->times() : std::vector<double>(),
          .isTimed = isTimed,
          .frame = [file](std::size_t index) { return frameOf(file->blocks(index)); }};
}

}  // namespace burnish
