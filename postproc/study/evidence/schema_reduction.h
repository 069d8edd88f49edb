#pragma once
#include "engine/schema/leaf.h"
#include "postproc/study/evidence/quantity.h"

namespace burnish {

template <>
struct EnumNames<RowReduction> {
  static constexpr std::array values{std::pair{"last", RowReduction::Last},
                                     std::pair{"max", RowReduction::Max},
                                     std::pair{"min", RowReduction::Min}};
};

template <>
struct EnumNames<Reduction> {
  static constexpr std::array values{std::pair{"first", Reduction::First},
                                     std::pair{"last", Reduction::Last},
                                     std::pair{"max", Reduction::Max},
                                     std::pair{"min", Reduction::Min},
                                     std::pair{"mean", Reduction::Mean},
                                     std::pair{"at", Reduction::At},
                                     std::pair{"oscillation", Reduction::Oscillation}};
};

}  // namespace burnish
