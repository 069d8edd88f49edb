#pragma once
#include <string>

namespace burnish {

/// A page that is one file and asks nothing of the network: a policy in it forbids that, and every script but
/// its own. All texts but the title are HTML, CSS and JavaScript as they are; the style adds to that of all
/// pages. scriptHash: SHA-256 of the script, in hexadecimal digits.
struct HtmlPage {
  std::string title, style, body;
  std::string script{}, scriptHash{};
};

std::string htmlText(const HtmlPage& page);

/// Plain text for elements and quoted attributes.
std::string escaped(const std::string& text);

/// The bytes of a PNG file as an address.
std::string pngUri(const std::string& png);

}  // namespace burnish
