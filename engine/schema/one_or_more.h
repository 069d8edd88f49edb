#pragma once
#include <vector>

namespace burnish::inline schema {

/// A list of mappings, of which a document may give a single one without brackets.
template <class T>
struct OneOrMore : std::vector<T> {
  using std::vector<T>::vector;
};

}  // namespace burnish::inline schema
