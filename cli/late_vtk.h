#pragma once

/// VTK takes longer to start than all the rest, and most commands do without. Where the program was built with BURNISH_LATE_VTK, the first
/// call of one of VTK's functions loads it (cmake/late_functions.py, cli/vtk_loader.cpp); else it was linked with it.
namespace burnish {

/// Loads VTK now, if it is not there yet. Throws `Error` if that fails; a first call of one of its functions ends the program
/// then, since many of those that call may not throw.
void loadVtk();

/// Does this once VTK is there, maybe at once.
void whenVtkIsThere(void (*task)());

/// For a program that is not linked with VTK, before it does anything else: what loads it.
void loadVtkBy(void (*loader)());

}  // namespace burnish
