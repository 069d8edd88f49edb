#include "engine/material/table_hardening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/error.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

void requireTable(const std::vector<double>& e, const std::vector<double>& sigma) {
  if (e.empty() || e.size() != sigma.size())
    throw Error("hardening table: " + std::to_string(e.size()) + " plastic strains and " +
                std::to_string(sigma.size()) + " stresses; give one stress for each strain, at least one");
  if (e.front() != 0.0)
    throw Error("hardening table: the first plastic strain is " + std::to_string(e.front()) +
                ", it must be 0");
  for (std::size_t k = 0; k < e.size(); ++k) {
    const std::string place = "hardening table, entry " + std::to_string(k + 1);
    if (!std::isfinite(e[k]) || (k > 0 && !(e[k] > e[k - 1])))
      throw Error(place + ": plastic strain " + std::to_string(e[k]) + " must be larger than the one before");
    if (!(sigma[k] > 0.0) || !std::isfinite(sigma[k]))
      throw Error(place + ": yield stress " + std::to_string(sigma[k]) + " must be positive");
  }
}

}  // namespace

TableHardening::TableHardening(const Parameters& table) {
  const auto& [e, sigma] = table;
  requireTable(e, sigma);
  double work = 0.0;
  for (std::size_t k = 0; k + 1 < e.size(); ++k) {
    const double length = e[k + 1] - e[k];
    pieces_.push_back({e[k], sigma[k], (sigma[k + 1] - sigma[k]) / length, work});
    work += 0.5 * (sigma[k] + sigma[k + 1]) * length;
  }
  pieces_.push_back({e.back(), sigma.back(), 0.0, work});
}

const TableHardening::Piece& TableHardening::pieceAt(double e) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), e,
                                      [](double value, const Piece& piece) { return value < piece.start; });
  return after == pieces_.begin() ? *after : *std::prev(after);
}

double TableHardening::sigma_y(double e) const {
  const Piece& piece = pieceAt(e);
  return piece.sigma + piece.slope * (e - piece.start);
}

double TableHardening::slope(double e) const {
  return pieceAt(e).slope;
}

double TableHardening::work(double e) const {
  const Piece& piece = pieceAt(e);
  const double s = e - piece.start;
  return piece.work + (piece.sigma + 0.5 * piece.slope * s) * s;
}

void check(const TableHardening::Parameters& table, const Problems& problems, const std::string& key) {
  if (!problems.clean(key)) return;
  if (table.ep.front() != 0.0)
    problems.report(
        key + ".ep[0]",
        fmt::format("found {}; allowed: 0, the table begins without plastic strain.", table.ep.front()));
  if (table.stress.size() != table.ep.size())
    problems.report(key + ".stress",
                    fmt::format("found {} stresses for {} plastic strains; allowed: one for each.",
                                table.stress.size(), table.ep.size()));
}

}  // namespace burnish::inline material
