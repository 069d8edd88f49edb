#include "postproc/draw/contour/seen_lines.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/core/interruption.h"
#include "postproc/draw/contour/ray_stops.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

/// Of a closed surface one sees two sides; of what is behind more of them nothing is left to be seen.
constexpr int kMostSides = 8;

/// Between places at which one looks, and to which the end of a piece is found, in pixels.
constexpr double kPixelsOfStep = 0.25, kPixelsOfEnd = 0.01;

using LinePlaces = std::vector<Eigen::Vector3d>;

std::vector<LinePlaces> placesOf(vtkPolyData& lines) {
  std::vector<LinePlaces> all;
  vtkNew<vtkIdList> ids;
  vtkCellArray& cells = *lines.GetLines();
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellAtId(cell, ids);
    LinePlaces line;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) line.emplace_back(lines.GetPoint(ids->GetId(k)));
    all.push_back(std::move(line));
  }
  return all;
}

}  // namespace

struct SeenLines::Group {
  double lift, opacity;
  Eigen::Vector3d middle;
  double radius;  ///< of a ball about the middle in which all surfaces are
  std::unique_ptr<RayStops> stops;
};

SeenLines::SeenLines(const std::vector<HidingSurface>& surfaces, const View& view) : view_(view) {
  std::map<std::pair<double, double>, Surfaces> alike;
  for (const HidingSurface& surface : surfaces)
    if (surface.opacity > 0.0) alike[{surface.lift, surface.opacity}].push_back(surface.shape);
  for (const auto& [look, shapes] : alike) {
    const RaySpace space = raySpaceOf(shapes);
    const double radius = 4.0 / space.scale;  // places in the space are no larger than 2
    groups_.push_back(
        {look.first, look.second, space.middle, radius, std::make_unique<RayStops>(shapes, space)});
  }
}

SeenLines::~SeenLines() = default;

double SeenLines::shareAt(const Eigen::Vector3d& point, double lift) const {
  double share = 1.0;
  for (const Group& group : groups_) {
    const double before = lift - group.lift;
    Eigen::Vector3d origin = point + before * view_.towardsEye(), towards = view_.towardsEye();
    double reach = std::numeric_limits<double>::infinity();
    if (view_.eye) {  // lifted along the line of sight by a distance across the picture
      constexpr double kMost = 0.99;
      const Eigen::Vector3d way = view_.eye->position(view_.axes) - point;
      origin = point + std::min(kMost, before / way.dot(view_.towardsEye())) * way;
      towards = way.normalized();
      reach = (view_.eye->position(view_.axes) - origin).norm();
    }
    // From where the ray comes to the surfaces, however far that is, to where it has passed them.
    const double passes = towards.dot(group.middle - origin), begin = std::max(0.0, passes - group.radius),
                 end = std::min(reach, passes + group.radius);
    if (begin >= end) continue;
    origin += begin * towards;
    reach = end - begin;
    const bool isOpaque = group.opacity == 1.0;
    const int sides = group.stops->numMet(origin, towards, reach, isOpaque ? 1 : kMostSides);
    share *= std::pow(1.0 - group.opacity, sides);
    if (share == 0.0) break;
  }
  return share;
}

std::vector<SeenLines::Piece> SeenLines::piecesOf(vtkPolyData& lines, double lift, double width) const {
  const std::vector<LinePlaces> all = placesOf(lines);
  std::vector<std::vector<Piece>> found(all.size());
  // In space, across a direction in the picture.
  const auto asideOf = [&](const Eigen::Vector2d& along, double far) -> Eigen::Vector3d {
    return far * view_.axes.transpose() * Eigen::Vector2d(-along.y(), along.x()).normalized();
  };
  const PixelRect seen{view_.area.x - width, view_.area.y - width, view_.area.width + 2.0 * width,
                       view_.area.height + 2.0 * width};
  const auto follow = [&](const LinePlaces& line, std::vector<Piece>& pieces) {
    throwIfInterrupted();
    bool goesOn = false;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Eigen::Vector3d &from = line[k], &to = line[k + 1];
      const Eigen::Vector2d begin = view_.pixel(from), end = view_.pixel(to);
      const double sizeFrom = view_.pixelsPerLengthAt(from), sizeTo = view_.pixelsPerLengthAt(to);
      const LinePart inside = partWithin(seen, begin, end);
      goesOn = goesOn && inside.begin == 0.0;
      if (inside.begin > inside.end) continue;
      const double pixels = (inside.end - inside.begin) * (end - begin).norm();
      const Eigen::Vector3d aside = asideOf(end - begin, 0.5 * width);
      // part: of the inside, in pixels
      const auto at = [&](double part) -> Eigen::Vector3d {
        const double whole = inside.begin + part * (inside.end - inside.begin);
        return from + whole * sizeTo / ((1.0 - whole) * sizeFrom + whole * sizeTo) * (to - from);
      };
      const auto shareOf = [&](double part) {
        const double share = shareAt(at(part), lift);
        if (share == 1.0 || pixels == 0.0) return share;
        const Eigen::Vector3d side = aside / view_.pixelsPerLengthAt(at(part));
        return std::max({share, shareAt(at(part) + side, lift), shareAt(at(part) - side, lift)});
      };
      double share = shareOf(0.0);
      if (!goesOn || pieces.back().share != share) pieces.push_back({{at(0.0)}, share});
      const double steps = std::max(1.0, std::ceil(pixels / kPixelsOfStep));
      for (double step = 0.0; step < steps; ++step) {
        double before = step / steps, after = (step + 1.0) / steps;
        const double next = shareOf(after);
        if (next == share) continue;
        while ((after - before) * pixels > kPixelsOfEnd) {
          const double middle = 0.5 * (before + after);
          (shareOf(middle) == share ? before : after) = middle;
        }
        const Eigen::Vector3d border = at(after);
        pieces.back().places.push_back(border);
        pieces.push_back({{border}, next});
        share = next;
      }
      pieces.back().places.push_back(at(1.0));
      goesOn = inside.end == 1.0;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size()), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k)
      if (all[k].size() > 1) follow(all[k], found[k]);
  });
  std::vector<Piece> pieces;
  for (std::vector<Piece>& of : found)
    pieces.insert(pieces.end(), std::make_move_iterator(of.begin()), std::make_move_iterator(of.end()));
  return pieces;
}

vtkSmartPointer<vtkPolyData> SeenLines::hiddenOf(vtkPolyData& lines, double lift, double width) const {
  PolyBuilder builder;
  for (const Piece& piece : piecesOf(lines, lift, width)) {
    if (piece.share > kHidden) continue;
    Eigen::Matrix3Xd places(3, std::ssize(piece.places));
    for (std::size_t k = 0; k < piece.places.size(); ++k)
      places.col(static_cast<Eigen::Index>(k)) = piece.places[k];
    builder.addLine(builder.addPoints(places));
  }
  return builder.finish();
}

}  // namespace burnish
