#include "postproc/draw/contour/shape_lines.h"

#include <vtkCleanPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include "postproc/mesh/vtk_arrays.h"

namespace burnish {

vtkSmartPointer<vtkPolyData> withoutSeams(vtkPolyData& surface) {
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(&surface);
  clean->SetTolerance(1e-6);
  clean->ConvertPolysToLinesOff();
  clean->ConvertLinesToPointsOff();
  clean->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clean->Update();
  return clean->GetOutput();
}

vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData& surface) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&surface);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> silhouetteOf(vtkPolyData& surface, const Eigen::Vector3d& towardsEye) {
  vtkDataArray& normals = *surface.GetPointData()->GetNormals();
  Eigen::RowVectorXd facing(normals.GetNumberOfTuples());
  for (Eigen::Index k = 0; k < facing.size(); ++k)
    facing(k) = Eigen::Map<const Eigen::Vector3d>(normals.GetTuple3(k)).dot(towardsEye);
  vtkNew<vtkPolyData> shape;
  shape->CopyStructure(&surface);
  shape->GetPointData()->SetScalars(makeArray("facing", facing, {}));
  vtkNew<vtkContourFilter> turn;
  turn->SetInputData(shape);
  turn->SetValue(0, 0.0);
  turn->Update();
  return turn->GetOutput();
}

vtkSmartPointer<vtkPolyData> edgesOf(vtkPolyData& surface) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(&surface);
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

}  // namespace burnish
