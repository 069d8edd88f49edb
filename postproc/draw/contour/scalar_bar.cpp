#include "postproc/draw/contour/scalar_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/place_marks.h"

namespace burnish {
namespace {

using Anchor = Overlay::Anchor;
using Direction = ScalarBar::Direction;

// Measures as parts of the text size.
constexpr double kLabelSize = 0.9;
constexpr double kEndSize = 0.85;
constexpr double kBarDepth = 1.0;
constexpr double kTick = 0.35;
constexpr double kGap = 0.3;
constexpr double kTitleGap = 0.75;
constexpr double kTitleDepth = 1.05;  // ascent and index of a line
constexpr double kEndGap = 0.85;
constexpr double kSmallestTitle = 0.6;
constexpr double kArrow = 1.2;
constexpr double kEndLine = 1.2;  // from line to line at an end

// As long as most numbers are at ticks, at arrows and at the ends.
constexpr const char *kLongLabel = "−0.00", *kLongLimit = "≥ −0.0000", *kLongEnd = "max −0.0000";

constexpr double kGapsLine = 1.7;  // from what stands before the box of places without values to its foot
constexpr double kBoxGap = 0.45;   // from it to its words
constexpr const char* kGapsWords = "no value";

constexpr int kEndDigits = 4;
constexpr double kRoundOff = 1e-9;  // of the range
constexpr double kVisible = 1e-3;   // of the range
constexpr double kTold = 0.02;      // the same, of the last digit

/// What stands in brackets behind the title: power of ten and unit.
RichText unitText(int exponent, const std::string& unit) {
  if (exponent == 0 && unit.empty()) return {};
  if (exponent == 0) return {{" [" + unit + "]"}};
  const std::string power = (exponent < 0 ? "−" : "") + std::to_string(std::abs(exponent));
  return {{" [10"}, {power, Script::Super}, {(unit.empty() ? "" : " " + unit) + "]"}};
}

PixelRect rounded(const PixelRect& r) {
  const double x = std::round(r.x), y = std::round(r.y);
  return {x, y, std::round(r.right()) - x, std::round(r.top()) - y};
}

}  // namespace

ScalarBar::ScalarBar(ColorScale scale, Texts texts, double textSize, const Theme& theme)
    : scale_(std::move(scale)),
      name_(std::move(texts.title)),
      title_(name_),
      states_(std::move(texts.states)),
      size_(textSize),
      even_(texts.even),
      bands_(texts.bands),
      constant_(texts.constant ? std::optional(texts.smallest) : std::nullopt),
      gaps_(texts.gaps),
      hasGapsRoom_(texts.gaps || texts.gapsRoom),
      ink_(theme.ink),
      titleStyle_{textSize, theme.ink, theme.font},
      labelStyle_{kLabelSize * textSize, theme.ink, theme.font},
      endStyle_{kEndSize * textSize, theme.softInk, theme.font} {
  if (!states_.empty()) return;
  const int exponent = makeTicks(scale_.range(), kMostTicks).exponent;
  unit_ = unitText(exponent, texts.unit);
  title_.insert(title_.end(), unit_.begin(), unit_.end());
  const double slack = kRoundOff * (scale_.range()[1] - scale_.range()[0]);
  using Extremes = std::array<double, 2>;
  const Extremes own{texts.smallest, texts.largest};
  const auto text = [&](const std::string& before, double value, const Extremes& of) {
    if (std::isnan(of[0])) return RichText{};
    // Other ranges have other powers of ten.
    const std::array<double, 2> range = even_ && of != own ? widened(of) : scale_.range();
    const double extent = range[1] - range[0], power = std::pow(10.0, makeTicks(range, kMostTicks).exponent);
    // No digits that cannot be seen.
    const double spread = of[1] - of[0], seen = isOneValue(of) ? extent : std::min(spread, extent);
    const double smallestStep = std::pow(10.0, std::floor(std::log10(kVisible * seen)));
    const double rounded = std::round(value / smallestStep) * smallestStep;
    // More of them where all values are alike in the first ones.
    const int order = decimalExponent(rounded);
    const bool areAlike = std::pow(10.0, order + 1 - kEndDigits) > kTold * seen;
    const int needed = areAlike ? order - decimalExponent(smallestStep) : kEndDigits;
    return RichText{{before + numberText(rounded / power, std::max(kEndDigits, needed))}};
  };
  std::vector<Extremes> all = texts.together;
  all.push_back(own);
  const auto endAt = [&](std::size_t k, const char* name, const char* sign, const char* beyond) {
    const double limit = scale_.range()[k];
    const auto passes = [&](const Extremes& of) { return endsPassed(scale_.range(), of)[k]; };
    const auto extreme = [&](const Extremes& of) {
      return text((texts.marked ? sign : "") + std::string(name), of[k], of);
    };
    End end{extreme(own), text(beyond, limit, scale_.range()), passes(own)};
    const auto isAtLimit = [&](const Extremes& of) { return std::abs(of[k] - limit) <= slack; };
    const auto isElsewhere = [&](const Extremes& of) { return !std::isnan(of[k]) && !isAtLimit(of); };
    // Of scales that stand together all have the numbers that one of them needs.
    end.isTold = end.passed || (even_ ? isAtLimit(own) : std::ranges::none_of(all, isElsewhere));
    end.hasArrow = end.passed || (even_ && texts.arrows[k]);
    for (const Extremes& of : all) {
      if (!even_) end.hasArrow = end.hasArrow || passes(of);  // in their own ranges others pass other ends
      end.longest = std::max(end.longest, textWidth(extreme(of), endStyle_));
    }
    return end;
  };
  low_ = endAt(0, "min ", kSmallestSign, "≤ ");
  high_ = endAt(1, "max ", kLargestSign, "≥ ");
  if (!constant_) return;
  low_.extreme = {{text("", *constant_, own).front().text + " everywhere"}};
  high_.extreme = {};
  if (texts.together.empty()) low_.longest = high_.longest = 0.0;
  low_.longest = std::max(low_.longest, textWidth(low_.extreme, endStyle_));
}

double ScalarBar::depth(Direction direction, double length) const {
  const double besideLabels = size_ * (kBarDepth + kTick + kGap + kTitleGap + kTitleDepth);
  if (direction == Direction::Right) return besideLabels + capitalHeight(labelStyle_) + gapsHeight();
  const double withLabels = std::max(gapsWidth(), besideLabels + longestLabel(ticksUp(barLengthUp(length))));
  if (!reachesEnds(fittedTitle(length), length)) return std::max(withLabels, longestEnd());
  return std::max(withLabels, longestEnd() + size_ * (kTitleGap + kTitleDepth));
}

double ScalarBar::gapsHeight() const {
  return hasGapsRoom_ ? size_ * kGapsLine : 0.0;
}

double ScalarBar::gapsWidth() const {
  if (!hasGapsRoom_) return 0.0;
  return size_ * (kBarDepth + kBoxGap) + textWidth({{kGapsWords}}, endStyle_);
}

/// corner: the lower left one of the box.
void ScalarBar::drawGaps(Overlay& overlay, FlatShapes& shapes, const Eigen::Vector2d& corner) const {
  if (!gaps_) return;
  const PixelRect box = rounded({corner.x(), corner.y(), kBarDepth * size_, capitalHeight(endStyle_)});
  overlay.addStripes(box, {*gaps_}, Direction::Right);
  const double left = box.x - 0.5, right = box.right() + 0.5, low = box.y - 0.5, top = box.top() + 0.5;
  shapes.addPolyline({{left, low}, {right, low}, {right, top}, {left, top}, {left, low}}, lineWidth(), ink_);
  overlay.addText({{kGapsWords}}, {box.right() + size_ * kBoxGap, box.y}, endStyle_);
}

double ScalarBar::longestEnd() const {
  const double longest = std::max(low_.longest, high_.longest);
  return even_ ? std::max(longest, textWidth({{kLongEnd}}, endStyle_)) : longest;
}

FittedText ScalarBar::fittedTitle(double length) const {
  return fitName(name_, unit_, titleStyle_, length, kSmallestTitle * size_);
}

bool ScalarBar::reachesEnds(const FittedText& title, double length) const {
  return textWidth(title.text, title.style) > barLengthUp(length);
}

void ScalarBar::draw(Overlay& overlay, FlatShapes& shapes, const PixelRect& space,
                     Direction direction) const {
  if (direction == Direction::Up)
    drawUp(overlay, shapes, space);
  else
    drawAcross(overlay, shapes, space);
}

void ScalarBar::drawUp(Overlay& overlay, FlatShapes& shapes, const PixelRect& space) const {
  const double endText = size_ * kEndGap + capitalHeight(endStyle_);
  PixelRect bar = rounded({space.x, space.y + gapsHeight() + endText + (low_.hasArrow ? kArrow * size_ : 0.0),
                           kBarDepth * size_, barLengthUp(space.height)});
  const Ticks ticks = ticksUp(bar.height);
  const FittedText title = fittedTitle(space.height);
  const double besideBar = size_ * (kTick + kGap), withLabels = bar.width + besideBar + longestLabel(ticks);
  // A title that is longer than the bar has the texts at its ends before it: they end where the labels do at most.
  const bool isLong = reachesEnds(title, space.height);
  if (isLong) bar.x += std::round(std::max(0.0, longestEnd() - withLabels));
  drawFrameAndTicks(overlay, shapes, bar, Direction::Up, ticks);
  const double labelStart = bar.right() + besideBar, labelHeight = capitalHeight(labelStyle_);
  for (std::size_t k = 0; k < ticks.values.size(); ++k)
    overlay.addText({{ticks.labels[k]}},
                    {labelStart, bar.y + along(ticks.values[k]) * bar.height - labelHeight / 2}, labelStyle_);
  const double arrow = kArrow * size_;
  if (high_.passed)
    overlay.addText(high_.limit, {labelStart, bar.top() + arrow - labelHeight / 2}, labelStyle_);
  if (low_.passed) overlay.addText(low_.limit, {labelStart, bar.y - arrow - labelHeight / 2}, labelStyle_);

  const double labelEnd = labelStart + longestLabel(ticks);
  const double baseline = labelEnd + size_ * kTitleGap + capitalHeight(title.style);
  const double middle =
      bar.center().y() + (high_.hasArrow ? arrow / 2 : 0.0) - (low_.hasArrow ? arrow / 2 : 0.0);
  overlay.addText(title.text, {baseline, middle}, title.style, Anchor::Middle, Direction::Up);
  const double endGap = size_ * kEndGap;
  const auto startOf = [&](const RichText& text) {
    return isLong ? std::min(bar.x, labelEnd - textWidth(text, endStyle_)) : bar.x;
  };
  overlay.addText(high_.extreme, {startOf(high_.extreme), bar.top() + (high_.passed ? arrow : 0.0) + endGap},
                  endStyle_);
  overlay.addText(
      low_.extreme,
      {startOf(low_.extreme), bar.y - (low_.passed ? arrow : 0.0) - endGap - capitalHeight(endStyle_)},
      endStyle_);
  drawGaps(overlay, shapes, {bar.x, space.y});
}

void ScalarBar::drawAcross(Overlay& overlay, FlatShapes& shapes, const PixelRect& space) const {
  const double left = endAcross(false), right = endAcross(true);
  const PixelRect bar = rounded(
      {space.x + left, space.top() - kBarDepth * size_, space.width - left - right, kBarDepth * size_});
  const Ticks ticks = ticksAcross(bar.width);
  drawFrameAndTicks(overlay, shapes, bar, Direction::Right, ticks);
  const double labelBase = bar.y - size_ * (kTick + kGap) - capitalHeight(labelStyle_);
  for (std::size_t k = 0; k < ticks.values.size(); ++k)
    overlay.addText({{ticks.labels[k]}}, {bar.x + along(ticks.values[k]) * bar.width, labelBase}, labelStyle_,
                    Anchor::Middle);
  const FittedText title = fittedTitle(space.width);
  const double baseline = labelBase - size_ * kTitleGap - capitalHeight(title.style);
  overlay.addText(title.text, {space.center().x(), baseline}, title.style, Anchor::Middle);
  drawEndAcross(overlay, bar, false, space.x);
  drawEndAcross(overlay, bar, true, space.right());
  drawGaps(overlay, shapes, {space.center().x() - gapsWidth() / 2.0, space.y});
}

/// edge: where the text ends, away from the bar.
void ScalarBar::drawEndAcross(Overlay& overlay, const PixelRect& bar, bool high, double edge) const {
  const End& end = high ? high_ : low_;
  const Anchor anchor = high ? Anchor::End : Anchor::Start;
  const double base = bar.center().y() - capitalHeight(endStyle_) / 2;
  if (end.passed) overlay.addText(end.limit, {edge, base}, endStyle_, anchor);
  overlay.addText(end.extreme, {edge, base - (end.passed ? kEndLine * size_ : 0.0)}, endStyle_, anchor);
}

void ScalarBar::drawArrow(FlatShapes& shapes, const PixelRect& bar, Direction direction, bool high) const {
  const Eigen::Vector2d along = direction == Direction::Up ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(1, 0);
  const Eigen::Vector2d across(along.y(), along.x());
  const Eigen::Vector2d end = high ? Eigen::Vector2d(bar.right(), bar.top()) : Eigen::Vector2d(bar.x, bar.y);
  const double inwards = high ? -1.0 : 1.0;
  const Eigen::Vector2d other = end + inwards * kBarDepth * size_ * across;
  const Eigen::Vector2d tip = (end + other) / 2 - inwards * kArrow * size_ * along;
  shapes.addConvexPolygon({end, other, tip}, high ? scale_.colors().back() : scale_.colors().front());
  shapes.addPolyline({end, tip, other}, lineWidth(), ink_);
}

void ScalarBar::drawFrameAndTicks(Overlay& overlay, FlatShapes& shapes, const PixelRect& bar,
                                  Direction direction, const Ticks& ticks) const {
  overlay.addStripes(bar, scale_.colors(), direction);
  // On the middles of pixels, where thin lines are crisp.
  const Eigen::Vector2d low(bar.x - 0.5, bar.y - 0.5), high(bar.right() + 0.5, bar.top() + 0.5);
  const Eigen::Vector2d lowRight(high.x(), low.y()), highLeft(low.x(), high.y());
  std::vector<Eigen::Vector2d> lines{low, lowRight, lowRight, high, high, highLeft, highLeft, low};
  for (const double value : ticks.values) {
    const bool up = direction == Direction::Up;
    const double place =
        std::floor((up ? bar.y : bar.x) + along(value) * (up ? bar.height : bar.width)) + 0.5;
    const Eigen::Vector2d foot = up ? Eigen::Vector2d(high.x(), place) : Eigen::Vector2d(place, low.y());
    lines.push_back(foot);
    lines.push_back(foot + size_ * kTick * (up ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, -1)));
  }
  if (low_.passed) drawArrow(shapes, bar, direction, false);
  if (high_.passed) drawArrow(shapes, bar, direction, true);
  overlay.addSegments(lines, lineWidth(), ink_);
}

