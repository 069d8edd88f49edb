#pragma once
#include <vtkOpenGLRenderer.h>

namespace burnish {

/// A renderer that, with depth peeling, blends translucent surfaces in their true order, pixel by pixel, by VTK's dual depth peeling;
/// what lies deeper than its peels reach is blended in the order of the actors. A peel takes the nearest and the farthest layer
/// that are left, the first one only the nearest where something opaque stands behind. Without depth peeling all are blended in
/// the order of the actors, without the textures as large as the picture that VTK's weighted blending needs.
class PeelingRenderer : public vtkOpenGLRenderer {
 public:
  static PeelingRenderer* New();
  void DeviceRenderTranslucentPolygonalGeometry(vtkFrameBufferObjectBase* target) override;
};

}  // namespace burnish
