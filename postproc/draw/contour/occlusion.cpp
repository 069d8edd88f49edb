#include "postproc/draw/contour/occlusion.h"

#include <vtkDataArray.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "postproc/draw/contour/free_sky.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

FreeSky skyOf(const ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity,
              double reach) {
  FreeSky::Surfaces bodies, toolSurfaces;
  for (const auto& part : {parts.body, parts.section, parts.plain, parts.plainSection})
    if (part) bodies.push_back(part);
  for (const ToolDrawing& tool : tools)
    if (tool.surface) toolSurfaces.push_back(tool.surface);
  return {bodies, toolSurfaces, toolOpacity, reach};
}

Eigen::Matrix3Xd tuplesOf(vtkDataArray& array) {
  Eigen::Matrix3Xd tuples(3, array.GetNumberOfTuples());
  for (Eigen::Index k = 0; k < tuples.cols(); ++k) array.GetTuple(k, tuples.col(k).data());
  return tuples;
}

}  // namespace

void setSky(const ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity) {
  constexpr double kReach = 0.25, kStart = 1.0 / 2000.0, kPressedIn = 0.01;  // of the bodies
  const double length = lengthOf(parts);
  const FreeSky sky = skyOf(parts, tools, toolOpacity, kReach * length);
  const auto set = [&](vtkPolyData* surface, const FreeSky::Start& start) {
    if (!surface || !surface->GetPointData()->GetNormals()) return;
    const Eigen::VectorXd shares = sky.sharesAt(tuplesOf(*surface->GetPoints()->GetData()),
                                                tuplesOf(*surface->GetPointData()->GetNormals()), start);
    surface->GetPointData()->AddArray(makeArray(kSky, shares.transpose(), {}));
  };
  for (const auto& body : {parts.body, parts.plain}) set(body, {kStart * length, -kPressedIn * length});
  for (const ToolDrawing& tool : tools) set(tool.surface, {-kPressedIn * length, kStart * length});
}

vtkSmartPointer<vtkPolyData> groundShadow(const ContourParts& parts, const std::vector<ToolDrawing>& tools,
                                          double toolOpacity) {
  constexpr double kLowestEye = 0.05, kReach = 0.5, kDarkest = 0.55, kNear = 0.01;
  constexpr int kCells = 100;
  const Eigen::Vector3d eye = parts.axes.row(0).cross(parts.axes.row(1)).transpose();
  if (eye.y() < kLowestEye) return nullptr;
  const double length = lengthOf(parts), reach = kReach * length;
  const double height = parts.box.min().y();
  for (const ToolDrawing& tool : tools)
    if (tool.surface && boxOf(*tool.surface).min().y() < height + kNear * length) return nullptr;
  Eigen::AlignedBox3d box = parts.box;
  box.min() -= Eigen::Vector3d::Constant(reach);
  box.max() += Eigen::Vector3d::Constant(reach);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->SetOrigin(box.min().x(), height, box.min().z());
  plane->SetPoint1(box.min().x(), height, box.max().z());
  plane->SetPoint2(box.max().x(), height, box.min().z());
  plane->SetResolution(kCells, kCells);
  plane->Update();
  const vtkSmartPointer<vtkPolyData> ground = plane->GetOutput();
  const Eigen::Matrix3Xd points = tuplesOf(*ground->GetPoints()->GetData());
  const Eigen::VectorXd shares =
      skyOf(parts, tools, toolOpacity, reach)
          .sharesAt(points, Eigen::Vector3d::UnitY().replicate(1, points.cols()), {});
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  for (const double share : shares)
    colors->InsertNextTuple4(0, 0, 0, std::round(255.0 * kDarkest * (1.0 - share)));
  ground->GetPointData()->SetScalars(colors);
  return ground;
}

}  // namespace burnish
