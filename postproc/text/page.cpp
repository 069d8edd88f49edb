#include "postproc/text/page.h"

#include <fmt/format.h>
#include <vtkBase64Utilities.h>

#include <string_view>

#include "postproc/text/page_texts.h"

namespace burnish {

std::string base64(std::string_view bytes) {
  std::string encoded((bytes.size() + 2) / 3 * 4 + 4, '\0');
  const unsigned long length = vtkBase64Utilities::Encode(
      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned long>(bytes.size()),
      reinterpret_cast<unsigned char*>(encoded.data()), 0);
  encoded.resize(length);
  return encoded;
}

std::string sourceOfHash(const std::string& hash) {
  std::string bytes;
  for (std::size_t k = 0; k + 1 < hash.size(); k += 2)
    bytes += static_cast<char>(std::stoi(hash.substr(k, 2), nullptr, 16));
  return "'sha256-" + base64(bytes) + "'";
}

std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string_view, std::string>>& marks) {
  std::string result;
  for (const auto& [mark, replacement] : marks) {
    const std::size_t at = text.find(mark);
    result.append(text.substr(0, at)).append(replacement);
    text.remove_prefix(at + mark.size());
  }
  return result.append(text);
}

std::string htmlText(const HtmlPage& page) {
  const bool isAlone = !page.styleHash.empty();
  std::string scripts = page.script.empty() ? "'none'" : sourceOfHash(page.scriptHash);
  for (const std::string& hash : page.framedHashes) scripts += ' ' + sourceOfHash(hash);
  return filled(
      kCommonPage,
      {{"/*reload*/", page.reloadSeconds > 0
                          ? fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", page.reloadSeconds)
                          : ""},
       {"/*style-source*/", isAlone ? sourceOfHash(page.styleHash) : "'unsafe-inline'"},
       {"/*script-source*/", scripts},
       {"/*title*/", escaped(page.title)},
       {"/*style*/", isAlone ? page.style : kCommonStyle + page.style},
       {"/*body*/", page.body},
       {"/*script*/", page.script}});
}

std::string framed(const HtmlPage& page, const std::string& name) {
  return fmt::format("<iframe title=\"{}\" srcdoc=\"{}\"></iframe>\n", escaped(name),
                     escaped(htmlText(page)));
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
