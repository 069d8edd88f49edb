#include "postproc/probe/laid_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/core/interruption.h"
#include "engine/nurbs/closest_point.h"
#include "postproc/probe/body_locator.h"

namespace burnish {
namespace {

constexpr int kMostCorrections = 20;       // of the place at a length
constexpr double kSameLength = 1e-10;      // of a piece: what remains to be corrected
constexpr double kLineResolution = 1e-13;  // of the line: where the face ends
constexpr int kMostJumpHalvings = 40;      // of a part of the line in which the nearest point may jump
constexpr int kMostCuts =
    4000;  // of all of the line: on the axis of a face of revolution it would jump anywhere
constexpr double kUneven = 0.75;     // share of one half of such a part in the way on the face
constexpr double kTiltBeside = 0.3;  // tilt of a way to the border from a point that is not beyond it
constexpr double kFollowing = 0.5;   // share of such a part of the line that the border at least goes with it
constexpr double kPoint = 1e-9;      // of the size of the face: the shortest curve
constexpr double kShortestJump = 1e-12;  // likewise

/// Length of a short arc from its chord and those of its halves, by Richardson's extrapolation.
double arcThrough(const Eigen::Vector3d& begin, const Eigen::Vector3d& middle, const Eigen::Vector3d& end) {
  return (4.0 * ((middle - begin).norm() + (end - middle).norm()) - (end - begin).norm()) / 3.0;
}

/// A line that runs along a face: "0.1,1,0.5:0.9,1,0.5".
std::string lineOn(const Patch<2, 3>& face) {
  const Eigen::Vector3d middle = face.position(parameterGrid(face.basis(), {0.5}).front());
  Eigen::Vector3d begin = middle, end = middle;
  for (int d = 0; d < 2; ++d) {
    const auto at = [&](double share) {
      Eigen::Vector2d xi = parameterGrid(face.basis(), {0.5}).front();
      xi(d) = face.basis().direction(d).parameterAt(share);
      return face.position(xi);
    };
    if ((at(0.9) - at(0.1)).norm() <= (end - begin).norm()) continue;
    begin = at(0.1);
    end = at(0.9);
  }
  const double unit = std::pow(10.0, std::floor(std::log10((end - begin).norm())) - 3.0);
  const auto text = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d rounded = unit * (point / unit).array().round() + 0.0;  // no -0
    return fmt::format("{:.6g}", fmt::join(rounded, ","));
  };
  return text(begin) + ":" + text(end);
}

}  // namespace

LaidLine::LaidLine(const Patch<2, 3>& face, const Eigen::Vector3d& begin, const Eigen::Vector3d& end,
                   int points, double window)
    : nearest_(face), begin_(begin), direction_((end - begin).stableNormalized()) {
  const double whole = (end - begin).stableNorm();
  // Twice the width reaches as far as the window on faces up to 75 degrees steep; beyond twice its size there is no face.
  const double beyond = std::min(2.0 * window, 2.0 * nearest_.box().diagonal().norm());
  add(-beyond, 0.0, points);
  const double before = reach();
  add(0.0, whole, points);
  length_ = reach() - before;
  add(whole, whole + beyond, points);
  for (Piece& piece : pieces_) piece.begin -= before;
  const bool isOnFace = std::ranges::any_of(pieces_, [](const Piece& piece) { return !piece.isGap; });
  if (isOnFace && length_ <= kPoint * nearest_.box().diagonal().norm())
    throw Error("line: found one across the face, which is a point on it; expected one along the face");
}

std::array<double, 2> LaidLine::ofWindows() const {
  return {pieces_.front().begin, reach()};
}

LaidLine::Place LaidLine::at(double length) const {
  const auto above = std::ranges::upper_bound(pieces_, length, {}, &Piece::begin);
  const Piece& piece = above == pieces_.begin() ? pieces_.front() : *std::prev(above);
  const double wanted = std::clamp(length - piece.begin, 0.0, piece.length);
  const auto share = [&] { return piece.length > 0.0 ? wanted / piece.length : 0.0; };
  if (piece.isGap)
    return {std::nullopt, begin_ + std::lerp(piece.from.along, piece.to.along, share()) * direction_};
  // Secants through the ends of what is left, of which one that stays twice counts half.
  double low = piece.from.along, high = piece.to.along, belowLow = -wanted, aboveHigh = piece.length - wanted;
  Laid here = belowLow < 0.0 ? piece.to : piece.from;
  int stays = 0;  // low: -1, high: 1
  for (int k = 0; k < kMostCorrections && belowLow < 0.0 && aboveHigh > 0.0; ++k) {
    here = lay(low - belowLow * (high - low) / (aboveHigh - belowLow));
    const Laid middle = lay(0.5 * (piece.from.along + here.along));
    const double error =
        arcThrough(piece.from.nearest.point, middle.nearest.point, here.nearest.point) - wanted;
    if (std::abs(error) <= kSameLength * piece.length) break;
    const int staying = error < 0.0 ? 1 : -1;
    (error < 0.0 ? low : high) = here.along;
    (error < 0.0 ? belowLow : aboveHigh) = error;
    if (staying == stays) (error < 0.0 ? aboveHigh : belowLow) *= 0.5;
    stays = staying;
  }
  if (here.side.where == Where::Beyond) return {std::nullopt, here.onLine};
  return {here.nearest.xi, here.nearest.point};
}

