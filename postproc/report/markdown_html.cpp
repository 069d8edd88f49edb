#include "postproc/report/markdown_html.h"

#include <md4c-html.h>

#include <algorithm>

namespace burnish {
namespace {

void append(const char* bytes, MD_SIZE size, void* text) {
  static_cast<std::string*>(text)->append(bytes, size);
}

}  // namespace

std::string markdownHtml(const std::string& markdown,
                         const std::function<std::string(const std::string& address)>& picture) {
  std::string html;
  md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, MD_DIALECT_GITHUB, 0);
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
