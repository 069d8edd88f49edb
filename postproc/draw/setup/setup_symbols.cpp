#include "postproc/draw/setup/setup_symbols.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "postproc/draw/chart/chart_curves.h"

namespace burnish {
namespace {

using Eigen::Vector2d;
using Points = SetupSymbols::Points;

constexpr Color kFaint{150, 150, 150}, kFaintText{110, 110, 110};

// Measures as parts of the text size.
constexpr double kThin = 0.045, kThick = 0.075;
constexpr double kHead = 0.55, kHeadWidth = 0.36;
constexpr double kHatch = 0.55, kHatchSpacing = 0.5;
constexpr double kRoller = 0.42;
constexpr double kRollerSpacing = 1.3;
constexpr double kLoadArrow = 1.9, kLoadSpacing = 1.5;
constexpr double kForceArrow = 3.0;
constexpr double kBeside = 0.5, kArrowAlong = 1.25;  // from a line to arrows along it, and their length

// Parts of the largest of a row of arrows: shorter ones are left out, or drawn longer to show their heads.
constexpr double kSmallestLoad = 0.1, kShortestLoad = 0.4;
constexpr double kAlong = 0.2;     // sine of the angle up to which an arrow goes along a line
constexpr double kSlanted = 0.35;  // of the angle to both axes from which a line is neither flat nor upright

constexpr double kExtension = 0.35;
constexpr double kTextGap = 0.35;
constexpr double kAxis = 1.7;
constexpr double kDash = 0.4;

/// A place on a polyline, the outward normal there and the number of the next point.
struct Station {
  Vector2d at, outward;
  std::size_t point;
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
    result.push_back({line[piece - 1] + part * (line[piece] - line[piece - 1]), outward[piece], piece});
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

SetupSymbols::SetupSymbols(PageSketch& sketch, const std::array<int, 2>& size, double textSize)
    : size_(size[0], size[1]),
      shapes_(sketch),
      overlay_(sketch),
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

void SetupSymbols::addLoad(const Points& line, const Points& outward, const Points& vectors,
                           const std::string& label) {
  double largest = 0.0;
  for (const Vector2d& vector : vectors) largest = std::max(largest, vector.norm());
  if (largest == 0.0) return;
  const std::vector<Station> row = stations(line, outward, kLoadSpacing * text_.size);
  const bool isAlong = std::all_of(row.begin(), row.end(), [&](const Station& s) {
    return std::abs(vectors[s.point].dot(s.outward)) <= kAlong * vectors[s.point].norm();
  });
  for (const Station& s : row) addLoadArrow(s.at, s.outward, vectors[s.point] / largest, isAlong);
  const Station middle = stations(line, outward, 1e9).front();
  addLoadText(label, middle.at, middle.outward);
}

void SetupSymbols::addLoadText(const std::string& label, const Vector2d& at, const Vector2d& outward) {
  Vector2d middle = at + (1.15 * kLoadArrow + 0.75) * text_.size * outward;
  const bool slanted = outward.cwiseAbs().minCoeff() > kSlanted;
  const bool sideways = !slanted && std::abs(outward.x()) > std::abs(outward.y());
  Vector2d half(textWidth({{label}}, text_) / 2, text_.size / 2);
  if (slanted) middle.x() += std::copysign(half.x(), outward.x());
  if (sideways) std::swap(half.x(), half.y());
  half.array() += kTextGap * text_.size;
  middle = middle.cwiseMin(size_ - half).cwiseMax(half);
  addText({{label}}, middle, Overlay::Anchor::Middle,
          sideways ? Overlay::Direction::Up : Overlay::Direction::Right);
}

void SetupSymbols::addLoadArrow(const Vector2d& at, const Vector2d& outward, const Vector2d& vector,
                                bool isAlong) {
  const double share = vector.norm();
  if (share < kSmallestLoad) return;
  const Vector2d direction = vector / share;
  const double against = -direction.dot(outward);
  const double length = std::max(share, kShortestLoad) * (isAlong ? kArrowAlong : kLoadArrow) * text_.size;
  Vector2d tail = at + 0.15 * length * direction;
  if (isAlong)
    tail = at + kBeside * text_.size * outward - length / 2 * direction;
  else if (against > 0.0)
    tail = at - length * direction;
  addArrow(tail, tail + (!isAlong && against > 0.0 ? 0.95 : 1.0) * length * direction);
}

void SetupSymbols::addForce(const Vector2d& middle, const Vector2d& direction, const std::string& label) {
  const Vector2d half = kForceArrow / 2 * text_.size * direction;
  addArrow(middle - half, middle + half);
  // So far that the label, as wide as it is, ends above or below the arrow, or beside it.
  constexpr double kGap = 0.6;
  const double before =
      std::min(kGap * text_.size / std::abs(direction.y()),
               kGap * text_.size + textWidth({{label}}, text_) / 2 / std::abs(direction.x()));
  addText({{label}}, middle - half - before * direction);
}

void SetupSymbols::addForceTo(const Vector2d& tip, const Vector2d& direction, const std::string& label) {
  addForce(tip - kForceArrow / 2 * text_.size * direction, direction, label);
}

void SetupSymbols::addTurn(const Vector2d& center, double radius, bool counterclockwise,
                           const std::string& label) {
  constexpr int kBegin = 100, kEnd = 190, kStep = 3;  // degrees
  Points arc;
  for (int angle = kBegin; angle <= kEnd; angle += kStep) {
    const double a = angle * std::numbers::pi / 180.0;
    arc.push_back(center + radius * Vector2d(std::cos(a), std::sin(a)));
  }
  if (!counterclockwise) std::reverse(arc.begin(), arc.end());
  const Vector2d tip = arc.back(), direction = (tip - arc[arc.size() - 2]).normalized();
  shapes_.addPolyline({arc.begin(), arc.end() - 1}, thick_, kInk);
  addHead(tip + 0.5 * kHead * text_.size * direction, direction);
  const Vector2d beyond = center + (radius + kTextGap * text_.size) * Vector2d(-1.0, 1.0).normalized();
  addText({{label}}, beyond + Vector2d(-0.2, 0.4) * text_.size, Overlay::Anchor::End);
}

void SetupSymbols::addDimension(const Vector2d& begin, const Vector2d& end, const Vector2d& offset,
                                const std::string& label) {
  const Vector2d away = offset.normalized(), along = (end - begin).normalized();
  const Vector2d from = begin + offset, to = end + offset;
  const double size = text_.size;
  shapes_.addSegments({begin + 0.25 * size * away, from + kExtension * size * away, end + 0.25 * size * away,
                       to + kExtension * size * away, from, to},
                      thin_, kInk);
  const bool upright = std::abs(along.y()) > std::abs(along.x());
  const double length = (to - from).norm();
  const bool isShort = length < 2.5 * kHead * size;  // heads from outside
  if (isShort)
    shapes_.addSegments({from - 1.5 * kHead * size * along, from, to, to + 1.5 * kHead * size * along}, thin_,
                        kInk);
  addHead(from, isShort ? along : Vector2d(-along));
  addHead(to, isShort ? Vector2d(-along) : along);
  const bool isLong = textWidth({{label}}, text_) > length;
  if (isLong && !upright)
    return addText({{label}}, to + (isShort ? 2.0 : 1.0) * kHead * size * along, Overlay::Anchor::Start);
  const double lift = (kTextGap + (isLong ? kExtension : 0.0)) * size + capitalHeight(size) / 2;
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
  addDashed(line, {kDash, kDash}, kFaint);
}

void SetupSymbols::addAxisLine(const Vector2d& begin, const Vector2d& end, const std::string& label) {
  addDashed({begin, end}, {4.0 * kDash, 0.6 * kDash, 0.4 * kDash, 0.6 * kDash}, kInk);
  addText({{label}}, end - Vector2d(0.4, 0.4) * text_.size, Overlay::Anchor::End);
}

void SetupSymbols::addDashed(const Points& line, const std::vector<double>& pattern, const Color& color) {
  std::vector<double> lengths = pattern;
  for (double& length : lengths) length *= text_.size;
  for (const Polyline& dash : dashes(line, lengths, 0.0)) shapes_.addPolyline(dash, thin_, color);
}

void SetupSymbols::addText(const RichText& text, const Vector2d& middle, Overlay::Anchor anchor,
                           Overlay::Direction direction) {
  addText(text, middle, text_, anchor, direction);
}

void SetupSymbols::addFaintText(const std::string& text, const Vector2d& middle) {
  addText({{text}}, middle, {text_.size, kFaintText}, Overlay::Anchor::Middle, Overlay::Direction::Right);
}

void SetupSymbols::addText(const RichText& text, const Vector2d& middle, const TextStyle& style,
                           Overlay::Anchor anchor, Overlay::Direction direction) {
  const double half = capitalHeight(style.size) / 2;
  overlay_.addText(text,
                   direction == Overlay::Direction::Right ? Vector2d(middle - Vector2d(0, half))
                                                          : Vector2d(middle + Vector2d(half, 0)),
                   style, anchor, direction);
}

void SetupSymbols::addHead(const Vector2d& tip, const Vector2d& direction) {
  const Vector2d back = tip - kHead * text_.size * direction;
  const Vector2d side = kHeadWidth / 2 * text_.size * turned(direction);
  shapes_.addConvexPolygon({tip, back + side, back - side}, kInk);
}

}  // namespace burnish
