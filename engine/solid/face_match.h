#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline solid {

/// How the parameters of one face run along another: direction d of the first along `along[d]` of the second,
/// from its end to its begin if `reversed[d]`.
template <int P>
struct FaceOrientation {
  std::array<int, P> along{};
  std::array<bool, P> reversed{};
};

/// The 2 orientations of curves, the 8 of surfaces.
template <int P>
std::vector<FaceOrientation<P>> faceOrientations();

/// Whether the corners of two faces coincide under an orientation. `tolerance` is a length, here and below.
template <int P, int S>
bool cornersMeet(const Patch<P, S>& first, const Patch<P, S>& second, const FaceOrientation<P>& orientation,
                 double tolerance);

/// Whether the first face lies on the second everywhere between its corners, at a grid of points.
template <int P, int S>
bool liesOn(const Patch<P, S>& first, const Patch<P, S>& second, double tolerance);

/// Points of a face on equal grids of parameters.
struct FaceSamples {
  Eigen::MatrixXd inside;  ///< away from its edges
  Eigen::MatrixXd all;     ///< closer to each other
  double reach = 0.0;      ///< no point of the face is farther from all of them
};

template <int P, int S>
FaceSamples samplesOf(const Patch<P, S>& face);

/// Whether a point of a face away from its edges, one of its samples, lies on another face.
template <int P, int S>
bool touches(const FaceSamples& samples, const Patch<P, S>& face, const FaceSamples& ofFace,
             double tolerance);

/// In words the first thing in which two faces differ: degrees, numbers of functions, knots (each scaled to
/// [0, 1]), weights (up to a common factor) or control points. Empty if they match.
template <int P, int S>
std::optional<std::string> faceDifference(const Patch<P, S>& first, const Patch<P, S>& second,
                                          const FaceOrientation<P>& orientation, double tolerance);

/// For every function of the first face the one of the second with the same control point; for faces that
/// match.
template <int P>
std::vector<int> counterparts(const TensorBasis<P>& first, const TensorBasis<P>& second,
                              const FaceOrientation<P>& orientation);

}  // namespace burnish::inline solid
