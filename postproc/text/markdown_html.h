#pragma once
#include <functional>
#include <string>

namespace burnish {

/// A document in GitHub's Markdown as HTML, which stands still: its pictures become what `picture` makes of
/// their address, elements other than anchors, <sup>, <sub> and <br> are shown as text, and links lead to
/// http and https, beside the page or within it, or are text.
std::string markdownHtml(const std::string& markdown,
                         const std::function<std::string(const std::string& address)>& picture);

/// The document without the section "## TITLE", which ends at the next "## " or the anchor before it.
std::string withoutSection(const std::string& markdown, const std::string& title);

}  // namespace burnish
