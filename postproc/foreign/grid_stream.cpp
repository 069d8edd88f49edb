#include "postproc/foreign/grid_stream.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <utility>

namespace burnish {
namespace {

/// What an attribute without an array, or an array without a role, has for a number.
constexpr std::int64_t kNone = -1;

void sendArray(vtkDataArray* array, const TakeBytes& take) {
  if (array == nullptr) return send(std::int64_t{kNone}, take);
  // Arrays of bits and of other layouts than one value after the other go as numbers in double precision.
  vtkSmartPointer<vtkDataArray> plain = array;
  if (!array->HasStandardMemoryLayout() || array->GetDataType() == VTK_BIT) {
    plain = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    plain->DeepCopy(array);
  }
  send(std::int64_t{plain->GetDataType()}, take);
  send(std::int64_t{plain->GetNumberOfComponents()}, take);
  send(std::int64_t{plain->GetNumberOfTuples()}, take);
  send(std::string(array->GetName() ? array->GetName() : ""), take);
  for (int k = 0; k < plain->GetNumberOfComponents(); ++k)
    send(std::string(array->GetComponentName(k) ? array->GetComponentName(k) : ""), take);
  take(plain->GetVoidPointer(0), static_cast<std::size_t>(plain->GetNumberOfValues()) *
                                     static_cast<std::size_t>(plain->GetDataTypeSize()));
}

vtkSmartPointer<vtkDataArray> receiveArray(const FillBytes& fill) {
  const std::int64_t type = receiveNumber(fill);
  if (type == kNone) return nullptr;
  const auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(static_cast<int>(type)));
  array->SetNumberOfComponents(static_cast<int>(receiveNumber(fill)));
  array->SetNumberOfTuples(receiveNumber(fill));
  array->SetName(receiveText(fill).c_str());
  for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    if (const std::string name = receiveText(fill); !name.empty()) array->SetComponentName(k, name.c_str());
  fill(array->GetVoidPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) *
                                     static_cast<std::size_t>(array->GetDataTypeSize()));
  return array;
}

/// Arrays with what they are to VTK: scalars, weights of rational cells and so on.
void sendArrays(vtkDataSetAttributes& data, const TakeBytes& take) {
  send(std::int64_t{data.GetNumberOfArrays()}, take);
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    send(std::int64_t{data.IsArrayAnAttribute(k)}, take);
    sendArray(data.GetArray(k), take);
  }
}

void receiveArrays(vtkDataSetAttributes& data, const FillBytes& fill) {
  const std::int64_t count = receiveNumber(fill);
  for (std::int64_t k = 0; k < count; ++k) {
    const auto role = static_cast<int>(receiveNumber(fill));
    const int index = data.AddArray(receiveArray(fill));
    if (role != kNone) data.SetActiveAttribute(index, role);
  }
}

void sendGrid(vtkUnstructuredGrid& grid, const TakeBytes& take) {
  vtkCellArray* cells = grid.GetCells();
  sendArray(grid.GetPoints() ? grid.GetPoints()->GetData() : nullptr, take);
  sendArray(cells ? cells->GetOffsetsArray() : nullptr, take);
  sendArray(cells ? cells->GetConnectivityArray() : nullptr, take);
  sendArray(grid.GetCellTypesArray(), take);
  sendArray(grid.GetFaces(), take);
  sendArray(grid.GetFaceLocations(), take);
  sendArrays(*grid.GetPointData(), take);
  sendArrays(*grid.GetCellData(), take);
}

vtkSmartPointer<vtkUnstructuredGrid> receiveGrid(const FillBytes& fill) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  if (const auto positions = receiveArray(fill)) points->SetData(positions);
  grid->SetPoints(points);
  const auto offsets = receiveArray(fill), corners = receiveArray(fill);
  vtkNew<vtkCellArray> cells;
  if (offsets && corners) cells->SetData(offsets, corners);
  vtkSmartPointer<vtkUnsignedCharArray> types = vtkUnsignedCharArray::SafeDownCast(receiveArray(fill));
  if (!types) types = vtkSmartPointer<vtkUnsignedCharArray>::New();
  const auto faces = receiveArray(fill), places = receiveArray(fill);
  grid->SetCells(types, cells, vtkIdTypeArray::SafeDownCast(places), vtkIdTypeArray::SafeDownCast(faces));
  receiveArrays(*grid->GetPointData(), fill);
  receiveArrays(*grid->GetCellData(), fill);
  return grid;
}

}  // namespace

void send(const std::vector<ForeignBlock>& blocks, const TakeBytes& take) {
  send(static_cast<std::int64_t>(blocks.size()), take);
  for (const ForeignBlock& block : blocks) {
    send(block.name, take);
    sendGrid(*block.grid, take);
  }
}

std::vector<ForeignBlock> receiveBlocks(const FillBytes& fill) {
  const std::int64_t count = receiveNumber(fill);
  std::vector<ForeignBlock> blocks;
  for (std::int64_t k = 0; k < count; ++k) {
    std::string name = receiveText(fill);
    blocks.push_back({std::move(name), receiveGrid(fill)});
  }
  return blocks;
}

}  // namespace burnish
