#include "postproc/draw/setup/setup_layout.h"

#include <fmt/format.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/core/error.h"
#include "engine/scene/path_of_tool.h"
#include "engine/scene/reader.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/draw/setup/setup_loads.h"
#include "postproc/draw/setup/setup_motion.h"
#include "postproc/draw/setup/setup_symbols.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/text/ticks.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

using Eigen::Vector2d;

// Measures as parts of the text size.
constexpr double kMargin = 0.5;
constexpr double kAxesRoom = 4.2;
constexpr double kTextLine = 1.8;
constexpr double kAboveTool = 2.0;    // for the force on a small one
constexpr double kBeforeArrow = 1.3;  // from a plane or a face to its arrow
constexpr double kBeyondAxis = 1.2;   // what the axis is longer than the body, at both ends

/// A tool is shown as far as it reaches beyond the body, the axis of a ring if it is near; in parts of the
/// body's diagonal.
constexpr double kReach = 0.8, kAxisReach = 1.5;

Eigen::AlignedBox2d flat(const Eigen::AlignedBox3d& box) {
  return {box.min().head<2>(), box.max().head<2>()};
}

int smoothSubdivision(const ModelRecord& model) {
  constexpr int kCells = 64;  // along the direction of the body that has the fewest spans
  int fewest = kCells;
  for (const PatchRecord& patch : model.mesh.patches)
    for (const DirectionRecord& direction : patch.directions)
      fewest = std::min(fewest, basisOf(direction).numSpans());
  return std::max(model.subdivision, (kCells + fewest - 1) / fewest);
}

/// Whether a point lies near the side of a box to which a normal points.
bool isAtBorder(const Vector2d& point, const Vector2d& normal, const Eigen::AlignedBox2d& box) {
  constexpr double kNear = 0.15;
  const Eigen::Index d = std::abs(normal.x()) > std::abs(normal.y()) ? 0 : 1;
  const double distance = normal(d) < 0.0 ? point(d) - box.min()(d) : box.max()(d) - point(d);
  return distance <= kNear * box.sizes()(d);
}

/// Of a tool that is a plane.
std::optional<Vector2d> awayFromBody(const ToolRecord& tool) {
  const auto normal = planeNormal(tool.shape);
  return normal ? std::optional<Vector2d>(-normal->head<2>().normalized()) : std::nullopt;
}

/// In the plane.
Eigen::AlignedBox2d boundsOf(vtkPolyData& outline) {
  const double* b = outline.GetBounds();
  return {Vector2d(b[0], b[2]), Vector2d(b[1], b[3])};
}

}  // namespace

double& SetupLayout::Rooms::at(const Vector2d& normal) {
  if (std::abs(normal.x()) > std::abs(normal.y())) return normal.x() < 0 ? left : right;
  return normal.y() < 0 ? bottom : top;
}

SetupLayout::SetupLayout(const ModelRecord& model, const std::array<int, 2>& size)
    : model_(model),
      scene_(parseScene(model.sceneYaml, "the scene of the result")),
      subdivision_(smoothSubdivision(model)),
      faces_(model, scene_, subdivision_),
      size_(size),
      textSize_(sheetTextSize(size[0])),
      end_(scene_.steps.empty() ? 0.0 : scene_.steps.back().until) {
  findBoxes();
  findTools();
  findRooms();
  findView();
}

void SetupLayout::findBoxes() {
  const auto body = BodySurface(model_.mesh, subdivision_).displaced({});
  const double* b = body->GetBounds();
  box_ = {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
  const Eigen::Vector3d half(box_.sizes().maxCoeff() / 2, 0.0, 0.0);
  toolBox_ = {box_.center() - half, box_.center() + half};
}

void SetupLayout::findTools() {
  constexpr double kNear = 0.15;  // of the body's diagonal
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kNear * box_.diagonal().norm());
  tools_ = model_.tools;
  for (ToolRecord& tool : tools_) tool.shape = partIn({box_.min() - margin, box_.max() + margin}, tool.shape);
}

