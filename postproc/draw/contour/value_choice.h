#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/schema/leaf.h"

/// Which values of a field a picture shows, as scenes and options of the command spell them.
namespace burnish {

/// Values between two ends, of the field that is drawn or of another one.
struct ValueBand {
  std::string field;  ///< empty: the one that is drawn
  std::array<double, 2> ends{-std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity()};
};

/// Some values of a field: so many, at equal distances between the ends of the colours, or given ones.
struct ChosenValues {
  int count = 0;               ///< of the field that is drawn; 0: the given ones
  std::string field;           ///< of the given ones
  std::vector<double> values;  ///< increasing

  /// Those meant by colours that go through a range, or by those of a field of one value, between which there are none.
  std::vector<double> of(const std::optional<std::array<double, 2>>& range) const;
};

inline constexpr int kMostSurfaces = 20;

template <>
struct Spelling<ValueBand> {
  static std::optional<ValueBand> read(const std::string& text);
  static std::string write(const ValueBand& band);
  static std::string words() {
    return "LO,HI or FIELD=LO,HI, the first one smaller; \"0.1,\" and \",0.1\" have one end";
  }
  static std::vector<std::string> candidates() { return {}; }
};

template <>
struct Spelling<ChosenValues> {
  static std::optional<ChosenValues> read(const std::string& text);
  static std::string write(const ChosenValues& chosen);
  static std::string words() {
    return "their number, 1 to 20, or FIELD=V,V,...: up to 20 increasing values of a field";
  }
  static std::vector<std::string> candidates() { return {}; }
};

/// What a picture says of it: "shown: Pressure from 0.5 to 2 MPa". words, unit: of the field.
std::string bandNote(const ValueBand& band, const std::string& words, const std::string& unit);

/// The same of surfaces: "surfaces: Pressure = 0.5, 1 MPa"; of many "9 surfaces: Pressure = 0.1, 0.2, …, 0.9 MPa".
std::string surfacesNote(const std::vector<double>& values, const std::string& words,
                         const std::string& unit);

}  // namespace burnish
