#include "postproc/draw/page/glyph_picture.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "postproc/draw/page/cairo_handles.h"

namespace burnish {
namespace {

/// Of what graphics take as one picture.
constexpr int kLongestSide = 16'000;

using Outlines = CairoPtr<cairo_path_t, cairo_path_destroy>;

/// Of the glyphs, and the box around them, on a page whose y goes down.
struct GlyphOutlines {
  Outlines path;
  double x0, y0, x1, y1;
};

GlyphOutlines outlinesOf(const ShapedText& text, const std::string& fontFile, int size) {
  const CairoSurface none(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext page(cairo_create(none.get()));
  placeLettersExactly(*page);
  cairo_set_font_face(page.get(), cairoFace(fontFile).get());
  cairo_set_font_size(page.get(), size);
  std::vector<cairo_glyph_t> glyphs;
  for (const Glyph& glyph : text.glyphs)
    glyphs.push_back({glyph.index, size * glyph.at.x(), -size * glyph.at.y()});
  cairo_glyph_path(page.get(), glyphs.data(), static_cast<int>(glyphs.size()));
  requireCairo(cairo_status(page.get()));
  GlyphOutlines outlines{Outlines(cairo_copy_path(page.get())), 0.0, 0.0, 0.0, 0.0};
  cairo_path_extents(page.get(), &outlines.x0, &outlines.y0, &outlines.x1, &outlines.y1);
  return outlines;
}

}  // namespace

GlyphPicture glyphPicture(const ShapedText& text, const std::string& fontFile, int size, const Color& color,
                          bool upwards) {
  const auto [path, x0, y0, x1, y1] = outlinesOf(text, fontFile, size);
  const int left = static_cast<int>(std::floor(x0)), top = static_cast<int>(std::floor(y0));
  const int width = std::clamp(static_cast<int>(std::ceil(x1)) - left, 1, kLongestSide);
  const int height = std::clamp(static_cast<int>(std::ceil(y1)) - top, 1, kLongestSide);

  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, width, height));
  const CairoContext page(cairo_create(surface.get()));
  cairo_translate(page.get(), -left, -top);
  cairo_append_path(page.get(), path.get());
  cairo_fill(page.get());
  requireCairo(cairo_status(page.get()));
  cairo_surface_flush(surface.get());
  const unsigned char* covered = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());

  GlyphPicture picture{vtkSmartPointer<vtkImageData>::New(), {left, -(top + height)}};
  picture.pixels->SetDimensions(upwards ? height : width, upwards ? width : height, 1);
  picture.pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      // A quarter turn takes what is on top to the left.
      const auto [x, y] = upwards ? std::pair{row, column} : std::pair{column, height - 1 - row};
      auto* pixel = static_cast<unsigned char*>(picture.pixels->GetScalarPointer(x, y, 0));
      std::copy(color.begin(), color.end(), pixel);
      pixel[3] = covered[row * stride + column];
    }
  if (upwards) picture.corner = {top, left};
  return picture;
}

}  // namespace burnish
