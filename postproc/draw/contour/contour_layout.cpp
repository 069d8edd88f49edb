#include "postproc/draw/contour/contour_layout.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "postproc/draw/contour/axes_triad.h"
#include "postproc/draw/contour/scale_bar.h"

namespace burnish {
namespace {

constexpr double kSmallestText = 10.0, kSmallestNote = 6.0;  // pixels

// Measures as parts of the text size.
constexpr double kMargin = 1.2;
constexpr double kBareMargin = 0.4;  // without a caption, for pictures in a sheet
constexpr double kTitleSize = 1.15;
constexpr double kLine = 1.5;
constexpr double kBelowCaption = 1.0;
constexpr double kBarGap = 1.6;
constexpr double kShortestBar = 12.0;
constexpr double kBesideTriad = 0.8;  // from its names to a line that stands beside them
constexpr double kNoteSize = 0.85;
constexpr double kNoteGap = 0.9;
constexpr double kNoteLine = 1.35;                           // from line to line, of its own size
constexpr double kPadding = 0.15;                            // keeps lines on the border of the content whole
constexpr double kReadableUp = 5.0, kReadableAcross = 15.0;  // bars whose numbers stand apart

constexpr double kLeastRoom = 0.15;  // for the content, of the picture's width and height

struct Placement {
  double scale = 0.0;  ///< pixels per length
  double barDepth = 0.0;
  PixelRect room;                                  ///< for content and bar together
  Eigen::Vector2d free = Eigen::Vector2d::Zero();  ///< for the content
};

double fittingScale(const Eigen::Vector2d& extent, double width, double height) {
  return std::max(1e-12, std::min(width / extent.x(), height / extent.y()));
}

/// Width and height of the content in pixels.
Eigen::Vector2d drawnSize(const Eigen::Vector2d& extent, double scale, double size) {
  return {std::ceil(scale * extent.x() + 2.0 * kPadding * size),
          std::ceil(scale * extent.y() + 2.0 * kPadding * size)};
}

/// As long as the content, unless that is too short for its labels.
double barLength(const PixelRect& room, const Eigen::Vector2d& drawn, Overlay::Direction direction,
                 double size) {
  if (direction == Overlay::Direction::Up)
    return std::clamp(drawn.y(), std::min(kShortestBar * size, room.height), room.height);
  return std::clamp(drawn.x(), std::min(3 * kShortestBar * size, room.width), room.width);
}

/// The content as large as possible with the bar at its right (Up) or below (Right). axes: room beside it.
Placement place(const PixelRect& room, const Eigen::Vector2d& extent, const ScalarBar& bar,
                Overlay::Direction direction, double size, const Eigen::Vector2d& axes) {
  const double padding = 2.0 * kPadding * size;
  Placement p;
  p.room = room;
  double depth = bar.depth(direction, direction == Overlay::Direction::Up ? room.height : room.width);
  // A shorter bar has other labels, and may need more room for them.
  while (depth > p.barDepth) {
    p.barDepth = depth;
    const double taken = p.barDepth + kBarGap * size + padding;
    p.free = direction == Overlay::Direction::Up ? Eigen::Vector2d(room.width - taken, room.height - padding)
                                                 : Eigen::Vector2d(room.width - padding, room.height - taken);
    p.free -= axes;
    p.scale = fittingScale(extent, p.free.x(), p.free.y());
    depth = bar.depth(direction, barLength(room, drawnSize(extent, p.scale, size), direction, size));
  }
  return p;
}

/// The middle of something so long, as near as it may be to where it is wanted within a part of the picture.
double middleWithin(double low, double extent, double length, double wanted) {
  return std::clamp(wanted, low + length / 2, std::max(low + length / 2, low + extent - length / 2));
}

/// Content and bar as one group in the middle of the room. axes: room at the left of the content and below it.
void arrange(ContourLayout& layout, const Placement& p, const Eigen::Vector2d& extent, double size,
             const Eigen::Vector2d& axes) {
  const Eigen::Vector2d drawn = drawnSize(extent, p.scale, size), whole = drawn + axes;
  const bool up = layout.barDirection == Overlay::Direction::Up;
  const double gap = kBarGap * size, length = barLength(p.room, drawn, layout.barDirection, size);
  const double group = (up ? whole.x() : whole.y()) + gap + p.barDepth;
  const Eigen::Vector2d middle = p.room.center();
  if (up) {
    const double left = std::floor(middle.x() - group / 2), low = std::floor(middle.y() - whole.y() / 2);
    layout.view.area = {left + axes.x(), low + axes.y(), drawn.x(), drawn.y()};
    const double wanted = axes.isZero(0.0) ? middle.y() : layout.view.area.center().y();
    layout.bar = {left + whole.x() + gap, middleWithin(p.room.y, p.room.height, length, wanted) - length / 2,
                  p.barDepth, length};
  } else {
    const double bottom = std::floor(middle.y() - group / 2);
    layout.view.area = {std::floor(middle.x() - whole.x() / 2) + axes.x(),
                        std::ceil(bottom + p.barDepth + gap) + axes.y(), drawn.x(), drawn.y()};
    const double wanted = axes.isZero(0.0) ? middle.x() : layout.view.area.center().x();
    layout.bar = {middleWithin(p.room.x, p.room.width, length, wanted) - length / 2, bottom, length,
                  p.barDepth};
  }
}

/// The content alone in the middle of the room.
void arrangeAlone(ContourLayout& layout, const PixelRect& all, const Eigen::Vector2d& extent, double size,
                  const Eigen::Vector2d& axes) {
  const double padding = 2.0 * kPadding * size;
  const PixelRect room{all.x + axes.x(), all.y + axes.y(), all.width - axes.x(), all.height - axes.y()};
  layout.view.pixelsPerLength = fittingScale(extent, room.width - padding, room.height - padding);
  const Eigen::Vector2d drawn = drawnSize(extent, layout.view.pixelsPerLength, size);
  const Eigen::Vector2d middle = room.center();
  layout.view.area = {std::floor(middle.x() - drawn.x() / 2), std::floor(middle.y() - drawn.y() / 2),
                      drawn.x(), drawn.y()};
  layout.barDirection = Overlay::Direction::Right;
  layout.bar = {layout.view.area.center().x(), layout.view.area.y, 0.0, 0.0};
}

bool isRoomy(const Eigen::Vector2d& free, const std::array<int, 2>& pictureSize) {
  return free.x() >= kLeastRoom * pictureSize[0] && free.y() >= kLeastRoom * pictureSize[1];
}

/// Content and bar, which stands where it leaves more room for the content.
void arrangeWithBar(ContourLayout& layout, const PixelRect& room, const Eigen::Vector2d& extent,
                    const ScalarBar& bar, double size, const std::array<int, 2>& pictureSize,
                    const Eigen::Vector2d& axes) {
  const Placement up = place(room, extent, bar, Overlay::Direction::Up, size, axes);
  const Placement across = place(room, extent, bar, Overlay::Direction::Right, size, axes);
  const bool isUp = up.scale >= across.scale;
  layout.barDirection = isUp ? Overlay::Direction::Up : Overlay::Direction::Right;
  layout.view.pixelsPerLength = isUp ? up.scale : across.scale;
  arrange(layout, isUp ? up : across, extent, size, axes);
  layout.hasRoom = isRoomy(isUp ? up.free : across.free, pictureSize) &&
                   (isUp ? room.height >= kReadableUp * size : room.width >= kReadableAcross * size);
}

/// One line, or two equally long ones where that would be cut off even in the smallest letters.
std::vector<FittedText> noteLines(const std::string& text, const TextStyle& style, double width) {
  const FittedText line = fitText({{text}}, style, width, kSmallestNote);
  if (line.text.front().text == text) return {line};
  const auto longer = [&](std::size_t blank) {
    return std::max(textWidth({{text.substr(0, blank)}}, style),
                    textWidth({{text.substr(blank + 1)}}, style));
  };
  std::size_t best = std::string::npos;
  int brackets = 0;  // coordinates of a point stay together
  for (std::size_t k = 0; k < text.size(); ++k) {
    brackets += text[k] == '(' ? 1 : text[k] == ')' ? -1 : 0;
    if (text[k] != ' ' || brackets > 0) continue;
    if (best == std::string::npos || longer(k) < longer(best)) best = k;
  }
  if (best == std::string::npos) return {line};
  std::vector<FittedText> lines;
  for (const std::string& part : {text.substr(0, best), text.substr(best + 1)})
    lines.push_back(fitText({{part}}, style, width, kSmallestNote));
  for (FittedText& part : lines) part.style.size = std::min(lines[0].style.size, lines[1].style.size);
  return lines;
}

/// axes: room below the content. Below content and bar: under the right end of an upright bar, under the middle of one across.
void placeNote(ContourLayout& layout, double size, double left, double axes) {
  if (layout.note.empty()) return;
  const double baseline = std::min(layout.view.area.y - axes, layout.bar.y) - kNoteGap * size -
                          capitalHeight(layout.note.front().style);
  double length = 0.0;
  for (const FittedText& line : layout.note) length = std::max(length, textWidth(line.text, line.style));
  layout.noteAt = layout.barDirection == Overlay::Direction::Up
                      ? Eigen::Vector2d(std::max(layout.bar.right(), left + length), baseline)
                      : Eigen::Vector2d(layout.bar.center().x(), baseline);
}

}  // namespace

double textSizeFor(const std::array<int, 2>& pictureSize) {
  // Those of the smallest pictures are smaller, else they leave no room.
  const double part = std::min({1.0, pictureSize[0] / 300.0, pictureSize[1] / 200.0});
  return std::max(std::round(part * kSmallestText),
                  std::round(std::min(0.027 * pictureSize[1], 0.018 * pictureSize[0])));
}

ContourLayout layOutContour(const std::array<int, 2>& pictureSize, double textSize,
                            const Eigen::AlignedBox2d& content, const Eigen::Matrix<double, 2, 3>& axes,
                            const ContourCaption& caption, const ScalarBar* bar, const Theme& theme) {
  const double width = pictureSize[0], height = pictureSize[1], size = textSize;
  const bool bare = caption.title.empty() && caption.time.empty();
  const double margin = std::round((bare ? kBareMargin : kMargin) * size);
  ContourLayout layout;

  double top = height - margin;
  const auto addLine = [&](const std::string& text, double textHeight, double gap) {
    const FittedText line = fitText({{text}}, {textHeight, theme.ink, theme.font}, width - 2 * margin,
                                    std::min(textHeight, kSmallestText));
    const Eigen::Vector2d at(margin, top - capitalHeight(line.style));
    top = at.y() - gap * size;
    return std::pair(line, at);
  };
  if (!caption.title.empty())
    std::tie(layout.title, layout.titleAt) =
        addLine(caption.title, std::round(kTitleSize * size),
                caption.time.empty() ? kBelowCaption : kLine - capitalHeight(1.0));
  if (!caption.time.empty())
    std::tie(layout.time, layout.timeAt) = addLine(caption.time, size, kBelowCaption);

  const double left = margin + (caption.triad ? kTriadRoom * size : 0.0);
  double bottom = margin;
  const TextStyle small{kNoteSize * size, theme.softInk, theme.font};
  const auto addSmallLine = [&](const TextStyle& style, bool hasRoom) {
    bottom += kNoteGap * size + capitalHeight(hasRoom ? small : style);  // of a long text smaller
  };
  layout.doubtAt = {left, margin};
  if (!caption.doubt.empty())
    layout.doubt = fitText({{caption.doubt}}, small, width - left - margin, kSmallestNote);
  if (!caption.doubt.empty() || caption.doubtRoom) addSmallLine(layout.doubt.style, caption.doubtRoom);
  layout.scaleBarAt = {left + (caption.triad ? kBesideTriad * size : 0.0), bottom};
  if (caption.scaleBar) bottom += kScaleBarRoom * size;
  if (!caption.note.empty()) layout.note = noteLines(caption.note, small, width - left - margin);
  if (!layout.note.empty() || caption.noteRoom)
    addSmallLine(layout.note.empty() ? small : layout.note.front().style, caption.noteRoom);
  if (layout.note.size() > 1) {
    layout.noteLine = kNoteLine * layout.note.front().style.size;
    bottom += layout.noteLine;
  }

  layout.triadAt = {margin, margin};
  const PixelRect room{left, bottom, width - margin - left, top - bottom};
  const Eigen::Vector2d extent = content.sizes().cwiseMax(1e-9 * content.sizes().maxCoeff());
  layout.view.axes = axes;
  layout.view.center = content.center();
  if (bar != nullptr)
    arrangeWithBar(layout, room, extent, *bar, size, pictureSize, caption.axesRoom);
  else
    arrangeAlone(layout, room, extent, size, caption.axesRoom);
  if (bar == nullptr) layout.hasRoom = isRoomy({room.width, room.height}, pictureSize);
  placeNote(layout, size, left, caption.axesRoom.y());
  return layout;
}

}  // namespace burnish
