#include "engine/contact/relative_length.h"

#include <algorithm>
#include <numeric>

#include "engine/solid/span_quadrature.h"

namespace burnish::inline contact {
namespace {

/// Whether a corner of a span lies at its end in direction d.
bool isAtEnd(std::size_t corner, int d) {
  return (corner >> static_cast<unsigned>(d) & 1U) != 0;
}

}  // namespace

template <int P>
RelativeLength<P>::RelativeLength(const TensorBasis<P>& basis, const std::vector<double>& sizes)
    : basis_(basis), corners_(sizes.size()) {
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
  constexpr std::size_t kCorners = 1U << P;
  for (int e = 0; e < basis.numSpans(); ++e)
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
      double sum = 0.0;
      int meeting = 0;
      for (std::size_t around = 0; around < kCorners; ++around) {
        auto index = basis.spanIndex(e);
        bool exists = true;
        for (int d = 0; d < P; ++d) {
          int& i = index[static_cast<std::size_t>(d)];
          if (isAtEnd(around, d)) i += isAtEnd(corner, d) ? 1 : -1;
          exists = exists && i >= 0 && i < basis.direction(d).numSpans();
        }
        if (!exists) continue;
        sum += sizes[static_cast<std::size_t>(basis.spanNumber(index))];
        ++meeting;
      }
      corners_[static_cast<std::size_t>(e)][corner] = sum / (meeting * mean);
    }
}

template <int P>
double RelativeLength<P>::at(int span, const Eigen::Vector<double, P>& xi) const {
  const auto box = spanBox(basis_, span);
  const auto& corners = corners_[static_cast<std::size_t>(span)];
  double length = 0.0;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    double share = corners[corner];
    for (int d = 0; d < P; ++d) {
      const double s = (xi(d) - box.begin(d)) / (box.end(d) - box.begin(d));
      share *= isAtEnd(corner, d) ? s : 1.0 - s;
    }
    length += share;
  }
  return length;
}

template <int P>
double RelativeLength<P>::largestOn(int span) const {
  const auto& corners = corners_[static_cast<std::size_t>(span)];
  return *std::max_element(corners.begin(), corners.end());
}

template class RelativeLength<1>;
template class RelativeLength<2>;

}  // namespace burnish::inline contact
