#include "postproc/mesh/plane_section.h"

#include <vtkAppendPolyData.h>
#include <vtkCleanPolyData.h>
#include <vtkClipPolyData.h>
#include <vtkContourTriangulator.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>

namespace burnish {
namespace {

/// Gaps that are closed, as a part of the whole: outlines of unions have them at their seams.
constexpr double kGap = 1e-4;

/// The most points of a line that VTK allows.
constexpr int kLongestLine = 100000;

vtkNew<vtkPlane> functionOf(const CutPlane& plane) {
  vtkNew<vtkPlane> function;
  const Eigen::Vector3d normal = plane.normal.normalized();
  function->SetOrigin(plane.point.x(), plane.point.y(), plane.point.z());
  function->SetNormal(normal.x(), normal.y(), normal.z());
  return function;
}

}  // namespace

vtkSmartPointer<vtkPolyData> sectionOf(vtkDataSet& cells, const CutPlane& plane, SectionPoints points) {
  vtkNew<vtkCutter> cutter;
  if (points == SectionPoints::OfEachCell) cutter->SetLocator(vtkNew<vtkNonMergingPointLocator>());
  cutter->SetInputData(&cells);
  cutter->SetCutFunction(functionOf(plane));
  cutter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  cutter->Update();
  return cutter->GetOutput();
}

vtkSmartPointer<vtkPolyData> behind(vtkPolyData& parts, const CutPlane& plane) {
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(&parts);
  clip->SetClipFunction(functionOf(plane));
  clip->InsideOutOn();
  // Faces that meet at a sharp edge keep points of their own, with their own normals.
  clip->SetLocator(vtkNew<vtkNonMergingPointLocator>());
  clip->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clip->Update();
  return clip->GetOutput();
}

vtkSmartPointer<vtkPolyData> enclosedAreas(vtkPolyData& segments) {
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(&segments);
  joined->SetTolerance(kGap);
  joined->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkStripper> loops;  // also of segments that do not all go round the same way
  loops->SetInputConnection(joined->GetOutputPort());
  loops->JoinContiguousSegmentsOn();
  loops->SetMaximumLength(kLongestLine);
  vtkNew<vtkContourTriangulator> triangulator;
  triangulator->SetInputConnection(loops->GetOutputPort());
  triangulator->Update();
  return triangulator->GetOutput();
}

vtkSmartPointer<vtkPolyData> together(vtkPolyData& one, vtkPolyData& other) {
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(&one);
  append->AddInputData(&other);
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->Update();
  return append->GetOutput();
}

}  // namespace burnish
