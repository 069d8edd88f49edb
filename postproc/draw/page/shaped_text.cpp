#include "postproc/draw/page/shaped_text.h"

#include "engine/core/module_function.h"

namespace burnish {

ShapedText shapedText(const std::string& text, const std::string& fontFile) {
  using Shape = void(const std::string&, const std::string&, ShapedText&);
  static auto* const shape = reinterpret_cast<Shape*>(
      moduleFunction({"burnish_shaper.so"}, "burnishShapeText", "a text of letters that join"));
  ShapedText shaped;
  shape(text, fontFile, shaped);
  return shaped;
}

std::string fontOfLetters(const std::set<char32_t>& letters, const std::string& fontFile) {
  using Take = void(const std::set<char32_t>&, const std::string&, std::string&);
  static auto* const take = reinterpret_cast<Take*>(
      moduleFunction({"burnish_shaper.so"}, "burnishFontOfLetters", "a page with texts as SVG"));
  std::string font;
  take(letters, fontFile, font);
  return font;
}

}  // namespace burnish
