#include "postproc/draw/contour/page_lines.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkClipPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "postproc/draw/contour/shape_lines.h"
#include "postproc/mesh/same_points.h"

namespace burnish {
namespace {

/// Points closer than this part of a set's diagonal are one.
constexpr double kSamePoint = 1e-7;

/// Points that are nearer to the line between others, in pixels of the picture, are left out of borders.
constexpr double kStraight = 0.01;

Eigen::Vector2d onPage(vtkPolyData& data, vtkIdType point, const View& view) {
  return view.pixel(Eigen::Map<const Eigen::Vector3d>(data.GetPoint(point)));
}

/// The points of each line.
std::vector<std::vector<vtkIdType>> pointsOfLines(vtkPolyData& lines) {
  std::vector<std::vector<vtkIdType>> result;
  const auto next = vtk::TakeSmartPointer(lines.GetLines()->NewIterator());
  for (next->GoToFirstCell(); !next->IsDoneWithTraversal(); next->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    next->GetCurrentCell(count, points);
    result.emplace_back(points, points + count);
  }
  return result;
}

std::vector<PagePoints> placed(vtkPolyData& lines, const View& view) {
  std::vector<PagePoints> result;
  for (const std::vector<vtkIdType>& line : pointsOfLines(lines)) {
    result.emplace_back();
    for (const vtkIdType point : line) result.back().push_back(onPage(lines, point, view));
  }
  return result;
}

PagePoints dotAt(vtkPolyData& points, vtkIdType point, const View& view) {
  const Eigen::Vector2d at = onPage(points, point, view);
  return {at, at};
}

/// Lines of one look, those of which an equal share comes through together.
class SeenTogether {
 public:
  /// look: without lines, as what is seen in full looks.
  explicit SeenTogether(PageLines look) : look_(std::move(look)) {}

  void add(PagePoints line, double share) {
    constexpr double kLeast = 0.01;
    if (share < kLeast) return;
    PageLines& lines = byShare_.try_emplace(share, look_).first->second;
    lines.opacity = share * look_.opacity;
    lines.lines.push_back(std::move(line));
  }

  std::vector<PageLines> lines() const {
    std::vector<PageLines> all;
    for (const auto& [share, lines] : byShare_) all.push_back(lines);
    return all;
  }

