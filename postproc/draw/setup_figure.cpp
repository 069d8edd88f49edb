#include "postproc/draw/setup_figure.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkGeometryFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/error.h"
#include "engine/scene/reader.h"
#include "postproc/draw/png_file.h"
#include "postproc/draw/setup_motion.h"
#include "postproc/draw/setup_symbols.h"
#include "postproc/draw/sheet.h"
#include "postproc/draw/space_actors.h"
#include "postproc/draw/ticks.h"
#include "postproc/draw/tool_drawing.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

using Eigen::Vector2d;
using Points = SetupSymbols::Points;

constexpr int kSmallestSide = 200, kLargestSide = 8000;
constexpr Color kBodyColor{226, 226, 226}, kToolColor{248, 248, 248}, kInk{20, 20, 20},
    kKnotColor{190, 190, 190};
constexpr int kDigits = 6;

// Measures as parts of the text size.
constexpr double kMargin = 0.5;
constexpr double kShortestArrow = 2.2;
constexpr double kAxesRoom = 4.2;
constexpr double kTextLine = 1.8;
constexpr double kBeforeArrow = 1.3;  // from a plane or a face to the tip of its arrow

/// A tool is shown as far as it reaches beyond the body, in parts of the body's diagonal.
constexpr double kToolReach = 0.8;

/// A face in model coordinates: points along it and the outward unit normals there.
struct FaceLine {
  Points points, outward;

  Vector2d meanNormal() const {
    return std::accumulate(outward.begin(), outward.end(), Vector2d(0, 0)).normalized();
  }
};

FaceLine faceLine(const Patch<2>& patch, const std::string& face, int subdivision) {
  const FaceId id = faceFromName<2>(face);
  const int fixed = id / 2, along = 1 - fixed;
  const auto& across = patch.basis().direction(fixed).breakpoints();
  FaceLine line;
  Patch<2>::Parameter xi;
  xi(fixed) = id % 2 == 0 ? across.front() : across.back();
  for (const double parameter : subdividedSpans(patch.basis().direction(along), subdivision)) {
    xi(along) = parameter;
    const Eigen::Matrix2d jacobian = patch.jacobian(xi);
    const Vector2d tangent = jacobian.col(along).normalized();
    const Vector2d out = (id % 2 == 0 ? -1.0 : 1.0) * jacobian.col(fixed);
    line.points.push_back(patch.position(xi));
    line.outward.push_back((out - out.dot(tangent) * tangent).normalized());
  }
  return line;
}

Eigen::AlignedBox2d flat(const Eigen::AlignedBox3d& box) {
  return {box.min().head<2>(), box.max().head<2>()};
}

/// Room beside the body in text sizes, on the side to which a normal points.
struct Rooms {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;

  double& at(const Vector2d& normal) {
    if (std::abs(normal.x()) > std::abs(normal.y())) return normal.x() < 0 ? left : right;
    return normal.y() < 0 ? bottom : top;
  }
};

/// What moves, from where, and how.
struct Mover {
  std::string name;
  Vector2d start;  ///< of the arrows, in pixels
  std::vector<Vector2d> phases;
  bool toScale;  ///< the arrows are as long as the phases, if that is long enough
};

