#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <vector>

#include "postproc/draw/page/view.h"

class vtkPolyData;

/// Lines that show the shape of a surface in space.
namespace burnish {

/// Which part of a line between two places lies in an area, as parts of its length; empty (begin > end) if it passes by.
struct LinePart {
  double begin = 0.0, end = 1.0;
};
LinePart partWithin(const PixelRect& area, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// The surface with one point where several coincide.
vtkSmartPointer<vtkPolyData> withoutSeams(vtkPolyData& surface);

/// The surface with normals at its points, for smooth shading and `silhouetteOf`; edges stay sharp.
vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData& surface);

/// Where a surface with normals turns away from the eye of a view.
vtkSmartPointer<vtkPolyData> silhouetteOf(vtkPolyData& surface, const View& view);

/// Lines with the point data `kWayAlong`: how far one has come along each, in pixels of a view. Segments that follow
/// one another are one line.
inline constexpr const char* kWayAlong = "way_along";
vtkSmartPointer<vtkPolyData> withWayAlong(vtkPolyData& lines, const View& view);

/// Point data: by what a point has moved, three components.
inline constexpr const char* kMoved = "moved";

/// Gives points `kMoved`, to the points of the same numbers after it.
void setMoved(vtkPolyData& before, vtkPolyData& after);

/// Whether its points have `kMoved`.
bool hasMotion(vtkPolyData& lines);

/// Of lines with `kMoved`, each in one piece, from where it is first seen to have moved by so many pixels to where it last is; lines
/// that have moved by less than three times as many have none. All of lines without it.
vtkSmartPointer<vtkPolyData> movedLines(vtkPolyData& lines, const View& view, double pixels);

/// Of lines what no polygon of one of the surfaces covers in the area of a view, to a pixel; nothing beyond the area. Lines and
/// surfaces may lie in one plane.
vtkSmartPointer<vtkPolyData> besideSurfaces(vtkPolyData& lines,
                                            const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces,
                                            const View& view);

/// The border of a surface and its sharp edges.
vtkSmartPointer<vtkPolyData> edgesOf(vtkPolyData& surface);

/// The border of a surface alone.
vtkSmartPointer<vtkPolyData> rimOf(vtkPolyData& surface);

}  // namespace burnish
