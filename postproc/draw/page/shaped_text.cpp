#include "postproc/draw/page/shaped_text.h"

#include <hb-ot.h>
#include <hb.h>
#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "postproc/draw/page/cairo_handles.h"

namespace burnish {
namespace {

template <auto Destroy>
struct ShaperDeleter {
  template <class T>
  void operator()(T* object) const {
    Destroy(object);
  }
};
using ShaperFont = std::unique_ptr<hb_font_t, ShaperDeleter<hb_font_destroy>>;
using ShaperFace = std::unique_ptr<hb_face_t, ShaperDeleter<hb_face_destroy>>;
using ShaperBlob = std::unique_ptr<hb_blob_t, ShaperDeleter<hb_blob_destroy>>;
using ShaperBuffer = std::unique_ptr<hb_buffer_t, ShaperDeleter<hb_buffer_destroy>>;

/// In units of the font's own grid.
hb_font_t* fontOf(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, ShaperFont> fonts;
  const std::lock_guard lock(mutex);
  ShaperFont& font = fonts[file];
  if (!font) {
    const ShaperBlob blob(hb_blob_create_from_file(file.c_str()));
    const ShaperFace face(hb_face_create(blob.get(), 0));
    font.reset(hb_font_create(face.get()));
    hb_font_make_immutable(font.get());
  }
  return font.get();
}

/// For cairo, whose y goes down.
std::vector<cairo_glyph_t> scaledGlyphs(const ShapedText& text, int size, double x, double y) {
  std::vector<cairo_glyph_t> glyphs;
  for (const Glyph& glyph : text.glyphs)
    glyphs.push_back({glyph.index, x + size * glyph.at.x(), y - size * glyph.at.y()});
  return glyphs;
}

void chooseFont(cairo_t& page, const std::string& fontFile, int size) {
  placeLettersExactly(page);
  cairo_set_font_face(&page, cairoFace(fontFile).get());
  cairo_set_font_size(&page, size);
}

}  // namespace

ShapedText shapedText(const std::string& text, const std::string& fontFile) {
  hb_font_t* font = fontOf(fontFile);
  const double em = hb_face_get_upem(hb_font_get_face(font));
  const ShaperBuffer buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), text.data(), static_cast<int>(text.size()), 0, -1);
  hb_buffer_guess_segment_properties(buffer.get());
  hb_buffer_set_direction(buffer.get(), HB_DIRECTION_LTR);
  hb_shape(font, buffer.get(), nullptr, 0);
  const unsigned count = hb_buffer_get_length(buffer.get());
  const hb_glyph_info_t* glyphs = hb_buffer_get_glyph_infos(buffer.get(), nullptr);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), nullptr);
  ShapedText shaped;
  Eigen::Vector2d pen = Eigen::Vector2d::Zero();
  for (unsigned k = 0; k < count; ++k) {
    if (glyphs[k].codepoint == 0) return {};
    const Eigen::Vector2d offset(places[k].x_offset, places[k].y_offset);
    shaped.glyphs.push_back({glyphs[k].codepoint, (pen + offset) / em, glyphs[k].cluster});
    pen += Eigen::Vector2d(places[k].x_advance, places[k].y_advance);
  }
  shaped.length = pen.x() / em;
  return shaped;
}

GlyphPicture glyphPicture(const ShapedText& text, const std::string& fontFile, int size, const Color& color,
                          bool upwards) {
  cairo_text_extents_t extents{};
  const CairoSurface none(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext measure(cairo_create(none.get()));
  chooseFont(*measure, fontFile, size);
  std::vector<cairo_glyph_t> glyphs = scaledGlyphs(text, size, 0.0, 0.0);
  cairo_glyph_extents(measure.get(), glyphs.data(), static_cast<int>(glyphs.size()), &extents);
  requireCairo(cairo_status(measure.get()));
  // A pixel more on all sides, for the edges of the glyphs.
  const int left = static_cast<int>(std::floor(extents.x_bearing)) - 1;
  const int top = static_cast<int>(std::floor(extents.y_bearing)) - 1;
  const int width = static_cast<int>(std::ceil(extents.x_bearing + extents.width)) + 1 - left;
  const int height = static_cast<int>(std::ceil(extents.y_bearing + extents.height)) + 1 - top;

  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, width, height));
  const CairoContext page(cairo_create(surface.get()));
  chooseFont(*page, fontFile, size);
  glyphs = scaledGlyphs(text, size, -left, -top);
  cairo_show_glyphs(page.get(), glyphs.data(), static_cast<int>(glyphs.size()));
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
      auto* pixel = static_cast<unsigned char*>(
          upwards ? picture.pixels->GetScalarPointer(row, column, 0)
                  : picture.pixels->GetScalarPointer(column, height - 1 - row, 0));
      std::copy(color.begin(), color.end(), pixel);
      pixel[3] = covered[row * stride + column];
    }
  if (upwards) picture.corner = {top, left};
  return picture;
}

}  // namespace burnish
