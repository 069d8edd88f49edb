#include "postproc/draw/contour/space_actors.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/stroke_mapper.h"

namespace burnish {
namespace {

vtkSmartPointer<vtkActor> makeActor(vtkPolyData& data,
                                    vtkOpenGLPolyDataMapper& mapper = *vtkNew<vtkOpenGLPolyDataMapper>()) {
  // The card gets floats: about the middle of the part, so that it is as exact wherever it lies.
  mapper.SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::ALWAYS_AUTO_SHIFT_SCALE);
  mapper.SetInputData(&data);
  mapper.ScalarVisibilityOff();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(&mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

void paint(vtkActor& actor, const Color& color, double opacity) {
  actor.GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  actor.GetProperty()->SetOpacity(opacity);
}

/// Light of lamps that go with the eye, the brightest above it: x to the right, y up, z to the eye. A face that looks
/// at the eye has its own colour, and left and right are lit alike, so that what is symmetric looks so. Computed here
/// and not by VTK, whose sums cannot be limited: colours of a scale must neither become others nor too dark to be read
/// from it. White light, nothing shines.
constexpr const char* kLight = R"(
  vec3 n = normalVCVSOutput;
  float lamps = 0.9 * max(0.0, dot(n, vec3(0.0, 0.7741, 0.6330))) +
    0.3 * max(0.0, dot(n, vec3(0.0, -0.9659, 0.2588))) + 0.3 * max(0.0, n.z) +
    0.26 * (max(0.0, dot(n, vec3(0.9397, 0.0, -0.3420))) + max(0.0, dot(n, vec3(-0.9397, 0.0, -0.3420))));
  float light = (0.45 + 0.6 * lamps) / 1.018;
)";

/// Between which a surface is lit.
struct LightRange {
  double least, most;
};
constexpr LightRange kFieldLight{0.6, 1.0}, kPlainLight{0.0, 1.15};

void shade(vtkActor& actor, vtkPolyData& surface, const LightRange& range) {
  vtkProperty& property = *actor.GetProperty();
  property.LightingOn();
  property.SetInterpolationToPhong();
  property.SetAmbient(1.0);
  property.SetDiffuse(0.0);
  vtkShaderProperty& shaders = *actor.GetShaderProperty();
  const bool hasSky = surface.GetPointData()->HasArray(kSky) != 0;
  if (hasSky) {
    vtkOpenGLPolyDataMapper::SafeDownCast(actor.GetMapper())
        ->MapDataArrayToVertexAttribute("skyMC", kSky, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
    shaders.AddVertexShaderReplacement(
        "//VTK::Normal::Dec", true, "//VTK::Normal::Dec\nin float skyMC;\nout float skyVCVSOutput;\n", false);
    shaders.AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                       "//VTK::Normal::Impl\n  skyVCVSOutput = skyMC;\n", false);
    shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                         "//VTK::Normal::Dec\nin float skyVCVSOutput;\n", false);
  }
  shaders.AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true,
      fmt::format(
          "//VTK::Light::Impl\n{}  gl_FragData[0].rgb *= clamp({}min(light, {:.4f}), {:.4f}, {:.4f});\n",
          kLight, hasSky ? "skyVCVSOutput * " : "", range.most, range.least, range.most),
      false);
}

/// Of a geometry shader that makes an area of a line; what VTK adds where it finds its marks goes through to the fragments.
/// With `kPixelsWide`, the width below which lines are thin, `kThin`, and `kEnd`, by which they go on beyond their ends.
constexpr const char* kStroke = R"(
//VTK::PositionVC::Dec
//VTK::PrimID::Dec
//VTK::Color::Dec
//VTK::Normal::Dec
//VTK::Light::Dec
//VTK::TCoord::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Clip::Dec
//VTK::Output::Dec
uniform vec2 lineWidthNVC;
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
noperspective out vec2 strokeGSOutput;
flat out float strokeLengthGSOutput;

void main() {
  vec2 pixel = lineWidthNVC / kPixelsWide;
  vec2 way = (gl_in[1].gl_Position.xy / gl_in[1].gl_Position.w -
              gl_in[0].gl_Position.xy / gl_in[0].gl_Position.w) / pixel;
  float span = length(way);
  if (span <= 1e-6) return;
  vec2 along = way / span;
  vec2 across = kPixelsWide * vec2(-along.y, along.x);
  if (kPixelsWide < kThin)
    across = max(1.0, floor(kPixelsWide + 0.5)) * (abs(way.x) >= 0.9999 * abs(way.y) ? vec2(0.0, 1.0) : vec2(1.0, 0.0));
  for (int j = 0; j < 4; j++) {
    int i = j / 2;
    float end = i == 0 ? -kEnd : kEnd, side = j % 2 == 0 ? 0.5 : -0.5;
    //VTK::PrimID::Impl
    //VTK::Clip::Impl
    //VTK::Color::Impl
    //VTK::Normal::Impl
    //VTK::Light::Impl
    //VTK::TCoord::Impl
    //VTK::DepthPeeling::Impl
    //VTK::Picking::Impl
    //VTK::PositionVC::Impl
    strokeGSOutput = vec2((i == 0 ? 0.0 : span / kPixelsWide) + end, side);
    strokeLengthGSOutput = span / kPixelsWide;
    vec4 place = gl_in[i].gl_Position;
    gl_Position = vec4(place.xy + pixel * (end * kPixelsWide * along + side * across) * place.w, place.z, place.w);
    EmitVertex();
  }
  EndPrimitive();
}
)";

