#pragma once
#include <array>
#include <functional>
#include <vector>

namespace burnish::inline material {

/// An adaptive piecewise Chebyshev interpolant of a function on [0, 1024], accurate to about 14 digits
/// wherever the function is smooth. Pieces become shorter towards 0 and at corners. Where the function is not
/// finite, and outside the interval, so are the answers.
class PiecewiseChebyshev {
 public:
  /// Throws `Error` when the function varies too wildly for a reasonable number of pieces.
  explicit PiecewiseChebyshev(const std::function<double(double)>& function);

  double value(double x) const;
  double slope(double x) const;
  /// Integral from 0 to x.
  double integral(double x) const;

 private:
  static constexpr int kDegree = 16;
  using Coefficients = std::array<double, kDegree + 2>;

  struct Piece {
    double start;
    double end;
    Coefficients value;     ///< in the local coordinate -1 … 1
    Coefficients slope;     ///< with respect to x
    Coefficients integral;  ///< from 0 to x

    double local(double x) const { return (2.0 * x - start - end) / (end - start); }
  };

  /// What halving an interval passes on: its last coefficients, and the largest value so far.
  struct Parent {
    double tail;
    double scale;
  };

  static Coefficients interpolate(const std::function<double(double)>& function, double start, double end);
  void resolve(const std::function<double(double)>& function, double start, double end, const Parent& parent,
               int depth);
  void append(double start, double end, const Coefficients& value);
  const Piece* pieceAt(double x) const;

  std::vector<Piece> pieces_;
};

}  // namespace burnish::inline material
