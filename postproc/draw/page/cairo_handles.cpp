#include "postproc/draw/page/cairo_handles.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>

#include "engine/core/error.h"

namespace burnish {

void requireCairo(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(fmt::format("cairo cannot draw: {}", cairo_status_to_string(status)));
}

CairoFace cairoFace(const std::string& fontFile) {
  FcPattern* pattern = FcPatternBuild(nullptr, FC_FILE, FcTypeString, fontFile.c_str(), nullptr);
  CairoFace face(cairo_ft_font_face_create_for_pattern(pattern));
  FcPatternDestroy(pattern);
  requireCairo(cairo_font_face_status(face.get()));
  return face;
}

void placeLettersExactly(cairo_t& page) {
  const CairoFontOptions options(cairo_font_options_create());
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(&page, options.get());
}

}  // namespace burnish
