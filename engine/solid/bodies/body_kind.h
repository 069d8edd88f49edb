#pragma once
#include <array>

namespace burnish::inline solid {

/// What a scene says about a shape of the body: the value of its key `shape`, a sentence, the shape with its
/// article, and the degrees in which NURBS describe it exactly, with one knot span in each direction.
template <int Dim>
struct BodyKind {
  const char* key;
  const char* sentence;
  const char* name;
  std::array<int, Dim> degrees;
};

}  // namespace burnish::inline solid
