#pragma once
#include "postproc/compare/picture.h"

namespace burnish {

/// Shows where two pictures of the same size differ: the baseline, faded to light grey, with the pixels that
/// differ visibly in colours from orange (just) to dark red (ΔE of 50 and more).
Picture differencePicture(const Picture& actual, const Picture& baseline);

}  // namespace burnish
