#include "postproc/compare/picture.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>

#include "postproc/draw/page/png_file.h"

namespace burnish {
namespace {

static_assert(sizeof(Color) == 3, "pixels are handed to libpng as rows of bytes");

/// Rows of a picture lie upwards in memory, those of a PNG file downwards.
png_int_32 rowStride(const png_image& image) {
  return -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(image));
}

}  // namespace

const Color& Picture::at(const Eigen::Vector2d& position) const {
  const int i = std::clamp(static_cast<int>(std::floor(position.x())), 0, width - 1);
  const int j = std::clamp(static_cast<int>(std::floor(position.y())), 0, height - 1);
  return pixels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
}

Picture readPicture(const std::filesystem::path& png) {
  Picture picture;
  readPng(png, false, [&](const PngSize& size) {
    picture.width = size.width;
    picture.height = size.height;
    picture.pixels.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    return reinterpret_cast<std::byte*>(picture.pixels.data());
  });
  return picture;
}

std::string encodePng(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), rowStride(image),
                                nullptr) == 0)
    throw std::bad_alloc();
  bytes.resize(size);
  return bytes;
}

}  // namespace burnish
