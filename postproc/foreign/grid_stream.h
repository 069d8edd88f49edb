#pragma once
#include <vector>

#include "engine/core/byte_stream.h"
#include "postproc/foreign/foreign_source.h"

/// What goes from the process of a reader to the program.
namespace burnish {

void send(const std::vector<ForeignBlock>& blocks, const TakeBytes& take);
std::vector<ForeignBlock> receiveBlocks(const FillBytes& fill);

}  // namespace burnish
