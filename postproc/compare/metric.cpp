#include "postproc/compare/metric.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <map>

#include "postproc/compare/lab.h"

namespace burnish {
namespace {

constexpr int kRadius = 6;
constexpr double kBlankShare = 0.001;
constexpr float kDrawnDeltaE = 5.0F;  // above noise of 2 of 255 in every channel

/// Sums over pixels x of one picture and y of the other, in L*, a*, b*: x, y, x², y², xy; and the number of
/// pixels that differ visibly.
struct Sums {
  Eigen::Array3d x = Eigen::Array3d::Zero(), y = x, xx = x, yy = x, xy = x;
  double visible = 0.0;

  void add(const Sums& other, double sign) {
    x += sign * other.x;
    y += sign * other.y;
    xx += sign * other.xx;
    yy += sign * other.yy;
    xy += sign * other.xy;
    visible += sign * other.visible;
  }
};

/// a* and b* counted from -128, so that colours about grey have no small means of either sign.
Eigen::Array3d positive(const Lab& color) {
  return color.cast<double>() + Eigen::Array3d(0.0, 128.0, 128.0);
}

Sums sumsOf(const Lab& a, const Lab& b) {
  const Eigen::Array3d x = positive(a), y = positive(b);
  return {x, y, x * x, y * y, x * y, deltaE(a, b) > kVisibleDeltaE ? 1.0 : 0.0};
}

/// 1 - structural similarity in the channel where it is least.
double dissimilarity(const Sums& sums, double count) {
  static const Eigen::Array3d range(100.0, 255.0, 255.0);
  static const Eigen::Array3d c1 = 1e-4 * range.square(), c2 = 9e-4 * range.square();
  const Eigen::Array3d mx = sums.x / count, my = sums.y / count;
  const Eigen::Array3d vx = sums.xx / count - mx * mx, vy = sums.yy / count - my * my;
  const Eigen::Array3d covariance = sums.xy / count - mx * my;
  const Eigen::Array3d similarity =
      (2.0 * mx * my + c1) * (2.0 * covariance + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
  return 1.0 - similarity.minCoeff();
}

/// Collects what windows and pixels say.
class Collector {
 public:
  Collector(int width, int height) : width_(width), height_(height) {}

  void addWindow(int i, int j, const Sums& sums, double count) {
    const double here = std::max(0.0, dissimilarity(sums, count));
    total_ += here;
    if (here > result_.dissimilarity) {
      result_.dissimilarity = here;
      worst_ = {i, j};
    }
    result_.windowShare = std::max(result_.windowShare, sums.visible / count);
  }

  void addVisiblePixel(int i, int j) {
    ++visible_;
    low_ = low_.min(Eigen::Array2i(i, j));
    high_ = high_.max(Eigen::Array2i(i, j));
  }

  PictureDifference result() {
    const double count = static_cast<double>(width_) * height_;
    result_.meanDissimilarity = total_ / count;
    result_.share = static_cast<double>(visible_) / count;
    if (visible_ == 0) {
      low_ = (worst_ - kRadius).max(0);
      high_ = (worst_ + kRadius).min(Eigen::Array2i(width_ - 1, height_ - 1));
    }
    result_.box = {low_.x(), height_ - 1 - high_.y(), high_.x() - low_.x() + 1, high_.y() - low_.y() + 1};
    return result_;
  }

 private:
  int width_, height_;
  PictureDifference result_;
  double total_ = 0.0;
  std::int64_t visible_ = 0;
  Eigen::Array2i worst_ = {0, 0}, low_ = {width_, height_}, high_ = {-1, -1};
};

/// Lowest and one past the highest index of a window in one direction.
int windowBegin(int at) {
  return std::max(0, at - kRadius);
}
int windowEnd(int at, int size) {
  return std::min(size, at + kRadius + 1);
}

}  // namespace

PictureDifference differenceOf(const Picture& actual, const Picture& baseline) {
  assert(actual.width == baseline.width && actual.height == baseline.height);
  if (actual.pixels == baseline.pixels) return {};  // no round-off, and most pairs are
  const int width = actual.width, height = actual.height;
  Collector collector(width, height);
  const std::vector<Lab> a = toLab(actual), b = toLab(baseline);
  std::vector<Sums> columns(static_cast<std::size_t>(width));  // over the rows of the windows at hand
  const auto addRow = [&](int j, double sign) {
    const std::size_t first = static_cast<std::size_t>(j) * columns.size();
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].add(sumsOf(a[first + i], b[first + i]), sign);
  };
  for (int j = 0; j < std::min(kRadius, height); ++j) addRow(j, 1.0);
  for (int j = 0; j < height; ++j) {
    if (j + kRadius < height) addRow(j + kRadius, 1.0);
    if (j - kRadius > 0) addRow(j - kRadius - 1, -1.0);
    const int rows = windowEnd(j, height) - windowBegin(j);
    Sums window;
    for (int i = 0; i < std::min(kRadius, width); ++i) window.add(columns[static_cast<std::size_t>(i)], 1.0);
    for (int i = 0; i < width; ++i) {
      if (i + kRadius < width) window.add(columns[static_cast<std::size_t>(i + kRadius)], 1.0);
      if (i - kRadius > 0) window.add(columns[static_cast<std::size_t>(i - kRadius - 1)], -1.0);
      collector.addWindow(i, j, window, static_cast<double>(rows) * (windowEnd(i, width) - windowBegin(i)));
      const std::size_t k = static_cast<std::size_t>(j) * columns.size() + static_cast<std::size_t>(i);
      if (deltaE(a[k], b[k]) > kVisibleDeltaE) collector.addVisiblePixel(i, j);
    }
  }
  return collector.result();
}

bool isBlank(const Picture& picture) {
  std::map<Color, std::size_t> counts;
  auto current = counts.end();
  for (const Color& color : picture.pixels) {
    if (current == counts.end() || current->first != color) current = counts.try_emplace(color, 0).first;
    ++current->second;
  }
  const auto paper = std::max_element(counts.begin(), counts.end(),
                                      [](const auto& p, const auto& q) { return p.second < q.second; });
  std::size_t drawn = 0;
  for (const auto& [color, count] : counts)
    if (deltaE(toLab(color), toLab(paper->first)) > kDrawnDeltaE) drawn += count;
  return static_cast<double>(drawn) < kBlankShare * static_cast<double>(picture.pixels.size());
}

}  // namespace burnish