void SetupLayout::findRooms() {
  // What stands at the same part of a face stands in a row.
  std::map<std::tuple<std::string, std::string, std::string, std::vector<double>>, double> depths;
  const auto add = [&](const FaceSpec& place, double depth) {
    double& sum = depths[{place.body, place.patch, place.face, place.part}];
    sum += depth;
    const FaceLine face = faces_.line(place);
    for (std::size_t k = 0; k < face.points.size(); ++k)
      if (isAtBorder(face.points[k], face.outward[k], flat(box_))) {
        double& room = rooms_.at(face.outward[k]);
        room = std::max(room, sum);
      }
  };
  for (const SupportSpec& support : scene_.supports) {
    const FaceLine face = faces_.line(support.place);
    const bool moves = !motionPhases(support, face.middle, scene_.definitions, end_).empty();
    if (!isOnAxis(face.points))
      add(support.place, SetupSymbols::kSupportDepth + (moves ? SetupSymbols::kLoadDepth : 0.0));
  }
  for (const LoadSpec& load : scene_.loads)
    if (load.bodyForce.empty()) add(load.place, SetupSymbols::kLoadDepth);
  findRoomsOfTools();
  if (!axisIsNear()) return;
  rooms_.bottom = std::max(rooms_.bottom, kBeyondAxis);
  rooms_.top = std::max(rooms_.top, kBeyondAxis);
}

void SetupLayout::findRoomsOfTools() {
  for (std::size_t k = 0; k < tools_.size(); ++k)
    if (const auto away = awayFromBody(tools_[k]); away && !phasesOf(k).empty())
      rooms_.at(*away) += SetupSymbols::kLoadDepth;
  for (std::size_t k = 0; k < scene_.tools.size(); ++k) {
    if (!scene_.tools[k].carry) continue;
    const Vector2d force = carriedBy(k).force;
    if (force.norm() > 0.0) rooms_.at(-force) = std::max(rooms_.at(-force), kAboveTool);
  }
  const auto isOpenBelow = [&](const ToolRecord& tool) {
    const SurfaceMesh* mesh = openMesh(tool.shape);
    return mesh && mesh->points.row(1).minCoeff() < box_.min().y();
  };
  if (std::any_of(tools_.begin(), tools_.end(), isOpenBelow)) rooms_.bottom += kTextLine;  // for their names
}

void SetupLayout::findView() {
  Eigen::AlignedBox2d content = flat(box_);
  for (std::size_t k = 0; k < tools_.size(); ++k)
    for (const Vector2d& shift : {Vector2d(0, 0), endOf(k)}) content.extend(toolBounds(k, shift));
  if (axisIsNear()) content.extend(Vector2d(0.0, content.center().y()));
  lowest_ = content.min().y();

  const double left = rooms_.left + SetupSymbols::kDimensionDepth, right = rooms_.right + kMargin;
  const double lines = kTextLine * static_cast<double>(amounts().size());
  const double bottom = std::max(rooms_.bottom + SetupSymbols::kDimensionDepth + lines, kAxesRoom);
  const double top = rooms_.top + kMargin;
  const double width = size_[0] - textSize_ * (left + right), height = size_[1] - textSize_ * (bottom + top);
  const Vector2d extent = content.sizes();
  view_.pixelsPerLength = std::min(width / extent.x(), height / extent.y());
  if (!(view_.pixelsPerLength > 0.0))
    throw Error(
        fmt::format("size: {} x {} pixels leave no room for the body beside supports, loads and measures; "
                    "take a larger height",
                    size_[0], size_[1]));
  view_.area = {0.0, 0.0, static_cast<double>(size_[0]), static_cast<double>(size_[1])};
  const Vector2d shift = textSize_ / 2 * Vector2d(left - right, bottom - top);
  view_.center = content.center() - shift / view_.pixelsPerLength;
}

bool SetupLayout::axisIsNear() const {
  return scene_.kinematics == KinematicsChoice::Axisymmetric &&
         box_.min().x() <= kAxisReach * box_.diagonal().norm();
}

std::optional<std::array<Vector2d, 2>> SetupLayout::axis() const {
  if (!axisIsNear()) return std::nullopt;
  const Vector2d beyond(0.0, kBeyondAxis * textSize_);
  return {{view_.pixel(Vector2d(0.0, box_.min().y())) - beyond,
           view_.pixel(Vector2d(0.0, box_.max().y())) + beyond}};
}

