#include "engine/core/interruption.h"

#include <csignal>

namespace burnish::inline core {
namespace {

volatile std::sig_atomic_t lastSignal = 0;
volatile std::sig_atomic_t count = 0;

}  // namespace

void noteInterruption(int signal) noexcept {
  lastSignal = signal;
  count = count + 1;
}

void forgetInterruptions() noexcept {
  lastSignal = 0;
  count = 0;
}

int interruption() noexcept {
  return lastSignal;
}

int numInterruptions() noexcept {
  return count;
}

void throwIfInterrupted() {
  if (lastSignal != 0) throw Interrupted();
}

}  // namespace burnish::inline core
