#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/picture_planes.h"

class vtkDataArray;
class vtkPolyData;

namespace burnish {

struct FieldChoice;

/// One of the places where a field is smallest, and one where it is largest.
struct ExtremePlaces {
  std::array<Eigen::Vector3d, 2> positions;  ///< as the picture tells them
  std::array<Eigen::Vector3d, 2> drawn;      ///< where they are drawn: with a factor on displacements
};

/// Nothing for a field that is the same everywhere, and for states. drawnDisplacement: of the frame's mesh.
std::optional<ExtremePlaces> extremePlaces(const ModelRecord& model, const FrameRecord& frame,
                                           const FieldChoice& field,
                                           const Eigen::MatrixXd& drawnDisplacement);

/// Moves places that are not seen to the first of their images in these planes that is, if there is one. planes: of
/// mirrors in which the field is its own image.
void moveToSeen(ExtremePlaces& places, const std::vector<MirrorPlane>& planes,
                const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen);

/// Numbers of the tuples with the smallest and the largest finite value of an array of scalars; nothing if they are equal.
std::optional<std::array<int, 2>> extremeTuples(vtkDataArray& scalars);

/// Flat signs in the plane of a view: a triangle that points down at the smallest value, one that points up at
/// the largest.
struct ExtremeMarks {
  vtkSmartPointer<vtkPolyData> areas, edges;
};

/// Signs of those places that are seen. side: of the triangles, in pixels.
ExtremeMarks extremeMarks(const ExtremePlaces& places,
                          const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen, const View& view,
                          double side);

/// A ring round a place in the plane of a view. diameter: in pixels.
vtkSmartPointer<vtkPolyData> ringMark(const Eigen::Vector3d& place, const View& view, double diameter);

/// "△ max at (1, 0.5), ▽ min at (0, 0)", without a sign for what is not seen. length: of the body, by which
/// coordinates are rounded.
std::string extremeNote(const ExtremePlaces& places,
                        const std::function<bool(const Eigen::Vector3d& drawn)>& isSeen, int dim,
                        double length);

inline constexpr const char *kSmallestSign = "▽ ", *kLargestSign = "△ ";

}  // namespace burnish
