#include "postproc/draw/contour_arrows.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include <algorithm>
#include <vector>

#include "postproc/draw/ticks.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

// Parts of the longest arrow.
constexpr double kDisplacementGap = 0.75, kTractionGap = 0.3;
constexpr double kShortest = 0.18;  // nothing is drawn below
constexpr double kHead = 0.3, kHeadHalfWidth = 0.12, kShaftHalfWidth = 0.035;

/// Where vectors stand and what they are, 3 x n.
struct VectorPoints {
  Eigen::Matrix3Xd points, vectors;

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& vector) {
    points.conservativeResize(Eigen::NoChange, points.cols() + 1);
    vectors.conservativeResize(Eigen::NoChange, points.cols());
    points.rightCols<1>() = point;
    vectors.rightCols<1>() = vector;
  }
};

Eigen::Vector3d tuple(vtkDataArray& array, vtkIdType k) {
  return Eigen::Map<const Eigen::Vector3d>(array.GetTuple3(k));
}

VectorPoints displacements(const ModelRecord& model, vtkPolyData& body, const Eigen::Vector3d& towardsEye) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&body);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->AutoOrientNormalsOff();
  normals->Update();
  vtkPolyData& surface = *normals->GetOutput();
  vtkDataArray& u = *surface.GetPointData()->GetArray("displacement");
  VectorPoints result;
  for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
    const bool faces =
        model.dim == 2 || tuple(*surface.GetPointData()->GetNormals(), k).dot(towardsEye) > 0.1;
    if (faces) result.add(Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(k)), tuple(u, k));
  }
  return result;
}

VectorPoints tractions(const ModelRecord& model, const FrameRecord& frame) {
  VectorPoints result;
  for (std::size_t tool = 0; tool < model.tools.size(); ++tool) {
    const auto surface = contactSurface(model, frame, tool);
    vtkDataArray& traction =
        *surface->GetPointData()->GetArray(labelled("traction", model.stressUnit).c_str());
    for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
      result.add(Eigen::Map<const Eigen::Vector3d>(surface->GetPoint(k)), tuple(traction, k));
  }
  return result;
}

/// Numbers of points, taken one after the other, none of which is closer than `gap` to one before it.
std::vector<Eigen::Index> thinned(const Eigen::Matrix2Xd& points, double gap) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](Eigen::Index other) { return (points.col(k) - points.col(other)).norm() < gap; }))
      kept.push_back(k);
  return kept;
}

/// along: from its begin to its tip. side: unit vector across.
void addArrow(PolyBuilder& areas, PolyBuilder& edges, const Eigen::Vector3d& tip,
              const Eigen::Vector3d& along, const Eigen::Vector3d& side, double longest) {
  const Eigen::Vector3d neck = tip - std::min(0.7, kHead * longest / along.norm()) * along;
  const double slim = std::min(1.0, 0.7 * along.norm() / (kHead * longest));
  const Eigen::Vector3d shaft = kShaftHalfWidth * longest * slim * side,
                        head = kHeadHalfWidth * longest * slim * side;
  Eigen::Matrix<double, 3, 8> corners;
  corners << tip, neck + head, neck + shaft, tip - along + shaft, tip - along - shaft, neck - shaft,
      neck - head, tip;
  const std::vector<vtkIdType> ids = areas.addPoints(corners);
  areas.addPolygon({ids[0], ids[1], ids[6]});
  areas.addPolygon({ids[2], ids[3], ids[4], ids[5]});
  edges.addLine(edges.addPoints(corners));
}

}  // namespace

ContourArrows contourArrows(ArrowField field, const ModelRecord& model, const FrameRecord& frame,
                            vtkPolyData& body, const ViewAxes& axes, double longest) {
  if (field == ArrowField::None) return {};
  const bool traction = field == ArrowField::Traction;
  const Eigen::Vector3d towardsEye = axes.row(0).cross(axes.row(1)).transpose();
  const VectorPoints all = traction ? tractions(model, frame) : displacements(model, body, towardsEye);
  const double largest = all.vectors.cols() == 0 ? 0.0 : all.vectors.colwise().norm().maxCoeff();
  const std::string name = traction ? "contact traction" : "displacement";
  if (largest == 0.0) return {nullptr, nullptr, fmt::format("no {}", name)};

  PolyBuilder areas, edges;
  for (const Eigen::Index k :
       thinned(axes * all.points, longest * (traction ? kTractionGap : kDisplacementGap))) {
    const Eigen::Vector3d along = all.vectors.col(k) * (longest / largest);
    const Eigen::Vector3d side = towardsEye.cross(along);
    if (side.norm() < kShortest * longest) continue;
    addArrow(areas, edges, all.points.col(k) + (traction ? Eigen::Vector3d::Zero().eval() : along), along,
             side.normalized(), longest);
  }
  const std::string& unit = traction ? model.stressUnit : model.lengthUnit;
  return {
      areas.finish(), edges.finish(),
      fmt::format("arrows: {}, up to {}{}", name, numberText(largest, 3), unit.empty() ? "" : " " + unit)};
}

}  // namespace burnish
