#include "engine/solid/bodies/coons.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "engine/core/error.h"
#include "engine/nurbs/constructions.h"
#include "engine/schema/problems.h"

namespace burnish::inline solid {
namespace {

struct Side {
  const char* name;
  const Net& curve;
};

Eigen::Vector2d endOf(const Side& side, bool atEnd) {
  const auto& point = atEnd ? side.curve.points.back() : side.curve.points.front();
  return {point[0], point[1]};
}

/// Whether the side is a curve of the plane whose ends have the same weight.
bool checkSide(const Side& side, const Problems& problems) {
  const std::string key = side.name;
  if (side.curve.degrees.size() > 1) {
    problems.report(key + ".degrees", "found a face; allowed: a curve, of one degree.");
    return false;
  }
  checkNet(side.curve, problems, key + ".", {2, 2}, "the plane");
  if (side.curve.points.empty() || side.curve.degrees.empty() || !problems.clean(key)) return false;
  const auto& weights = side.curve.weights;
  if (weights.empty() || weights.front() == weights.back()) return true;
  problems.report(key + ".weights",
                  fmt::format("found {} at the begin and {} at the end; allowed: the same at both.",
                              weights.front(), weights.back()));
  return false;
}

/// Two sides meet at an end of each.
void checkCorner(const Side& a, bool atEndOfA, const Side& b, bool atEndOfB, double size,
                 const Problems& problems) {
  constexpr double kSame = 1e-9;
  const Eigen::Vector2d pA = endOf(a, atEndOfA), pB = endOf(b, atEndOfB);
  if (const double apart = (pA - pB).norm(); apart > kSame * size)
    problems.report(
        b.name,
        fmt::format("found a curve that {} at ({:.6g}, {:.6g}), {:.3g} from ({:.6g}, {:.6g}), where {} {}; "
                    "allowed: curves that meet in the corner of {} and {}.",
                    atEndOfB ? "ends" : "begins", pB.x(), pB.y(), apart, pA.x(), pA.y(), a.name,
                    atEndOfA ? "ends" : "begins", a.name, b.name));
}

}  // namespace

template <int Dim>
Patch<Dim> CoonsBody::patch() const {
  if constexpr (Dim == 2)
    return inPlane(
        coonsPatch(bottom.patch<1, 3>(), right.patch<1, 3>(), top.patch<1, 3>(), left.patch<1, 3>()));
  else
    throw Error("geometry: a Coons patch is a body of two dimensions");
}

void check(const CoonsBody& body, const Problems& problems) {
  const Side bottom{"bottom", body.bottom}, right{"right", body.right}, top{"top", body.top},
      left{"left", body.left};
  bool clean = true;
  for (const Side& side : {bottom, right, top, left}) clean = checkSide(side, problems) && clean;
  if (!clean) return;
  const double size = std::max((endOf(bottom, true) - endOf(left, true)).norm(),
                               (endOf(right, true) - endOf(bottom, false)).norm());
  checkCorner(bottom, false, left, false, size, problems);
  checkCorner(bottom, true, right, false, size, problems);
  checkCorner(left, true, top, false, size, problems);
  checkCorner(right, true, top, true, size, problems);
}

template Patch<2> CoonsBody::patch() const;
template Patch<3> CoonsBody::patch() const;

}  // namespace burnish::inline solid
