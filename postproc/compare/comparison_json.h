#pragma once
#include <json/value.h>

#include "postproc/compare/comparison.h"
#include "postproc/text/json_text.h"

namespace burnish {

/// `name`, `verdict`, `metric`, `value`, `threshold`, `different_share`, `box` (`x`, `y`, `width`, `height`
/// in pixels from the upper left corner) and `message`. Value and share are null where nothing could be
/// measured, the box also where nothing differs.
Json::Value comparisonJson(const Comparison& comparison, const PictureRule& rule);

/// A list of objects, in as many lines.
std::string comparisonsText(const std::vector<Comparison>& comparisons, const PictureRule& rule);

/// A list of values, in as many lines.
std::string listText(const std::vector<Json::Value>& values, int digits = 6);

}  // namespace burnish
