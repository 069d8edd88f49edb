#include "postproc/draw/contour/peeling_renderer.h"

#include <vtkDualDepthPeelingPass.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkTranslucentPass.h>

namespace burnish {

namespace {

/// Peels as often as it is told. VTK itself stops after a peel that has left nothing in the layers from behind: where
/// a body lies behind all of a picture, or of a strip of it, that is the first one, and what is left is lost.
class AllPeels : public vtkDualDepthPeelingPass {
 public:
  static AllPeels* New();
  void Render(const vtkRenderState* state) override {
    auto& window = dynamic_cast<vtkOpenGLRenderWindow&>(*state->GetRenderer()->GetRenderWindow());
    State = window.GetState();
    Timer = window.GetRenderTimer();
    PreRender(state);
    Initialize(state);
    Prepare();
    for (int peel = 0; peel < MaximumNumberOfPeels; ++peel) Peel();
    TranslucentWrittenPixels = OcclusionThreshold + 1;  // `Finalize` blends what is left
    Finalize();
    PostRender(state);
  }
};

vtkStandardNewMacro(AllPeels);

}  // namespace

vtkStandardNewMacro(PeelingRenderer);

void PeelingRenderer::DeviceRenderTranslucentPolygonalGeometry(vtkFrameBufferObjectBase* target) {
  if (blendsInOrder_ && !UseDepthPeeling) {
    UpdateTranslucentPolygonalGeometry();
    return;
  }
  if (UseDepthPeeling && !DepthPeelingPass) {
    DepthPeelingPass = AllPeels::New();
    const vtkNew<vtkTranslucentPass> layers;
    DepthPeelingPass->SetTranslucentPass(layers);
  }
  vtkOpenGLRenderer::DeviceRenderTranslucentPolygonalGeometry(target);
}

}  // namespace burnish