class SetupPicture {
 public:
  SetupPicture(const ModelRecord& model, const std::array<int, 2>& size, bool knots)
      : model_(model),
        scene_(parseScene(model.sceneYaml, "the scene of the result")),
        patch_(patchGeometry<2>(model.patches.front())),
        size_(size),
        knots_(knots),
        textSize_(sheetTextSize(size[0])) {
    FrameRecord rest;
    rest.displacement = Eigen::MatrixXd::Zero(2, model.numNodes);
    vtkNew<vtkGeometryFilter> surface;
    surface->SetInputData(makeGrid(Tessellation(model, model.subdivision), rest, false));
    surface->Update();
    body_ = surface->GetOutput();
    const double* b = body_->GetBounds();
    box_ = {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
    const Eigen::Vector3d half(box_.sizes().maxCoeff() / 2, 0.0, 0.0);
    toolBox_ = {box_.center() - half, box_.center() + half};
    end_ = scene_.steps.empty() ? 0.0 : scene_.steps.back().until;
    layOut();
  }

  void draw(const std::filesystem::path& png) {
    OffscreenCanvas canvas(size_[0], size_[1]);
    vtkNew<vtkRenderer> space;
    canvas.window().AddRenderer(space);
    space->SetBackground(1.0, 1.0, 1.0);
    drawSpace(*space, canvas.supersampling());
    SetupSymbols symbols(*space, canvas.supersampling(), textSize_);
    drawMeasures(symbols);
    for (const SupportSpec& support : scene_.supports) drawSupport(symbols, support);
    for (const LoadSpec& load : scene_.loads) drawLoad(symbols, load);
    for (std::size_t k = 0; k < scene_.tools.size(); ++k) drawToolTexts(symbols, k);
    drawMotions(symbols);
    writePng(*canvas.capture(), png);
  }

 private:
  std::string number(double value, const std::string& unit) const {
    std::string text = numberText(value, kDigits);
    if (text.size() == 1) text += ".0";
    return unit.empty() ? text : text + " " + unit;
  }
  std::string length(double value) const { return number(value, model_.lengthUnit); }

  const ToolRecord& tool(std::size_t k) const { return model_.tools[k]; }

  /// What is to be seen of a tool: all that is not far away.
  Eigen::AlignedBox2d toolBounds(std::size_t k, const Vector2d& shift) const {
    const double* b = toolOutline(tool(k), shift, toolBox_)->GetBounds();
    const Vector2d margin = Vector2d::Constant(kToolReach * box_.diagonal().norm());
    const Eigen::AlignedBox2d body = flat(box_), seen(body.min() - margin, body.max() + margin);
    return seen.intersection(Eigen::AlignedBox2d(Vector2d(b[0], b[2]), Vector2d(b[1], b[3])));
  }

  std::vector<Vector2d> phasesOf(std::size_t k) const {
    const auto& motion = scene_.tools[k].motion;
    return motion ? motionPhases(*motion, end_) : std::vector<Vector2d>();
  }

  Vector2d endOf(std::size_t k) const {
    const auto phases = phasesOf(k);
    return std::accumulate(phases.begin(), phases.end(), Vector2d(0, 0));
  }

  void layOut() {
    Eigen::AlignedBox2d content = flat(box_);
    for (std::size_t k = 0; k < model_.tools.size(); ++k) {
      for (const Vector2d& shift : {Vector2d(0, 0), endOf(k)}) content.extend(toolBounds(k, shift));
      if (const auto* plane = std::get_if<Plane>(&tool(k).shape); plane && !phasesOf(k).empty())
        rooms_.at(-plane->normal.head<2>()) += SetupSymbols::kLoadDepth;
    }
    for (const SupportSpec& support : scene_.supports)
      rooms_.at(normalOf(support.place.face)) +=
          SetupSymbols::kSupportDepth + (support.move ? SetupSymbols::kLoadDepth : 0.0);
    for (const LoadSpec& load : scene_.loads)
      rooms_.at(normalOf(load.place.face)) += SetupSymbols::kLoadDepth;

    const double left = rooms_.left + SetupSymbols::kDimensionDepth, right = rooms_.right + kMargin;
    const double lines = movers().empty() ? 0.0 : kTextLine;
    const double bottom = std::max(rooms_.bottom + SetupSymbols::kDimensionDepth + lines, kAxesRoom);
    const double top = rooms_.top + kMargin;
    const double width = size_[0] - textSize_ * (left + right),
                 height = size_[1] - textSize_ * (bottom + top);
    const Vector2d extent = content.sizes();
    view_.pixelsPerLength = std::min(width / extent.x(), height / extent.y());
    if (!(view_.pixelsPerLength > 0.0))
      throw Error(
          fmt::format("size: {} x {} pixels leave no room for the body beside supports, loads and "
                      "measures; take a larger height",
                      size_[0], size_[1]));
    view_.area = {0.0, 0.0, static_cast<double>(size_[0]), static_cast<double>(size_[1])};
    const Vector2d shift = textSize_ / 2 * Vector2d(left - right, bottom - top);
    view_.center = content.center() - shift / view_.pixelsPerLength;
  }

  Vector2d normalOf(const std::string& face) const {
    return faceLine(patch_, face, model_.subdivision).meanNormal();
  }

  FaceLine pixels(FaceLine line) const {
    for (Vector2d& point : line.points) point = view_.pixel(point);
    return line;
  }

  void drawSpace(vtkRenderer& renderer, int scale) const {
    const double line = scale * std::max(1.2, 0.075 * textSize_), depth = body_->GetLength() / 100.0;
    int layer = 0;
    const auto add = [&](const vtkSmartPointer<vtkActor>& actor) {
      actor->SetPosition(0.0, 0.0, depth * ++layer);
      renderer.AddActor(actor);
    };
    add(plainActor(*body_, kBodyColor, false, 1.0));
    if (knots_) add(lineActor(*knotLines(model_, {}, model_.subdivision), kKnotColor, 0.5 * line, 1.0));
    add(lineActor(*bodyOutline(model_, {}, model_.subdivision), kInk, line, 1.0));
    for (const ToolRecord& record : model_.tools) {
      const ToolDrawing drawing =
          drawTool(record, Vector2d(0, 0), 2, toolBox_, 0.55 * textSize_ / view_.pixelsPerLength);
      if (drawing.surface) add(plainActor(*drawing.surface, kToolColor, false, 1.0));
      if (drawing.lines) add(lineActor(*drawing.lines, kInk, line, 1.0));
    }
    aim(renderer, view_, size_, 10.0 * body_->GetLength());
  }

  void drawMeasures(SetupSymbols& symbols) const {
    const double size = textSize_, line = 0.85 * SetupSymbols::kDimensionDepth;
    const Vector2d low = view_.pixel(box_.min().head<2>()), high = view_.pixel(box_.max().head<2>());
    const Vector2d extent = flat(box_).sizes();
    symbols.addDimension(low, {high.x(), low.y()}, {0.0, -size * (rooms_.bottom + line)}, length(extent.x()));
    symbols.addDimension(low, {low.x(), high.y()}, {-size * (rooms_.left + 0.5 * line), 0.0},
                         length(extent.y()));
    symbols.addAxes({0.9 * size, 0.9 * size});
  }

  void drawSupport(SetupSymbols& symbols, const SupportSpec& support) const {
    const FaceLine face = pixels(faceLine(patch_, support.place.face, model_.subdivision));
    const Vector2d normal = face.meanNormal();
    const std::string across = std::abs(normal.x()) > std::abs(normal.y()) ? "x" : "y";
    if (support.symmetry || (support.fix.size() == 1 && support.fix.front() == across))
      symbols.addRollers(face.points, face.outward);
    else
      symbols.addHatching(face.points, face.outward);
    if (support.fix.size() != 1 || support.fix.front() == across) return;
    const Vector2d middle = face.points[face.points.size() / 2] + 1.5 * textSize_ * normal;
    symbols.addText({{"u"}, {support.fix.front(), Script::Sub}, {" = 0"}}, middle);
  }

  void drawLoad(SetupSymbols& symbols, const LoadSpec& load) const {
    const FaceLine face = pixels(faceLine(patch_, load.place.face, model_.subdivision));
    if (load.traction.empty()) return;
    const Vector2d traction(Formula(load.traction[0], scene_.definitions).constant(),
                            Formula(load.traction[1], scene_.definitions).constant());
    if (traction.norm() > 0.0)
      symbols.addLoad(face.points, face.outward, traction.normalized(),
                      number(traction.norm(), model_.stressUnit));
  }

  void drawToolTexts(SetupSymbols& symbols, std::size_t k) const {
    if (endOf(k).norm() > 0.0) symbols.addDashes(outlinePixels(k, endOf(k)));
    if (const auto* plane = std::get_if<Plane>(&tool(k).shape)) {
      const Points line = outlinePixels(k, Vector2d(0, 0));
      const Vector2d away = -plane->normal.head<2>().normalized();
      symbols.addText({{tool(k).name}},
                      line.front() + 0.15 * (line.back() - line.front()) + 1.3 * textSize_ * away);
      return;
    }
    const double radius = curvatureRadius(tool(k).shape);
    const Vector2d center = middleOf(k);
    const Vector2d middle = view_.area.center();
    const Vector2d direction = Vector2d(center.x() < middle.x() ? 1.0 : -1.0, 1.0).normalized();
    symbols.addRadius(center, center + radius * view_.pixelsPerLength * direction, "R = " + length(radius));
  }

  Points outlinePixels(std::size_t k, const Vector2d& shift) const {
    const auto outline = toolOutline(tool(k), shift, toolBox_);
    Points points;
    for (vtkIdType i = 0; i < outline->GetNumberOfPoints(); ++i)
      points.push_back(view_.pixel(Eigen::Vector3d(outline->GetPoint(i))));
    if (!std::holds_alternative<Plane>(tool(k).shape)) points.push_back(points.front());
    return points;
  }

  /// Of a disc, or the point of a plane that is nearest to the body's middle; in pixels.
  Vector2d middleOf(std::size_t k) const {
    const double* b = toolOutline(tool(k), Vector2d(0, 0), toolBox_)->GetBounds();
    return view_.pixel(Vector2d((b[0] + b[1]) / 2, (b[2] + b[3]) / 2));
  }

  /// Arrows of tools start in the middle of a disc, or behind a plane; those of a face, in front of it.
  std::vector<Mover> movers() const {
    std::vector<Mover> result;
    const double before = (kBeforeArrow + kShortestArrow) * textSize_;
    for (std::size_t k = 0; k < model_.tools.size(); ++k) {
      const auto phases = phasesOf(k);
      if (phases.empty()) continue;
      const auto* plane = std::get_if<Plane>(&tool(k).shape);
      const Vector2d away = plane ? Vector2d(-plane->normal.head<2>().normalized()) : Vector2d(0, 0);
      result.push_back({tool(k).name, middleOf(k) + before * away, phases, !plane});
    }
    for (const SupportSpec& support : scene_.supports) {
      const auto phases = support.move ? motionPhases(*support.move, end_) : std::vector<Vector2d>();
      if (phases.empty()) continue;
      const FaceLine face = pixels(faceLine(patch_, support.place.face, model_.subdivision));
      const Vector2d middle = face.points[face.points.size() / 2];
      result.push_back({support.place.face, middle + before * face.meanNormal(), phases, false});
    }
    return result;
  }

  /// The amounts stand below the picture.
  void drawMotions(SetupSymbols& symbols) const {
    const std::vector<Mover> all = movers();
    RichText amounts;
    for (const Mover& mover : all) {
      Vector2d at = mover.start;
      if (!amounts.empty()) amounts.push_back({";  "});
      if (all.size() > 1) amounts.push_back({mover.name + ": "});
      for (std::size_t k = 0; k < mover.phases.size(); ++k) {
        const RichText name = phaseName(mover.phases.size(), k);
        const Vector2d direction = mover.phases[k].normalized();
        const double drawn = std::max(kShortestArrow * textSize_,
                                      mover.toScale ? mover.phases[k].norm() * view_.pixelsPerLength : 0.0);
        symbols.addArrow(at, at + drawn * direction);
        const Vector2d beside = std::abs(direction.x()) > 0.5 ? Vector2d(0, 0.8) : Vector2d(-0.9, 0);
        symbols.addText(name, at + 0.5 * drawn * direction + textSize_ * beside);
        if (k > 0) amounts.push_back({", then "});
        amounts.insert(amounts.end(), name.begin(), name.end());
        amounts.push_back({" = " + length(mover.phases[k].norm())});
        at += drawn * direction;
      }
    }
    const Vector2d low = view_.pixel(box_.min().head<2>()), high = view_.pixel(box_.max().head<2>());
    if (!amounts.empty()) symbols.addText(amounts, {(low.x() + high.x()) / 2, textSize_});
  }

  static RichText phaseName(std::size_t count, std::size_t k) {
    if (count == 1) return {{"u"}};
    return {{"u"}, {std::to_string(k + 1), Script::Sub}};
  }

  const ModelRecord& model_;
  Scene scene_;
  Patch<2> patch_;
  std::array<int, 2> size_;
  bool knots_;
  double textSize_;
  double end_ = 0.0;  ///< of the run
  vtkSmartPointer<vtkPolyData> body_;
  Eigen::AlignedBox3d box_;      ///< of the body
  Eigen::AlignedBox3d toolBox_;  ///< along which planes are drawn
  Rooms rooms_;
  View view_;
};

}  // namespace

void drawSetup(const ModelRecord& model, const std::array<int, 2>& size, const std::filesystem::path& png,
               bool knots) {
  if (model.dim != 2)
    throw Error(fmt::format("set-up drawing: found a model in {} dimensions; expected 2", model.dim));
  if (std::min(size[0], size[1]) < kSmallestSide || std::max(size[0], size[1]) > kLargestSide)
    throw Error(fmt::format("size: found {} x {} pixels; expected {} to {}", size[0], size[1], kSmallestSide,
                            kLargestSide));
  SetupPicture(model, size, knots).draw(png);
}

}  // namespace burnish
