#include "postproc/offscreen/offscreen_canvas.h"

#include <vtkActor2D.h>
#include <vtkActor2DCollection.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkRenderingOpenGLConfigure.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/interruption.h"
#include "engine/core/memory_limit.h"
#include "postproc/offscreen/open_gl.h"

#ifdef VTK_OPENGL_HAS_OSMESA
#include <vtkOSOpenGLRenderWindow.h>
#else
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#endif

namespace burnish {

namespace {

#ifdef VTK_OPENGL_HAS_OSMESA

/// This VTK brings a window in memory of its own.
class Context {
 public:
  void makeCurrent() {}
  vtkSmartPointer<vtkRenderWindow> makeWindow() { return vtkSmartPointer<vtkOSOpenGLRenderWindow>::New(); }
};

#else

/// VTK draws into framebuffers that it allocates itself.
class Context {
 public:
  void makeCurrent() { context_->makeCurrent(); }

  vtkSmartPointer<vtkRenderWindow> makeWindow() {
    const auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    window->SetReadyForRendering(true);
    window->SetOwnContext(0);
    window->SetFrameBlitModeToNoBlit();
    const auto isCurrent = vtkSmartPointer<vtkCallbackCommand>::New();
    isCurrent->SetCallback(
        [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; });
    window->AddObserver(vtkCommand::WindowIsCurrentEvent, isCurrent);
    window->OpenGLInit();
    return window;
  }

 private:
  std::unique_ptr<GlContext> context_ = openGl().makeContext();
};

#endif

constexpr int kFactor = OffscreenCanvas::kSupersampling;

/// Supersampled pixels that are drawn at once. A picture of 1600 x 900 in one piece takes 130 MB of buffers;
/// in strips it takes a third more time.
constexpr int kPixelsAtOnce = 6'000'000, kFewPixelsAtOnce = 1'500'000;
std::atomic<int> pixelsAtOnce{kPixelsAtOnce};

/// Rows (at most, supersampled) by which a strip is drawn beyond its edges: lines are cut off where their
/// middle leaves the window, though half of their width may still be inside.
constexpr int kOverlap = 16;

int stripsFor(int width, int height) {
  const double pixels = static_cast<double>(width) * height * kFactor * kFactor;
  return std::clamp(static_cast<int>(std::ceil(pixels / pixelsAtOnce)), 1, height);
}

/// Rows of a strip; the last strip may have fewer.
int rowsFor(int height, int strips) {
  return (height + strips - 1) / strips;
}

/// Address space of Mesa's and LLVM's libraries.
constexpr std::uint64_t kLibraries = 180 * kMegabyte;

/// Bytes that a picture takes (measured, and a little more): Mesa, which ends the program where it gets less,
/// with its compiler; the buffers of a strip; the picture itself and as a PNG.
std::uint64_t memoryFor(int width, int height, int strips, bool hasContext) {
  constexpr std::uint64_t mesa = 130 * kMegabyte, compiler = 30 * kMegabyte, perPixel = 20;
  const auto w = static_cast<std::uint64_t>(width), h = static_cast<std::uint64_t>(height);
  const std::uint64_t strip = w * kFactor * (static_cast<std::uint64_t>(rowsFor(height, strips)) * kFactor);
  return (hasContext ? 0 : mesa) + compiler + perPixel * strip + 5 * w * h;
}

/// One renderer of a picture that is drawn in horizontal strips.
class StripView {
 public:
  /// Takes the renderer as it is set up for the whole picture of the given height in pixels.
  StripView(vtkRenderer& renderer, int height)
      : renderer_(&renderer),
        parallelScale_(renderer.GetActiveCamera()->GetParallelScale()),
        slope_(std::tan(vtkMath::RadiansFromDegrees(renderer.GetActiveCamera()->GetViewAngle()) / 2.0)) {
    std::copy_n(renderer.GetActiveCamera()->GetWindowCenter(), 2, center_.begin());
    std::copy_n(renderer.GetViewport(), 4, viewport_.begin());
    bottom_ = static_cast<int>(std::lround(viewport_[1] * height));
    top_ = static_cast<int>(std::lround(viewport_[3] * height));
    vtkActor2DCollection* flat = renderer.GetActors2D();
    vtkCollectionSimpleIterator next = nullptr;
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
    camera.SetViewAngle(vtkMath::DegreesFromRadians(2.0 * std::atan(slope_ * share)));
    camera.SetWindowCenter(center_[0], (center_[1] + 2.0 * middle - 1.0) / share);
    for (const auto& [actor, x, y] : flat_) actor->SetPosition(x, y - (low - bottom_));
  }

