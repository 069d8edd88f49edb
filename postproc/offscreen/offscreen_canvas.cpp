#include "postproc/offscreen/offscreen_canvas.h"

#include <vtkActor2D.h>
#include <vtkActor2DCollection.h>
#include <vtkCamera.h>
#include <vtkImageAppend.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkRenderingOpenGLConfigure.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#ifdef VTK_OPENGL_HAS_OSMESA
#include <vtkOSOpenGLRenderWindow.h>
#else
#include <GL/osmesa.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include "engine/core/error.h"
#endif

namespace burnish {

#ifdef VTK_OPENGL_HAS_OSMESA

/// This VTK brings a window in memory of its own.
class OffscreenCanvas::Context {
 public:
  vtkSmartPointer<vtkRenderWindow> makeWindow() { return vtkSmartPointer<vtkOSOpenGLRenderWindow>::New(); }
};

#else

/// An OSMesa context that is current as long as it lives. VTK draws into framebuffers that it allocates
/// itself, so the context's own buffer is one pixel: at full size it would only cost memory.
class OffscreenCanvas::Context {
 public:
  Context() {
    constexpr std::array attributes{OSMESA_FORMAT,
                                    OSMESA_RGBA,
                                    OSMESA_DEPTH_BITS,
                                    24,
                                    OSMESA_PROFILE,
                                    OSMESA_CORE_PROFILE,
                                    OSMESA_CONTEXT_MAJOR_VERSION,
                                    3,
                                    OSMESA_CONTEXT_MINOR_VERSION,
                                    2,
                                    0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (!context_ || !OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
      if (context_) OSMesaDestroyContext(context_);
      throw Error(
          "OSMesa gives no OpenGL 3.2 context; Mesa 13 or newer is needed (Debian package libosmesa6)");
    }
  }
  ~Context() {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    OSMesaDestroyContext(context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  vtkSmartPointer<vtkRenderWindow> makeWindow() {
    const auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    window->SetReadyForRendering(true);
    window->SetOwnContext(0);
    window->SetFrameBlitModeToNoBlit();
    const auto isCurrent = vtkSmartPointer<vtkCallbackCommand>::New();
    isCurrent->SetCallback(
        [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; });
    window->AddObserver(vtkCommand::WindowIsCurrentEvent, isCurrent);
    return window;
  }

 private:
  std::array<unsigned char, 4> pixel_{};
  OSMesaContext context_ = nullptr;
};

#endif

namespace {

/// Pixels that are drawn at once. A supersampled picture of 1600 x 900 at once would take 130 MB of buffers.
constexpr int kPixelsAtOnce = 1'500'000;

/// Number of equal strips that a picture is drawn in: the smallest divisor of its height that keeps a strip
/// small.
int stripsFor(int width, int height, int supersampling) {
  const double pixels = static_cast<double>(width) * height * supersampling * supersampling;
  for (int strips = 1; strips < height; ++strips)
    if (height % strips == 0 && pixels <= static_cast<double>(strips) * kPixelsAtOnce) return strips;
  return height;
}

/// One renderer of a picture that is drawn in horizontal strips.
class StripView {
 public:
  /// Takes the renderer as it is set up for the whole picture of the given height in pixels.
  StripView(vtkRenderer& renderer, int height)
      : renderer_(&renderer), parallelScale_(renderer.GetActiveCamera()->GetParallelScale()) {
    std::copy_n(renderer.GetViewport(), 4, viewport_.begin());
    bottom_ = static_cast<int>(std::lround(viewport_[1] * height));
    top_ = static_cast<int>(std::lround(viewport_[3] * height));
    vtkActor2DCollection* flat = renderer.GetActors2D();
    vtkCollectionSimpleIterator next;
    flat->InitTraversal(next);
    while (vtkActor2D* actor = flat->GetNextActor2D(next))
      flat_.push_back({actor, actor->GetPosition()[0], actor->GetPosition()[1]});
  }

  /// Shows the part that lies in the strip from pixel row `first` on.
  void show(int first, int height) const {
    const int low = std::max(bottom_, first), high = std::min(top_, first + height);
    renderer_->SetDraw(low < high);
    if (low >= high) return;
    const double total = top_ - bottom_, share = (high - low) / total;
    const double middle = (0.5 * (low + high) - bottom_) / total;
    renderer_->SetViewport(viewport_[0], static_cast<double>(low - first) / height, viewport_[2],
                           static_cast<double>(high - first) / height);
    vtkCamera& camera = *renderer_->GetActiveCamera();
    camera.SetParallelScale(parallelScale_ * share);
    camera.SetWindowCenter(0.0, (2.0 * middle - 1.0) / share);
    for (const auto& [actor, x, y] : flat_) actor->SetPosition(x, y - (low - bottom_));
  }

 private:
  struct Flat {
    vtkActor2D* actor;
    double x, y;
  };
  vtkRenderer* renderer_;
  double parallelScale_;
  std::array<double, 4> viewport_{};
  int bottom_, top_;  ///< of the viewport, in pixels of the whole picture
  std::vector<Flat> flat_;
};

}  // namespace

OffscreenCanvas::OffscreenCanvas(int width, int height, int supersampling)
    : supersampling_(supersampling),
      strips_(stripsFor(width, height, supersampling)),
      context_(std::make_unique<Context>()),
      window_(context_->makeWindow()) {
  window_->SetOffScreenRendering(true);
  window_->SetMultiSamples(0);
  window_->SetDPI(72);
  window_->SetSize(width * supersampling, height / strips_ * supersampling);
#ifndef VTK_OPENGL_HAS_OSMESA
  static_cast<vtkGenericOpenGLRenderWindow&>(*window_).OpenGLInit();
#endif
}

OffscreenCanvas::~OffscreenCanvas() {
  window_->Finalize();
  window_ = nullptr;
}

vtkRenderWindow& OffscreenCanvas::window() {
  return *window_;
}

vtkSmartPointer<vtkImageData> OffscreenCanvas::captureStrip() {
  window_->Render();
  const auto grab = vtkSmartPointer<vtkWindowToImageFilter>::New();
  grab->SetInput(window_);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  const auto average = vtkSmartPointer<vtkImageShrink3D>::New();
  average->SetInputConnection(grab->GetOutputPort());
  average->SetShrinkFactors(supersampling_, supersampling_, 1);
  average->MeanOn();
  average->Update();
  return average->GetOutput();
}

vtkSmartPointer<vtkImageData> OffscreenCanvas::capture() {
  if (strips_ == 1) return captureStrip();
  const int stripHeight = window_->GetSize()[1];
  std::vector<StripView> views;
  vtkRendererCollection* renderers = window_->GetRenderers();
  vtkCollectionSimpleIterator next;
  renderers->InitTraversal(next);
  while (vtkRenderer* renderer = renderers->GetNextRenderer(next))
    views.emplace_back(*renderer, strips_ * stripHeight);

  const auto stack = vtkSmartPointer<vtkImageAppend>::New();
  stack->SetAppendAxis(1);
  for (int strip = 0; strip < strips_; ++strip) {
    for (const StripView& view : views) view.show(strip * stripHeight, stripHeight);
    stack->AddInputData(captureStrip());
  }
  stack->Update();
  return stack->GetOutput();
}

}  // namespace burnish
