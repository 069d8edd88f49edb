#pragma once
#include <string>

namespace burnish {

/// What draws the pictures of this process, such as "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6,
/// through OSMesa". Draws a few pixels; throws `Error` if there is no OpenGL, or if it draws another colour than it should.
std::string openGlName();

}  // namespace burnish
