#pragma once
#include <vtkSmartPointer.h>

#include <vector>

#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/free_sky.h"
#include "postproc/draw/contour/tool_drawing.h"

namespace burnish {

/// What takes light from the bodies and tools of a picture in space.
class Occlusion {
 public:
  /// parts, tools: that are drawn, which must outlive the object. Tools stop rays as far as one cannot see through
  /// them. Throws as `FreeSky`.
  Occlusion(ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity);

  /// Gives the surfaces of the tools and, if wished, of the bodies, those that have normals, the point data `kSky`:
  /// rays as long as a quarter of the bodies.
  void setSky(bool ofBodies);

  /// The shadow of the bodies on the ground on which they stand, a surface of RGBA points. Null where the eye does
  /// not look down on it or a tool is in its place. y goes up.
  vtkSmartPointer<vtkPolyData> groundShadow() const;

 private:
  ContourParts& parts_;
  const std::vector<ToolDrawing>& tools_;
  double length_;  ///< of the bodies
  FreeSky sky_;
};

/// Lets a shadow end before the border of the picture, whose edge would be seen on a page. picture: a view whose area
/// is all of it.
void fadeAtBorder(vtkPolyData& shadow, const View& picture);

}  // namespace burnish
