#include "postproc/mesh/contact_surface.h"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "postproc/mesh/contact_grid.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// The point that is nearest to a place, of some that are columns.
Eigen::VectorXd nearestOf(const Eigen::MatrixXd& points, const Eigen::VectorXd& place) {
  Eigen::Index nearest = 0;
  (points.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
  return points.col(nearest);
}

/// The ends of a face of a plane body, or the edges of one in space as points that lie close together.
std::vector<Eigen::MatrixXd> edgesOf(const Patch<1, 2>& face) {
  return {face.points().leftCols(1), face.points().rightCols(1)};
}

std::vector<Eigen::MatrixXd> edgesOf(const Patch<2, 3>& face) {
  constexpr int kPerSpan = 64;
  std::vector<Eigen::MatrixXd> edges;
  for (int along = 0; along < 2; ++along) {
    const std::vector<double> ways = subdividedSpans(face.basis().direction(along), kPerSpan);
    const std::vector<double> across = subdividedSpans(face.basis().direction(1 - along), 1);
    for (const double side : {across.front(), across.back()}) {
      Eigen::MatrixXd& edge = edges.emplace_back(3, std::ssize(ways));
      for (std::size_t k = 0; k < ways.size(); ++k) {
        Eigen::Vector2d xi;
        xi(along) = ways[k];
        xi(1 - along) = side;
        edge.col(static_cast<Eigen::Index>(k)) = face.position(xi);
      }
    }
  }
  return edges;
}

/// The grid with a row and a column more at each end, on the edges of the face.
ContactGrid toEdges(const ContactGrid& inner, const std::vector<Eigen::MatrixXd>& edges) {
  const Eigen::Index dim = inner.positions.rows();
  const auto directions = static_cast<std::size_t>(dim) - 1;
  ContactGrid grid{inner.box, {}, {}};
  for (std::size_t d = 0; d < directions; ++d) grid.box.extent[d] += 2;
  grid.positions.resize(dim, grid.box.size());
  const auto innerOf = [&](IndexBox::Index index) {
    for (std::size_t d = 0; d < directions; ++d)
      index[d] = std::clamp(index[d] - 1, 0, inner.box.extent[d] - 1);
    return inner.box.number(index);
  };
  // Images in mirrors may run the other way: a side of the grid lies at the edge that is nearest to its middle.
  const auto edgeAt = [&](std::size_t d, bool atEnd) -> const Eigen::MatrixXd& {
    IndexBox::Index middle{};
    for (std::size_t e = 0; e < directions; ++e) middle[e] = grid.box.extent[e] / 2;
    middle[d] = atEnd ? grid.box.extent[d] - 1 : 0;
    const Eigen::VectorXd place = inner.positions.col(innerOf(middle));
    return *std::min_element(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
      return (nearestOf(a, place) - place).norm() < (nearestOf(b, place) - place).norm();
    });
  };
  for (int k = 0; k < grid.box.size(); ++k) {
    const IndexBox::Index index = grid.box.index(k);
    const int from = innerOf(index);
    grid.recordedAt.push_back(inner.recordedAt[static_cast<std::size_t>(from)]);
    Eigen::VectorXd place = inner.positions.col(from);
    for (int pass = 0; pass < 2; ++pass)  // a corner is found from the edge at which it lies
      for (std::size_t d = 0; d < directions; ++d)
        if (index[d] == 0 || index[d] == grid.box.extent[d] - 1)
          place = nearestOf(edgeAt(d, index[d] != 0), place);
    grid.positions.col(k) = place;
  }
  return grid;
}

void addCells(const ContactGrid& grid, const std::vector<vtkIdType>& ids, int dim, PolyBuilder& builder) {
  const IndexBox& box = grid.box;
  const auto id = [&](int i, int j) { return ids[static_cast<std::size_t>(box.number({i, j, 0}))]; };
  if (dim == 2) {
    std::vector<vtkIdType> line;
    for (int i = 0; i < box.extent[0]; ++i) line.push_back(id(i, 0));
    if (!line.empty()) builder.addLine(line);
    return;
  }
  for (int j = 0; j + 1 < box.extent[1]; ++j)
    for (int i = 0; i + 1 < box.extent[0]; ++i)
      builder.addPolygon({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
}

/// Rows: pressure, gap, three components of the traction, three of the slip, the way slipped, three of the
/// traction of friction; a column per point.
constexpr Eigen::Index kRows = 12;
Eigen::MatrixXd valuesOf(const ContactRecord& contact) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(kRows, contact.quadraturePoints.cols());
  if (values.cols() == 0) return values;
  values.topRows(5) << contact.quadraturePressure.transpose(), contact.quadratureGap.transpose(),
      inSpace(contact.quadratureNormal * contact.quadraturePressure.asDiagonal());
  if (contact.quadratureSliding.empty()) return values;
  values.bottomRows<3>() = inSpace(contact.quadratureFriction);
  values.middleRows<3>(2) += values.bottomRows<3>();
  values.middleRows<3>(5) = inSpace(contact.quadratureSlip);
  if (contact.quadratureSlipped.size() > 0) values.row(8) = contact.quadratureSlipped.transpose();
  return values;
}

}  // namespace

