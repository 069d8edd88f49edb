#pragma once

namespace burnish::inline cad {

/// Loads the library with OpenCASCADE. Throws `Error` if it is not there.
void requireCad();

}  // namespace burnish::inline cad
