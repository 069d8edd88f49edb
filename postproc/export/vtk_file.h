#pragma once
#include <filesystem>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace burnish {

/// Writes a data set at a time of the analysis as VTK XML (compressed, base64), which other programs take for
/// the time of the file. The file appears under its name only when it is complete; equal data give equal
/// bytes. Throws `Error` naming the file.
void writeVtkFile(vtkUnstructuredGrid& grid, double time, const std::filesystem::path& vtu);
void writeVtkFile(vtkPolyData& data, double time, const std::filesystem::path& vtp);

}  // namespace burnish
