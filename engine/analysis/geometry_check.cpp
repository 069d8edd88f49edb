#include "engine/analysis/geometry_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/analysis/boundary_crossing.h"
#include "engine/core/input_error.h"

namespace burnish::inline analysis {
namespace {

template <int Dim>
struct DeterminantRange {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  Eigen::Vector<double, Dim> place = Eigen::Vector<double, Dim>::Zero();  ///< of the lowest
};

/// Determinant of the map at the corners of all knot spans, taken from inside of each.
template <int Dim>
DeterminantRange<Dim> cornerDeterminants(const Patch<Dim>& patch) {
  DeterminantRange<Dim> found;
  for (int span = 0; span < patch.basis().numSpans(); ++span) {
    const auto index = patch.basis().spanIndex(span);
    const Eigen::MatrixXd points = patch.points()(Eigen::all, patch.basis().spanFunctions(span));
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      Eigen::Vector<double, Dim> xi;
      for (int d = 0; d < Dim; ++d) {
        const auto& direction = patch.basis().direction(d);
        const int e = index[static_cast<std::size_t>(d)];
        xi(d) = (corner >> d & 1) != 0 ? direction.spanEnd(e) : direction.spanBegin(e);
      }
      const auto shape = patch.shape(span, xi);
      const Eigen::Matrix<double, Dim, Dim> jacobian = points * shape.dR;
      const double det = jacobian.determinant();
      found.highest = std::max(found.highest, det);
      if (det >= found.lowest) continue;
      found.lowest = det;
      found.place = points * shape.R;
    }
  }
  return found;
}

/// mesh: of the patch; path: of what has it.
template <int Dim>
void requirePositive(const Patch<Dim>& patch, const MeshSpec& mesh, const std::string& path) {
  constexpr double kRounding = 1e-9;
  const auto found = cornerDeterminants(patch);
  if (found.lowest >= -kRounding * std::max(found.highest, -found.lowest)) return;
  const bool hasRelief = !mesh.relief.empty();
  if (found.highest <= 0.0 && !hasRelief)
    throw InputError(path,
                     "the body is inside out: the determinant of its map is negative at all knots; reverse "
                     "the order of the control points in one direction");
  throw InputError(
      hasRelief ? path + ".relief" : path,
      fmt::format("the map is folded near ({:.4g}): its determinant is {:.3g}; {} so that it is "
                  "positive everywhere",
                  fmt::join(found.place, ", "), found.lowest,
                  hasRelief ? "make heights smaller, or slopes flatter," : "move the control points"));
}

/// Samples of a face in order. The inner ones stand at odd places, so that lines which cross at round numbers
/// do not meet in samples.
std::vector<Eigen::Vector2d> samplesOf(const Patch<1, 2>& face) {
  constexpr int kPerSpan = 12;
  constexpr double kOdd = 0.3819660112501051;
  const UnivariateBasis& basis = face.basis().direction(0);
  std::vector<Eigen::Vector2d> samples;
  const auto add = [&](double xi) { samples.push_back(face.position(Eigen::Vector<double, 1>(xi))); };
  for (int span = 0; span < basis.numSpans(); ++span) {
    add(basis.spanBegin(span));
    const double width = basis.spanEnd(span) - basis.spanBegin(span);
    for (int k = 0; k < kPerSpan; ++k) add(basis.spanBegin(span) + (k + kOdd) / kPerSpan * width);
  }
  add(basis.breakpoints().back());
  return samples;
}

/// Of the body with the patches from `first` to before `end`.
std::vector<BoundaryPiece> outerBoundary(const FaceFinder<2>& faces, int first, int end) {
  std::vector<BoundaryPiece> pieces;
  for (const OuterFace& face : faces.outerFaces()) {
    if (face.place.patch < first || face.place.patch >= end) continue;
    const auto& patch = faces.body().patches[static_cast<std::size_t>(face.place.patch)];
    const auto samples = samplesOf(tracePatch(patch, face.place.face));
    for (std::size_t k = 1; k < samples.size(); ++k)
      if (samples[k] != samples[k - 1]) pieces.push_back({samples[k - 1], samples[k], face.text});
  }
  return pieces;
}

void requireSimpleBoundary(const Model<2>& model, std::size_t number, const Scene& scene) {
  constexpr double kRounding = 1e-9;
  const ModelBody<2>& body = model.bodies()[number];
  const int end = body.firstPatch + static_cast<int>(body.body.patches.size());
  const auto crossing =
      findCrossing(outerBoundary(model.faces(), body.firstPatch, end), kRounding * body.body.size());
  if (!crossing) return;
  throw InputError(scene.bodyKey(number, "geometry"),
                   fmt::format("the boundary crosses itself near ({:.4g}, {:.4g}), face {} and face {}; move "
                               "the control points so that the body covers no place twice",
                               crossing->place.x(), crossing->place.y(), crossing->first, crossing->second));
}

}  // namespace

template <int Dim>
void requireSoundGeometry(const Model<Dim>& model, const Scene& scene) {
  InputProblems problems;
  for (std::size_t k = 0; k < model.bodies().size(); ++k) {
    const std::string path = scene.bodyKey(k, "geometry");
    const GeometrySpec& geometry = scene.allBodies()[k].geometry;
    const auto* several = std::get_if<PatchesSpec>(&geometry.shape);
    const auto& patches = model.bodies()[k].body.patches;
    for (std::size_t p = 0; p < patches.size(); ++p)
      problems.gather([&] {
        if (several)
          requirePositive(patches[p], several->patches[p].mesh, fmt::format("{}.patches[{}]", path, p));
        else
          requirePositive(patches[p], geometry.mesh, path);
      });
  }
  problems.throwIfAny();
  if constexpr (Dim == 2)
    for (std::size_t k = 0; k < model.bodies().size(); ++k)
      problems.gather([&] { requireSimpleBoundary(model, k, scene); });
  problems.throwIfAny();
}

template void requireSoundGeometry(const Model<2>&, const Scene&);
template void requireSoundGeometry(const Model<3>&, const Scene&);

}  // namespace burnish::inline analysis
