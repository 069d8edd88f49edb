#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/shown_text.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/text/page.h"

namespace {

using namespace burnish;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Part of a text up to a byte, which is taken from it.
std::string taken(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string part(text.substr(0, length));
  text.remove_prefix(std::min(length + 1, text.size()));
  return part;
}

/// An array of zeros with a name and, behind tabulators, those of its components.
vtkSmartPointer<vtkDoubleArray> arrayOf(std::string_view names, int components, vtkIdType count) {
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  array->Fill(0.0);
  array->SetName(taken(names, '\t').c_str());
  for (int k = 0; k < components && !names.empty(); ++k)
    array->SetComponentName(k, taken(names, '\t').c_str());
  return array.Get();
}

/// A name that can be given, read and written.
void requireShown(const std::string& name) {
  require(!name.empty() && shownTextFault(name).empty());
  require(name.find_first_of(",\n\t") == std::string::npos);
  require(escaped(name).find_first_of("<>\"") == std::string::npos);
  require(csvRow({name}).find('\n') == std::string::npos);
}

}  // namespace

/// Names that a file of another program may have, parted by zeros: one that is asked for, then those of arrays, whose first
/// byte says whether they are of cells and how many components they have. Every field has a name of its own by which it
/// is found.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostArrays = 30;
  constexpr int kMostComponents = 10;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string asked = taken(text, '\0');
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  grid->SetPoints(points);
  const vtkIdType corner = 0;
  grid->InsertNextCell(VTK_VERTEX, 1, &corner);
  std::set<std::string> pointNames, cellNames;  // a reader gives arrays names that differ
  for (std::size_t k = 0; k < kMostArrays && !text.empty(); ++k) {
    const std::string line = taken(text, '\0');
    if (line.size() < 2) continue;
    const bool ofCells = (line[0] & 1) != 0;
    const auto array =
        arrayOf(std::string_view(line).substr(1), 1 + (line[0] >> 1 & 0x3F) % kMostComponents, 1);
    if (*array->GetName() == '\0' || !(ofCells ? cellNames : pointNames).insert(array->GetName()).second)
      continue;
    if (ofCells)
      grid->GetCellData()->AddArray(array);
    else
      grid->GetPointData()->AddArray(array);
  }

  const std::vector<ForeignBlock> blocks{{"", grid.Get()}};
  const std::vector<ForeignField> fields = foreignFieldsOf(blocks);
  std::set<std::string> names;
  for (const ForeignField& field : fields) {
    require(names.insert(field.name).second);
    const auto requireFound = [&](const std::string& name, int component) {
      requireShown(name);
      const auto found = findForeignField(fields, name);
      require(found && found->component == component);
      require(std::tie(found->field.array, found->field.ofCells) == std::tie(field.array, field.ofCells));
      require(found->valuesOf(blocks.front()).size() == 1);
      require(shownTextFault(wordsOf(*found).words).empty());
    };
    if (field.components.empty() || field.isVector()) requireFound(field.name, -1);
    for (std::size_t k = 0; k < field.components.size(); ++k)
      requireFound(field.name + "." + field.components[k], static_cast<int>(k));
  }
  const std::string shown = foreignFieldToShow(fields);
  require(fields.empty() ? shown.empty() : findForeignField(fields, shown).has_value());
  try {
    chooseForeignField(fields, asked);
  } catch (const Error& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}