/// Flat ones where overlaps would be seen, as of translucent lines (at bends a little of the lines overlaps anyway); joined ones
/// go on by as little as closes the gaps at bends, where what lies beyond the ends of a line would be wrong.
enum class LineEnds { Flat, Joined, Round };

/// Makes areas of lines, which lie as they do in a mirror; which pixels are at the ends of OpenGL's own depends on where they begin.
/// Thin ones are whole pixels wide along an axis of the window, so that they are even; others have their width across them
/// in every direction, and round ends, in which the next line begins.
void stroke(vtkActor& actor, double width, LineEnds ends) {
  constexpr double kThin = 3.5;  // pixels of the window
  if (width < kThin) ends = LineEnds::Flat;
  constexpr std::array kEnds{0.0, 0.2, 0.5};  // in widths
  vtkShaderProperty& shaders = *actor.GetShaderProperty();
  actor.GetProperty()->SetLineWidth(static_cast<float>(width));
  shaders.SetGeometryShaderCode(
      fmt::format("//VTK::System::Dec\nconst float kPixelsWide = {:.6f}, kThin = {:.1f}, kEnd = {:.1f};{}",
                  width, kThin, kEnds[static_cast<std::size_t>(ends)], kStroke)
          .c_str());
  if (ends != LineEnds::Round) return;
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                       "//VTK::Normal::Dec\nnoperspective in vec2 strokeGSOutput;\n"
                                       "flat in float strokeLengthGSOutput;\n",
                                       false);
  shaders.AddFragmentShaderReplacement(
      "//VTK::Color::Impl", true,
      "//VTK::Color::Impl\n  float beyond = max(-strokeGSOutput.x, strokeGSOutput.x - strokeLengthGSOutput);\n"
      "  if (beyond > 0.0 && beyond * beyond + strokeGSOutput.y * strokeGSOutput.y > 0.25) discard;\n",
      false);
}

void colorBy(const ColorScale& scale, vtkActor& actor) {
  vtkMapper& mapper = *actor.GetMapper();
  mapper.ScalarVisibilityOn();
  mapper.SetScalarModeToUsePointData();
  mapper.SetColorModeToMapScalars();
  mapper.InterpolateScalarsBeforeMappingOn();
  mapper.SetLookupTable(scale.table());
  mapper.UseLookupTableScalarRangeOn();
}

}  // namespace

vtkSmartPointer<vtkActor> plainActor(vtkPolyData& surface, const Color& color, bool shaded, double opacity) {
  const auto actor = makeActor(surface);
  paint(*actor, color, opacity);
  if (shaded) shade(*actor, surface, kPlainLight);
  return actor;
}

vtkSmartPointer<vtkActor> contourActor(vtkPolyData& surface, const ColorScale& scale, bool shaded) {
  const auto actor = makeActor(surface);
  colorBy(scale, *actor);
  if (shaded) shade(*actor, surface, kFieldLight);
  return actor;
}

vtkSmartPointer<vtkActor> shadowActor(vtkPolyData& surface) {
  const auto actor = makeActor(surface);
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetScalarModeToUsePointData();
  actor->GetMapper()->SetColorModeToDirectScalars();
  actor->ForceTranslucentOn();
  return actor;
}

vtkSmartPointer<vtkActor> lineActor(vtkPolyData& lines, const Color& color, double width, double opacity) {
  const auto actor = makeActor(lines, *vtkNew<StrokeMapper>());
  paint(*actor, color, opacity);
  stroke(*actor, width, opacity == 1.0 ? LineEnds::Round : LineEnds::Flat);
  return actor;
}

vtkSmartPointer<vtkActor> contourLineActor(vtkPolyData& lines, const ColorScale& scale, double width) {
  const auto actor = makeActor(lines, *vtkNew<StrokeMapper>());
  colorBy(scale, *actor);
  stroke(*actor, width, LineEnds::Joined);
  return actor;
}

