#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/index_box.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Quadrature points of a face in rows and columns: `perSpan` per knot span and direction.
struct FacePoints {
  IndexBox spans;
  int perSpan = 0;
  int dim = 2;  ///< of space

  IndexBox points() const {
    IndexBox box;
    for (std::size_t d = 0; d + 1 < static_cast<std::size_t>(dim); ++d)
      box.extent[d] = spans.extent[d] * perSpan;
    return box;
  }

  /// Place in the record, which goes span by span, of the point in this row and column.
  std::size_t place(const IndexBox::Index& index) const {
    const int row = dim == 2 ? 1 : perSpan;
    const int span = spans.number({index[0] / perSpan, index[1] / row, 0});
    const std::ptrdiff_t line = std::ptrdiff_t{span} * row + index[1] % row;
    return static_cast<std::size_t>(line * perSpan + index[0] % perSpan);
  }
};

template <int Dim>
FacePoints facePoints(const MeshRecord& mesh, const ContactRecord& contact) {
  const auto trace = tracePatch(patchGeometry<Dim>(mesh.patches[static_cast<std::size_t>(contact.patch)]),
                                faceFromName<Dim>(contact.face));
  FacePoints face{.spans = {}, .perSpan = 0, .dim = Dim};
  for (int d = 0; d < Dim - 1; ++d)
    face.spans.extent[static_cast<std::size_t>(d)] = trace.basis().direction(d).numSpans();
  while (face.points().size() < contact.quadraturePoints.cols()) ++face.perSpan;
  if (face.points().size() != contact.quadraturePoints.cols())
    throw Error(fmt::format(
        "contact face {}: found {} quadrature points on {} knot spans; expected the same number on each",
        contact.face, contact.quadraturePoints.cols(), face.spans.size()));
  return face;
}

void addCells(const FacePoints& face, const std::vector<vtkIdType>& ids, PolyBuilder& builder) {
  const IndexBox points = face.points();
  const auto id = [&](int i, int j) { return ids[face.place({i, j, 0})]; };
  if (face.dim == 2) {
    std::vector<vtkIdType> line;
    for (int i = 0; i < points.extent[0]; ++i) line.push_back(id(i, 0));
    if (!line.empty()) builder.addLine(line);
    return;
  }
  for (int j = 0; j + 1 < points.extent[1]; ++j)
    for (int i = 0; i + 1 < points.extent[0]; ++i)
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

vtkSmartPointer<vtkPolyData> contactSurface(const ModelRecord& model, const FrameRecord& frame,
                                            const ContactName& wanted) {
  const MeshRecord& mesh = meshOf(model, frame);
  PolyBuilder builder;
  Eigen::MatrixXd values(kRows, 0);
  std::vector<int> sliding;
  bool rubs = false;
  for (const ContactRecord& contact : frame.contact) {
    if (ContactName{contact.tool, contact.pair} != wanted) continue;
    const FacePoints face = model.dim == 2 ? facePoints<2>(mesh, contact) : facePoints<3>(mesh, contact);
    addCells(face, builder.addPoints(contact.quadraturePoints), builder);
    const auto added = valuesOf(contact);
    values.conservativeResize(Eigen::NoChange, values.cols() + added.cols());
    values.rightCols(added.cols()) = added;
    rubs = rubs || !contact.quadratureSliding.empty();
    sliding.insert(sliding.end(), contact.quadratureSliding.begin(), contact.quadratureSliding.end());
    sliding.resize(static_cast<std::size_t>(values.cols()), 0);
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

}  // namespace burnish
