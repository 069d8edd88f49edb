#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/picture_planes.h"

class vtkPolyData;

namespace burnish {

/// Flat arrows that lie in the plane of a view, their lengths as those of their vectors.
struct ContourArrows {
  vtkSmartPointer<vtkPolyData> areas, edges;          ///< null without arrows
  std::string note;                                   ///< what they show and how much the longest stands for
  vtkSmartPointer<vtkPolyData> darkAreas, darkEdges;  ///< of compression; null without crosses
};

/// Why a field of a run has no arrows of its own; nothing if it has.
std::optional<std::string> directionProblem(const std::string& field);

/// What arrows stand on, and what they show.
struct ArrowGround {
  int dim = 3;
  vtkSmartPointer<vtkPolyData>
      surface;             ///< point data: `vectors`, or `stress` (xx, yy, zz, xy, yz, zx), which any tensor
                           ///< may be; in space also normals
  bool isOneSided = true;  ///< its normals point out of the body; of others those of either side may be seen
  std::string name, unit;  ///< of what is shown; the unit may be empty
};

/// The faces in contact with their tractions.
ArrowGround tractionGround(const ModelRecord& model, const FrameRecord& frame);

/// Arrows that begin on the body (displacement) or end on its contact faces (traction), or crosses of pairs of arrows
/// along the principal directions of stress, apart in tension and towards one another in compression, or curved arrows
/// along vectors in a plane (streamlines), as far apart as even lines are. Of a body in
/// space only what faces the eye of the view, of which axes and eye count, and is not hidden by `before` (null: nothing
/// hides), has arrows; those of tractions, which lie under tools or between bodies, are drawn all. longest: length of
/// the longest arrow or pair, in space of those that are drawn; they keep most of it as their distance. symmetries: planes
/// on which crosses stand across and along.
ContourArrows contourArrows(ArrowField field, const ArrowGround& ground, vtkPolyData* before,
                            const View& view, double longest, const std::vector<MirrorPlane>& symmetries);

}  // namespace burnish
