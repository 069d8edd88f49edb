#pragma once
#include <array>
#include <cstddef>

namespace burnish {

/// Numbering of a box of items, first direction fastest. A plane box has one layer in the third direction.
struct IndexBox {
  using Index = std::array<int, 3>;

  Index extent{1, 1, 1};

  int size() const { return extent[0] * extent[1] * extent[2]; }
  int number(const Index& index) const { return index[0] + extent[0] * (index[1] + extent[1] * index[2]); }
  Index index(int number) const {
    const int row = number / extent[0];
    return {number % extent[0], row % extent[1], row / extent[1]};
  }
};

}  // namespace burnish
