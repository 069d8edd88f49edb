#pragma once
#include <string>

namespace burnish {

enum class FontWeight { Regular, Bold };

/// The DejaVu Sans font, which has Greek letters, overbars and superscripts, from the system's font
/// directories. Throws `Error` that names the package if it is not installed.
const std::string& fontFile(FontWeight weight);

}  // namespace burnish
