#include "cli/late_vtk.h"

namespace burnish {
namespace {

void (*load)() = nullptr;
void (*afterwards)() = nullptr;

}  // namespace

void loadVtk() {
  [[maybe_unused]] static const bool isThere = [] {
    if (load != nullptr) load();
    if (afterwards != nullptr) afterwards();
    return true;
  }();
}

void whenVtkIsThere(void (*task)()) {
  if (load == nullptr)
    task();
  else
    afterwards = task;
}

void loadVtkBy(void (*loader)()) {
  load = loader;
}

}  // namespace burnish