Ticks ScalarBar::ticks(int most) const {
  if (states_.empty()) {
    if (constant_) return makeTickAt(*constant_, scale_.range(), kEndDigits);
    if (bands_ > 0) return makeTicksOfBands(scale_.range(), bands_, most);
    return withEnds(makeTicks(scale_.range(), most), most);
  }
  std::vector<double> values(states_.size());
  std::iota(values.begin(), values.end(), 0.0);
  return {values, states_};
}

Ticks ScalarBar::withEnds(Ticks ticks, int most) const {
  constexpr double kApart = 0.3, kOfStep = 0.5;  // of the bar, and of the smallest distance of its marks
  const double apart = ticks.values.size() > 1 ? kOfStep / most : kApart;
  for (const End* end : {&low_, &high_}) {
    if (end->isTold) continue;
    const bool isHigh = end == &high_;
    const double limit = scale_.range()[isHigh ? 1 : 0];
    if (!ticks.values.empty()) {
      const std::ptrdiff_t nearest = isHigh ? std::ssize(ticks.values) - 1 : 0;
      const double way = std::abs(along(ticks.values[static_cast<std::size_t>(nearest)]) - along(limit));
      if (way < kRoundOff) continue;
      if (way < apart) {
        ticks.values.erase(ticks.values.begin() + nearest);
        ticks.labels.erase(ticks.labels.begin() + nearest);
      }
    }
    const Ticks mark = makeTickAt(limit, scale_.range(), kEndDigits);
    ticks.values.insert(isHigh ? ticks.values.end() : ticks.values.begin(), limit);
    ticks.labels.insert(isHigh ? ticks.labels.end() : ticks.labels.begin(), mark.labels.front());
  }
  return ticks;
}

