#pragma once
#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

/// Keeps what is to be told of a picture that is drawn all the same. A text is kept once.
void noteWarning(const std::string& text);

/// A field, in words, and what has its values: "points" or "cells".
struct GappyField {
  std::string field, places;
  auto operator<=>(const GappyField&) const = default;
};

/// At how many of all places of a frame, which has no number if it is the only one, a field has no finite value.
struct FieldGaps {
  std::ptrdiff_t count, all;
  std::optional<int> frame;
};

/// Keeps that a field which is drawn has gaps. Those of all frames are told in one sentence.
void noteGaps(const GappyField& field, const FieldGaps& gaps);

/// What was noted since the last call.
std::vector<std::string> takeWarnings();

}  // namespace burnish
