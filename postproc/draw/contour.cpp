#include "postproc/draw/contour.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkGeometryFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/color_range.h"
#include "postproc/draw/contour_arrows.h"
#include "postproc/draw/contour_layout.h"
#include "postproc/draw/contour_transparency.h"
#include "postproc/draw/contour_view.h"
#include "postproc/draw/field_choice.h"
#include "postproc/draw/flat_shapes.h"
#include "postproc/draw/overlay.h"
#include "postproc/draw/png_file.h"
#include "postproc/draw/scalar_bar.h"
#include "postproc/draw/space_actors.h"
#include "postproc/draw/tool_drawing.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

constexpr int kSmallestWidth = 200, kSmallestHeight = 150, kLargestSide = 8000;
constexpr double kSmallestText = 6.0, kLargestText = 200.0;

constexpr int kMostIsolines = 100;

constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// Longest arrow as a part of the diagonal of what is seen of the body.
constexpr double kArrowLength = 0.07;

/// A tool is shown whole if it reaches no further than this beyond the body (part of the body's diagonal),
/// else cut off at the smaller distance.
constexpr double kToolReach = 0.4, kToolCut = 0.2;

constexpr double kDotRoom = 0.005;  // for the dots of the control net, of the diagonal

/// Order in which things lie over each other in a 2D picture.
enum Layer { kToolFill, kBody, kIsolines, kKnots, kNet, kUndeformed, kBodyOutline, kToolLines, kArrows };

void checkOptions(const ContourOptions& options) {
  const auto [width, height] = options.size;
  if (width < kSmallestWidth || height < kSmallestHeight || std::max(width, height) > kLargestSide)
    throw Error(fmt::format("size: found {} x {} pixels; expected {} x {} to {} x {}", width, height,
                            kSmallestWidth, kSmallestHeight, kLargestSide, kLargestSide));
  if (options.textSize && !(*options.textSize >= kSmallestText && *options.textSize <= kLargestText))
    throw Error(fmt::format("text size: found {}; expected {} to {} pixels", *options.textSize, kSmallestText,
                            kLargestText));
  if (options.range && options.clip)
    throw Error("range and clip both say where the colours end; give one of them");
  if (options.isolines < 0 || options.isolines > kMostIsolines)
    throw Error(fmt::format("isolines: found {}; expected 0 to {}", options.isolines, kMostIsolines));
  if (!std::isfinite(options.warp))
    throw Error(fmt::format("warp: found {}; expected a number", options.warp));
  if (options.arrows == ArrowField::Traction && options.warp != 1.0)
    throw Error("contact tractions belong to the true displacements; draw them without a warp");
}

/// What decides on the shape of things in a frame, with displacements times `warp`.
FrameRecord shapeOf(const FrameRecord& frame, double warp) {
  FrameRecord shape;
  shape.displacement = warp * frame.displacement;
  shape.toolDisplacement = warp * frame.toolDisplacement;
  return shape;
}

