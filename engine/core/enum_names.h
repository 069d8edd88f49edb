#pragma once

#include <array>
#include <type_traits>
#include <utility>

namespace burnish::inline core {

/// Names of the values of an enumeration, in files and messages: pairs of name and value. Beside every enumeration
/// that a document may choose from stands the function that gives them,
/// `constexpr auto enumNames(std::type_identity<E>)`.
template <class E>
inline constexpr auto kNamesOf = enumNames(std::type_identity<E>{});

}  // namespace burnish::inline core
