#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/data/data_comparison.h"
#include "postproc/compare/data/data_pairs.h"

namespace burnish {

/// What became of the fields of one pair.
struct ResultComparison {
  DataPair pair;
  std::vector<FieldComparison> fields;
};

/// The name of a field, behind that of the pair if it has one: "press: stress".
std::string fullName(const DataPair& pair, const FieldComparison& field);

/// Compares two of a kind that is not pictures, or what is below two directories pair by pair: of these what cannot
/// be read is a verdict. Throws `Error` for two that cannot be read, a missing baseline among them unless
/// `mayLackBaseline`, for patterns of the rule that match nothing, and if they leave no field.
std::vector<ResultComparison> compareData(ComparedKind kind, const std::filesystem::path& actual,
                                          const std::filesystem::path& baseline, const DataRule& rule,
                                          bool mayLackBaseline = false);

/// Whether the actual data of a pair differ, are whole and can be copied by themselves, so that `makeBaseline` makes
/// them the baseline.
bool becomesBaseline(const ResultComparison& comparison);

/// Makes the actual data of the pairs that differ the baseline, and compares these again. Returns a line for each: its
/// name, and what is left of the former baseline beside it. Pairs of which one is missing at `actual` or cannot
/// be read stay as they are, and of several those that name other files, with a line that says so. Throws
/// `Error` for a single file that names others, and for files that cannot be written.
std::vector<std::string> makeBaseline(std::vector<ResultComparison>& comparisons, const DataRule& rule);

}  // namespace burnish