bool SetupLayout::isOnAxis(const std::vector<Vector2d>& line) const {
  constexpr double kRounding = 1e-9;
  return scene_.kinematics == KinematicsChoice::Axisymmetric &&
         std::all_of(line.begin(), line.end(), [&](const Vector2d& x) {
           return std::abs(x.x()) <= kRounding * box_.diagonal().norm();
         });
}

FaceLine SetupLayout::pixels(const FaceSpec& place) const {
  FaceLine line = faces_.line(place);
  for (Vector2d& point : line.points) point = view_.pixel(point);
  line.middle = view_.pixel(line.middle);
  return line;
}

vtkSmartPointer<vtkPolyData> SetupLayout::outlineOf(std::size_t tool, const Vector2d& shift) const {
  return toolOutline(movedTool(tools_[tool], {shift.x(), shift.y(), 0.0}, 0.0), 2, toolBox_);
}

std::vector<std::vector<Vector2d>> SetupLayout::toolPixels(std::size_t tool, const Vector2d& shift) const {
  vtkNew<vtkStripper> joined;
  joined->SetInputData(withoutSeams(*outlineOf(tool, shift)));
  joined->JoinContiguousSegmentsOn();
  joined->SetMaximumLength(100000);  // all that VTK allows
  joined->Update();
  std::vector<std::vector<Vector2d>> lines;
  vtkNew<vtkIdList> ids;
  vtkPolyData& outline = *joined->GetOutput();
  for (vtkIdType line = 0; line < outline.GetNumberOfCells(); ++line) {
    outline.GetCellPoints(line, ids);
    lines.emplace_back();
    for (const vtkIdType id : *ids)
      lines.back().push_back(view_.pixel(Eigen::Vector3d(outline.GetPoint(id))));
  }
  return lines;
}

Vector2d SetupLayout::middleOf(std::size_t tool) const {
  if (recordedMesh(tools_[tool].shape)) return view_.pixel(toolBounds(tool, Vector2d(0, 0)).center());
  return view_.pixel(boundsOf(*outlineOf(tool, Vector2d(0, 0))).center());
}

DrawnToolLoad SetupLayout::carriedBy(std::size_t tool) const {
  const ToolSpec& spec = scene_.tools[tool];
  Vector2d middle = tools_[tool].pivot.head<2>();
  if (spec.path) middle += pathOf(spec).displacement(0.0).head<2>();
  Vector2d outward(0.0, 0.0);
  double nearest = HUGE_VAL;
  for (const ContactSpec& contact : scene_.contact) {
    if (contact.tool != spec.name) continue;
    const FaceLine face = faces_.line(contact.place);
    for (std::size_t k = 0; k < face.points.size(); ++k)
      if (const double distance = (face.points[k] - middle).norm(); distance < nearest) {
        nearest = distance;
        outward = face.outward[k];
      }
  }
  return toolLoad(*spec.carry, outward, scene_, endTime(tool));
}

std::string SetupLayout::forceText(double force) const {
  return "F = " + number(force, derivedUnits(model_).force);
}

std::string SetupLayout::momentText(double moment) const {
  return "M = " + number(moment, derivedUnits(model_).energy);
}

/// What is to be seen of a tool: all that is not far away.
Eigen::AlignedBox2d SetupLayout::toolBounds(std::size_t tool, const Vector2d& shift) const {
  const Vector2d margin = Vector2d::Constant(kReach * box_.diagonal().norm());
  const Eigen::AlignedBox2d body = flat(box_), seen(body.min() - margin, body.max() + margin);
  return seen.intersection(boundsOf(*outlineOf(tool, shift)));
}

std::vector<Vector2d> SetupLayout::phasesOf(std::size_t tool) const {
  return motionPhases(scene_.tools[tool], scene_.definitions, endTime(tool));
}

Vector2d SetupLayout::endOf(std::size_t tool) const {
  const auto phases = phasesOf(tool);
  return std::accumulate(phases.begin(), phases.end(), Vector2d(0, 0));
}

