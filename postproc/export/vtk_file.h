#pragma once
#include <filesystem>
#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace burnish {

/// Writes a data set at a time of the analysis as VTK XML (compressed, base64), which other programs take for
/// the time of the file. The file appears under its name only when it is complete; equal data give equal
/// bytes. Throws `Error` naming the file.
void writeVtkFile(vtkUnstructuredGrid& grid, double time, const std::filesystem::path& vtu);
void writeVtkFile(vtkPolyData& data, double time, const std::filesystem::path& vtp);

/// What a data set has at its points and in its cells, as a `.pvtu` file tells it of all its pieces.
std::string layoutOf(vtkUnstructuredGrid& grid);

/// Writes the file that makes one data set of several files beside it, which have the same layout. Throws
/// `Error` naming the file.
void writePvtuFile(const std::string& layout, const std::vector<std::filesystem::path>& pieces,
                   const std::filesystem::path& pvtu);

}  // namespace burnish
