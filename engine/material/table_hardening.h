#pragma once
#include <string>
#include <vector>

#include "engine/material/law_list.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// Yield stress from a table: piecewise linear, constant beyond the last entry.
class TableHardening {
 public:
  static constexpr LawKind kind{"table", "Piecewise linear."};

  struct Parameters {
    std::vector<double> ep;      ///< starts at 0, strictly increasing
    std::vector<double> stress;  ///< > 0, one for each; constant beyond the last entry
  };

  /// Throws `Error` unless both lists are equally long and not empty, `ep` starts at 0 and increases
  /// strictly, and all stresses are positive.
  explicit TableHardening(const Parameters& table);

  double sigma_y(double e) const;
  double slope(double e) const;
  double work(double e) const;

 private:
  struct Piece {
    double start;  ///< plastic strain at which the piece begins
    double sigma;  ///< yield stress there
    double slope;
    double work;  ///< H there
  };
  const Piece& pieceAt(double e) const;

  std::vector<Piece> pieces_;
};

template <class Visitor>
void describe(Visitor& v, TableHardening::Parameters& s) {
  v.field("ep", s.ep, {.required = true, .atLeast = 0, .increasing = true, .minEntries = 1},
          "Equivalent plastic strains; the first is 0.");
  v.field("stress", s.stress, {.required = true, .above = 0, .minEntries = 1, .unit = "stress"},
          "Yield stress at each of them; linear in between and constant beyond the last.");
}

/// See `checkHardening`.
void check(const TableHardening::Parameters& table, const Problems& problems, const std::string& key);

}  // namespace burnish::inline material
