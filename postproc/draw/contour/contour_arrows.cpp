#include "postproc/draw/contour/contour_arrows.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <vector>

#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

// Parts of the longest arrow.
constexpr double kDisplacementGap = 0.75, kTractionGap = 0.3;
constexpr double kShortest = 0.18;  // nothing is drawn below
constexpr double kHead = 0.3, kHeadHalfWidth = 0.12, kShaftHalfWidth = 0.035;

/// Where vectors stand and what they are.
struct VectorPoints {
  std::vector<Eigen::Vector3d> points, vectors;

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& vector) {
    points.push_back(point);
    vectors.push_back(vector);
  }
};

Eigen::Vector3d tuple(vtkDataArray& array, vtkIdType k) {
  return Eigen::Map<const Eigen::Vector3d>(array.GetTuple3(k));
}

VectorPoints displacements(vtkPolyData& body, const Eigen::Vector3d& towardsEye) {
  vtkDataArray& u = *body.GetPointData()->GetArray("displacement");
  vtkDataArray* normals = body.GetPointData()->GetNormals();  // of a body in space
  VectorPoints result;
  for (vtkIdType k = 0; k < body.GetNumberOfPoints(); ++k)
    if (!normals || tuple(*normals, k).dot(towardsEye) > 0.1)
      result.add(Eigen::Map<const Eigen::Vector3d>(body.GetPoint(k)), tuple(u, k));
  return result;
}

VectorPoints tractions(const ModelRecord& model, const FrameRecord& frame) {
  VectorPoints result;
  for (const ContactName& contact : contactsOf(frame)) {
    const auto surface = contactSurface(model, frame, contact);
    vtkDataArray& traction =
        *surface->GetPointData()->GetArray(labelled("traction", model.stressUnit).c_str());
    for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
      result.add(Eigen::Map<const Eigen::Vector3d>(surface->GetPoint(k)), tuple(traction, k));
  }
  return result;
}

/// Numbers of points, taken one after the other, none of which is seen closer than `gap` to one before it.
std::vector<std::size_t> thinned(const std::vector<Eigen::Vector3d>& points, const ViewAxes& axes,
                                 double gap) {
  std::vector<std::size_t> kept;
  std::vector<Eigen::Vector2d> places;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector2d place = axes * points[k];
    const auto isNear = [&](const Eigen::Vector2d& other) { return (place - other).norm() < gap; };
    if (std::any_of(places.begin(), places.end(), isNear)) continue;
    kept.push_back(k);
    places.push_back(place);
  }
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
  const VectorPoints all = traction ? tractions(model, frame) : displacements(body, towardsEye);
  double largest = 0.0;
  for (const Eigen::Vector3d& vector : all.vectors) largest = std::max(largest, vector.norm());
  const std::string name = traction ? "contact traction" : "displacement";
  if (largest == 0.0) return {nullptr, nullptr, fmt::format("no {}", name)};

  PolyBuilder areas, edges;
  for (const std::size_t k :
       thinned(all.points, axes, longest * (traction ? kTractionGap : kDisplacementGap))) {
    const Eigen::Vector3d along = all.vectors[k] * (longest / largest);
    const Eigen::Vector3d side = towardsEye.cross(along);
    if (side.norm() < kShortest * longest) continue;
    addArrow(areas, edges, all.points[k] + (traction ? Eigen::Vector3d::Zero().eval() : along), along,
             side.normalized(), longest);
  }
  const std::string& unit = traction ? model.stressUnit : model.lengthUnit;
  return {
      areas.finish(), edges.finish(),
      fmt::format("arrows: {}, up to {}{}", name, numberText(largest, 3), unit.empty() ? "" : " " + unit)};
}

}  // namespace burnish