vtkSmartPointer<vtkActor> dashedActor(vtkPolyData& lines, const Color& color, double width,
                                      const Dashes& dashes) {
  const auto actor = lineActor(lines, color, width, dashes.opacity);
  vtkOpenGLPolyDataMapper::SafeDownCast(actor->GetMapper())
      ->MapDataArrayToVertexAttribute("wayMC", kWayAlong, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  vtkShaderProperty& shaders = *actor->GetShaderProperty();
  shaders.AddVertexShaderReplacement(
      "//VTK::Normal::Dec", true, "//VTK::Normal::Dec\nin float wayMC;\nout float wayVCVSOutput;\n", false);
  shaders.AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true,
      fmt::format("//VTK::PositionVC::Impl\n  wayVCVSOutput = wayMC;\n"
                  "  gl_Position.z = 1e-4 * gl_Position.z - {:.4f} * gl_Position.w;\n",
                  0.999 + 3e-4 * dashes.number),
      false);
  shaders.AddGeometryShaderReplacement(
      "//VTK::Normal::Dec", true, "//VTK::Normal::Dec\nin float wayVCVSOutput[];\nout float wayVCGSOutput;\n",
      false);
  shaders.AddGeometryShaderReplacement("//VTK::Normal::Impl", true,
                                       "//VTK::Normal::Impl\n    wayVCGSOutput = wayVCVSOutput[i];\n", false);
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                       "//VTK::Normal::Dec\nin float wayVCGSOutput;\n", false);
  shaders.AddFragmentShaderReplacement(
      "//VTK::Color::Impl", true,
      fmt::format("//VTK::Color::Impl\n  if (mod(wayVCGSOutput, {:.4f}) > {:.4f}) discard;\n", dashes.length,
                  dashes.share * dashes.length),
      false);
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

namespace {

/// Between which distances from an eye things are seen.
std::array<double, 2> depthsOf(const Eye& eye, double distance) {
  constexpr double kNearest = 0.4;
  return {kNearest * eye.distance, eye.distance + distance};
}

/// Half of the height of a view at the plane of its picture.
double halfHeight(const View& view) {
  return view.area.height / (2.0 * view.pixelsPerLength);
}

void aimEye(vtkRenderer& renderer, const View& view, double distance) {
  const Eye& eye = *view.eye;
  const Eigen::Vector3d position = eye.position(view.axes),
                        focus = position - eye.distance * view.towardsEye();
  const Eigen::Vector2d aside = view.pixelsPerLength * (view.center - eye.at);
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOff();
  camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera.SetPosition(position.x(), position.y(), position.z());
  camera.SetViewUp(view.axes(1, 0), view.axes(1, 1), view.axes(1, 2));
  camera.SetViewAngle(vtkMath::DegreesFromRadians(2.0 * std::atan(halfHeight(view) / eye.distance)));
  camera.SetWindowCenter(2.0 * aside.x() / view.area.width, 2.0 * aside.y() / view.area.height);
  const auto [nearest, farthest] = depthsOf(eye, distance);
  camera.SetClippingRange(nearest, farthest);
}

/// Coordinate along the direction towards the eye that nothing in the renderer lies before.
double frontOf(vtkRenderer& renderer, const View& view) {
  std::array<double, 6> b{};
  renderer.ComputeVisiblePropBounds(b.data());
  if (!vtkMath::AreBoundsInitialized(b.data())) return 0.0;
  const Eigen::Vector3d low(b[0], b[2], b[4]), high(b[1], b[3], b[5]), sight = view.towardsEye();
  return sight.cwiseProduct(low).cwiseMax(sight.cwiseProduct(high)).sum();
}

}  // namespace

void lift(vtkActor& actor, const View& view, double length, double distance) {
  if (!view.eye) {
    const Eigen::Vector3d shift = length * view.towardsEye();
    actor.SetPosition(shift.x(), shift.y(), shift.z());
    return;
  }
  constexpr double kBeforeAll = 1.01;
  const auto [nearest, farthest] = depthsOf(*view.eye, distance);
  // Of a projection z = a w + b, where w is the distance along the line of sight.
  const double a = (farthest + nearest) / (farthest - nearest),
               b = -2.0 * farthest * nearest / (farthest - nearest);
  actor.GetShaderProperty()->AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true,
      fmt::format(
          "//VTK::PositionVC::Impl\n  float liftedW = max(gl_Position.w - ({:.8e}), {:.8e});\n"
          "  gl_Position = vec4(gl_Position.xy * (liftedW / gl_Position.w), {:.8e} * liftedW + ({:.8e}), "
          "liftedW);\n",
          length, kBeforeAll * nearest, a, b),
      false);
}

void aim(vtkRenderer& renderer, const View& view, const std::array<int, 2>& pictureSize, double distance) {
  renderer.SetViewport(view.area.x / pictureSize[0], view.area.y / pictureSize[1],
                       view.area.right() / pictureSize[0], view.area.top() / pictureSize[1]);
  if (view.eye) {
    aimEye(renderer, view, distance);
    return;
  }
  const Eigen::Vector3d focus =
      view.axes.transpose() * view.center + frontOf(renderer, view) * view.towardsEye();
  const Eigen::Vector3d eye = focus + distance * view.towardsEye();
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera.SetPosition(eye.x(), eye.y(), eye.z());
  camera.SetViewUp(view.axes(1, 0), view.axes(1, 1), view.axes(1, 2));
  camera.SetParallelScale(halfHeight(view));
  renderer.ResetCameraClippingRange();
}

}  // namespace burnish
