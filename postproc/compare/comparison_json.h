#pragma once
#include <json/value.h>

#include "postproc/compare/comparison.h"

namespace burnish {

/// `name`, `verdict`, `metric`, `value`, `threshold`, `different_share`, `box` (`x`, `y`, `width`, `height`
/// in pixels from the upper left corner) and `message`. Value and share are null where nothing could be
/// measured, the box also where nothing differs.
Json::Value comparisonJson(const Comparison& comparison, const PictureRule& rule);

/// A list of objects, in as many lines.
std::string comparisonsText(const std::vector<Comparison>& comparisons, const PictureRule& rule);

/// Without blanks and line ends.
std::string compactText(const Json::Value& value);

}  // namespace burnish
