#include <vtkSVGExporter.h>

/// What writes charts as SVG, loaded when one is written: VTK's library of it brings fourteen others along. The caller owns it.
extern "C" vtkSVGExporter* burnishNewSvgExporter() {
  return vtkSVGExporter::New();
}
