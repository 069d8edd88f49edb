#pragma once
#include <string>

#include "engine/schema/declaration.h"

namespace burnish::inline schema {

/// The JSON Schema (draft 2020-12) of a document with these keys, as indented JSON: types, ranges, defaults,
/// sentences, the keys of every alternative. What needs more than one value, such as increasing lists, is
/// left to the reader.
std::string jsonSchema(const std::string& title, const Declarations& keys);

}  // namespace burnish::inline schema
