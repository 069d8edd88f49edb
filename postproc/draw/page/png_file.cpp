#include "postproc/draw/page/png_file.h"

#include <fmt/format.h>
#include <png.h>
#include <vtkImageData.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

/// Level 5 with all filters takes four times as long for files that are a tenth to a quarter smaller.
constexpr int kLevel = 3;
constexpr int kFilters = PNG_FILTER_NONE;

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;

struct FreeImage {
  void operator()(png_image* image) const { png_image_free(image); }
};

void append(png_structp png, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

/// Holds no objects with destructors: libpng leaves it by a jump when something is wrong.
bool encode(png_structp png, png_infop info, vtkImageData& picture, png_bytepp rows, std::string* bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  constexpr std::array kinds{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
  const int* size = picture.GetDimensions();
  png_set_write_fn(png, bytes, append, nullptr);
  png_set_compression_level(png, kLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, kFilters);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size[0]), static_cast<png_uint_32>(size[1]), 8,
               kinds[static_cast<std::size_t>(picture.GetNumberOfScalarComponents() - 1)], PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_rows(png, info, rows);
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

}  // namespace

void readPng(const std::filesystem::path& file, bool keepsAlpha,
             const std::function<std::byte*(const PngSize&)>& place) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable))
    throw Error(fmt::format("{}: there is no such picture", file.string()));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, FreeImage> guard(&image);
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
    throw Error(fmt::format("{}: found no PNG picture ({})", file.string(), image.message));
  const bool hasAlpha = keepsAlpha && (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  image.format = hasAlpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  if (std::uint64_t{image.width} * image.height > kMostPixels)
    throw Error(fmt::format("{}: found {} x {} pixels; expected at most {} in all", file.string(),
                            image.width, image.height, kMostPixels));
  std::byte* pixels = place({static_cast<int>(image.width), static_cast<int>(image.height), hasAlpha});
  const png_color white{255, 255, 255};
  const auto upwards = -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(image));
  if (png_image_finish_read(&image, &white, pixels, upwards, nullptr) == 0)
    throw Error(fmt::format("{}: the PNG picture is damaged ({})", file.string(), image.message));
}

std::string pngBytes(vtkImageData& picture) {
  std::vector<png_bytep> rows;  // the highest one first
  for (int row = picture.GetDimensions()[1] - 1; row >= 0; --row)
    rows.push_back(static_cast<png_bytep>(picture.GetScalarPointer(0, row, 0)));
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const bool fine = encode(png, info, picture, rows.data(), &bytes);
  png_destroy_write_struct(&png, &info);
  if (!fine) throw Error("libpng refuses the picture");
  return bytes;
}

void writePng(vtkImageData& picture, const std::filesystem::path& file) {
  const std::string bytes = pngBytes(picture);
  writeFileAtomically(file, std::as_bytes(std::span(bytes)));
}

}  // namespace burnish
