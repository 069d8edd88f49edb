#include "postproc/offscreen/offscreen_canvas.h"

#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderingOpenGLConfigure.h>
#include <vtkWindowToImageFilter.h>

#ifdef VTK_OPENGL_HAS_OSMESA
#include <vtkOSOpenGLRenderWindow.h>
#else
#include <GL/osmesa.h>
#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <array>
#include <vector>

#include "engine/core/error.h"
#endif

namespace burnish {

#ifdef VTK_OPENGL_HAS_OSMESA

/// This VTK brings a window in memory of its own.
class OffscreenCanvas::Context {
 public:
  Context(int, int) {}
  vtkSmartPointer<vtkRenderWindow> makeWindow() { return vtkSmartPointer<vtkOSOpenGLRenderWindow>::New(); }
};

#else

/// An OSMesa context that is current on a buffer of its own as long as it lives.
class OffscreenCanvas::Context {
 public:
  Context(int width, int height)
      : pixels_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
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
    if (!context_ || !OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width, height)) {
      if (context_) OSMesaDestroyContext(context_);
      throw Error(fmt::format(
          "OSMesa cannot draw a picture of {} x {} pixels; a smaller picture or a newer Mesa may help", width,
          height));
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
    const auto isCurrent = vtkSmartPointer<vtkCallbackCommand>::New();
    isCurrent->SetCallback(
        [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; });
    window->AddObserver(vtkCommand::WindowIsCurrentEvent, isCurrent);
    return window;
  }

 private:
  std::vector<unsigned char> pixels_;
  OSMesaContext context_ = nullptr;
};

#endif

OffscreenCanvas::OffscreenCanvas(int width, int height, int supersampling)
    : supersampling_(supersampling),
      context_(std::make_unique<Context>(width * supersampling, height * supersampling)),
      window_(context_->makeWindow()) {
  window_->SetOffScreenRendering(true);
  window_->SetMultiSamples(0);
  window_->SetDPI(72);
  window_->SetSize(width * supersampling, height * supersampling);
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

vtkSmartPointer<vtkImageData> OffscreenCanvas::capture() {
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

}  // namespace burnish