 private:
  PageLines look_;
  std::map<double, PageLines> byShare_;
};

/// Cells that have the points on their common borders in common; those that have no area then are left out.
vtkSmartPointer<vtkPolyData> joined(vtkPolyData& cells) {
  if (cells.GetNumberOfPoints() == 0) return &cells;
  const std::vector<vtkIdType> one = firstOfSame(*cells.GetPoints(), kSamePoint * cells.GetLength());
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfPolys(); ++cell) {
    cells.GetPolys()->GetCellAtId(cell, corners);
    std::vector<vtkIdType> different;
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      if (const vtkIdType corner = one[corners->GetId(k)];
          std::ranges::find(different, corner) == different.end())
        different.push_back(corner);
    if (different.size() > 2) polygons->InsertNextCell(std::ssize(different), different.data());
  }
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(cells.GetPoints());
  result->SetPolys(polygons);
  result->GetPointData()->SetScalars(cells.GetPointData()->GetScalars());
  return result;
}

/// Adds the points between the ends of a part of a line from which it is further than `kStraight` without them.
void addBends(const PagePoints& line, std::size_t begin, std::size_t end, PagePoints& kept) {
  const Eigen::Vector2d way = line[end] - line[begin];
  double most = 0.0;
  std::size_t farthest = begin;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const Eigen::Vector2d from = line[k] - line[begin];
    const double along =
        way.squaredNorm() > 0.0 ? std::clamp(from.dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
    const double distance = (from - along * way).norm();
    if (distance > most) {
      most = distance;
      farthest = k;
    }
  }
  if (most <= kStraight) return;
  addBends(line, begin, farthest, kept);
  kept.push_back(line[farthest]);
  addBends(line, farthest, end, kept);
}

/// The edges that only one of joined cells has. Code of our own: vtkFeatureEdges asks for too much memory with two million cells.
vtkSmartPointer<vtkPolyData> bordersOf(vtkPolyData& cells) {
  using Edge = std::array<vtkIdType, 2>;
  std::vector<Edge> edges;
  vtkNew<vtkIdList> ids;
  vtkCellArray& polygons = *cells.GetPolys();
  for (vtkIdType cell = 0; cell < polygons.GetNumberOfCells(); ++cell) {
    polygons.GetCellAtId(cell, ids);
    for (vtkIdType k = 0, count = ids->GetNumberOfIds(); k < count; ++k) {
      const vtkIdType a = ids->GetId(k), b = ids->GetId((k + 1) % count);
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::ranges::sort(edges);
  vtkNew<vtkCellArray> single;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::find_if(edge, edges.end(), [&](const Edge& other) { return other != *edge; });
    if (next - edge == 1) single->InsertNextCell(2, edge->data());
    edge = next;
  }
  const auto borders = vtkSmartPointer<vtkPolyData>::New();
  borders->SetPoints(cells.GetPoints());
  borders->SetLines(single);
  borders->GetPointData()->SetScalars(cells.GetPointData()->GetScalars());
  return borders;
}

/// Segments round regions as closed lines with as few points as show them.
std::vector<PagePoints> loopsOf(vtkPolyData& segments, const View& view) {
  std::vector<PagePoints> loops;
  for (const PagePoints& line : placed(*inFewPieces(segments), view)) {
    PagePoints& loop = loops.emplace_back(PagePoints{line.front()});
    addBends(line, 0, line.size() - 1, loop);
  }
  return loops;
}

}  // namespace

vtkSmartPointer<vtkPolyData> inFewPieces(vtkPolyData& lines) {
  vtkNew<vtkPolyData> alone;  // polygons beside them would become strips
  if (lines.GetNumberOfPoints() == 0) return alone.Get();
  const std::vector<vtkIdType> one = firstOfSame(*lines.GetPoints(), kSamePoint * lines.GetLength());
  std::vector<std::array<vtkIdType, 2>> segments;
  for (const std::vector<vtkIdType>& line : pointsOfLines(lines))
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const vtkIdType a = one[static_cast<std::size_t>(line[k])],
                      b = one[static_cast<std::size_t>(line[k + 1])];
      if (a != b) segments.push_back({std::min(a, b), std::max(a, b)});
    }
  std::ranges::sort(segments);
  const auto repeated = std::ranges::unique(segments);
  segments.erase(repeated.begin(), repeated.end());
  vtkNew<vtkCellArray> cells;
  for (const auto& segment : segments) cells->InsertNextCell(2, segment.data());
  alone->SetPoints(lines.GetPoints());
  alone->SetLines(cells);
  vtkNew<vtkStripper> strip;
  strip->SetInputData(alone);
  strip->JoinContiguousSegmentsOn();
  strip->SetMaximumLength(std::numeric_limits<int>::max());
  strip->Update();
  return strip->GetOutput();
}

PageLines pageLines(vtkPolyData& lines, const View& view, const Color& color, double width, double opacity) {
  return {placed(*inFewPieces(lines), view), width, color, opacity, true, view.area};
}

std::vector<PageLines> pageLines(vtkPolyData& lines, const View& view, const Color& color, double width,
                                 double opacity, const SeenLines& seen, double lift) {
  SeenTogether together({{}, width, color, opacity, true, view.area});
  for (const SeenLines::Piece& piece : seen.piecesOf(*inFewPieces(lines), lift, width)) {
    PagePoints points;
    for (const Eigen::Vector3d& place : piece.places) points.push_back(view.pixel(place));
    together.add(std::move(points), piece.share);
  }
  return together.lines();
}

PageLines pageDashes(vtkPolyData& lines, const View& view, const Color& color, double width,
                     const Dashes& look) {
  PageLines dashes{{}, width, color, look.opacity, false, view.area};
  vtkDataArray& ways = *lines.GetPointData()->GetArray(kWayAlong);
  for (const std::vector<vtkIdType>& line : pointsOfLines(lines)) {
    bool isDrawn = false;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Eigen::Vector2d begin = onPage(lines, line[k], view), end = onPage(lines, line[k + 1], view);
      const double from = ways.GetComponent(line[k], 0), to = ways.GetComponent(line[k + 1], 0);
      const auto at = [&](double way) -> Eigen::Vector2d {
        return begin + (to > from ? (way - from) / (to - from) : 0.0) * (end - begin);
      };
      for (double number = std::floor(from / look.length); number * look.length < to; ++number) {
        const double first = std::max(from, number * look.length),
                     last = std::min(to, (number + look.share) * look.length);
        if (first >= last) continue;
        if (!isDrawn || first > from) dashes.lines.push_back({at(first)});
        dashes.lines.back().push_back(at(last));
        isDrawn = last == to;
      }
    }
  }
  return dashes;
}

PageLines pageDots(vtkPolyData& points, const View& view, const Color& color, double diameter) {
  PageLines dots{{}, diameter, color, 1.0, true, view.area};
  for (vtkIdType k = 0; k < points.GetNumberOfPoints(); ++k) dots.lines.push_back(dotAt(points, k, view));
  return dots;
}

