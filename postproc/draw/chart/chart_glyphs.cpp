// VTK 9.1 reads UTF-8 only from a type of string that it declares deprecated.
#define VTK_DEPRECATION_LEVEL 0
#include "postproc/draw/chart/chart_glyphs.h"

#include <vtkIntArray.h>
#include <vtkPath.h>
#include <vtkSmartPointer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
#include <vtkUnicodeString.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace burnish {
namespace {

constexpr int kResolution = 72;  ///< points per inch: a font size is in pixels
constexpr int kCurveSteps = 6;

vtkSmartPointer<vtkPath> pathOf(const std::string& text, vtkTextProperty& property) {
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
  const vtkUnicodeString unicode = vtkUnicodeString::from_utf8(text);
#else
  const vtkStdString unicode = text;
#endif
  const auto path = vtkSmartPointer<vtkPath>::New();
  vtkTextRenderer::GetInstance()->StringToPath(&property, unicode, path, kResolution);
  return path;
}

/// The curve of Bernstein polynomials between the first and the last of three or four points, without the
/// first.
template <std::size_t N>
void addCurve(const std::array<Eigen::Vector2d, N>& control, Polyline& line) {
  for (int i = 1; i <= kCurveSteps; ++i) {
    const double t = static_cast<double>(i) / kCurveSteps;
    std::array<Eigen::Vector2d, N> points = control;
    for (std::size_t left = N - 1; left > 0; --left)
      for (std::size_t k = 0; k < left; ++k) points[k] += t * (points[k + 1] - points[k]);
    line.push_back(points[0]);
  }
}

/// The closed outlines of a path: conic curves come from TrueType fonts, cubic ones from PostScript.
std::vector<Polyline> outlines(vtkPath& path) {
  std::vector<Polyline> result;
  const auto point = [&](vtkIdType k) {
    const double* p = path.GetPoint(k);
    return Eigen::Vector2d(p[0], p[1]);
  };
  for (vtkIdType k = 0; k < path.GetNumberOfPoints(); ++k) {
    const int code = path.GetCodes()->GetValue(k);
    if (code == vtkPath::MOVE_TO) {
      result.push_back({point(k)});
    } else if (code == vtkPath::CONIC_CURVE) {
      addCurve<3>({result.back().back(), point(k), point(k + 1)}, result.back());
      k += 1;
    } else if (code == vtkPath::CUBIC_CURVE) {
      addCurve<4>({result.back().back(), point(k), point(k + 1), point(k + 2)}, result.back());
      k += 2;
    } else {
      result.back().push_back(point(k));
    }
  }
  return result;
}

double signedArea(const Polyline& outline) {
  double area = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d &a = outline[k], &b = outline[(k + 1) % outline.size()];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return area;
}

bool encloses(const Polyline& outline, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d &a = outline[k], &b = outline[(k + 1) % outline.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// Joins a hole to the outline around it where they are nearest: there the cut lies within the letter.
Polyline joined(Polyline outer, Polyline hole) {
  double best = std::numeric_limits<double>::infinity();
  auto from = outer.begin(), to = hole.begin();
  for (auto a = outer.begin(); a != outer.end(); ++a) {
    for (auto b = hole.begin(); b != hole.end(); ++b) {
      if ((*a - *b).squaredNorm() >= best) continue;
      best = (*a - *b).squaredNorm();
      from = a;
      to = b;
    }
  }
  std::rotate(hole.begin(), to, hole.end());
  hole.push_back(hole.front());
  hole.push_back(*from);
  outer.insert(std::next(from), hole.begin(), hole.end());
  return outer;
}

}  // namespace

std::vector<Polyline> glyphPolygons(const std::string& text, vtkTextProperty& property) {
  std::vector<Polyline> all = outlines(*pathOf(text, property)), letters, holes;
  // Outer outlines run one way and holes the other; which one depends on the kind of font.
  double largest = 0.0;
  for (const Polyline& outline : all)
    if (std::abs(signedArea(outline)) > std::abs(largest)) largest = signedArea(outline);
  for (Polyline& outline : all) {
    const bool isHole = signedArea(outline) * largest < 0.0;
    (isHole ? holes : letters).push_back(std::move(outline));
  }
  for (Polyline& hole : holes)
    for (Polyline& letter : letters) {
      if (!encloses(letter, hole.front())) continue;
      letter = joined(std::move(letter), std::move(hole));
      break;
    }
  return letters;
}

}  // namespace burnish
