#include "postproc/draw/setup/setup_figure.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/draw/contour/page_lines.h"
#include "postproc/draw/contour/space_actors.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/draw/page/painted_sketch.h"
#include "postproc/draw/page/picture_size.h"
#include "postproc/draw/page/png_file.h"
#include "postproc/draw/setup/setup_layout.h"
#include "postproc/draw/setup/setup_loads.h"
#include "postproc/draw/setup/setup_motion.h"
#include "postproc/draw/setup/setup_symbols.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

using Eigen::Vector2d;
using Points = SetupSymbols::Points;

constexpr Color kBodyColor{226, 226, 226}, kToolColor{248, 248, 248}, kKnotColor{190, 190, 190};

/// Digits of a load that is not the same everywhere on its face.
constexpr int kDigitsInMiddle = 3;

bool isUpright(const Vector2d& v) {
  return std::abs(v.y()) >= std::abs(v.x());
}

class SetupPicture {
 public:
  SetupPicture(const ModelRecord& model, const std::array<int, 2>& size, bool knots)
      : model_(model),
        size_(size),
        knots_(knots),
        layout_(model, size),
        body_(BodySurface(model.mesh, layout_.subdivision()).displaced({})) {}

  void draw(const std::filesystem::path& png) {
    OffscreenCanvas canvas(size_[0], size_[1]);
    vtkNew<vtkRenderer> space;
    canvas.window().AddRenderer(space);
    space->SetBackground(1.0, 1.0, 1.0);
    int layer = 0;
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor) {
      actor->SetPosition(0.0, 0.0, body_->GetLength() / 100.0 * ++layer);
      space->AddActor(actor);
    };
    forEachPart([&](vtkPolyData& area, const Color& color) { add(plainActor(area, color, false, 1.0)); },
                [&](vtkPolyData& lines, const Color& color, double width) {
                  add(lineActor(lines, color, canvas.supersampling() * width, 1.0));
                });
    aim(*space, view(), size_, 10.0 * body_->GetLength());
    paint(texts(), *space, canvas.supersampling());
    writePng(*canvas.capture(), png);
  }

  PrintPage page() {
    PrintPage page{{static_cast<double>(size_[0]), static_cast<double>(size_[1])}, model_.title, {}};
    std::vector<PageSketch::Shape>& shapes = page.sketch.shapes;
    forEachPart(
        [&](vtkPolyData& area, const Color& color) { shapes.emplace_back(pageRegion(area, view(), color)); },
        [&](vtkPolyData& lines, const Color& color, double width) {
          shapes.emplace_back(pageLines(lines, view(), color, width, 1.0));
        });
    for (PageSketch::Shape& shape : texts().shapes) shapes.push_back(std::move(shape));
    return page;
  }

 private:
  const Scene& scene() const { return layout_.scene(); }
  const View& view() const { return layout_.view(); }
  double textSize() const { return layout_.textSize(); }

  /// Symbols and texts.
  PageSketch texts() const {
    PageSketch sketch;
    SetupSymbols symbols(sketch, size_, layout_.textSize());
    if (const auto axis = layout_.axis()) symbols.addAxisLine((*axis)[0], (*axis)[1], "axis");
    drawMeasures(symbols);
    for (const SupportSpec& support : scene().supports) drawSupport(symbols, support);
    for (const LoadSpec& load : scene().loads) drawLoad(symbols, load);
    for (std::size_t k = 0; k < scene().tools.size(); ++k) drawToolTexts(symbols, k);
    drawMotions(symbols);
    return sketch;
  }

  /// Body and tools from the back to the front, as areas of a colour and lines of a colour and a width in pixels.
  template <class Area, class Lines>
  void forEachPart(const Area& area, const Lines& lines) const {
    const double line = std::max(1.2, 0.075 * textSize());
    area(*body_, kBodyColor);
    if (knots_) lines(*knotLines(model_.mesh, {}, layout_.subdivision()), kKnotColor, 0.5 * line);
    lines(*outlineBesideAxis(), SetupSymbols::kInk, line);
    for (const ToolRecord& record : layout_.tools()) {
      const ToolDrawing drawing =
          drawPlaneTool(record, layout_.toolBox(), 0.55 * textSize() / view().pixelsPerLength);
      if (drawing.area) area(*drawing.area, kToolColor);
      if (drawing.lines) lines(*drawing.lines, SetupSymbols::kInk, line);
    }
  }

  /// Half of a section ends at the axis, but the body does not.
  vtkSmartPointer<vtkPolyData> outlineBesideAxis() const {
    const auto outline = bodyOutline(model_.mesh, {}, layout_.subdivision());
    for (vtkIdType k = 0; k < outline->GetNumberOfCells(); ++k) {
      const double* b = outline->GetCell(k)->GetBounds();
      if (layout_.isOnAxis({{b[0], b[2]}, {b[1], b[3]}})) outline->DeleteCell(k);
    }
    outline->RemoveDeletedCells();
    return outline;
  }

  void drawMeasures(SetupSymbols& symbols) const {
    const Eigen::AlignedBox3d& box = layout_.box();
    const Vector2d low = view().pixel(box.min().head<2>()), high = view().pixel(box.max().head<2>());
    const Eigen::Vector3d extent = box.sizes();
    symbols.addDimension(low, {high.x(), low.y()}, layout_.belowBody(), layout_.length(extent.x()));
    symbols.addDimension(low, {low.x(), high.y()}, layout_.besideBody(), layout_.length(extent.y()));
    if (const auto axis = layout_.axis(); axis && low.x() - (*axis)[0].x() > textSize())
      symbols.addDimension({(*axis)[0].x(), low.y()}, low, layout_.belowBody(),
                           layout_.length(box.min().x()));
    symbols.addAxes({0.9 * textSize(), 0.9 * textSize()});
  }

  void drawSupport(SetupSymbols& symbols, const SupportSpec& support) const {
    if (layout_.isOnAxis(layout_.faces().line(support.place).points)) return;
    const FaceLine face = layout_.pixels(support.place);
    const Vector2d normal = face.meanNormal();
    const std::string across = isUpright(normal) ? "y" : "x";
    if (support.symmetry || (support.fix.size() == 1 && support.fix.front() == across))
      symbols.addRollers(face.points, face.outward);
    else
      symbols.addHatching(face.points, face.outward);
    if (support.fix.size() != 1 || support.fix.front() == across) return;
    symbols.addText({{"u"}, {support.fix.front(), Script::Sub}, {" = 0"}},
                    face.middle + 1.5 * textSize() * normal);
  }

  void drawLoad(SetupSymbols& symbols, const LoadSpec& load) const {
    if (!load.bodyForce.empty()) return drawBodyForce(symbols, load);
    const FaceLine face = layout_.pixels(load.place);
    const FaceLoad found = faceLoad(load, layout_.faces().line(load.place), scene(), layout_.endTime());
    const std::string label =
        found.varies ? "≈ " + SetupLayout::number(found.middle, model_.stressUnit, kDigitsInMiddle)
                     : SetupLayout::number(found.middle, model_.stressUnit);
    symbols.addLoad(face.points, face.outward, found.vectors, label);
  }

  void drawBodyForce(SetupSymbols& symbols, const LoadSpec& load) const {
    const Vector2d middle = layout_.faces().middleOf(load.place);
    const Vector2d force = bodyForceAt(load, middle, scene(), layout_.endTime());
    if (force.norm() == 0.0) return;
    const bool hasUnits = !model_.stressUnit.empty() && !model_.lengthUnit.empty();
    const std::string unit = hasUnits ? model_.stressUnit + "/" + model_.lengthUnit : "";
    symbols.addForce(view().pixel(middle), force.normalized(), SetupLayout::number(force.norm(), unit));
  }

  void drawToolTexts(SetupSymbols& symbols, std::size_t k) const {
    const Vector2d end = layout_.endOf(k);
    if (end.norm() > 0.0)
      for (const Points& line : layout_.toolPixels(k, end)) symbols.addDashes(line);
    nameTool(symbols, k);
    drawTurn(symbols, k);
    if (scene().tools[k].carry) drawCarried(symbols, k);
  }

  void nameTool(SetupSymbols& symbols, std::size_t k) const {
    const ToolRecord& tool = layout_.tools()[k];
    const Vector2d center = layout_.middleOf(k);
    if (const auto normal = planeNormal(tool.shape)) {
      const Points line = layout_.toolPixels(k, Vector2d(0, 0)).front();
      const Vector2d away = -normal->head<2>().normalized();
      symbols.addText({{tool.name}},
                      line.front() + 0.15 * (line.back() - line.front()) + 1.3 * textSize() * away);
    } else if (const auto disc = discOf(tool.shape)) {
      const Vector2d direction =
          Vector2d(center.x() < view().area.center().x() ? 1.0 : -1.0, 1.0).normalized();
      symbols.addRadius(center, center + disc->radius * view().pixelsPerLength * direction,
                        "R = " + layout_.length(disc->radius));
    } else if (const SurfaceMesh* open = openMesh(tool.shape)) {
      if (open->cells.size() > 0) nameOpenTool(symbols, tool.name, *open);
    } else if (recordedMesh(tool.shape)) {
      symbols.addText({{tool.name}}, center + Vector2d(0.0, 0.9 * textSize()));
    }
  }

  /// On the side of the tool, at a quarter of its longest segment.
  void nameOpenTool(SetupSymbols& symbols, const std::string& name, const SurfaceMesh& mesh) const {
    Vector2d at(0.0, 0.0), along(0.0, 0.0);
    for (const auto& cell : mesh.cells.colwise()) {
      const Vector2d begin = view().pixel(mesh.points.col(cell(0))),
                     end = view().pixel(mesh.points.col(cell(1)));
      if ((end - begin).norm() <= along.norm()) continue;
      along = end - begin;
      at = (begin.x() < end.x() ? begin : end) + (begin.x() < end.x() ? 0.25 : -0.25) * along;
    }
    const Vector2d side = Vector2d(-along.y(), along.x()).normalized();
    const double half = textWidth({{name}}, {.size = textSize()}) / 2.0;
    symbols.addText({{name}}, at + (1.4 * textSize() + std::abs(side.x()) * half) * side);
  }

  void drawTurn(SetupSymbols& symbols, std::size_t k) const {
    const double turn = turnOf(scene().tools[k], scene().definitions, layout_.endTime(k));
    if (turn != 0.0)
      symbols.addTurn(view().pixel(layout_.tools()[k].pivot), turnRadius(k), turn > 0.0,
                      "φ = " + numberText(std::abs(turn), 4) + "°");
  }

  /// Just inside a disc, and small for what has no radius.
  double turnRadius(std::size_t k) const {
    const auto disc = discOf(layout_.tools()[k].shape);
    return disc ? 0.8 * disc->radius * view().pixelsPerLength : 2.0 * textSize();
  }

  void drawCarried(SetupSymbols& symbols, std::size_t k) const {
    const DrawnToolLoad load = layout_.carriedBy(k);
    const Vector2d middle = layout_.middleOf(k);
    if (load.force.norm() > 0.0)
      symbols.addForceTo(middle, load.force.normalized(), layout_.forceText(load.force.norm()));
    if (load.moment != 0.0)
      symbols.addTurn(view().pixel(layout_.tools()[k].pivot), turnRadius(k), load.moment > 0.0,
                      layout_.momentText(std::abs(load.moment)));
  }

  /// The amounts stand below the picture.
  void drawMotions(SetupSymbols& symbols) const {
    const std::vector<Mover> movers = layout_.movers();
    for (const Mover& mover : movers) drawArrows(symbols, mover);
    const std::vector<RichText> lines = layout_.amounts();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double lift = 1.8 * textSize() * static_cast<double>(lines.size() - 1 - k);
      symbols.addText(lines[k], layout_.amountsAt(lines[k]) + Vector2d(0.0, lift));
    }
    // Only the amounts of several name patches.
    const bool named =
        std::count_if(movers.begin(), movers.end(), [](const Mover& m) { return !m.differs; }) > 1;
    for (const SetupFaces::Label& label : layout_.faces().labels(named))
      symbols.addFaintText(label.text, view().pixel(label.at));
  }

  /// One behind the other; those that go along earlier ones, as that of a tool which is lifted again, stand beside them.
  void drawArrows(SetupSymbols& symbols, const Mover& mover) const {
    constexpr double kApart = 0.8,
                     kPastName = 2.0;  // from an arrow to the next one, and past its name, in text sizes
    struct Drawn {
      Vector2d tail, direction, beside;
      double length;
    };
    std::vector<Drawn> before;
    Vector2d at = mover.start;
    for (std::size_t k = 0; k < mover.phases.size(); ++k) {
      const Vector2d direction = mover.phases[k].normalized();
      const double toScale = mover.toScale ? mover.phases[k].norm() * view().pixelsPerLength : 0.0;
      const double drawn = std::max(SetupSymbols::kShortestMotion * textSize(), toScale);
      const auto isAlong = [&](const Drawn& other) {
        const Vector2d across(-other.direction.y(), other.direction.x()), from = at - other.tail;
        const double begin = from.dot(other.direction), end = begin + drawn * direction.dot(other.direction);
        return std::abs(across.dot(direction)) < 0.1 && std::abs(across.dot(from)) < 0.5 * textSize() &&
               std::max(begin, end) > 0.2 * textSize() &&
               std::min(begin, end) < other.length - 0.2 * textSize();
      };
      const auto number = std::count_if(before.begin(), before.end(), isAlong);
      const auto first = std::find_if(before.begin(), before.end(), isAlong);
      Vector2d beside = besideArrow(direction, at + 0.5 * drawn * direction), shift(0.0, 0.0);
      if (number > 0) {
        beside = -first->beside;
        shift = textSize() * (kApart + kPastName * static_cast<double>(number - 1)) * beside.normalized();
      }
      symbols.addArrow(at + shift, at + shift + drawn * direction);
      symbols.addText(SetupLayout::phaseName(mover.phases.size(), k),
                      at + shift + 0.5 * drawn * direction + textSize() * beside);
      before.push_back({at, direction, beside, drawn});
      at += drawn * direction;
    }
  }

  /// From an arrow to its name, in text sizes: away from the body, or above and left where that is neither.
  Vector2d besideArrow(const Vector2d& direction, const Vector2d& middle) const {
    Vector2d beside(-direction.y(), direction.x());
    if (beside.y() < -0.5 || (beside.y() < 0.5 && beside.x() > 0.0)) beside = -beside;
    const Vector2d fromBody = middle - view().pixel(layout_.box().center().head<2>());
    if (fromBody.dot(beside) < -textSize()) beside = -beside;
    return beside.cwiseProduct(Vector2d(0.9, 0.8));
  }

  const ModelRecord& model_;
  std::array<int, 2> size_;
  bool knots_;
  SetupLayout layout_;
  vtkSmartPointer<vtkPolyData> body_;
};

void checkSetup(const ModelRecord& model, const std::array<int, 2>& size) {
  if (model.dim != 2)
    throw Error(fmt::format("set-up drawing: found a model in {} dimensions; expected 2", model.dim));
  if (!isPictureSize(size))
    throw Error(fmt::format("size: found {} x {} pixels; expected {}", size[0], size[1], pictureSizeWords()));
}

}  // namespace

void drawSetup(const ModelRecord& model, const std::array<int, 2>& size, const std::filesystem::path& png,
               bool knots) {
  checkSetup(model, size);
  SetupPicture(model, size, knots).draw(png);
}

PrintPage setupPage(const ModelRecord& model, const std::array<int, 2>& size, bool knots) {
  checkSetup(model, size);
  return SetupPicture(model, size, knots).page();
}

}  // namespace burnish
