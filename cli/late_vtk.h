#pragma once

namespace burnish {

/// Does this once VTK is there: at once where the program was linked with it. Where it was built with BURNISH_LATE_VTK, VTK is
/// loaded by the first call of one of its functions: it takes longer to start than all the rest, and most commands
/// do without. A call throws `ModuleError` then if burnish_vtk.so is not beside the program.
void whenVtkIsThere(void (*task)());

}  // namespace burnish
