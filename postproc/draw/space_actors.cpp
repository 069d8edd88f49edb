#include "postproc/draw/space_actors.h"

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace burnish {
namespace {

vtkSmartPointer<vtkActor> makeActor(vtkPolyData& data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&data);
  mapper->ScalarVisibilityOff();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

void paint(vtkActor& actor, const Color& color, double opacity) {
  actor.GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  actor.GetProperty()->SetOpacity(opacity);
}

void shade(vtkActor& actor) {
  actor.GetProperty()->LightingOn();
  actor.GetProperty()->SetAmbient(0.6);
  actor.GetProperty()->SetDiffuse(0.4);
}

}  // namespace

vtkSmartPointer<vtkActor> plainActor(vtkPolyData& surface, const Color& color, bool shaded, double opacity) {
  const auto actor = makeActor(surface);
  paint(*actor, color, opacity);
  if (shaded) shade(*actor);
  return actor;
}

vtkSmartPointer<vtkActor> contourActor(vtkPolyData& surface, const ColorScale& scale, bool shaded) {
  const auto actor = makeActor(surface);
  vtkMapper& mapper = *actor->GetMapper();
  mapper.ScalarVisibilityOn();
  mapper.SetScalarModeToUsePointData();
  mapper.SetColorModeToMapScalars();
  mapper.InterpolateScalarsBeforeMappingOn();
  mapper.SetLookupTable(scale.table());
  mapper.UseLookupTableScalarRangeOn();
  if (shaded) shade(*actor);
  return actor;
}

vtkSmartPointer<vtkActor> lineActor(vtkPolyData& lines, const Color& color, double width, double opacity) {
  const auto actor = makeActor(lines);
  paint(*actor, color, opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

}  // namespace burnish
