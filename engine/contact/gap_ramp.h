#pragma once

namespace burnish::inline contact {

/// What is added to gaps of two faces while their interference is resolved: the amount at the time `from`,
/// nothing from `until` on. Without an amount nothing at all.
struct GapRamp {
  double amount = 0.0, from = 0.0, until = 0.0;

  double at(double t) const {
    return amount != 0.0 && t < until ? amount * (until - t) / (until - from) : 0.0;
  }
};

}  // namespace burnish::inline contact
