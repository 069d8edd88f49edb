#include "postproc/draw/setup_symbols.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burnish {
namespace {

using Eigen::Vector2d;
using Points = SetupSymbols::Points;

constexpr Color kInk{20, 20, 20};
constexpr Color kFaint{150, 150, 150};

// Measures as parts of the text size.
constexpr double kThin = 0.045, kThick = 0.075;
constexpr double kHead = 0.55, kHeadWidth = 0.36;
constexpr double kHatch = 0.55, kHatchSpacing = 0.5;
constexpr double kRoller = 0.42;
constexpr double kRollerSpacing = 1.3;
constexpr double kLoadArrow = 1.9, kLoadSpacing = 1.5;
constexpr double kExtension = 0.35;
constexpr double kTextGap = 0.35;
constexpr double kAxis = 1.7;
constexpr double kDash = 0.4;

/// A point of a polyline and the outward normal there.
struct Station {
  Vector2d at, outward;
};

/// Stations at equal distances, half a distance from both ends.
std::vector<Station> stations(const Points& line, const Points& outward, double spacing) {
  std::vector<double> length{0.0};
  for (std::size_t k = 1; k < line.size(); ++k)
    length.push_back(length.back() + (line[k] - line[k - 1]).norm());
  const int count = std::max(1, static_cast<int>(std::lround(length.back() / spacing)));
  std::vector<Station> result;
  std::size_t piece = 1;
  for (int i = 0; i < count; ++i) {
    const double wanted = length.back() * (i + 0.5) / count;
    while (piece + 1 < line.size() && length[piece] < wanted) ++piece;
    const double part = (wanted - length[piece - 1]) / (length[piece] - length[piece - 1]);
    result.push_back({line[piece - 1] + part * (line[piece] - line[piece - 1]), outward[piece]});
  }
  return result;
}

Points moved(const Points& line, const Points& outward, double distance) {
  Points result;
  for (std::size_t k = 0; k < line.size(); ++k) result.push_back(line[k] + distance * outward[k]);
  return result;
}

Points circle(const Vector2d& center, double radius) {
  constexpr int corners = 48;
  Points points;
  for (int k = 0; k <= corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    points.push_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

Vector2d turned(const Vector2d& v) {
  return {-v.y(), v.x()};
}

}  // namespace

SetupSymbols::SetupSymbols(vtkRenderer& renderer, int scale, double textSize)
    : shapes_(renderer, scale),
      overlay_(renderer, scale),
      text_{textSize, kInk},
      thin_(std::max(0.8, kThin * textSize)),
      thick_(std::max(1.2, kThick * textSize)) {}

void SetupSymbols::addHatching(const Points& line, const Points& outward) {
  const double size = text_.size;
  Points strokes;
  for (const Station& s : stations(line, outward, kHatchSpacing * size)) {
    strokes.push_back(s.at + kHatch / 4 * size * turned(s.outward));
    strokes.push_back(s.at + kHatch * size * (s.outward - 0.75 * turned(s.outward)));
  }
  shapes_.addSegments(strokes, thin_, kInk);
  shapes_.addPolyline(line, thick_, kInk);
}

void SetupSymbols::addRollers(const Points& line, const Points& outward) {
  const double radius = kRoller / 2 * text_.size;
  for (const Station& s : stations(line, outward, kRollerSpacing * text_.size))
    shapes_.addPolyline(circle(s.at + (radius + thick_ / 2) * s.outward, radius), thin_, kInk);
  addHatching(moved(line, outward, 2.0 * radius + thick_), outward);
}

void SetupSymbols::addArrow(const Vector2d& tail, const Vector2d& tip) {
  const Vector2d direction = (tip - tail).normalized();
  shapes_.addPolyline({tail, tip - 0.8 * kHead * text_.size * direction}, thick_, kInk);
  addHead(tip, direction);
}

void SetupSymbols::addLoad(const Points& line, const Points& outward, const Vector2d& direction,
                           const std::string& label) {
  const double length = kLoadArrow * text_.size;
  for (const Station& s : stations(line, outward, kLoadSpacing * text_.size)) {
    const bool pushes = direction.dot(s.outward) < 0.0;
    const Vector2d tail = s.at + (pushes ? -length : 0.15 * length) * direction;
    addArrow(tail, tail + (pushes ? 0.95 : 1.0) * length * direction);
  }
  const Station middle = stations(line, outward, 1e9).front();
  const Vector2d beyond = middle.at + (1.15 * length + 0.75 * text_.size) * middle.outward;
  const bool sideways = std::abs(middle.outward.x()) > std::abs(middle.outward.y());
  addText({{label}}, beyond, Overlay::Anchor::Middle,
          sideways ? Overlay::Direction::Up : Overlay::Direction::Right);
}

void SetupSymbols::addDimension(const Vector2d& begin, const Vector2d& end, const Vector2d& offset,
                                const std::string& label) {
  const Vector2d away = offset.normalized(), along = (end - begin).normalized();
  const Vector2d from = begin + offset, to = end + offset;
  const double size = text_.size;
  shapes_.addSegments({begin + 0.25 * size * away, from + kExtension * size * away, end + 0.25 * size * away,
                       to + kExtension * size * away, from, to},
                      thin_, kInk);
  addHead(from, -along);
  addHead(to, along);
  const bool upright = std::abs(along.y()) > std::abs(along.x());
  const double lift = kTextGap * size + capitalHeight(size) / 2;
  addText({{label}}, (from + to) / 2 + lift * (upright ? Vector2d(-1, 0) : Vector2d(0, 1)),
          Overlay::Anchor::Middle, upright ? Overlay::Direction::Up : Overlay::Direction::Right);
}

void SetupSymbols::addRadius(const Vector2d& center, const Vector2d& rim, const std::string& label) {
  const Vector2d direction = (rim - center).normalized();
  shapes_.addPolyline({center, rim}, thin_, kInk);
  addHead(rim, direction);
  shapes_.addConvexPolygon(circle(center, 0.12 * text_.size), kInk);
  const bool right = direction.x() > 0.0;
  addText({{label}}, rim + kTextGap * text_.size * Vector2d(right ? 1.0 : -1.0, 1.0),
          right ? Overlay::Anchor::Start : Overlay::Anchor::End);
}

void SetupSymbols::addAxes(const Vector2d& origin) {
  const double length = kAxis * text_.size, beyond = length + 0.55 * text_.size;
  addArrow(origin, origin + Vector2d(length, 0));
  addArrow(origin, origin + Vector2d(0, length));
  addText({{"x"}}, origin + Vector2d(beyond, 0));
  addText({{"y"}}, origin + Vector2d(0, beyond));
}

void SetupSymbols::addDashes(const Points& line) {
  const double dash = kDash * text_.size;
  Points dashes;
  double walked = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double length = (line[k] - line[k - 1]).norm();
    const Vector2d along = (line[k] - line[k - 1]) / length;
    for (double at = 0.0; at < length;) {
      const bool drawn = std::fmod(walked + at, 2.0 * dash) < dash;
      const double next = std::min(length, at + dash - std::fmod(walked + at, dash) + 1e-9 * dash);
      if (drawn) dashes.insert(dashes.end(), {line[k - 1] + at * along, line[k - 1] + next * along});
      at = next;
    }
    walked += length;
  }
  shapes_.addSegments(dashes, thin_, kFaint);
}

void SetupSymbols::addText(const RichText& text, const Vector2d& middle, Overlay::Anchor anchor,
                           Overlay::Direction direction) {
  const double half = capitalHeight(text_.size) / 2;
  overlay_.addText(text,
                   direction == Overlay::Direction::Right ? Vector2d(middle - Vector2d(0, half))
                                                          : Vector2d(middle + Vector2d(half, 0)),
                   text_, anchor, direction);
}

void SetupSymbols::addHead(const Vector2d& tip, const Vector2d& direction) {
  const Vector2d back = tip - kHead * text_.size * direction;
  const Vector2d side = kHeadWidth / 2 * text_.size * turned(direction);
  shapes_.addConvexPolygon({tip, back + side, back - side}, kInk);
}

}  // namespace burnish