std::vector<ContactName> contactsOf(const FrameRecord& frame) {
  std::vector<ContactName> names;
  for (const ContactRecord& contact : frame.contact)
    if (const ContactName name{contact.tool, contact.pair};
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

namespace {

ContactGrid gridToEdges(const ContactGrid& inner, const ModelRecord& model, const FrameRecord& frame,
                        const ContactRecord& contact) {
  const MeshRecord& mesh = meshOf(model, frame);
  return toEdges(inner, model.dim == 2 ? edgesOf(contactFace<2>(mesh, contact, frame.displacement))
                                       : edgesOf(contactFace<3>(mesh, contact, frame.displacement)));
}

/// toEdges: with points on the edges of the faces.
vtkSmartPointer<vtkPolyData> surfaceOf(const ModelRecord& model, const FrameRecord& frame,
                                       const ContactName& wanted, bool toEdges) {
  const MeshRecord& mesh = meshOf(model, frame);
  PolyBuilder builder;
  Eigen::MatrixXd values(kRows, 0);
  std::vector<int> sliding;
  bool rubs = false;
  for (const ContactRecord& contact : frame.contact) {
    if (ContactName{contact.tool, contact.pair} != wanted) continue;
    ContactGrid grid = contactGrid(model.dim, mesh, contact);
    std::vector<std::size_t> from(
        grid.recordedAt.size());  // places in the record, in the order of the points
    std::vector<vtkIdType> ids;
    if (toEdges && grid.box.size() > 0) {
      grid = gridToEdges(grid, model, frame, contact);
      ids = builder.addPoints(grid.positions);
      from = grid.recordedAt;
    } else {
      std::iota(from.begin(), from.end(), std::size_t{0});
      const std::vector<vtkIdType> recorded = builder.addPoints(contact.quadraturePoints);
      for (const std::size_t place : grid.recordedAt) ids.push_back(recorded[place]);
    }
    addCells(grid, ids, model.dim, builder);
    const Eigen::MatrixXd added = valuesOf(contact)(Eigen::all, from);
    values.conservativeResize(Eigen::NoChange, values.cols() + added.cols());
    values.rightCols(added.cols()) = added;
    rubs = rubs || !contact.quadratureSliding.empty();
    for (const std::size_t place : from)
      sliding.push_back(contact.quadratureSliding.empty() ? 0 : contact.quadratureSliding[place]);
  }
  std::vector<int> status;
  for (const double pressure : values.row(0)) status.push_back(pressure != 0.0 ? 1 : 0);

  const auto surface = builder.finish();
  vtkPointData& data = *surface->GetPointData();
  data.AddArray(makeArray(labelled("contact_pressure", model.stressUnit), values.row(0), {}));
  data.AddArray(makeArray(labelled("traction", model.stressUnit), values.middleRows(2, 3), kAxes));
  data.AddArray(makeArray(labelled("gap", model.lengthUnit), values.row(1), {}));
  data.AddArray(makeIntegers("status", status));
  if (!rubs) return surface;
  data.AddArray(makeArray(labelled("friction", model.stressUnit), values.bottomRows(3), kAxes));
  data.AddArray(makeArray(labelled("slip", model.lengthUnit), values.middleRows(5, 3), kAxes));
  data.AddArray(makeArray(labelled("slipped", model.lengthUnit), values.row(8), {}));
  data.AddArray(makeIntegers("sliding", sliding));
  return surface;
}

}  // namespace

vtkSmartPointer<vtkPolyData> contactSurface(const ModelRecord& model, const FrameRecord& frame,
                                            const ContactName& wanted) {
  return surfaceOf(model, frame, wanted, false);
}

vtkSmartPointer<vtkPolyData> contactSurfaceToEdges(const ModelRecord& model, const FrameRecord& frame,
                                                   const ContactName& wanted) {
  return surfaceOf(model, frame, wanted, true);
}

}  // namespace burnish
