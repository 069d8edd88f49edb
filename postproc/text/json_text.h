#pragma once
#include <json/value.h>

#include <string>

namespace burnish {

/// Of numbers that are to be computed with.
inline constexpr int kJsonDigits = 15;

/// Without blanks and line ends; numbers with so many digits.
std::string compactText(const Json::Value& value, int digits = 6);

/// The same for a script element of a page, which it cannot end.
std::string scriptText(const Json::Value& value, int digits = 6);

}  // namespace burnish
