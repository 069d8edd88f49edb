#include "postproc/draw/chart/chart_scene.h"

#include <vtkContext2D.h>
#include <vtkObjectFactory.h>

namespace burnish {

vtkStandardNewMacro(PaintedItem);
vtkStandardNewMacro(ExportActor);

bool PaintedItem::Paint(vtkContext2D* painter) {
  painting_(*painter);
  return true;
}

void ExportActor::Initialize(vtkViewport*) {
  Context->Begin(ForceDevice);
  Initialized = true;
}

}  // namespace burnish
