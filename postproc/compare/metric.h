#pragma once
#include "postproc/compare/picture.h"

namespace burnish {

/// A rectangle of pixels, counted from the upper left corner as image viewers do.
struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
};

/// How two pictures of the same size differ. A *window* is the pixels around one, 6 to each side as far as
/// the picture goes. Its similarity is the structural similarity
///   (2 mx my + c1) (2 cov + c2) / ((mx² + my² + c1) (vx + vy + c2))
/// of means, variances and covariance in L*, a* or b*, whichever is least; c1 = 1e-4 L², c2 = 9e-4 L² with
/// L = 100 for L* and 255 for a* and b*, which are counted from -128.
struct PictureDifference {
  double dissimilarity = 0.0;      ///< 1 - similarity of the least similar window
  double meanDissimilarity = 0.0;  ///< the same, mean over all windows
  double share = 0.0;              ///< share of pixels that differ visibly (ΔE > 2.3)
  double windowShare = 0.0;        ///< the same within the window that has the most of them
  PixelBox box;                    ///< around all pixels that differ visibly; without any, the worst window
};

/// The pictures must have the same size.
PictureDifference differenceOf(const Picture& actual, const Picture& baseline);

/// Whether fewer than 1 of 1000 pixels clearly differ from the most frequent colour (ΔE > 5): nothing is
/// drawn.
bool isBlank(const Picture& picture);

}  // namespace burnish
