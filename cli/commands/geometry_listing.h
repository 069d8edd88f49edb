#pragma once
#include <json/value.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/cad/cad_file.h"

/// What `burnish info` tells of files with geometry for scenes: STEP, IGES, g2, and JSON of NURBS.
namespace burnish {

/// A curve, a surface or a volume; they are in their order, from 0 as `entry` counts.
struct ListedNet {
  std::string name{};  ///< may be empty
  std::vector<int> degrees{}, functions{};
  bool isRational = false;
  Eigen::AlignedBox3d box{};  ///< of the control points
};

struct GeometryListing {
  std::filesystem::path file{};
  std::string kind{};         ///< "STEP", ...
  std::string unit{};         ///< as the file says it; may be empty
  std::string unitOfBoxes{};  ///< of solids, shells and faces
  std::vector<CadPart> solids{}, shells{}, faces{};
  std::vector<ListedNet> nets{};
};

/// Nothing for a file that is of none of these kinds by its ending, or JSON without NURBS. Throws `Error` if one cannot be read.
std::optional<GeometryListing> listGeometry(const std::filesystem::path& file);

std::string geometryText(const GeometryListing& listing);
Json::Value geometryJson(const GeometryListing& listing);

}  // namespace burnish
