#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include "postproc/offscreen/quiet_libraries.h"

namespace burnish {
namespace {

class SilentWindow : public vtkOutputWindow {
 public:
  static SilentWindow* New();
  void DisplayText(const char*) override {}
};
vtkStandardNewMacro(SilentWindow);

}  // namespace

void silenceVtk() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  const vtkNew<SilentWindow> window;
  vtkOutputWindow::SetInstance(window);
}

}  // namespace burnish
