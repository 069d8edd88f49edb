#include "postproc/draw/scalar_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish {
namespace {

using Anchor = Overlay::Anchor;
using Direction = Overlay::Direction;

constexpr Color kInk{30, 30, 30};
constexpr Color kSoftInk{95, 95, 95};

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

constexpr int kMostTicks = 11;
constexpr int kEndDigits = 4;

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

ScalarBar::ScalarBar(ColorScale scale, Texts texts, double textSize)
    : scale_(std::move(scale)),
      title_(std::move(texts.title)),
      size_(textSize),
      titleStyle_{textSize, kInk},
      labelStyle_{kLabelSize * textSize, kInk},
      endStyle_{kEndSize * textSize, kSoftInk} {
  const int exponent = makeTicks(scale_.range(), kMostTicks).exponent;
  const RichText unit = unitText(exponent, texts.unit);
  title_.insert(title_.end(), unit.begin(), unit.end());
  const double power = std::pow(10.0, exponent);
  smallest_ = {{"min " + numberText(texts.smallest / power, kEndDigits)}};
  largest_ = {{"max " + numberText(texts.largest / power, kEndDigits)}};
}

double ScalarBar::depth(Direction direction, double length) const {
  if (direction == Direction::Right)
    return size_ * (kBarDepth + kTick + kGap + kTitleGap + kTitleDepth) + capitalHeight(labelStyle_.size);
  const double column = size_ * (kBarDepth + kTick + kGap + kTitleGap + kTitleDepth) +
                        longestLabel(ticksUp(barLengthUp(length)));
  return std::max({column, textWidth(smallest_, endStyle_), textWidth(largest_, endStyle_)});
}

void ScalarBar::draw(Overlay& overlay, const PixelRect& space, Direction direction) const {
  if (direction == Direction::Up)
    drawUp(overlay, space);
  else
    drawAcross(overlay, space);
}

void ScalarBar::drawUp(Overlay& overlay, const PixelRect& space) const {
  const double length = barLengthUp(space.height);
  const PixelRect bar = rounded({space.x, space.y + (space.height - length) / 2, kBarDepth * size_, length});
  const Ticks ticks = ticksUp(bar.height);
  drawFrameAndTicks(overlay, bar, Direction::Up, ticks);
  const double labelStart = bar.right() + size_ * (kTick + kGap);
  for (std::size_t k = 0; k < ticks.values.size(); ++k)
    overlay.addText(
        {{ticks.labels[k]}},
        {labelStart, bar.y + along(ticks.values[k]) * bar.height - capitalHeight(labelStyle_.size) / 2},
        labelStyle_);
  const FittedText title = fitText(title_, titleStyle_, space.height, kSmallestTitle * size_);
  const double baseline =
      labelStart + longestLabel(ticks) + size_ * kTitleGap + capitalHeight(title.style.size);
  overlay.addText(title.text, {baseline, bar.center().y()}, title.style, Anchor::Middle, Direction::Up);
  overlay.addText(largest_, {bar.x, bar.top() + size_ * kEndGap}, endStyle_);
  overlay.addText(smallest_, {bar.x, bar.y - size_ * kEndGap - capitalHeight(endStyle_.size)}, endStyle_);
}

void ScalarBar::drawAcross(Overlay& overlay, const PixelRect& space) const {
  const double left = textWidth(smallest_, endStyle_) + size_ * kEndGap;
  const double right = textWidth(largest_, endStyle_) + size_ * kEndGap;
  const PixelRect bar = rounded(
      {space.x + left, space.top() - kBarDepth * size_, space.width - left - right, kBarDepth * size_});
  const Ticks ticks = ticksAcross(bar.width);
  drawFrameAndTicks(overlay, bar, Direction::Right, ticks);
  const double labelBase = bar.y - size_ * (kTick + kGap) - capitalHeight(labelStyle_.size);
  for (std::size_t k = 0; k < ticks.values.size(); ++k)
    overlay.addText({{ticks.labels[k]}}, {bar.x + along(ticks.values[k]) * bar.width, labelBase}, labelStyle_,
                    Anchor::Middle);
  const FittedText title = fitText(title_, titleStyle_, space.width, kSmallestTitle * size_);
  const double titleBase = labelBase - size_ * kTitleGap - capitalHeight(title.style.size);
  overlay.addText(title.text, {space.center().x(), titleBase}, title.style, Anchor::Middle);
  const double endBase = bar.center().y() - capitalHeight(endStyle_.size) / 2;
  overlay.addText(smallest_, {space.x, endBase}, endStyle_);
  overlay.addText(largest_, {space.right(), endBase}, endStyle_, Anchor::End);
}

void ScalarBar::drawFrameAndTicks(Overlay& overlay, const PixelRect& bar, Direction direction,
                                  const Ticks& ticks) const {
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
  overlay.addSegments(lines, std::max(1.0, size_ / 20.0), kInk);
}

Ticks ScalarBar::ticksUp(double barLength) const {
  const int most = static_cast<int>(barLength / (2.4 * size_));
  return makeTicks(scale_.range(), std::clamp(most, 2, kMostTicks));
}

Ticks ScalarBar::ticksAcross(double barLength) const {
  for (int most = kMostTicks; most > 2; --most) {
    Ticks ticks = makeTicks(scale_.range(), most);
    const double spacing =
        ticks.values.size() < 2 ? barLength : (along(ticks.values[1]) - along(ticks.values[0])) * barLength;
    if (longestLabel(ticks) + 1.2 * size_ <= spacing) return ticks;
  }
  return makeTicks(scale_.range(), 2);
}

double ScalarBar::barLengthUp(double length) const {
  return length - 2.0 * (size_ * kEndGap + capitalHeight(endStyle_.size));
}

double ScalarBar::longestLabel(const Ticks& ticks) const {
  double longest = 0.0;
  for (const std::string& label : ticks.labels)
    longest = std::max(longest, textWidth({{label}}, labelStyle_));
  return longest;
}

double ScalarBar::along(double value) const {
  return (value - scale_.range()[0]) / (scale_.range()[1] - scale_.range()[0]);
}

}  // namespace burnish