 private:
  struct Flat {
    vtkActor2D* actor;
    double x, y;
  };
  vtkRenderer* renderer_;
  double parallelScale_;
  double slope_;                    ///< of the upper edge of a perspective view, from its middle
  std::array<double, 2> center_{};  ///< of the window of the whole picture, in half sizes of it
  std::array<double, 4> viewport_{};
  int bottom_, top_;  ///< of the viewport, in pixels of the whole picture
  std::vector<Flat> flat_;
};

/// Averages blocks of `Factor` x `Factor` RGBA pixels into RGB pixels. A loop of our own: vtkImageShrink3D
/// takes a fifth of the time of a whole picture. width and height: of the pixels.
template <std::size_t Factor>
void average(const unsigned char* pixels, int width, int height, unsigned char* averages) {
  constexpr std::size_t block = Factor * Factor, blockSize = 4 * Factor;
  const auto rowSize = 4 * static_cast<std::size_t>(width);
  std::vector<std::uint16_t> columns(rowSize);  // sums over the rows of a block
  for (int j = 0; j < height; j += static_cast<int>(Factor)) {
    std::fill(columns.begin(), columns.end(), std::uint16_t{0});
    for (std::size_t row = 0; row < Factor; ++row, pixels += rowSize)
      for (std::size_t k = 0; k < rowSize; ++k)
        columns[k] = static_cast<std::uint16_t>(columns[k] + pixels[k]);
    for (std::size_t k = 0; k < rowSize; k += blockSize, averages += 3)
      for (std::size_t c = 0; c < 3; ++c) {
        unsigned sum = block / 2;
        for (std::size_t i = 0; i < Factor; ++i) sum += columns[k + 4 * i + c];
        averages[c] = static_cast<unsigned char>(sum / block);
      }
  }
}

}  // namespace

class OffscreenCanvas::Surface {
 public:
  Surface() : window_(context_.makeWindow()) {
    window_->SetOffScreenRendering(true);
    window_->SetMultiSamples(0);
    window_->SetDPI(72);
  }
  ~Surface() {
    context_.makeCurrent();
    window_->Finalize();
    window_ = nullptr;
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  vtkRenderWindow& window() { return *window_; }

  void makeCurrent() { context_.makeCurrent(); }

  /// Forgets what was drawn, but keeps the compiled shaders.
  void clear() {
    context_.makeCurrent();
    while (vtkRenderer* renderer = window_->GetRenderers()->GetFirstRenderer())
      window_->RemoveRenderer(renderer);
    window_->SetNumberOfLayers(1);
  }

  /// A surface that waits for the next canvas of this thread, to which its context belongs. One is kept, so
  /// that memory does not grow: it holds at most a strip's framebuffers.
  static std::unique_ptr<Surface>& idle() {
    thread_local std::unique_ptr<Surface> surface;
    return surface;
  }

 private:
  Context context_;
  vtkSmartPointer<vtkRenderWindow> window_;
};

void OffscreenCanvas::saveMemory() {
  pixelsAtOnce = kFewPixelsAtOnce;
}

OffscreenCanvas::OffscreenCanvas(int width, int height)
    : height_(height), strips_(stripsFor(width, height)), overlap_(strips_ == 1 ? 0 : kOverlap) {
  throwIfInterrupted();
  std::unique_ptr<Surface>& idle = Surface::idle();
  requireMemory(memoryFor(width, height, strips_, idle != nullptr), "drawing",
                openGlIsLoaded() ? 0 : kLibraries);
  surface_ = idle ? std::move(idle) : std::make_unique<Surface>();
  surface_->makeCurrent();
  window().SetSize(width * kFactor, rowsFor(height, strips_) * kFactor + 2 * overlap_);
}

OffscreenCanvas::~OffscreenCanvas() {
  surface_->clear();
  Surface::idle() = std::move(surface_);
}

vtkRenderWindow& OffscreenCanvas::window() {
  return surface_->window();
}

void OffscreenCanvas::captureStrip(int count, unsigned char* rows) {
  window().Render();
  const int* size = window().GetSize();
  // With alpha, as it lies in the framebuffer: quicker than leaving it out.
  const int drawn = count * kFactor;
  window().GetRGBACharPixelData(0, overlap_, size[0] - 1, overlap_ + drawn - 1, 0, pixels_);
  average<kFactor>(pixels_->GetPointer(0), size[0], drawn, rows);
}

vtkSmartPointer<vtkImageData> OffscreenCanvas::capture() {
  surface_->makeCurrent();
  const int stripHeight = window().GetSize()[1] - 2 * overlap_;
  std::vector<StripView> views;
  vtkRendererCollection* renderers = window().GetRenderers();
  vtkCollectionSimpleIterator next = nullptr;
  renderers->InitTraversal(next);
  while (vtkRenderer* renderer = renderers->GetNextRenderer(next))
    views.emplace_back(*renderer, height_ * kFactor);

  const auto picture = vtkSmartPointer<vtkImageData>::New();
  const int rowsPerStrip = stripHeight / kFactor;
  picture->SetDimensions(window().GetSize()[0] / kFactor, height_, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int row = 0; row < height_; row += rowsPerStrip) {
    throwIfInterrupted();
    for (const StripView& view : views) view.show(row * kFactor - overlap_, stripHeight + 2 * overlap_);
    captureStrip(std::min(rowsPerStrip, height_ - row),
                 static_cast<unsigned char*>(picture->GetScalarPointer(0, row, 0)));
  }
  return picture;
}

}  // namespace burnish
