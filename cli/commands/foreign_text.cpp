#include "cli/commands/foreign_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "cli/commands/info_line.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_ranges.h"

namespace burnish {
namespace {

/// vtkQuadraticTetra as quadratic tetra. VTK 9.1 has the names of curved triangles and quadrilaterals in each other's
/// places.
std::string cellTypeInWords(int type) {
  std::string words;
  const std::map<int, int> swapped{{VTK_LAGRANGE_TRIANGLE, VTK_LAGRANGE_QUADRILATERAL},
                                   {VTK_LAGRANGE_QUADRILATERAL, VTK_LAGRANGE_TRIANGLE},
                                   {VTK_BEZIER_TRIANGLE, VTK_BEZIER_QUADRILATERAL},
                                   {VTK_BEZIER_QUADRILATERAL, VTK_BEZIER_TRIANGLE}};
  const int named = swapped.contains(type) ? swapped.at(type) : type;
  for (const char letter : std::string_view(vtkCellTypes::GetClassNameFromTypeId(named)).substr(3)) {
    const bool isCapital = letter >= 'A' && letter <= 'Z';
    if (isCapital && !words.empty()) words += ' ';
    words += isCapital ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return words;
}

std::string blockText(const ForeignBlock& block) {
  std::map<std::string, vtkIdType> types;
  for (vtkIdType cell = 0; cell < block.grid->GetNumberOfCells(); ++cell)
    ++types[cellTypeInWords(block.grid->GetCellType(cell))];
  std::string text = block.name.empty() ? "" : infoWords(block.name) + ": ";
  text += fmt::format("{} points, {} cells", block.grid->GetNumberOfPoints(), block.grid->GetNumberOfCells());
  std::vector<std::string> counts;
  for (const auto& [type, count] : types) counts.push_back(fmt::format("{} {}", count, type));
  if (!counts.empty()) text += fmt::format(" ({})", fmt::join(counts, ", "));
  return text;
}

/// As many as show the extent to a thousandth, of a box far from the origin more than six.
int boundsDigits(const Eigen::AlignedBox3d& box) {
  constexpr int kUsual = 6, kOfExtent = 3, kMost = std::numeric_limits<double>::max_digits10;
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double extent = box.sizes().maxCoeff();
  if (!(extent > 0.0)) return kUsual;
  return std::clamp(kOfExtent + static_cast<int>(std::ceil(std::log10(largest / extent))) + 1, kUsual, kMost);
}

std::string coordinatesText(const Eigen::Vector3d& point, int digits) {
  return fmt::format("{:.{}g}, {:.{}g}, {:.{}g}", point.x(), digits, point.y(), digits, point.z(), digits);
}

std::string boundsText(const std::vector<ForeignBlock>& blocks) {
  Eigen::AlignedBox3d box;
  for (const ForeignBlock& block : blocks) {
    const double* b = block.grid->GetBounds();
    if (block.grid->GetNumberOfPoints() == 0) continue;
    box.extend(Eigen::Vector3d(b[0], b[2], b[4])).extend(Eigen::Vector3d(b[1], b[3], b[5]));
  }
  if (box.isEmpty()) return "nothing";
  const int digits = boundsDigits(box);
  return fmt::format("({}) to ({})", coordinatesText(box.min(), digits), coordinatesText(box.max(), digits));
}

/// With as many digits as single precision has.
std::string rangeText(const ForeignRange& range) {
  if (!range.values) return "no finite value";
  const auto [least, most] = *range.values;
  std::string text = fmt::format("{:.9g} to {:.9g}", least, most);
  if (range.gaps > 0) text += fmt::format(", no finite value at {} of {}", range.gaps, range.all);
  return text;
}

std::string foreignFieldText(const ForeignField& field, const ForeignRanges& ranges) {
  std::string text = infoWords(field.name);
  if (!field.components.empty()) text += infoWords(fmt::format(" ({})", fmt::join(field.components, " ")));
  if (!field.unit.empty()) text += fmt::format(" [{}]", infoWords(field.unit));
  text += field.ofCells ? " of cells" : " of points";
  if (field.components.empty() || field.isVector()) return text + ": " + rangeText(ranges.of({field, -1}));
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < field.components.size(); ++k)
    texts.push_back(field.components[k] + " " + rangeText(ranges.of({field, static_cast<int>(k)})));
  return text + ": " + infoWords(fmt::format("{}", fmt::join(texts, "; ")));
}

}  // namespace

std::string foreignText(const ForeignFile& file) {
  const std::vector<double>& times = file.times();
  const std::vector<ForeignBlock> blocks = file.blocks(times.empty() ? 0 : times.size() - 1);
  std::string text = infoLine("file", file.file().string()) + infoLine("kind", foreignKind(file.file()));
  if (!times.empty())
    text += infoLine(
        "frames",
        fmt::format("{}, t = {:.7g} to {:.7g}{}", times.size(), times.front(), times.back(),
                    times.size() == 1 ? "" : fmt::format("; what follows is of frame {}", times.size() - 1)));
  for (const ForeignBlock& block : blocks) text += infoLine("block", blockText(block));
  text += infoLine("bounds", boundsText(blocks));
  const ForeignRanges ranges(blocks);
  for (const ForeignField& field : foreignFieldsOf(blocks))
    text += infoLine("field", foreignFieldText(field, ranges));
  return text;
}

}  // namespace burnish
