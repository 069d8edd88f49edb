#pragma once

namespace burnish {

/// Names of the values of an enumeration, in files and messages. Specialised beside every enumeration that a
/// document may choose from: `values`, an array of pairs of name and value.
template <class E>
struct EnumNames;

}  // namespace burnish
