#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "engine/core/error.h"
#include "engine/results/result.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_arrows.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/place_marks.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/body_surface.h"

class vtkPolyData;

namespace burnish {

/// A tool that is shown, where it stands.
struct ShownTool {
  ToolRecord record;
  std::optional<double> turn;  ///< of one that has turned, in radians
};

/// What a contour picture shows in space, where it stands in the frame: displacements times the warp.
struct ContourParts {
  ViewAxes axes;
  std::optional<Eye> eye;        ///< of a perspective picture
  Eigen::AlignedBox3d box;       ///< of the body before it is cut
  Eigen::MatrixXd displacement;  ///< of the body, dim x nodes of the frame's mesh
  std::vector<ShownTool> tools;
  vtkSmartPointer<vtkPolyData> body;                 ///< its point scalars are the values that are drawn; the
                                                     ///< contact faces where these are a contact field
  vtkSmartPointer<vtkPolyData> section;              ///< the same, of a cut; null without one
  vtkSmartPointer<vtkPolyData> plain, plainSection;  ///< of bodies that do not have the field; null without
  vtkSmartPointer<vtkPolyData> wholeBody, wholePlain;  ///< of a cut: `body` and `plain` before it
  std::vector<BodySurface::Lattice> bodyLattices,
      plainLattices;  ///< how the points of `body` and `plain`, of a cut of
                      ///< `wholeBody` and `wholePlain`, lie in space; none
                      ///< where they are of no patches
  vtkSmartPointer<vtkPolyData> outline;
  vtkSmartPointer<vtkPolyData> knots, undeformed, net;  ///< null where they are not shown
  vtkSmartPointer<vtkPolyData>
      ghost;  ///< all of the bodies, where only a part of them is drawn, and null else;
  vtkSmartPointer<vtkPolyData> ghostOutline;  ///< its edges
  std::optional<CutPlane> plane;  ///< of a cut or a slice: just inside the body, the normal to the eye
  ContourArrows arrows;
  std::optional<ExtremePlaces> extremes;  ///< to be marked
  std::optional<Eigen::Vector3d> mark;    ///< a place to be marked
};

/// field: that of the options, in this model and frame. Throws `Error` for a plane that misses the body or is
/// seen edge-on.
ContourParts contourParts(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field,
                          const ContourOptions& options);

/// Gives parts that are complete but for these their arrows. shown: what of the body is seen, of which the arrows are parts
/// in length, so that they are as long for a body as for a part of it.
void addArrows(ContourParts& parts, const ArrowGround& ground, vtkPolyData& shown,
               const ContourOptions& options);

/// The plane of a cut or a slice with its normal to the eye; one in a face of the body has a section on its
/// inner side alone, and is moved there. Throws `Error` for a plane that is seen edge-on.
CutPlane shownPlane(const ContourOptions& options, const ContourParts& parts);

/// The eye of a perspective picture: over the middle of what is to be seen, with a plane through what of it is
/// nearest, and so far that the longer side is seen under the angle of the options. None for a parallel one.
std::optional<Eye> eyeOf(const ContourOptions& options, const ContourParts& parts, int dim);

/// The same of several pictures. content: projected in parallel. nearest: coordinate towards the eye.
Eye eyeAt(double degrees, const Eigen::AlignedBox2d& content, double nearest);

/// Coordinate of the nearest point of bodies and tools towards the eye.
double nearestOf(const ContourParts& parts);

/// Of a plane that meets nothing of what is in the box of the parts.
Error planeMisses(const ContourOptions& options, const ContourParts& parts, int frame);

/// Makes what is drawn of a body so fine that it is exact in this view: within a quarter pixel, its colours
/// within half of one of the steps of the range, or a tenth where bands or isolines show their borders. With
/// `subdivision` in the options it has these cells. field, options: those of the parts, for which boxes stay
/// as they were.
void refineForView(ContourParts& parts, const ModelRecord& model, const FrameRecord& frame,
                   const FieldChoice& field, const ContourOptions& options, const View& view,
                   const std::array<double, 2>& range);

/// Cells per knot span and direction, of what does not follow from the picture.
int subdivisionOf(const ModelRecord& model, const ContourOptions& options);

/// The smallest box round a part in space, and in the picture's plane.
Eigen::AlignedBox3d boxOf(vtkPolyData& part);
Eigen::AlignedBox2d boxOf(vtkPolyData& part, const ViewAxes& axes, const std::optional<Eye>& eye = {});

/// Whether a place of the bodies is in the window of the options, and in the part that their cut or slice leaves.
bool isSeen(const ContourParts& parts, const ContourOptions& options, const Eigen::Vector3d& place);

/// Diagonal of the bodies, and their projected box.
double lengthOf(const ContourParts& parts);
Eigen::AlignedBox2d bodiesBox(const ContourParts& parts);

/// The projected box that is to be seen, of a body in so many dimensions.
Eigen::AlignedBox2d contentOf(const ContourParts& parts, int dim);

}  // namespace burnish
