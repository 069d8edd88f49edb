#include "postproc/draw/contour/contour_arrows.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
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
constexpr double kCrossGap = 0.95, kCrossHead = 0.75;
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

/// Numbers of the points of a surface that face the eye; all of a plane body.
std::vector<vtkIdType> facingPoints(vtkPolyData& body, const View& view) {
  vtkDataArray* normals = body.GetPointData()->GetNormals();
  std::vector<vtkIdType> result;
  for (vtkIdType k = 0; k < body.GetNumberOfPoints(); ++k)
    if (!normals ||
        tuple(*normals, k).dot(view.towardsEye(Eigen::Map<const Eigen::Vector3d>(body.GetPoint(k)))) > 0.1)
      result.push_back(k);
  return result;
}

VectorPoints displacements(vtkPolyData& body, const View& view) {
  vtkDataArray& u = *body.GetPointData()->GetArray("displacement");
  VectorPoints result;
  for (const vtkIdType k : facingPoints(body, view))
    result.add(Eigen::Map<const Eigen::Vector3d>(body.GetPoint(k)), tuple(u, k));
  return result;
}

/// Principal stresses and their directions, in a plane body those in its plane.
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(vtkDataArray& stress, vtkIdType point, int dim) {
  const auto s = [&](int component) { return stress.GetComponent(point, component); };
  Eigen::Matrix3d tensor;
  tensor << s(0), s(3), s(5),  //
      s(3), s(1), s(4),        //
      s(5), s(4), s(2);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tensor.topLeftCorner(dim, dim));
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

std::string upTo(double largest, const std::string& unit) {
  return fmt::format("up to {}{}", numberText(largest, 3), unit.empty() ? "" : " " + unit);
}

ContourArrows crosses(const ModelRecord& model, vtkPolyData& body, const View& view, double longest) {
  vtkDataArray& stress = *body.GetPointData()->GetArray("stress");
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>> solutions;
  double largest = 0.0;
  for (const vtkIdType k : facingPoints(body, view)) {
    points.emplace_back(body.GetPoint(k));
    solutions.push_back(principal(stress, k, model.dim));
    largest = std::max(largest, solutions.back().eigenvalues().cwiseAbs().maxCoeff());
  }
  if (largest == 0.0) return {nullptr, nullptr, "no stress", nullptr, nullptr};
  PolyBuilder areas, edges, darkAreas, darkEdges;
  for (const std::size_t k : thinned(points, view.axes, kCrossGap * longest))
    for (Eigen::Index d = 0; d < model.dim; ++d) {
      const double value = solutions[k].eigenvalues()(d);
      Eigen::Vector3d along = Eigen::Vector3d::Zero();
      along.head(model.dim) =
          solutions[k].eigenvectors().col(d) * (0.5 * longest * std::abs(value) / largest);
      const Eigen::Vector3d side = view.towardsEye(points[k]).cross(along);
      if (side.norm() < 0.5 * kShortest * longest) continue;
      for (const double way : {-1.0, 1.0}) {
        const Eigen::Vector3d outwards = way * along, across = way * side.normalized();
        if (value > 0.0)
          addArrow(areas, edges, points[k] + outwards, outwards, across, kCrossHead * longest);
        else
          addArrow(darkAreas, darkEdges, points[k], -outwards, -across, kCrossHead * longest);
      }
    }
  return {areas.finish(), edges.finish(),
          fmt::format("crosses: principal stresses, {}; white: tension, black: compression",
                      upTo(largest, model.stressUnit)),
          darkAreas.finish(), darkEdges.finish()};
}

}  // namespace

ContourArrows contourArrows(ArrowField field, const ModelRecord& model, const FrameRecord& frame,
                            vtkPolyData& body, const View& view, double longest) {
  if (field == ArrowField::None) return {};
  if (field == ArrowField::Principal) return crosses(model, body, view, longest);
  const bool traction = field == ArrowField::Traction;
  const VectorPoints all = traction ? tractions(model, frame) : displacements(body, view);
  double largest = 0.0;
  for (const Eigen::Vector3d& vector : all.vectors) largest = std::max(largest, vector.norm());
  const std::string name = traction ? "contact traction" : "displacement";
  if (largest == 0.0) return {nullptr, nullptr, fmt::format("no {}", name), nullptr, nullptr};

  PolyBuilder areas, edges;
  for (const std::size_t k :
       thinned(all.points, view.axes, longest * (traction ? kTractionGap : kDisplacementGap))) {
    const Eigen::Vector3d along = all.vectors[k] * (longest / largest);
    const Eigen::Vector3d side = view.towardsEye(all.points[k]).cross(along);
    if (side.norm() < kShortest * longest) continue;
    addArrow(areas, edges, all.points[k] + (traction ? Eigen::Vector3d::Zero().eval() : along), along,
             side.normalized(), longest);
  }
  const std::string& unit = traction ? model.stressUnit : model.lengthUnit;
  return {areas.finish(), edges.finish(), fmt::format("arrows: {}, {}", name, upTo(largest, unit)), nullptr,
          nullptr};
}

}  // namespace burnish
