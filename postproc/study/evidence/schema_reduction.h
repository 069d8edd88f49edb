#pragma once
#include "engine/schema/leaf.h"
#include "postproc/study/evidence/quantity.h"

namespace burnish {

constexpr auto enumNames(std::type_identity<RowReduction>) {
  return std::array{std::pair{"last", RowReduction::Last}, std::pair{"max", RowReduction::Max},
                    std::pair{"min", RowReduction::Min}};
}

constexpr auto enumNames(std::type_identity<Reduction>) {
  return std::array{std::pair{"first", Reduction::First},
                    std::pair{"last", Reduction::Last},
                    std::pair{"max", Reduction::Max},
                    std::pair{"min", Reduction::Min},
                    std::pair{"mean", Reduction::Mean},
                    std::pair{"at", Reduction::At},
                    std::pair{"oscillation", Reduction::Oscillation}};
}

}  // namespace burnish
