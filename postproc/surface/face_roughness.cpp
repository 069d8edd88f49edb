#include "postproc/surface/face_roughness.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/solid/face_quadrature.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/probe/face_address.h"
#include "postproc/probe/path_text.h"

namespace burnish {
namespace {

constexpr int kPerSpan = 64, kPerSpanInSpace = 16;  // places per knot span and direction

/// Places on a face, now and in the undeformed body, dim x places, and the area of each, outwards.
struct FacePlaces {
  Eigen::MatrixXd now, before, areas;
};

/// Equally distant parameters in every span, both ends included, and how much of the range each stands for.
struct ParameterRow {
  std::vector<double> at, weights;
};

ParameterRow parametersAlong(const UnivariateBasis& basis, int perSpan) {
  ParameterRow row{subdividedSpans(basis, perSpan), {}};
  for (std::size_t k = 0; k < row.at.size(); ++k) {
    const double before = row.at[k == 0 ? 0 : k - 1], behind = row.at[std::min(k + 1, row.at.size() - 1)];
    row.weights.push_back(0.5 * (behind - before));
  }
  return row;
}

template <int Dim>
FacePlaces placesOf(const PatchRecord& record, const Eigen::MatrixXd& displacement, FaceId face) {
  const Patch<Dim> now = patchGeometry<Dim>(record, displacement), before = patchGeometry<Dim>(record);
  const Patch<Dim - 1, Dim> surface = tracePatch(now, face), undeformed = tracePatch(before, face);
  const double sign = outwardSign(now, face);
  const ParameterRow first =
      parametersAlong(surface.basis().direction(0), Dim == 2 ? kPerSpan : kPerSpanInSpace);
  ParameterRow second{{0.0}, {1.0}};
  if constexpr (Dim == 3) second = parametersAlong(surface.basis().direction(1), kPerSpanInSpace);
  FacePlaces places;
  const auto count = static_cast<Eigen::Index>(first.at.size() * second.at.size());
  for (Eigen::MatrixXd* all : {&places.now, &places.before, &places.areas}) all->resize(Dim, count);
  Eigen::Index next = 0;
  for (std::size_t j = 0; j < second.at.size(); ++j)
    for (std::size_t i = 0; i < first.at.size(); ++i, ++next) {
      Eigen::Vector<double, Dim - 1> xi;
      xi(0) = first.at[i];
      if constexpr (Dim == 3) xi(1) = second.at[j];
      places.now.col(next) = surface.position(xi);
      places.before.col(next) = undeformed.position(xi);
      places.areas.col(next) =
          sign * first.weights[i] * second.weights[j] * areaVector<Dim>(surface.jacobian(xi));
    }
  return places;
}

/// Keeps the places that lay in the box. Of a line those between the first and the last of them.
void keepWithin(FacePlaces& places, const std::string& within) {
  if (within.empty()) return;
  ProbeSpec spec;
  spec.line = within;
  const auto dim = static_cast<int>(places.now.rows());
  LinePath corners;
  try {
    corners = std::get<LinePath>(pathOf(spec, dim));
  } catch (const Error&) {
    throw Error(fmt::format("within: found {}; expected {}, two corners of a box", quoted(within),
                            dim == 2 ? "X0,Y0:X1,Y1" : "X0,Y0,Z0:X1,Y1,Z1"));
  }
  const Eigen::VectorXd low = corners.begin.cwiseMin(corners.end), high = corners.begin.cwiseMax(corners.end);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < places.before.cols(); ++k)
    if ((places.before.col(k).array() >= low.array()).all() &&
        (places.before.col(k).array() <= high.array()).all())
      kept.push_back(k);
  if (kept.size() < 2)
    throw Error(fmt::format("within: nothing of the face lay in the box {} of the undeformed body", within));
  if (dim == 2) {
    const Eigen::Index first = kept.front(), last = kept.back();
    kept.clear();
    for (Eigen::Index k = first; k <= last; ++k) kept.push_back(k);
  }
  for (Eigen::MatrixXd* all : {&places.now, &places.before, &places.areas})
    *all = (*all)(Eigen::all, kept).eval();
}

template <int Dim>
FacePlaces placesOn(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  PictureOptions shown;
  shown.bodies = spec.bodies;
  return withShownModel(model, frame, shown, [&](const ModelRecord& chosen, const FrameRecord& its) {
    const FacePlace face = facePlace(chosen, its, {spec.face, spec.patch});
    FacePlaces places = placesOf<Dim>(meshOf(chosen, its).patches[static_cast<std::size_t>(face.patch)],
                                      its.displacement, face.face);
    keepWithin(places, spec.within);
    return places;
  });
}

}  // namespace

FaceProfile faceProfile(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  const FacePlaces places = placesOn<2>(model, frame, spec);
  const Eigen::Vector2d begin = places.now.col(0), end = places.now.rightCols<1>();
  const Eigen::Vector2d up = places.areas.rowwise().sum(), chord = end - begin;
  if (!(chord.norm() > 1e-6 * (places.now.rowwise().maxCoeff() - places.now.rowwise().minCoeff()).norm()))
    throw Error("face: it ends where it begins; expected within, a box of the part to be looked at");
  Eigen::Matrix2d frameOfChord;  // rows: along, and out of the material
  frameOfChord.row(0) = chord.normalized();
  frameOfChord.row(1) << -frameOfChord(0, 1), frameOfChord(0, 0);
  if (frameOfChord.row(1).dot(up) < 0.0) frameOfChord.row(1) *= -1.0;
  const Eigen::Matrix2Xd local = frameOfChord * (places.now.colwise() - begin);
  FaceProfile result{profileOf(local, static_cast<int>(places.now.cols())), {}};
  result.roughness = roughnessOf(result.profile, spec.cutoff);
  result.profile = levelled(result.profile);
  if (spec.cutoff) result.profile = roughnessProfile(result.profile, *spec.cutoff);
  return result;
}

FaceArea faceArea(const ModelRecord& model, const FrameRecord& frame, const RoughnessSpec& spec) {
  if (spec.cutoff) throw Error("cutoff: areas are not filtered; expected it of faces of plane bodies alone");
  const FacePlaces places = placesOn<3>(model, frame, spec);
  const Eigen::Vector3d up = places.areas.rowwise().sum();
  return {roughnessOf(places.now, places.areas.colwise().norm().transpose(), up), places.now};
}

}  // namespace burnish
