#pragma once
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <memory>

class vtkImageData;
class vtkRenderWindow;
class vtkUnsignedCharArray;

namespace burnish {

/// A render window in memory: needs no display, no graphics card and no environment variable. The window and
/// its GL context outlive a canvas and serve the next one of the same thread, which saves making a context
/// and compiling shaders; a canvas stays in the thread that made it.
class OffscreenCanvas {
 public:
  static constexpr int kSupersampling = 2;

  /// Makes this process draw its next pictures in narrow strips, for the sake of other things that need
  /// memory.
  static void saveMemory();

  /// Renders `kSupersampling` times larger than width x height (pixels) and averages: antialiasing without
  /// multisamples. Throws `Error` if no GL context of this size can be had, and `Interrupted`.
  OffscreenCanvas(int width, int height);
  ~OffscreenCanvas();
  OffscreenCanvas(const OffscreenCanvas&) = delete;
  OffscreenCanvas& operator=(const OffscreenCanvas&) = delete;

  /// The window to add renderers to. Its size is the supersampled one (or one of its strips), its DPI 72: a
  /// font size is a height in its own pixels.
  vtkRenderWindow& window();

  int supersampling() const { return kSupersampling; }

  /// Renders and returns the picture (or throws `Interrupted`), width x height RGB bytes, lowest row first.
  /// Once per canvas: the cameras, which must be parallel, and the positions of flat actors are left at the
  /// last strip.
  vtkSmartPointer<vtkImageData> capture();

 private:
  class Surface;

  /// Renders a strip and writes the averages of its lowest `count` rows to `rows`.
  void captureStrip(int count, unsigned char* rows);

  int height_;                           ///< of the picture
  int strips_;                           ///< the picture is drawn in horizontal strips, which saves memory
  int overlap_;                          ///< rows drawn beyond each edge of a strip
  std::unique_ptr<Surface> surface_;     ///< GL context and window
  vtkNew<vtkUnsignedCharArray> pixels_;  ///< of a strip
};

}  // namespace burnish
