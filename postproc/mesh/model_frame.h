#pragma once
#include "engine/results/result.h"

namespace burnish {

/// A model with one frame of it.
struct ModelFrame {
  ModelRecord model;
  FrameRecord frame;
};

}  // namespace burnish