std::string LaidLine::where(const std::string& face) const {
  return fmt::format("across from face {}, which lies between {} and {}", face,
                     pointText(nearest_.box().min()), pointText(nearest_.box().max()));
}

LaidLine::Laid LaidLine::lay(double along) const {
  const Eigen::Vector3d onLine = begin_ + along * direction_;
  const NearestOnFace<3>::Found nearest = nearest_(onLine);
  Side side;
  if (nearest.isFoot)
    side.where = Where::Across;
  else if (nearest.tilt <= kTiltBeside)
    side = {Where::Beside, nearest.ends};
  return {along, onLine, nearest, side};
}

void LaidLine::add(double from, double to, int points) {
  if (!(to > from)) return;
  Laid before = lay(from);
  for (int k = 1; k < points; ++k) {
    throwIfInterrupted();
    Laid next = lay(k + 1 == points ? to : std::lerp(from, to, k / (points - 1.0)));
    add(before, next, 0);
    before = std::move(next);
  }
}

/// Cut in halves again where one of them makes most of the way on the face, as long as the nearest point may jump in it.
void LaidLine::add(const Laid& from, const Laid& to, int halvings) {
  if (from.side != to.side) return addChange(from, to, halvings);
  const double ofLine = to.along - from.along;
  if (from.side.where == Where::Beyond) return addPiece(from, to, ofLine, true);
  const Laid middle = lay(0.5 * (from.along + to.along));
  const Eigen::Vector3d &begin = from.nearest.point, &between = middle.nearest.point, &end = to.nearest.point;
  const double first = (between - begin).norm(), second = (end - between).norm();
  const bool isShort = first + second <= kShortestJump * nearest_.box().diagonal().norm();
  const bool isSmooth =
      middle.side == from.side && (isShort || std::max(first, second) <= kUneven * (first + second));
  if (!isSmooth && halvings < kMostJumpHalvings && cuts_ < kMostCuts) {
    ++cuts_;
    add(from, middle, halvings + 1);
    return add(middle, to, halvings + 1);
  }
  if (!isSmooth) return addPiece(from, to, (end - begin).norm(), true);
  const double length = arcThrough(begin, between, end);
  const bool isAway = from.side.where == Where::Beside && length < kFollowing * ofLine;
  addPiece(from, to, isAway ? ofLine : length, isAway);
}

/// With the place where the line gets to another side, up to rounding.
void LaidLine::addChange(const Laid& from, const Laid& to, int halvings) {
  if (++cuts_ > kMostCuts) return addPiece(from, to, to.along - from.along, true);
  Laid before = from, behind = to;
  const double resolution = kLineResolution * std::max({std::abs(from.along), std::abs(to.along)});
  while (behind.along - before.along > resolution) {
    Laid middle = lay(0.5 * (before.along + behind.along));
    if (middle.along <= before.along || middle.along >= behind.along) break;
    (middle.side == from.side ? before : behind) = std::move(middle);
  }
  const bool isBorder = before.side.where == Where::Beyond || behind.side.where == Where::Beyond;
  add(from, before, halvings);
  addPiece(before, behind,
           isBorder ? behind.along - before.along : (behind.nearest.point - before.nearest.point).norm(),
           isBorder);
  add(behind, to, halvings);
}

void LaidLine::addPiece(const Laid& from, const Laid& to, double length, bool isGap) {
  pieces_.push_back({from, to, reach(), length, isGap});
}

double LaidLine::reach() const {
  return pieces_.empty() ? 0.0 : pieces_.back().begin + pieces_.back().length;
}

Error areaIsNoPath(const Patch<2, 3>& face, const std::string& name) {
  return Error(fmt::format(
      "face: a face of a body in space is an area, not a path; expected a line on it as well, such as line {}, or "
      "depth {}@X,Y,Z from a place on it into the body",
      lineOn(face), name));
}

Error planeFaceIsPath() {
  return Error("line: found beside a face of a plane body, which is a path itself; expected one of the two");
}

}  // namespace burnish
