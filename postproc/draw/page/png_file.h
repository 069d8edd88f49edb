#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

class vtkImageData;

namespace burnish {

/// What the header of a PNG says.
struct PngSize {
  int width = 0, height = 0;
  bool hasAlpha = false;
};

/// Reads a PNG of any kind into rows of bytes, the lowest first: grey and palette become RGB, 16 bits per
/// channel 8. place: gives the room for the pixels when the size is known, RGB or, if there is an alpha
/// channel and `keepsAlpha`, RGBA; otherwise what is translucent stands on white. Throws `Error` naming the
/// file if it is missing, no PNG, damaged, or above 2^28 pixels, the last before any room is asked for.
void readPng(const std::filesystem::path& file, bool keepsAlpha,
             const std::function<std::byte*(const PngSize&)>& place);

/// A picture of bytes (grey, RGB or RGBA) as the contents of a PNG.
std::string pngBytes(vtkImageData& picture);

/// Writes a picture of bytes (grey, RGB or RGBA) as PNG; the file appears under its name only when it is
/// complete. Throws `Error` naming the file.
void writePng(vtkImageData& picture, const std::filesystem::path& file);

}  // namespace burnish
