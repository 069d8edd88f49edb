#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/lower_case.h"

namespace burnish {

/// A format of other programs, as the program knows it without its reader.
struct ForeignFormat {
  std::string_view ending;  ///< of the names of files, in lower case
  const char* words;
};

/// In the order of their endings.
inline constexpr std::array kForeignFormats{
    ForeignFormat{".avs", "AVS UCD file"},   ForeignFormat{".cas", "Fluent case"},
    ForeignFormat{".case", "EnSight case"},  ForeignFormat{".cgns", "CGNS file"},
    ForeignFormat{".e", "Exodus file"},      ForeignFormat{".ex2", "Exodus file"},
    ForeignFormat{".exo", "Exodus file"},    ForeignFormat{".foam", "case of OpenFOAM"},
    ForeignFormat{".glb", "glTF file"},      ForeignFormat{".obj", "OBJ file"},
    ForeignFormat{".ply", "PLY file"},       ForeignFormat{".pvd", "collection of VTK files"},
    ForeignFormat{".pvti", "VTK file"},      ForeignFormat{".pvtp", "VTK file"},
    ForeignFormat{".pvtr", "VTK file"},      ForeignFormat{".pvts", "VTK file"},
    ForeignFormat{".pvtu", "VTK file"},      ForeignFormat{".series", "series of VTK files"},
    ForeignFormat{".stl", "STL file"},       ForeignFormat{".tec", "Tecplot file"},
    ForeignFormat{".tp", "Tecplot file"},    ForeignFormat{".ucd", "AVS UCD file"},
    ForeignFormat{".vti", "VTK file"},       ForeignFormat{".vtk", "legacy VTK file"},
    ForeignFormat{".vtkhdf", "VTKHDF file"}, ForeignFormat{".vtm", "VTK file"},
    ForeignFormat{".vtp", "VTK file"},       ForeignFormat{".vtpc", "VTK file"},
    ForeignFormat{".vtr", "VTK file"},       ForeignFormat{".vts", "VTK file"},
    ForeignFormat{".vtu", "VTK file"}};

/// In lower case, as some programs write it in capitals.
inline std::string endingOf(const std::filesystem::path& file) {
  return inLowerCase(file.extension().string());
}

/// What the ending of a name says of a file; null for one that no reader has.
inline const ForeignFormat* foreignFormat(const std::filesystem::path& file) {
  const auto* found = std::ranges::find(kForeignFormats, endingOf(file), &ForeignFormat::ending);
  return found == kForeignFormats.end() ? nullptr : found;
}

}  // namespace burnish
