#include "postproc/html/page.h"

#include <vtkBase64Utilities.h>

#include <string_view>

#include "postproc/html/page_texts.h"

namespace burnish {

std::string htmlText(const HtmlPage& page) {
  std::string_view rest = kCommonPage;
  std::string text;
  const auto replace = [&](std::string_view mark, const std::string& replacement) {
    const std::size_t at = rest.find(mark);
    text.append(rest.substr(0, at)).append(replacement);
    rest.remove_prefix(at + mark.size());
  };
  replace("/*title*/", escaped(page.title));
  replace("/*style*/", kCommonStyle + page.style);
  replace("/*body*/", page.body);
  replace("/*script*/", page.script);
  return text.append(rest);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string pngUri(const std::string& png) {
  std::string encoded((png.size() + 2) / 3 * 4 + 4, '\0');
  const auto* bytes = reinterpret_cast<const unsigned char*>(png.data());
  const unsigned long length = vtkBase64Utilities::Encode(
      bytes, static_cast<unsigned long>(png.size()), reinterpret_cast<unsigned char*>(encoded.data()), 0);
  encoded.resize(length);
  return "data:image/png;base64," + encoded;
}

}  // namespace burnish
