#pragma once
#include <vtkOpenGLPolyDataMapper.h>

namespace burnish {

/// Draws lines by a geometry shader that makes areas of them: VTK tells it their width in the coordinates of the window
/// (`lineWidthNVC`), also where OpenGL could draw them itself.
class StrokeMapper : public vtkOpenGLPolyDataMapper {
 public:
  static StrokeMapper* New();

 protected:
  bool HaveWideLines(vtkRenderer* renderer, vtkActor* actor) override;
};

}  // namespace burnish
