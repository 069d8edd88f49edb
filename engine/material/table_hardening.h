#pragma once
#include <vector>

namespace burnish {

/// Yield stress from a table: piecewise linear, constant beyond the last entry.
class TableHardening {
 public:
  /// Throws `Error` unless both lists are equally long and not empty, `e` starts at 0 and increases strictly,
  /// and all stresses are positive.
  TableHardening(std::vector<double> e, std::vector<double> sigma);

  double sigma_y(double e) const;
  double slope(double e) const;
  double work(double e) const;

 private:
  struct Piece {
    double start;  ///< plastic strain at which the piece begins
    double sigma;  ///< yield stress there
    double slope;
    double work;  ///< H there
  };
  const Piece& pieceAt(double e) const;

  std::vector<Piece> pieces_;
};

}  // namespace burnish
