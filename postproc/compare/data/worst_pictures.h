#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "postproc/compare/data/compare_data.h"

namespace burnish {

/// Pictures of a field on both sides, as bytes of PNG files; empty for what cannot be drawn, such as values that are not
/// finite.
struct FieldPictures {
  std::string baseline, actual, difference;
};

/// A field that differs at a place.
struct WorstField {
  const DataPair* pair;
  const FieldComparison* field;
};

/// The fields whose values differ, at most so many: those of bodies first, and of these those whose difference is
/// the largest part of what is allowed.
std::vector<WorstField> worstFields(const std::vector<ResultComparison>& comparisons, std::size_t most);

/// Draws fields at the times at which they differ most, with a ring round the place: baseline and actual data
/// with the same colours and the same window; of the coefficients of a run also their difference, on the
/// deformed baseline, of other programs' points and cells the same or, if it is not finite somewhere, these places, and
/// of a column of a history charts.
class WorstPictures {
 public:
  /// Opens all files of the fields, whose pairs must outlive the object: before the first picture, see `ForeignFile`.
  explicit WorstPictures(const std::vector<WorstField>& fields);
  ~WorstPictures();
  WorstPictures(const WorstPictures&) = delete;
  WorstPictures& operator=(const WorstPictures&) = delete;

  /// field: one of these.
  FieldPictures draw(const WorstField& field) const;

 private:
  class PairDrawing;
  class RunDrawing;
  class FileDrawing;

  std::map<const DataPair*, std::unique_ptr<PairDrawing>> drawings_;
};

}  // namespace burnish
