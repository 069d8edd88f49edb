#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"

/// STEP and IGES files, by OpenCASCADE.
namespace burnish::inline cad {

/// A NURBS surface in space. points: first direction fastest.
struct CadFace {
  std::array<int, 2> degrees{};
  std::array<std::vector<double>, 2> knots{};
  Eigen::Matrix3Xd points{};
  Eigen::VectorXd weights{};
  bool reversed = false;  ///< the solid is in front of the normal ∂1 x ∂2, not behind it
  std::string name{};
};

/// Faces that bound a body together, or are a part of what does.
struct CadBody {
  std::string name{};
  std::vector<CadFace> faces{};
};

/// What of a file is read, and how.
struct CadRequest {
  std::string file{};
  std::string face{}, solid{},
      shell{};  ///< name or number from 1; at most one of the three, all of the file when all are empty
  LengthUnit unit = LengthUnit::Millimetre;  ///< into which lengths are converted
  std::optional<double>
      tolerance{};            ///< of the mesh, in that unit; a 1000th of the largest extent when left out
  bool oneExactFace = false;  ///< and nothing else will do: see `readCadFace`
};

/// A surface out of a file: exact if it is a single face without trimming curves, else triangles.
struct CadSurface {
  std::optional<CadFace> exact;
  Eigen::Matrix3Xd points;   ///< those of different faces are different points
  Eigen::Matrix3Xd normals;  ///< of the faces at the points, outwards; zero where not known
  Eigen::Matrix3Xi cells;    ///< corners counterclockwise seen from outside
};

/// A face, a shell or a solid of a file as `CadListing` has it. box: corners in the unit of the listing.
struct CadPart {
  std::string name{};  ///< may be empty, or that of another part, too
  Eigen::AlignedBox3d box{};
  bool isExact = false;  ///< a face: its edges are the ends of its surface
  int solid = 0;         ///< of a face or a shell: number of the solid that it bounds; 0: of none
  int faces = 0;         ///< of a solid or a shell
};

/// What is in a file, in its order: numbers of parts count from 1.
struct CadListing {
  std::string fileUnit{};  ///< as the file names it; empty if it does not
  LengthUnit unit =
      LengthUnit::Millimetre;  ///< of the boxes: that of the file, millimetres if it is none of ours
  std::vector<CadPart> solids{}, shells{}, faces{};
};

/// Whether a file has one of the endings of STEP and IGES, in letters of any case.
bool isCadFile(const std::filesystem::path& file);

/// Reads in a process of its own: OpenCASCADE ends its process on some damaged files. Throws `KeyError`, with the key `file`, `face`, `shell` or
/// `solid` at fault, if the file cannot be read or does not hold what is asked for, and `Error` without OpenCASCADE.
CadSurface readCad(const CadRequest& request);

/// The same of a single face without trimming curves, exactly. face: name or number from 1; may be empty if the file has one
/// face alone.
CadFace readCadFace(const std::string& file, const std::string& face, LengthUnit unit);

/// What is in a file; the same holds for reading.
CadListing listCad(const std::string& file);

enum class CadFormat { Step, Iges };

/// Writes bodies, whose lengths are in such a unit, to a file that is replaced: in STEP a product with a solid each where their faces
/// close, else with shells; in IGES the faces. The time in the file is that of SOURCE_DATE_EPOCH where it is set. Throws `Error` if that
/// is not possible, or without OpenCASCADE.
void writeCad(const std::vector<CadBody>& bodies, LengthUnit unit, CadFormat format, const std::string& file);

/// What went wrong, and the key of the request that is to blame; nothing went wrong without a text.
struct CadProblem {
  std::string key{}, text{};
};

/// The interface of the library that has all of OpenCASCADE.
extern "C" {
using ReadCadFunction = void(const CadRequest& request, CadSurface& surface, CadProblem& problem);
using ListCadFunction = void(const std::string& file, CadListing& listing, CadProblem& problem);
using WriteCadFunction = void(const std::vector<CadBody>& bodies, LengthUnit unit, CadFormat format,
                              const std::string& file, CadProblem& problem);
}

}  // namespace burnish::inline cad
