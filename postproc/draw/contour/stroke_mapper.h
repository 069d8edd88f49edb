#pragma once
#include <vtkOpenGLPolyDataMapper.h>

namespace burnish {

/// Draws lines as areas of a width across them, whatever their direction. Lines of OpenGL have theirs along an axis of the
/// window, so that oblique ones are thinner, and which pixels lie at their ends depends on where they begin.
class StrokeMapper : public vtkOpenGLPolyDataMapper {
 public:
  static StrokeMapper* New();

 protected:
  /// Of what VTK then tells a geometry shader: the width in the coordinates of the window.
  bool HaveWideLines(vtkRenderer* renderer, vtkActor* actor) override;
};

}  // namespace burnish
