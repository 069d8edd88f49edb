#pragma once
#include <vtkOpenGLRenderer.h>

namespace burnish {

/// A renderer that, with depth peeling, blends translucent surfaces in their true order, pixel by pixel, by VTK's
/// dual depth peeling; what lies deeper than its peels reach is blended in the order of the actors. A peel takes the
/// nearest and the farthest layer that are left, the first one only the nearest where something opaque stands behind.
class PeelingRenderer : public vtkOpenGLRenderer {
 public:
  static PeelingRenderer* New();

  /// Without depth peeling, blends translucent shapes in the order of the actors from now on, and not by weights,
  /// for which VTK needs textures as large as the picture.
  void blendInOrder() { blendsInOrder_ = true; }

  void DeviceRenderTranslucentPolygonalGeometry(vtkFrameBufferObjectBase* target) override;

 private:
  bool blendsInOrder_ = false;
};

}  // namespace burnish
