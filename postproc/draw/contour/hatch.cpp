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
  double begin = first + 0.5 * gap;
  if (!view.eye) {  // those alone that may be seen, where they would be in a picture of the whole
    const double middle = across.dot(view.axes.transpose() * view.center),
                 reach = 0.5 * std::hypot(view.area.width, view.area.height) / view.pixelsPerLength;
    begin += gap * std::max(0.0, std::floor((middle - reach - begin) / gap));
    last = std::min(last, middle + reach);
  }
  for (double place = begin; place < last; place += gap) cutter->SetValue(count++, place);
  cutter->SetNumberOfContours(count);
  if (count == 0) return vtkSmartPointer<vtkPolyData>::New();
  cutter->Update();
  return cutter->GetOutput();
}

}  // namespace burnish
