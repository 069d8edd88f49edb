#pragma once
#include <string>

/// How messages show what they have read.
namespace burnish::inline core {

/// A text as `forMessage` shows it, cut after 60 letters.
std::string shortened(const std::string& text);

/// The same in quotation marks.
std::string quoted(const std::string& text);

}  // namespace burnish::inline core
