#include "postproc/compare/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <system_error>

#include "engine/core/error.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;

static_assert(sizeof(Color) == 3, "pixels are handed to libpng as rows of bytes");

struct FreeImage {
  void operator()(png_image* image) const { png_image_free(image); }
};

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

Picture readPicture(const fs::path& png) {
  std::error_code unreadable;
  if (!fs::is_regular_file(png, unreadable))
    throw Error(fmt::format("{}: there is no such picture", png.string()));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, FreeImage> guard(&image);
  if (png_image_begin_read_from_file(&image, png.c_str()) == 0)
    throw Error(fmt::format("{}: found no PNG picture ({})", png.string(), image.message));
  image.format = PNG_FORMAT_RGB;
  const std::uint64_t count = std::uint64_t{image.width} * image.height;
  if (count > kMostPixels)
    throw Error(fmt::format("{}: found {} x {} pixels; expected at most {} in all", png.string(), image.width,
                            image.height, kMostPixels));
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.pixels.resize(count);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, picture.pixels.data(), rowStride(image), nullptr) == 0)
    throw Error(fmt::format("{}: the PNG picture is damaged ({})", png.string(), image.message));
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
