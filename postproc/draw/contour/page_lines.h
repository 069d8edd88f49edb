#pragma once
#include <vector>

#include "postproc/draw/page/page_sketch.h"

class vtkPolyData;

/// Lines of space as vectors on a page, cut off at the edges of the view.
namespace burnish {

/// Polylines with round ends and corners, pieces that meet as one. width: in pixels of the picture.
PageLines pageLines(vtkPolyData& lines, const View& view, const Color& color, double width, double opacity);

/// The points as round dots.
PageLines pageDots(vtkPolyData& points, const View& view, const Color& color, double diameter);

/// Lines in the colours of their point scalars, a piece of each colour.
std::vector<PageLines> coloredPageLines(vtkPolyData& lines, const View& view, const ColorScale& scale,
                                        double width);

/// What cells in the view's plane cover, without the borders between them.
PageRegion pageRegion(vtkPolyData& cells, const View& view, const Color& color);

/// The same in the colours of their point scalars: a region for each of so many equal bands of the scale, one over
/// the other, from what has any value to what has the highest ones.
std::vector<PageRegion> coloredPageRegions(vtkPolyData& cells, const View& view, const ColorScale& scale,
                                           int bands);

/// Adds an area, an arrow or a sign, for each closed line round one.
void addPageAreas(PageSketch& sketch, vtkPolyData& edges, const View& view, const Color& area,
                  const Color& edge, double width);

}  // namespace burnish