/// Beside a line, so that an arrow towards it ends there.
Vector2d SetupLayout::arrowStart(const Vector2d& at, const Vector2d& normal, const Vector2d& phase) const {
  const double towards = std::max(0.0, -phase.normalized().dot(normal));
  return at + (kBeforeArrow + towards * SetupSymbols::kShortestMotion) * textSize_ * normal;
}

std::vector<Mover> SetupLayout::movers() const {
  std::vector<Mover> result;
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    const auto phases = phasesOf(k);
    if (phases.empty()) continue;
    const auto away = awayFromBody(tools_[k]);
    const Vector2d middle = middleOf(k);
    const Vector2d start = away ? arrowStart(middle, *away, phases.front()) : middle;
    result.push_back({tools_[k].name, start, phases, !away, false});
  }
  for (const SupportSpec& support : scene_.supports) {
    const FaceLine face = faces_.line(support.place);
    const auto phases = motionPhases(support, face.middle, scene_.definitions, end_);
    if (phases.empty()) continue;
    const Vector2d start = arrowStart(view_.pixel(face.middle), face.meanNormal(), phases.front());
    const auto moved = [&](const Vector2d& X) { return motionPhases(support, X, scene_.definitions, end_); };
    const bool same = std::all_of(face.points.begin(), face.points.end(),
                                  [&](const Vector2d& X) { return moved(X) == phases; });
    result.push_back({faces_.nameOf(support.place), start, phases, false, !same});
  }
  return result;
}

std::vector<RichText> SetupLayout::amounts() const {
  std::vector<Mover> all = movers();
  const bool differ = std::erase_if(all, [](const Mover& mover) { return mover.differs; }) > 0;
  const double room = size_[0] - (kAxesRoom + kMargin) * textSize_;
  std::vector<RichText> lines;
  for (const Mover& mover : all) {
    RichText text;
    if (all.size() > 1) text.push_back({mover.name + ": "});
    for (std::size_t k = 0; k < mover.phases.size(); ++k) {
      const RichText name = phaseName(mover.phases.size(), k);
      if (k > 0) text.push_back({", then "});
      text.insert(text.end(), name.begin(), name.end());
      text.push_back({" = " + length(mover.phases[k].norm())});
    }
    RichText longer = lines.empty() ? RichText() : lines.back();
    if (!longer.empty()) longer.push_back({";  "});
    longer.insert(longer.end(), text.begin(), text.end());
    if (!lines.empty() && textWidth(longer, {.size = textSize_}) <= room)
      lines.back() = longer;
    else
      lines.push_back(text);
  }
  if (differ) lines.push_back({{"u depends on x and y"}});
  if (scene_.kinematics == KinematicsChoice::Axisymmetric && !axisIsNear())
    lines.push_back({{"axis " + length(box_.min().x()) + " left of the body"}});
  return lines;
}

/// Under the middle of the body, unless the line would leave the picture or meet the axes.
Vector2d SetupLayout::amountsAt(const RichText& line) const {
  const double half = textWidth(line, {.size = textSize_}) / 2;
  const double wanted = view_.pixel(flat(box_).center()).x();
  const double first = kAxesRoom * textSize_ + half, last = size_[0] - kMargin * textSize_ - half;
  return {std::clamp(wanted, first, std::max(first, last)), textSize_};
}

Vector2d SetupLayout::belowBody() const {
  const double tools = view_.pixelsPerLength * (box_.min().y() - lowest_);
  return {0.0, -tools - textSize_ * (rooms_.bottom + 0.85 * SetupSymbols::kDimensionDepth)};
}

Vector2d SetupLayout::besideBody() const {
  const double toAxis = axisIsNear() ? view_.pixelsPerLength * box_.min().x() : 0.0;
  return {-toAxis - textSize_ * (rooms_.left + 0.425 * SetupSymbols::kDimensionDepth), 0.0};
}

std::string SetupLayout::number(double value, const std::string& unit, int digits) {
  std::string text = numberText(value, digits);
  if (text.size() == 1) text += ".0";
  return unit.empty() ? text : text + " " + unit;
}

RichText SetupLayout::phaseName(std::size_t count, std::size_t phase) {
  if (count == 1) return {{"u"}};
  return {{"u"}, {std::to_string(phase + 1), Script::Sub}};
}

}  // namespace burnish
