#include "postproc/draw/contour/stroke_mapper.h"

#include <vtkObjectFactory.h>

namespace burnish {

vtkStandardNewMacro(StrokeMapper);

bool StrokeMapper::HaveWideLines(vtkRenderer* /*renderer*/, vtkActor* /*actor*/) {
  return true;
}

}  // namespace burnish
