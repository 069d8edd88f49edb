#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string_view>
#include <vector>

/// Planes of pictures, as scenes and options of the command spell them.
namespace burnish {

/// A plane that cuts through what is drawn.
struct CutPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of any length but 0
};

/// The plane of symmetry on which the coordinate `axis` is `at`.
struct MirrorPlane {
  int axis = 0;  ///< 0, 1, 2: x, y, z
  double at = 0.0;
};

inline constexpr const char* kCutPlaneWords =
    "x=V, y=V or z=V, or X,Y,Z,NX,NY,NZ: a point and a normal that is not 0,0,0";
inline constexpr const char* kMirrorPlaneWords =
    "one or more of x, y, z, each once, or x=V: where the plane is";

/// The parts of a text between commas.
std::vector<std::string_view> commaParts(std::string_view text);

/// The whole text as a finite number, or nothing.
std::optional<double> finiteNumber(std::string_view text);

/// A plane as in `kCutPlaneWords`, or nothing.
std::optional<CutPlane> cutPlaneNamed(std::string_view text);

/// Planes as in `kMirrorPlaneWords`, with commas between them, or nothing.
std::optional<std::vector<MirrorPlane>> mirrorPlanesNamed(std::string_view text);

}  // namespace burnish
