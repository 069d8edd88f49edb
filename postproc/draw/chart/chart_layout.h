#pragma once
#include <optional>

#include "postproc/draw/chart/chart_curves.h"
#include "postproc/draw/chart/chart_legend.h"
#include "postproc/draw/chart/chart_scale.h"

namespace burnish {

/// Where everything stands in a chart, in pixels (see PixelRect). Texts stand at the middle of their
/// capitals.
struct ChartLayout {
  double textSize = 12.0;
  PixelRect plot;  ///< the rectangle between the axes
  ChartScale x, y;
  std::optional<ChartScale> y2;  ///< at the right
  std::vector<PlottedCurve> curves;
  ChartLegend legend;
  PixelRect legendBox;  ///< empty without a legend
  int legendColumns = 1;
  bool legendInside = false;                               ///< or below the plot
  double xLabelsAt = 0.0;                                  ///< height of the labels of the x axis
  double yLabelsEnd = 0.0;                                 ///< where the labels of the y axis end
  double y2LabelsStart = 0.0;                              ///< where those of the axis at the right start
  FittedText title, xTitle, yTitle, y2Title;               ///< empty text: none
  Eigen::Vector2d titleAt, xTitleAt, yTitleAt, y2TitleAt;  ///< middle of the texts
  Eigen::Vector2d xFactorAt, yFactorAt, y2FactorAt;        ///< end, start and end of the texts

  Eigen::Vector2d pixel(double xValue, double yValue, bool onRight = false) const;
};

/// Throws `Error` if the picture is too small for its texts.
ChartLayout layOutChart(const Chart& chart);

}  // namespace burnish
