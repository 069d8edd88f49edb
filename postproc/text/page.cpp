#include "postproc/text/page.h"

#include <vtkBase64Utilities.h>

#include <string_view>

#include "postproc/text/page_texts.h"

namespace burnish {

namespace {

std::string base64(std::string_view bytes) {
  std::string encoded((bytes.size() + 2) / 3 * 4 + 4, '\0');
  const unsigned long length = vtkBase64Utilities::Encode(
      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned long>(bytes.size()),
      reinterpret_cast<unsigned char*>(encoded.data()), 0);
  encoded.resize(length);
  return encoded;
}

/// What the policy of a page says of its script.
std::string sourceOf(const HtmlPage& page) {
  if (page.script.empty()) return "'none'";
  std::string bytes;
  for (std::size_t k = 0; k + 1 < page.scriptHash.size(); k += 2)
    bytes += static_cast<char>(std::stoi(page.scriptHash.substr(k, 2), nullptr, 16));
  return "'sha256-" + base64(bytes) + "'";
}

}  // namespace

std::string htmlText(const HtmlPage& page) {
  std::string_view rest = kCommonPage;
  std::string text;
  const auto replace = [&](std::string_view mark, const std::string& replacement) {
    const std::size_t at = rest.find(mark);
    text.append(rest.substr(0, at)).append(replacement);
    rest.remove_prefix(at + mark.size());
  };
  replace("/*script-source*/", sourceOf(page));
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
  return "data:image/png;base64," + base64(png);
}

}  // namespace burnish
