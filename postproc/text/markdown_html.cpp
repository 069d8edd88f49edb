#include "postproc/text/markdown_html.h"

#include <md4c-html.h>

#include <algorithm>
#include <regex>

namespace burnish {
namespace {

void append(const char* bytes, MD_SIZE size, void* text) {
  static_cast<std::string*>(text)->append(bytes, size);
}

/// The elements that our documents have besides those of Markdown, as md4c shows them: as text.
const std::regex& ownElements() {
  static const std::regex pattern("&lt;(/?su[bp]|br ?/?|/a|a id=&quot;[A-Za-z0-9_.-]+&quot;)&gt;");
  return pattern;
}

/// With those as elements again; all others stay text.
std::string withOwnElements(const std::string& html) {
  std::string result;
  auto rest = html.cbegin();
  for (std::smatch found; std::regex_search(rest, html.cend(), found, ownElements());) {
    const std::string element = std::regex_replace(found[1].str(), std::regex("&quot;"), "\"");
    result.append(rest, found[0].first).append("<" + element + ">");
    rest = found[0].second;
  }
  return result.append(rest, html.cend());
}

/// Whether an address is one of http or https, one beside the page or a place in it. What browsers pass over
/// before a scheme, such as blanks, counts as part of it.
bool isHarmless(const std::string& address) {
  if (address.starts_with("//")) return false;
  const std::size_t colon = address.find(':');
  if (colon == std::string::npos || colon > address.find_first_of("/?#")) return true;
  static const std::regex allowed("https?", std::regex::icase);
  return std::regex_match(address.substr(0, colon), allowed);
}

/// Links to any other address become the text that they show.
std::string withoutOtherLinks(std::string html) {
  const std::string opening = "<a href=\"", closing = "</a>";
  for (std::size_t at = 0; (at = html.find(opening, at)) != std::string::npos;) {
    const std::size_t begin = at + opening.size(), end = html.find('"', begin);
    if (isHarmless(html.substr(begin, end - begin))) {
      at = end;
      continue;
    }
    html.erase(html.find(closing, end), closing.size());
    html.erase(at, html.find('>', end) + 1 - at);
  }
  return html;
}

}  // namespace

std::string markdownHtml(const std::string& markdown,
                         const std::function<std::string(const std::string& address)>& picture) {
  std::string html;
  md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html,
          MD_DIALECT_GITHUB | MD_FLAG_NOHTML, 0);
  html = withoutOtherLinks(withOwnElements(html));
  const std::string opening = "<img src=\"";
  for (std::size_t at = 0; (at = html.find(opening, at)) != std::string::npos;) {
    at += opening.size();
    const std::string shown = picture(html.substr(at, html.find('"', at) - at));
    html.replace(at, html.find('"', at) - at, shown);
    at += shown.size();
  }
  return html;
}

std::string withoutSection(const std::string& markdown, const std::string& title) {
  const std::size_t begin = markdown.find("\n## " + title + "\n");
  if (begin == std::string::npos) return markdown;
  const std::size_t end = std::min(markdown.find("\n## ", begin + 1), markdown.find("\n<a id=", begin + 1));
  return markdown.substr(0, begin) + (end == std::string::npos ? "\n" : markdown.substr(end));
}

}  // namespace burnish
