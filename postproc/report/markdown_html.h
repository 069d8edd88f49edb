#pragma once
#include <functional>
#include <string>

namespace burnish {

/// A document in GitHub's Markdown as HTML. Its pictures become what `picture` makes of their address.
std::string markdownHtml(const std::string& markdown,
                         const std::function<std::string(const std::string& address)>& picture);

/// The document without the section "## TITLE", which ends at the next "## " or the anchor before it.
std::string withoutSection(const std::string& markdown, const std::string& title);

}  // namespace burnish
