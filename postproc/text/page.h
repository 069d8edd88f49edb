#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace burnish {

/// A page that is one file and asks nothing of the network: a policy in it forbids that, and every script but
/// its own. All texts but the title are HTML, CSS and JavaScript as they are. scriptHash, styleHash: SHA-256 in
/// hexadecimal digits. A style with a hash is all that the page has; one without adds to that of all pages.
struct HtmlPage {
  std::string title, style, body;
  std::string script{}, scriptHash{}, styleHash{};
  std::vector<std::string> framedHashes{};  ///< of the scripts of pages that stand in it, see `framed`
  int reloadSeconds = 0;                    ///< after which the page loads itself again; 0: never
};

std::string htmlText(const HtmlPage& page);

/// An element that shows a page within another one, which must allow the script of it. name: for readers that do not see it.
std::string framed(const HtmlPage& page, const std::string& name);

/// A text with its marks replaced; each stands in it once, in this order.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& marks);

/// What a policy says of a script or a style with this hash (SHA-256 in hexadecimal digits): 'sha256-...'.
std::string sourceOfHash(const std::string& hash);

/// Bytes in letters.
std::string base64(std::string_view bytes);

/// Plain text for elements and quoted attributes.
std::string escaped(const std::string& text);

/// The bytes of a PNG file as an address.
std::string pngUri(const std::string& png);

}  // namespace burnish