Ticks ScalarBar::ticksUp(double barLength) const {
  const int most = static_cast<int>(barLength / (2.4 * size_));
  return ticks(std::clamp(most, 2, kMostTicks));
}

Ticks ScalarBar::ticksAcross(double barLength) const {
  for (int most = kMostTicks; most > 2; --most) {
    Ticks marks = ticks(most);
    double spacing = barLength;
    for (std::size_t k = 1; k < marks.values.size(); ++k)
      spacing = std::min(spacing, (along(marks.values[k]) - along(marks.values[k - 1])) * barLength);
    if (longestLabel(marks) + 1.2 * size_ <= spacing) return marks;
  }
  Ticks few = ticks(2);
  if (few.values.size() == 3 && longestLabel(few) + 0.6 * size_ > barLength / 2.0) {
    few.values.erase(few.values.begin() + 1);
    few.labels.erase(few.labels.begin() + 1);
  }
  return few;
}

double ScalarBar::barLengthUp(double length) const {
  const int arrows = (low_.hasArrow ? 1 : 0) + (high_.hasArrow ? 1 : 0);
  return length - gapsHeight() - 2.0 * (size_ * kEndGap + capitalHeight(endStyle_)) - arrows * kArrow * size_;
}

/// Room that an end takes beside a bar across.
double ScalarBar::endAcross(bool high) const {
  const End& end = high ? high_ : low_;
  if (!end.hasArrow) return end.longest + size_ * kEndGap;
  return std::max(end.longest, textWidth(end.limit, endStyle_)) + size_ * (kEndGap + kArrow);
}

double ScalarBar::longestLabel(const Ticks& ticks) const {
  double longest = even_ ? textWidth({{kLongLabel}}, labelStyle_) : 0.0;
  for (const std::string& label : ticks.labels)
    longest = std::max(longest, textWidth({{label}}, labelStyle_));
  for (const End& end : {low_, high_}) {
    if (!end.hasArrow) continue;
    longest = std::max(longest, textWidth(end.limit, labelStyle_));
    if (even_) longest = std::max(longest, textWidth({{kLongLimit}}, labelStyle_));
  }
  return longest;
}

double ScalarBar::lineWidth() const {
  return std::max(1.0, size_ / 20.0);
}

double ScalarBar::along(double value) const {
  return (value - scale_.range()[0]) / (scale_.range()[1] - scale_.range()[0]);
}

}  // namespace burnish
