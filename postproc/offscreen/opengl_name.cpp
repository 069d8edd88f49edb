#include "postproc/offscreen/opengl_name.h"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <sstream>

#include "engine/core/error.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "postproc/offscreen/open_gl.h"

namespace burnish {
namespace {

/// The rest of the line that begins so.
std::string rowOf(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) return line.substr(line.find_first_not_of(' ', begin.size()));
  return "unknown";
}

}  // namespace

std::string openGlName() {
  OffscreenCanvas canvas(16, 16);
  const vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 0.0, 0.2);
  canvas.window().AddRenderer(renderer);
  const auto picture = canvas.capture();
  const auto* pixel = static_cast<const unsigned char*>(picture->GetScalarPointer(8, 8, 0));
  if (pixel[0] != 255 || pixel[1] != 0 || pixel[2] != 51)
    throw Error("OpenGL draws other colours than it is told");
  const std::string told = canvas.window().ReportCapabilities();
  return fmt::format("{}, {}, through {}", rowOf(told, "OpenGL renderer string:"),
                     rowOf(told, "OpenGL version string:"), openGl().name());
}

}  // namespace burnish
