#pragma once
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace burnish {

/// A part of a file of another program: cells on points, with arrays of numbers at both, whose names differ.
struct ForeignBlock {
  std::string name;  ///< empty for the only one of a file that does not name it
  vtkSmartPointer<vtkUnstructuredGrid> grid;
};

/// A file of another program as VTK's readers see it, in the process that they may bring to its end.
class ForeignSource {
 public:
  virtual ~ForeignSource() = default;

  /// Ascending; empty for one instant without a time.
  virtual std::vector<double> times() { return {}; }

  /// What is there at an instant, checked by `isSound`. Throws `Error` for what is damaged.
  virtual std::vector<ForeignBlock> blocks(std::size_t instant) = 0;
};

/// What the ending of a name says of a file, in words ("an STL file"); empty for an ending that no reader has.
std::string foreignKind(const std::filesystem::path& file);

/// All endings with a reader.
std::vector<std::string> foreignEndings();

/// Loads VTK's readers, which takes some hundredths of a second. Throws `Error` if they are not installed.
void loadReaders();

/// Opens a file by its ending. Throws `Error` for a file that is not there, or none of its ending, or damaged.
/// From now on VTK's errors are noted in this process: `blocks` throws for them, too.
std::unique_ptr<ForeignSource> openForeign(const std::filesystem::path& file);

}  // namespace burnish
