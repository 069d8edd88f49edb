#pragma once
#include <Eigen/Dense>
#include <vector>

#include "postproc/draw/page/color_scale.h"

class vtkPolyData;
class vtkRenderer;

namespace burnish {

/// Lines and areas in pixels (see PixelRect), in a renderer that is `scale` times larger. What is added later
/// lies over what was added before.
class FlatShapes {
 public:
  using Points = std::vector<Eigen::Vector2d>;

  FlatShapes(vtkRenderer& renderer, int scale) : renderer_(renderer), scale_(scale) {}

  void addConvexPolygon(const Points& corners, const Color& color);

  void addPolyline(const Points& points, double width, const Color& color);

  /// Line segments from even to odd points.
  void addSegments(const Points& points, double width, const Color& color);

 private:
  void add(vtkPolyData& shape, const Points& points, double width, const Color& color);

  vtkRenderer& renderer_;
  int scale_;
};

}  // namespace burnish
