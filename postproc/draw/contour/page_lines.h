#pragma once
#include <vtkSmartPointer.h>

#include <vector>

#include "postproc/draw/contour/seen_lines.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/draw/page/page_sketch.h"

class vtkPolyData;

/// Lines of space as vectors on a page, cut off at the edges of the view.
namespace burnish {

/// The lines in as few pieces as there can be, and nothing twice.
vtkSmartPointer<vtkPolyData> inFewPieces(vtkPolyData& lines);

/// Polylines with round ends and corners, pieces that meet as one. width: in pixels of the picture.
PageLines pageLines(vtkPolyData& lines, const View& view, const Color& color, double width, double opacity);

/// What is seen of polylines, those of one darkness at once. lift: see `SeenLines`.
std::vector<PageLines> pageLines(vtkPolyData& lines, const View& view, const Color& color, double width,
                                 double opacity, const SeenLines& seen, double lift);

/// Lines with `kWayAlong` in dashes.
PageLines pageDashes(vtkPolyData& lines, const View& view, const Color& color, double width,
                     const Dashes& dashes);

/// The points as round dots.
PageLines pageDots(vtkPolyData& points, const View& view, const Color& color, double diameter);

/// Those that are seen.
std::vector<PageLines> pageDots(vtkPolyData& points, const View& view, const Color& color, double diameter,
                                const SeenLines& seen, double lift);

/// Lines in the colours of their point scalars, a piece of each colour.
std::vector<PageLines> coloredPageLines(vtkPolyData& lines, const View& view, const ColorScale& scale,
                                        double width);

/// What cells in the view's plane cover, without the borders between them.
PageRegion pageRegion(vtkPolyData& cells, const View& view, const Color& color);

/// The same in the colours of their point scalars: a region for each of so many equal bands of the scale, one over
/// the other, from what has any value to what has the highest ones.
std::vector<PageRegion> coloredPageRegions(vtkPolyData& cells, const View& view, const ColorScale& scale,
                                           int bands);

/// Of closed lines those round a middle that is seen.
vtkSmartPointer<vtkPolyData> seenLoops(vtkPolyData& loops, const SeenLines& seen, double lift);

/// Adds an area, an arrow or a sign, for each closed line round one.
void addPageAreas(PageSketch& sketch, vtkPolyData& edges, const View& view, const Color& area,
                  const Color& edge, double width);

}  // namespace burnish
