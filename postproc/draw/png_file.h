#pragma once
#include <filesystem>

class vtkImageData;

namespace burnish {

/// Writes a picture of bytes (grey, RGB or RGBA) as PNG; the file appears under its name only when it is
/// complete. Throws `Error` naming the file.
void writePng(vtkImageData& picture, const std::filesystem::path& file);

}  // namespace burnish