std::vector<PageLines> pageDots(vtkPolyData& points, const View& view, const Color& color, double diameter,
                                const SeenLines& seen, double lift) {
  SeenTogether together({{}, diameter, color, 1.0, true, view.area});
  for (vtkIdType k = 0; k < points.GetNumberOfPoints(); ++k)
    together.add(dotAt(points, k, view),
                 seen.shareAt(Eigen::Map<const Eigen::Vector3d>(points.GetPoint(k)), lift));
  return together.lines();
}

vtkSmartPointer<vtkPolyData> seenLoops(vtkPolyData& loops, const SeenLines& seen, double lift) {
  vtkNew<vtkCellArray> kept;
  for (const std::vector<vtkIdType>& loop : pointsOfLines(loops)) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const vtkIdType point : loop) middle += Eigen::Map<const Eigen::Vector3d>(loops.GetPoint(point));
    if (seen.shareAt(middle / static_cast<double>(loop.size()), lift) > SeenLines::kHidden)
      kept->InsertNextCell(std::ssize(loop), loop.data());
  }
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(loops.GetPoints());
  result->SetLines(kept);
  return result;
}

std::vector<PageLines> coloredPageLines(vtkPolyData& lines, const View& view, const ColorScale& scale,
                                        double width) {
  constexpr double kStepsOfRange = 256.0;
  const double step = (scale.range()[1] - scale.range()[0]) / kStepsOfRange;
  std::vector<PageLines> pieces;
  vtkDataArray& values = *lines.GetPointData()->GetScalars();
  for (const std::vector<vtkIdType>& line : pointsOfLines(lines)) {
    const std::size_t before = pieces.size();
    const auto add = [&](const Eigen::Vector2d& begin, const Eigen::Vector2d& end, const Color& color) {
      if (pieces.size() == before || pieces.back().color != color) {
        // Below the begin of the next piece, so that nothing shines through between two.
        if (pieces.size() > before) pieces.back().lines.front().push_back(end);
        pieces.push_back({{{begin}}, width, color, 1.0, false, view.area});
      }
      pieces.back().lines.front().push_back(end);
    };
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double from = values.GetComponent(line[k], 0), to = values.GetComponent(line[k + 1], 0);
      const Eigen::Vector2d begin = onPage(lines, line[k], view), end = onPage(lines, line[k + 1], view);
      const double parts = std::clamp(std::ceil(std::abs(to - from) / step), 1.0, kStepsOfRange);
      for (double part = 0.0; part < parts; ++part)
        add(begin + part / parts * (end - begin), begin + (part + 1.0) / parts * (end - begin),
            scale.color(std::lerp(from, to, (part + 0.5) / parts)));
    }
  }
  return pieces;
}

PageRegion pageRegion(vtkPolyData& cells, const View& view, const Color& color) {
  return {loopsOf(*bordersOf(*joined(cells)), view), color, view.area};
}

std::vector<PageRegion> coloredPageRegions(vtkPolyData& cells, const View& view, const ColorScale& scale,
                                           int bands) {
  const auto [low, high] = scale.range();
  const double band = (high - low) / bands;
  const auto colorOf = [&, from = low](int number) { return scale.color(from + (number + 0.5) * band); };
  const auto whole = joined(cells);
  const auto borders = bordersOf(*whole);
  // Where a value is reached: along its line, and along the part of the borders with higher ones.
  vtkNew<vtkContourFilter> line;
  line->SetInputData(whole);
  line->UseScalarTreeOn();
  line->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkClipPolyData> above;
  above->SetInputData(borders);
  above->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(line->GetOutputPort());
  both->AddInputConnection(above->GetOutputPort());
  std::vector<PageRegion> regions{{loopsOf(*borders, view), colorOf(0), view.area}};
  for (int number = 1; number < bands; ++number) {
    line->SetValue(0, low + number * band);
    above->SetValue(low + number * band);
    both->Update();
    std::vector<PagePoints> loops = loopsOf(*both->GetOutput(), view);
    if (loops.empty()) break;
    regions.push_back({std::move(loops), colorOf(number), view.area});
  }
  return regions;
}

void addPageAreas(PageSketch& sketch, vtkPolyData& edges, const View& view, const Color& area,
                  const Color& edge, double width) {
  for (const PagePoints& arrow : placed(edges, view)) {
    sketch.shapes.emplace_back(PageArea{arrow, area, view.area});
    sketch.shapes.emplace_back(PageLines{{arrow}, width, edge, 1.0, true, view.area});
  }
}

}  // namespace burnish