Eigen::AlignedBox3d boxOf(vtkDataSet& data) {
  const double* b = data.GetBounds();
  return {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
}

void extendByPoints(Eigen::AlignedBox2d& box, vtkDataSet& data, const ViewAxes& axes) {
  for (vtkIdType k = 0; k < data.GetNumberOfPoints(); ++k)
    box.extend(Eigen::Vector2d(axes * Eigen::Map<const Eigen::Vector3d>(data.GetPoint(k))));
}

/// The notes that there are, in one line.
std::string joined(const std::vector<std::string>& notes) {
  std::string line;
  for (const std::string& note : notes)
    if (!note.empty()) line += (line.empty() ? "" : "; ") + note;
  return line;
}

/// Makes one picture, part by part.
class ContourPicture {
 public:
  ContourPicture(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options)
      : model_(model),
        frame_(frame),
        options_(options),
        shape_(shapeOf(frame, options.warp)),
        textSize_(options.textSize.value_or(options.theme.textSize * textSizeFor(options.size))),
        subdivision_(options.subdivision.value_or(model.subdivision)),
        tessellation_(model, subdivision_),
        field_(chooseField(model, frame, options.field)),
        values_(field_.values(tessellation_)),
        axes_(options.axes.value_or(viewNamed("auto", model.dim))) {
    if (!values_.allFinite())
      throw Error(fmt::format("field {} of frame {} holds values that are not finite; it cannot be drawn",
                              options.field, frame.index));
    makeBody();
    if (options.arrows != ArrowField::None)
      arrows_ = contourArrows(options.arrows, model, frame, *body_, axes_, arrowLength());
  }

  View draw(const std::filesystem::path& png) {
    const std::array<double, 2> whole{values_.minCoeff(), values_.maxCoeff()};
    const std::array<double, 2> shown =
        options_.range.value_or(valueRange(tessellation_, values_, options_.clip));
    const ColorScale scale(options_.colormap, options_.range ? shown : widened(shown), options_.bands);
    const ScalarBar bar(scale, {field_.title, field_.unit, whole[0], whole[1]}, textSize_, options_.theme);
    const ContourLayout layout =
        layOutContour(options_.size, textSize_, options_.window ? *options_.window : content(), axes_,
                      caption(options_.clip && shown != whole), bar, options_.theme);
    if (options_.transparent)
      writePng(*withoutPaper(*capture(kWhite, layout, bar, scale), *capture(kBlack, layout, bar, scale)),
               png);
    else
      writePng(*capture(options_.theme.paper, layout, bar, scale), png);
    return layout.view;
  }

  /// The projected box that is to be seen.
  Eigen::AlignedBox2d content() const {
    Eigen::AlignedBox2d box;
    extendByPoints(box, *body_, axes_);
    if (undeformed_) extendByPoints(box, *undeformed_, axes_);
    if (net_) {
      extendByPoints(box, *net_, axes_);
      const Eigen::Vector2d dot = Eigen::Vector2d::Constant(kDotRoom * box.diagonal().norm());
      box.extend(Eigen::Vector2d(box.min() - dot)).extend(Eigen::Vector2d(box.max() + dot));
    }
    if (arrows_.edges) extendByPoints(box, *arrows_.edges, axes_);
    const Eigen::AlignedBox2d bodyBox = box;
    const auto grown = [&](double part) {
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(part * bodyBox.diagonal().norm());
      return Eigen::AlignedBox2d(bodyBox.min() - margin, bodyBox.max() + margin);
    };
    for (std::size_t k = 0; k < numTools(); ++k) {
      Eigen::AlignedBox2d tool;
      const Eigen::Matrix3Xd landmarks = toolLandmarks(model_.tools[k], toolShift(k), boxOf(*body_));
      for (const auto& point : landmarks.colwise()) tool.extend(Eigen::Vector2d(axes_ * point));
      const Eigen::AlignedBox2d seen = grown(grown(kToolReach).contains(tool) ? kToolReach : kToolCut);
      if (seen.intersects(tool)) box.extend(seen.intersection(tool));
    }
    return box;
  }

 private:
  void makeBody() {
    const auto grid = makeGrid(tessellation_, shape_, true);
    grid->GetPointData()->SetScalars(makeArray("drawn", values_.transpose(), {}));
    if (options_.warp != 1.0)
      grid->GetPointData()->AddArray(
          makeArray("displacement", inSpace(tessellation_.evaluate(frame_.displacement)), kAxes));
    vtkNew<vtkGeometryFilter> surface;
    surface->SetInputData(grid);
    surface->Update();
    body_ = surface->GetOutput();
    outline_ = bodyOutline(model_, shape_.displacement, subdivision_);
    if (options_.undeformed) undeformed_ = bodyOutline(model_, {}, subdivision_);
    if (options_.controlNet) net_ = controlNet(model_, shape_);
  }

  /// Parts of what is seen, so that it is the same for a body and for a part of it.
  double arrowLength() const {
    Eigen::AlignedBox2d box;
    extendByPoints(box, *body_, axes_);
    if (options_.window && options_.window->intersects(box)) box = options_.window->intersection(box);
    return kArrowLength * box.diagonal().norm();
  }

  ContourCaption caption(bool clipped) const {
    return {options_.title.value_or(model_.title),
            options_.time ? fmt::format("t = {:.6g}", frame_.time) : "",
            joined({options_.warp == 1.0 ? "" : fmt::format("displacements × {:.6g}", options_.warp),
                    arrows_.note, options_.note, clipped ? clipNote(*options_.clip, model_.dim) : ""})};
  }

  std::size_t numTools() const { return options_.tools ? model_.tools.size() : 0; }

  Eigen::VectorXd toolShift(std::size_t tool) const {
    return shape_.toolDisplacement.col(static_cast<Eigen::Index>(tool));
  }

  vtkSmartPointer<vtkImageData> capture(const Color& background, const ContourLayout& layout,
                                        const ScalarBar& bar, const ColorScale& scale) const {
    OffscreenCanvas canvas(options_.size[0], options_.size[1]);
    vtkNew<vtkRenderer> paper, space;
    canvas.window().SetNumberOfLayers(2);
    canvas.window().AddRenderer(paper);
    canvas.window().AddRenderer(space);
    paper->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
    drawTexts(*paper, canvas.supersampling(), layout, bar);
    space->SetLayer(1);
    drawSpace(*space, canvas.supersampling(), layout.view, scale);
    return canvas.capture();
  }

  void drawTexts(vtkRenderer& renderer, int scale, const ContourLayout& layout, const ScalarBar& bar) const {
    Overlay overlay(renderer, scale);
    if (!layout.title.text.empty()) overlay.addText(layout.title.text, layout.titleAt, layout.title.style);
    if (!layout.time.text.empty()) overlay.addText(layout.time.text, layout.timeAt, layout.time.style);
    if (!layout.note.text.empty())
      overlay.addText(
          layout.note.text, layout.noteAt, layout.note.style,
          layout.barDirection == Overlay::Direction::Up ? Overlay::Anchor::End : Overlay::Anchor::Middle);
    FlatShapes shapes(renderer, scale);
    bar.draw(overlay, shapes, layout.bar, layout.barDirection);
    if (cutsBody()) drawFrame(shapes, layout.view.area);
  }

  /// Whether only a part of the body is seen.
  bool cutsBody() const {
    Eigen::AlignedBox2d box;
    extendByPoints(box, *body_, axes_);
    return options_.window && !options_.window->contains(box);
  }

  /// Round a part of the body, whose edges are not those of the body.
  void drawFrame(FlatShapes& shapes, const PixelRect& area) const {
    const double left = area.x - 0.5, right = area.right() + 0.5, low = area.y - 0.5, top = area.top() + 0.5;
    shapes.addPolyline({{left, low}, {right, low}, {right, top}, {left, top}, {left, low}},
                       std::max(1.0, textSize_ / 24.0), options_.theme.softInk);
  }

  void drawSpace(vtkRenderer& renderer, int scale, const View& view, const ColorScale& colors) const {
    const bool shaded = model_.dim == 3;
    const double line = scale * std::max(0.8, textSize_ / 16.0);
    const double depth = body_->GetLength() / (shaded ? 1000.0 : 100.0);
    const Eigen::Vector3d eye = view.towardsEye();
    const auto add = [&](vtkSmartPointer<vtkActor> actor, Layer layer) {
      const Eigen::Vector3d shift = static_cast<double>(layer) * depth * eye;
      actor->SetPosition(shift.x(), shift.y(), shift.z());
      renderer.AddActor(actor);
    };
    const Theme& theme = options_.theme;
    add(contourActor(*body_, colors, shaded), kBody);
    if (options_.isolines > 0)
      add(lineActor(*isolines(colors.range()), theme.outline, 0.7 * line, 1.0), kIsolines);
    if (options_.knots)
      add(lineActor(*knotLines(model_, shape_.displacement, subdivision_), theme.knots, 0.5 * line, 0.5),
          kKnots);
    if (net_) {
      add(lineActor(*net_, theme.controlNet, 0.6 * line, 1.0), kNet);
      add(pointActor(*net_, theme.controlNet, 4.0 * line), kNet);
    }
    if (undeformed_) add(lineActor(*undeformed_, theme.undeformed, 0.8 * line, 1.0), kUndeformed);
    add(lineActor(*outline_, theme.outline, line, 1.0), kBodyOutline);
    for (std::size_t k = 0; k < numTools(); ++k) {
      const ToolDrawing tool = drawTool(model_.tools[k], toolShift(k), model_.dim, visibleBox(view),
                                        textSize_ * 0.6 / view.pixelsPerLength);
      if (tool.surface)
        add(plainActor(*tool.surface, theme.tool, shaded, tool.hidesBody ? 0.4 : 1.0), kToolFill);
      if (tool.lines) add(lineActor(*tool.lines, theme.outline, 1.2 * line, 1.0), kToolLines);
    }
    if (arrows_.areas) drawArrows(renderer, line, eye);
    aim(renderer, view, options_.size, 10.0 * body_->GetLength());
  }

  /// In front of everything: white with a dark edge, which is seen on every colour.
  void drawArrows(vtkRenderer& renderer, double line, const Eigen::Vector3d& eye) const {
    const auto areas = plainActor(*arrows_.areas, kWhite, false, 1.0);
    const auto edges = lineActor(*arrows_.edges, kBlack, 0.5 * line, 1.0);
    double nearness = model_.dim == 2 ? static_cast<double>(kArrows) / 100.0 : 2.0;
    for (const auto& actor : {areas, edges}) {
      const Eigen::Vector3d shift = nearness * body_->GetLength() * eye;
      actor->SetPosition(shift.x(), shift.y(), shift.z());
      renderer.AddActor(actor);
      nearness += 0.005;
    }
  }

  vtkSmartPointer<vtkPolyData> isolines(const std::array<double, 2>& range) const {
    vtkNew<vtkContourFilter> filter;
    filter->SetInputData(body_);
    for (int k = 0; k < options_.isolines; ++k)
      filter->SetValue(k, std::lerp(range[0], range[1], (k + 1.0) / (options_.isolines + 1.0)));
    filter->Update();
    return filter->GetOutput();
  }

  /// A box that covers all that is seen.
  Eigen::AlignedBox3d visibleBox(const View& view) const {
    if (model_.dim == 3) {
      Eigen::AlignedBox3d box = boxOf(*body_);
      const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kToolCut * box.diagonal().norm());
      return {box.min() - margin, box.max() + margin};
    }
    const Eigen::Vector2d half =
        Eigen::Vector2d(view.area.width, view.area.height) / (2.0 * view.pixelsPerLength);
    Eigen::Vector3d low(0, 0, 0), high(0, 0, 0);
    low.head<2>() = view.center - half;
    high.head<2>() = view.center + half;
    return {low, high};
  }

  const ModelRecord& model_;
  const FrameRecord& frame_;
  const ContourOptions& options_;
  FrameRecord shape_;
  double textSize_;
  int subdivision_;
  Tessellation tessellation_;
  FieldChoice field_;
  Eigen::VectorXd values_;
  ViewAxes axes_;
  vtkSmartPointer<vtkPolyData> body_, outline_, undeformed_, net_;
  ContourArrows arrows_;
};

}  // namespace

View drawContour(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                 const std::filesystem::path& png) {
  checkOptions(options);
  return ContourPicture(model, frame, options).draw(png);
}

Eigen::AlignedBox2d contentOf(const ModelRecord& model, const FrameRecord& frame,
                              const ContourOptions& options) {
  return ContourPicture(model, frame, options).content();
}

}  // namespace burnish
