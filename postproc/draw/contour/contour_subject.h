#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/field_choice.h"

namespace burnish {

/// What a contour picture is of: a frame of a run, or an instant of a file of another program.
struct ContourSubject {
  int dim = 3;
  std::string title;           ///< unless the options have one
  std::optional<double> time;  ///< none of what has no time
  FieldChoice field;           ///< its words and what its values mean
  FieldRange ranges;
  ContourParts parts;
  std::vector<std::string> without;  ///< names of bodies that do not have the field
  std::string note;                  ///< what is to be said of it; may be empty
  std::string lengthUnit{};          ///< of positions; may be empty

  /// Makes parts exact in a view, for colours over a range; none of parts that are what they are.
  std::function<void(ContourParts& parts, const View& view, const std::array<double, 2>& range)> refine{};

  /// The values of the field by which the options choose, asked for when nothing is left; none where they choose nothing.
  std::function<std::array<double, 2>()> chosenRange{};

  /// What is to be said of what the options choose by values, of colours over a range; none where they choose nothing.
  std::function<std::string(const std::array<double, 2>& range)> choiceNote{};

  /// Leaves of a body in space what the options choose by values, when it is exact; none where they choose nothing.
  std::function<void(ContourParts& parts, const std::array<double, 2>& range)> choose{};
};

/// Draws as `contourImage` does.
ContourImage contourImage(const ContourSubject& subject, const ContourOptions& options);

/// Draws as `drawContour` does.
View drawContour(const ContourSubject& subject, const ContourOptions& options,
                 const std::filesystem::path& file);

/// Makes a page as `contourPage` does.
PrintPage contourPage(const ContourSubject& subject, const ContourOptions& options);

}  // namespace burnish
