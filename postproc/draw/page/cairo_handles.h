#pragma once
#include <cairo-ft.h>

#include <memory>
#include <string>

namespace burnish {

template <class T, void (*Free)(T*)>
struct CairoDeleter {
  void operator()(T* object) const { Free(object); }
};
template <class T, void (*Free)(T*)>
using CairoPtr = std::unique_ptr<T, CairoDeleter<T, Free>>;

using CairoSurface = CairoPtr<cairo_surface_t, cairo_surface_destroy>;
using CairoContext = CairoPtr<cairo_t, cairo_destroy>;
using CairoFace = CairoPtr<cairo_font_face_t, cairo_font_face_destroy>;
using CairoFontOptions = CairoPtr<cairo_font_options_t, cairo_font_options_destroy>;

/// Throws `Error` for what is no success.
void requireCairo(cairo_status_t status);

/// Throws `Error` if the file cannot be read.
CairoFace cairoFace(const std::string& fontFile);

/// Letters stand where they belong on paper, not at whole pixels.
void placeLettersExactly(cairo_t& page);

}  // namespace burnish
