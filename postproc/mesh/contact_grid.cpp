#include "postproc/mesh/contact_grid.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "postproc/mesh/patch_geometry.h"

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
  const auto trace = contactFace<Dim>(mesh, contact, {});
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

}  // namespace

ContactGrid contactGrid(int dim, const MeshRecord& mesh, const ContactRecord& contact) {
  const FacePoints face = dim == 2 ? facePoints<2>(mesh, contact) : facePoints<3>(mesh, contact);
  ContactGrid grid{face.points(), contact.quadraturePoints, {}};
  for (int k = 0; k < grid.box.size(); ++k) {
    grid.recordedAt.push_back(face.place(grid.box.index(k)));
    grid.positions.col(k) = contact.quadraturePoints.col(static_cast<Eigen::Index>(grid.recordedAt.back()));
  }
  return grid;
}

template <int Dim>
Patch<Dim - 1, Dim> contactFace(const MeshRecord& mesh, const ContactRecord& contact,
                                const Eigen::MatrixXd& displacement) {
  return tracePatch(patchGeometry<Dim>(mesh.patches[static_cast<std::size_t>(contact.patch)], displacement),
                    faceFromName<Dim>(contact.face));
}

template Patch<1, 2> contactFace<2>(const MeshRecord&, const ContactRecord&, const Eigen::MatrixXd&);
template Patch<2, 3> contactFace<3>(const MeshRecord&, const ContactRecord&, const Eigen::MatrixXd&);

}  // namespace burnish
