#pragma once
#include <string>
#include <vector>

namespace burnish {

/// What a chart of letters is made of.
struct TextChart {
  std::vector<double> x, y;       ///< x ascends; values that are not finite are passed over
  double begin = 0.0, end = 1.0;  ///< of the x axis
  int columns = 60, rows = 6;
  bool blocks = true;  ///< eighths of letters, of Unicode; else # alone
};

/// Columns as high as the values between the smallest and the largest, whose numbers stand at the right; one line per row, without
/// blanks at the end. Nothing for fewer than two values.
std::vector<std::string> chartLines(const TextChart& chart);

}  // namespace burnish
