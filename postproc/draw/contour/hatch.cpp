#include "postproc/draw/contour/hatch.h"

#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>

#include <cmath>

namespace burnish {

vtkSmartPointer<vtkPolyData> hatchOf(vtkPolyData& section, const View& view, double pixels) {
  const Eigen::Vector3d across = (view.axes.row(0) - view.axes.row(1)).transpose().normalized();
  const double gap = pixels / view.pixelsPerLength;
  double first = HUGE_VAL, last = -HUGE_VAL;
  for (vtkIdType k = 0; k < section.GetNumberOfPoints(); ++k) {
    const double place = across.dot(Eigen::Map<const Eigen::Vector3d>(section.GetPoint(k)));
    first = std::min(first, place);
    last = std::max(last, place);
  }
  vtkNew<vtkPlane> plane;
  plane->SetNormal(across.x(), across.y(), across.z());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(&section);
  cutter->SetCutFunction(plane);
  cutter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  int count = 0;
  for (double place = first + 0.5 * gap; place < last; place += gap) cutter->SetValue(count++, place);
  cutter->SetNumberOfContours(count);
  if (count == 0) return vtkSmartPointer<vtkPolyData>::New();
  cutter->Update();
  return cutter->GetOutput();
}

}  // namespace burnish
