#include "postproc/mesh/vtk_arrays.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>

namespace burnish {

vtkSmartPointer<vtkPoints> makePoints(const Eigen::MatrixXd& positions) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(positions.cols());
  Eigen::Map<Eigen::MatrixXd> x(static_cast<double*>(points->GetVoidPointer(0)), 3, positions.cols());
  x.topRows(positions.rows()) = positions;
  x.bottomRows(3 - positions.rows()).setZero();
  return points;
}

vtkSmartPointer<vtkDoubleArray> makeArray(const std::string& name, const Eigen::MatrixXd& values,
                                          const std::vector<std::string>& componentNames) {
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  for (std::size_t c = 0; c < componentNames.size(); ++c)
    array->SetComponentName(static_cast<vtkIdType>(c), componentNames[c].c_str());
  // Both store the components of a tuple next to each other.
  Eigen::Map<Eigen::MatrixXd>(array->GetPointer(0), values.rows(), values.cols()) = values;
  return array;
}

vtkSmartPointer<vtkIntArray> makeIntegers(const std::string& name, const std::vector<int>& values) {
  const auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkCellArray> makeCells(const Eigen::MatrixXi& corners) {
  vtkNew<vtkTypeInt64Array> offsets, points;
  offsets->SetNumberOfValues(corners.cols() + 1);
  for (Eigen::Index cell = 0; cell <= corners.cols(); ++cell) offsets->SetValue(cell, cell * corners.rows());
  points->SetNumberOfValues(corners.size());
  std::copy_n(corners.data(), corners.size(), points->GetPointer(0));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, points);
  return cells;
}

std::string labelled(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

Eigen::MatrixXd inSpace(const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, vectors.cols());
  result.topRows(vectors.rows()) = vectors;
  return result;
}

}  // namespace burnish
