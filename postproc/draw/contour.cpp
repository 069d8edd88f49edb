#include "postproc/draw/contour.h"

#include <fmt/format.h>
#include <vtkActor.h>
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

#include "engine/core/error.h"
#include "postproc/draw/color_range.h"
#include "postproc/draw/contour_layout.h"
#include "postproc/draw/field_choice.h"
#include "postproc/draw/flat_shapes.h"
#include "postproc/draw/overlay.h"
#include "postproc/draw/png_file.h"
#include "postproc/draw/scalar_bar.h"
#include "postproc/draw/space_actors.h"
#include "postproc/draw/tool_drawing.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

constexpr int kSmallestWidth = 200, kSmallestHeight = 150, kLargestSide = 8000;
constexpr double kSmallestText = 6.0, kLargestText = 200.0;

constexpr Color kOutlineColor{25, 25, 25};
constexpr Color kUndeformedColor{150, 150, 150};
constexpr Color kKnotColor{255, 255, 255};
constexpr Color kToolColor{222, 222, 222};

/// A tool is shown whole if it reaches no further than this beyond the body (part of the body's diagonal),
/// else cut off at the smaller distance.
constexpr double kToolReach = 0.4, kToolCut = 0.2;

/// Order in which things lie over each other in a 2D picture.
enum Layer { kToolFill, kBody, kKnots, kUndeformed, kBodyOutline, kToolLines };

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
}

/// Right and up of the picture: the plane itself, or from the front, the right and above.
Eigen::Matrix<double, 2, 3> viewAxes(int dim) {
  Eigen::Matrix<double, 2, 3> axes = Eigen::Matrix<double, 2, 3>::Identity();
  if (dim == 2) return axes;
  const Eigen::Vector3d towardsEye = Eigen::Vector3d(0.5, 0.45, 1.0).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(towardsEye).normalized();
  axes << right.transpose(), towardsEye.cross(right).transpose();
  return axes;
}

Eigen::AlignedBox3d boxOf(vtkDataSet& data) {
  const double* b = data.GetBounds();
  return {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
}

void extendByPoints(Eigen::AlignedBox2d& box, vtkDataSet& data, const Eigen::Matrix<double, 2, 3>& axes) {
  for (vtkIdType k = 0; k < data.GetNumberOfPoints(); ++k)
    box.extend(Eigen::Vector2d(axes * Eigen::Map<const Eigen::Vector3d>(data.GetPoint(k))));
}

/// Makes one picture, part by part.
class ContourPicture {
 public:
  ContourPicture(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options)
      : model_(model),
        frame_(frame),
        options_(options),
        textSize_(options.textSize.value_or(textSizeFor(options.size))),
        subdivision_(options.subdivision.value_or(model.subdivision)),
        tessellation_(model, subdivision_),
        field_(chooseField(model, frame, options.field)),
        values_(field_.values(tessellation_)),
        axes_(viewAxes(model.dim)) {
    if (!values_.allFinite())
      throw Error(fmt::format("field {} of frame {} holds values that are not finite; it cannot be drawn",
                              options.field, frame.index));
    makeBody();
  }

  View draw(const std::filesystem::path& png) {
    const std::array<double, 2> whole{values_.minCoeff(), values_.maxCoeff()};
    const std::array<double, 2> shown =
        options_.range.value_or(valueRange(tessellation_, values_, options_.clip));
    const ColorScale scale(options_.colormap, options_.range ? shown : widened(shown), options_.bands);
    const ScalarBar bar(scale, {field_.title, field_.unit, whole[0], whole[1]}, textSize_);
    const bool clipped = options_.clip && shown != whole;
    const ContourCaption caption{options_.title.value_or(model_.title),
                                 options_.time ? fmt::format("t = {:.6g}", frame_.time) : "",
                                 clipped ? clipNote(*options_.clip, model_.dim) : ""};
    const ContourLayout layout =
        layOutContour(options_.size, textSize_, options_.window ? *options_.window : content(), axes_, caption, bar);

    OffscreenCanvas canvas(options_.size[0], options_.size[1]);
    vtkNew<vtkRenderer> paper, space;
    canvas.window().SetNumberOfLayers(2);
    canvas.window().AddRenderer(paper);
    canvas.window().AddRenderer(space);
    paper->SetBackground(1.0, 1.0, 1.0);
    drawTexts(*paper, canvas.supersampling(), layout, bar);
    space->SetLayer(1);
    drawSpace(*space, canvas.supersampling(), layout.view, scale);
    writePng(*canvas.capture(), png);
    return layout.view;
  }

  /// The projected box that is to be seen.
  Eigen::AlignedBox2d content() const {
    Eigen::AlignedBox2d box;
    extendByPoints(box, *body_, axes_);
    if (undeformed_) extendByPoints(box, *undeformed_, axes_);
    const Eigen::AlignedBox2d bodyBox = box;
    const auto grown = [&](double part) {
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(part * bodyBox.diagonal().norm());
      return Eigen::AlignedBox2d(bodyBox.min() - margin, bodyBox.max() + margin);
    };
    for (std::size_t k = 0; k < model_.tools.size(); ++k) {
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
    const auto grid = makeGrid(tessellation_, frame_, true);
    const auto scalars = makeArray("drawn", values_.transpose(), {});
    grid->GetPointData()->SetScalars(scalars);
    vtkNew<vtkGeometryFilter> surface;
    surface->SetInputData(grid);
    surface->Update();
    body_ = surface->GetOutput();
    outline_ = bodyOutline(model_, frame_.displacement, subdivision_);
    if (options_.undeformed) undeformed_ = bodyOutline(model_, {}, subdivision_);
  }

  Eigen::VectorXd toolShift(std::size_t tool) const {
    return frame_.toolDisplacement.col(static_cast<Eigen::Index>(tool));
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
    add(contourActor(*body_, colors, shaded), kBody);
    if (options_.knots)
      add(lineActor(*knotLines(model_, frame_.displacement, subdivision_), kKnotColor, 0.5 * line, 0.5),
          kKnots);
    if (undeformed_) add(lineActor(*undeformed_, kUndeformedColor, 0.8 * line, 1.0), kUndeformed);
    add(lineActor(*outline_, kOutlineColor, line, 1.0), kBodyOutline);
    for (std::size_t k = 0; k < model_.tools.size(); ++k) {
      const ToolDrawing tool = drawTool(model_.tools[k], toolShift(k), model_.dim, visibleBox(view),
                                        textSize_ * 0.6 / view.pixelsPerLength);
      if (tool.surface)
        add(plainActor(*tool.surface, kToolColor, shaded, tool.hidesBody ? 0.4 : 1.0), kToolFill);
      if (tool.lines) add(lineActor(*tool.lines, kOutlineColor, 1.2 * line, 1.0), kToolLines);
    }
    aim(renderer, view, options_.size, 10.0 * body_->GetLength());
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
  double textSize_;
  int subdivision_;
  Tessellation tessellation_;
  FieldChoice field_;
  Eigen::VectorXd values_;
  Eigen::Matrix<double, 2, 3> axes_;
  vtkSmartPointer<vtkPolyData> body_, outline_, undeformed_;
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
