#pragma once
#include <string>

/// How messages show what they have read.
namespace burnish {

/// A text cut to about 60 characters, with ... for the rest.
std::string shortened(const std::string& text);

/// The same in quotation marks.
std::string quoted(const std::string& text);

}  // namespace burnish
