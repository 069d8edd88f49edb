#include "postproc/draw/contour/space_actors.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace burnish {
namespace {

vtkSmartPointer<vtkActor> makeActor(vtkPolyData& data) {
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  // The card gets floats: about the middle of the part, so that it is as exact wherever it lies.
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::ALWAYS_AUTO_SHIFT_SCALE);
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

vtkSmartPointer<vtkActor> pointActor(vtkPolyData& points, const Color& color, double diameter) {
  const auto actor = makeActor(points);
  paint(*actor, color, 1.0);
  actor->GetProperty()->SetRepresentationToPoints();
  actor->GetProperty()->RenderPointsAsSpheresOn();
  actor->GetProperty()->SetPointSize(static_cast<float>(diameter));
  return actor;
}

void aim(vtkRenderer& renderer, const View& view, const std::array<int, 2>& pictureSize, double distance) {
  renderer.SetViewport(view.area.x / pictureSize[0], view.area.y / pictureSize[1],
                       view.area.right() / pictureSize[0], view.area.top() / pictureSize[1]);
  const Eigen::Vector3d focus = view.axes.transpose() * view.center;
  const Eigen::Vector3d eye = focus + distance * view.towardsEye();
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera.SetPosition(eye.x(), eye.y(), eye.z());
  camera.SetViewUp(view.axes(1, 0), view.axes(1, 1), view.axes(1, 2));
  camera.SetParallelScale(view.area.height / (2.0 * view.pixelsPerLength));
  renderer.ResetCameraClippingRange();
}

}  // namespace burnish
