#include <hb-subset.h>
#include <hb.h>

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "postproc/draw/page/shaped_text.h"

/// HarfBuzz, loaded when a text of letters that join is drawn or a page holds a font: it brings libraries along.
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
using ShaperSubset = std::unique_ptr<hb_subset_input_t, ShaperDeleter<hb_subset_input_destroy>>;
using ShaperBuffer = std::unique_ptr<hb_buffer_t, ShaperDeleter<hb_buffer_destroy>>;

/// In units of the font's own grid.
hb_font_t* shaperFont(const std::string& file) {
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

}  // namespace
}  // namespace burnish

/// Leaves the text without glyphs if the font has none for a part of it.
extern "C" void burnishShapeText(const std::string& text, const std::string& fontFile,
                                 burnish::ShapedText& shaped) {
  using namespace burnish;
  hb_font_t* font = shaperFont(fontFile);
  const double em = hb_face_get_upem(hb_font_get_face(font));
  const ShaperBuffer buffer(hb_buffer_create());
  hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));  // not that of the environment
  hb_buffer_add_utf8(buffer.get(), text.data(), static_cast<int>(text.size()), 0, -1);
  hb_buffer_guess_segment_properties(buffer.get());
  hb_buffer_set_direction(buffer.get(), HB_DIRECTION_LTR);
  hb_shape(font, buffer.get(), nullptr, 0);
  const unsigned count = hb_buffer_get_length(buffer.get());
  const hb_glyph_info_t* glyphs = hb_buffer_get_glyph_infos(buffer.get(), nullptr);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), nullptr);
  ShapedText made;
  Eigen::Vector2d pen = Eigen::Vector2d::Zero();
  for (unsigned k = 0; k < count; ++k) {
    if (glyphs[k].codepoint == 0) return;
    const Eigen::Vector2d offset(places[k].x_offset, places[k].y_offset);
    made.glyphs.push_back({glyphs[k].codepoint, (pen + offset) / em, glyphs[k].cluster});
    pen += Eigen::Vector2d(places[k].x_advance, places[k].y_advance);
  }
  made.length = pen.x() / em;
  shaped = made;
}

/// Leaves the font empty if it has none of the letters.
extern "C" void burnishFontOfLetters(const std::set<char32_t>& letters, const std::string& fontFile,
                                     std::string& font) {
  using namespace burnish;
  hb_face_t* whole = hb_font_get_face(shaperFont(fontFile));
  const ShaperSubset wanted(hb_subset_input_create_or_fail());
  if (!wanted) return;
  hb_subset_input_set_flags(wanted.get(), HB_SUBSET_FLAGS_NO_HINTING);
  hb_set_t* codes = hb_subset_input_unicode_set(wanted.get());
  for (const char32_t letter : letters) hb_set_add(codes, letter);
  const ShaperFace part(hb_subset_or_fail(whole, wanted.get()));
  if (!part || hb_face_get_glyph_count(part.get()) < 2) return;  // the first one stands for what is missing
  const ShaperBlob blob(hb_face_reference_blob(part.get()));
  unsigned size = 0;
  const char* bytes = hb_blob_get_data(blob.get(), &size);
  font.assign(bytes, size);
}
