#pragma once

namespace burnish {

/// Loads the library with OpenCASCADE. Throws `Error` if it is not there.
void requireCad();

}  // namespace burnish
