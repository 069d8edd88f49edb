#include "engine/tools/cad_tool.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/core/angles.h"
#include "engine/core/error.h"
#include "engine/core/key_error.h"
#include "engine/nurbs/patch.h"
#include "engine/tools/faceted_distance.h"
#include "engine/tools/nurbs_shape.h"
#include "engine/tools/shape_problems.h"
#include "engine/tools/surface_file.h"

namespace burnish::inline tools {
namespace {

RigidShape exactShape(const CadFace& face, double scale) {
  std::vector<UnivariateBasis> directions;
  for (std::size_t d = 0; d < 2; ++d)
    directions.push_back(UnivariateBasis::bspline(KnotVector(face.degrees[d], face.knots[d])));
  return makeNurbsShape(Patch<2, 3>(TensorBasis<2>(std::move(directions)), scale * face.points, face.weights),
                        face.reversed);
}

/// Normals of a surface of CAD by the places of its points.
class KnownNormals {
 public:
  explicit KnownNormals(const CadSurface& surface) {
    for (Eigen::Index k = 0; k < surface.points.cols(); ++k)
      normals_[keyOf(surface.points.col(k))].push_back(surface.normals.col(k));
  }

  /// Those at the corners of the triangles of a mesh with these points: of the faces that meet in a corner, the one
  /// that the triangle belongs to. Zero where none fits.
  std::vector<Eigen::Matrix3d> of(const SurfaceMesh& mesh) const {
    const double fits = std::cos(radians(30.0));
    std::vector<Eigen::Matrix3d> all;
    for (const auto& cell : mesh.cells.colwise()) {
      const auto at = [&](int k) -> Eigen::Vector3d { return mesh.points.col(cell(k)); };
      const Eigen::Vector3d ofCell = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      Eigen::Matrix3d& normals = all.emplace_back(Eigen::Matrix3d::Zero());
      for (int k = 0; k < 3; ++k) {
        double best = fits;
        const auto known = normals_.find(keyOf(at(k)));
        if (known == normals_.end()) continue;
        for (const Eigen::Vector3d& normal : known->second)
          if (normal.dot(ofCell) > best) {
            best = normal.dot(ofCell);
            normals.col(k) = normal;
          }
      }
    }
    return all;
  }

 private:
  using Key = std::array<double, 3>;
  static Key keyOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

  std::map<Key, std::vector<Eigen::Vector3d>> normals_;
};

FacetedShape facetedShape(CadSurface surface, double scale, bool open, std::optional<double> smoothing) {
  surface.points *= scale;
  SurfaceMesh mesh = soundSurface(surface.points, surface.cells, open);
  auto normals = KnownNormals(surface).of(mesh);
  return {std::make_shared<const FacetedDistance>(std::move(mesh), smoothing, std::move(normals))};
}

}  // namespace

RigidShape CadTool::made() const {
  try {
    requireFile(file, "STEP or IGES model");
    CadSurface surface = readCad({.file = file,
                                  .face = face,
                                  .solid = solid,
                                  .shell = shell,
                                  .unit = unit,
                                  .tolerance = tolerance ? std::optional(*tolerance / scale) : std::nullopt});
    if (surface.exact) return exactShape(*surface.exact, scale);
    return facetedShape(std::move(surface), scale, open, smoothing);
  } catch (const KeyError&) {
    throw;
  } catch (const Error& error) {
    const char* key = !face.empty() ? "face" : !shell.empty() ? "shell" : !solid.empty() ? "solid" : "file";
    throw KeyError(key, std::string(error.what()).starts_with(file)
                            ? error.what()
                            : fmt::format("{}: {}", file, error.what()));
  }
}

void check(const CadTool& tool, const ShapeProblems& problems) {
  const char* first = nullptr;
  for (const auto& [key, wanted] :
       {std::pair{"face", &tool.face}, {"shell", &tool.shell}, {"solid", &tool.solid}}) {
    if (wanted->empty() || !problems.clean(key)) continue;
    if (first)
      problems.report(key,
                      fmt::format("found {} beside {}; allowed: one of face, shell and solid, or none for "
                                  "all of the file.",
                                  key, first));
    first = key;
  }
}

}  // namespace burnish::inline tools
