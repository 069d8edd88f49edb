#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "postproc/draw/chart/chart_curves.h"
#include "postproc/draw/page/overlay.h"

namespace burnish {

/// The labels of the curves, each after a sample of its line. All lengths in pixels.
class ChartLegend {
 public:
  struct Entry {
    std::size_t curve;
    FittedText label;
  };

  /// Without entries.
  ChartLegend() = default;

  /// Curves without a label are left out; labels are shortened to `widestLabel`, and those of the axis at
  /// the right say so.
  ChartLegend(const Chart& chart, double textSize, double widestLabel);

  const std::vector<Entry>& entries() const { return entries_; }

  /// Width and height, the space around the entries included.
  Eigen::Vector2d extent(int columns) const;

  /// As many columns as there is room for, at least one.
  int columnsIn(double width) const;

  /// A place for one column within the plot where it covers no curve and no marker: a corner or, failing
  /// that, the middle of a side.
  std::optional<PixelRect> freePlace(const PixelRect& plot, const std::vector<PlottedCurve>& curves) const;

  /// Where the samples of the entries begin, when the legend fills `box`.
  std::vector<Eigen::Vector2d> entryStarts(const PixelRect& box, int columns) const;

  double sampleLength() const;

  /// From the start of a sample to its label.
  double labelOffset() const;

 private:
  double size_ = 0.0;
  double longestLabel_ = 0.0;
  std::vector<Entry> entries_;
};

}  // namespace burnish
