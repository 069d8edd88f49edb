#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/cad/length_unit.h"

/// STEP and IGES files, by OpenCASCADE.
namespace burnish {

/// A NURBS surface in space. points: first direction fastest.
struct CadFace {
  std::array<int, 2> degrees{};
  std::array<std::vector<double>, 2> knots{};
  Eigen::Matrix3Xd points{};
  Eigen::VectorXd weights{};
  bool reversed = false;  ///< the solid is in front of the normal ∂1 x ∂2, not behind it
  std::string name{};
};

/// What of a file is read, and how.
struct CadRequest {
  std::string file{};
  std::string face{},
      solid{};  ///< name or number from 1; at most one of the two, all of the file when both are empty
  LengthUnit unit = LengthUnit::Millimetre;  ///< into which lengths are converted
  std::optional<double>
      tolerance{};  ///< of the mesh, in that unit; a 1000th of the largest extent when left out
};

/// A surface out of a file: exact if it is a single face without trimming curves, else triangles.
struct CadSurface {
  std::optional<CadFace> exact;
  Eigen::Matrix3Xd points;   ///< those of different faces are different points
  Eigen::Matrix3Xd normals;  ///< of the faces at the points, outwards; zero where not known
  Eigen::Matrix3Xi cells;    ///< corners counterclockwise seen from outside
};

/// Reads in a process of its own: OpenCASCADE ends its process on some damaged files. Throws `Error` if the file cannot be read or
/// does not hold what is asked for, or without OpenCASCADE.
CadSurface readCad(const CadRequest& request);

enum class CadFormat { Step, Iges };

/// Writes surfaces, whose lengths are in such a unit, to a file that is replaced. Throws `Error` if that is not possible, or
/// without OpenCASCADE.
void writeCad(const std::vector<CadFace>& faces, LengthUnit unit, CadFormat format, const std::string& file);

/// The interface of the library that has all of OpenCASCADE. Both return what went wrong, or nothing.
extern "C" {
using ReadCadFunction = void(const CadRequest& request, CadSurface& surface, std::string& problem);
using WriteCadFunction = void(const std::vector<CadFace>& faces, LengthUnit unit, CadFormat format,
                              const std::string& file, std::string& problem);
}

}  // namespace burnish
