#include "engine/contact/master_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace burnish::inline contact {
namespace {

template <int Dim>
Eigen::Vector3d inSpace(const Eigen::Vector<double, Dim>& point) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result.head<Dim>() = point;
  return result;
}

/// Samples lie in the middles of degree + 1 equal parts of a span in every direction, first direction fastest.
template <int Dim>
SurfacePlace<Dim> samplePlace(const MasterSurface<Dim>& surface, int face, int span, Eigen::Index number) {
  const auto& basis = surface.basis(face);
  const auto index = basis.spanIndex(span);
  SurfacePlace<Dim> place{face, span, {}};
  for (int d = 0; d < Dim - 1; ++d) {
    const UnivariateBasis& direction = basis.direction(d);
    const int e = index[static_cast<std::size_t>(d)], count = direction.degree() + 1;
    const double share = (static_cast<double>(number % count) + 0.5) / count;
    place.xi(d) = std::lerp(direction.spanBegin(e), direction.spanEnd(e), share);
    number /= count;
  }
  return place;
}

/// Adds the surface's normals at the corners of a span, on all spans that meet there.
template <int Dim>
void addCornerNormals(const MasterSurface<Dim>& surface, int face, int span,
                      std::vector<Eigen::Vector<double, Dim>>& normals) {
  const auto& basis = surface.basis(face);
  const auto index = basis.spanIndex(span);
  for (unsigned corner = 0; corner < 1u << (Dim - 1); ++corner) {
    SurfacePlace<Dim> place{face, span, {}};
    for (int d = 0; d < Dim - 1; ++d) {
      const int e = index[static_cast<std::size_t>(d)];
      const UnivariateBasis& direction = basis.direction(d);
      place.xi(d) = (corner >> d & 1u) == 0 ? direction.spanBegin(e) : direction.spanEnd(e);
    }
    for (const auto& side : surface.around(place)) normals.push_back(surface.at(side).normal);
  }
}

}  // namespace

template <int Dim>
MasterSearch<Dim>::MasterSearch(const MasterSurface<Dim>& surface, bool withNormals) {
  for (int face = 0; face < surface.numFaces(); ++face)
    for (int span = 0; span < surface.basis(face).numSpans(); ++span) {
      Candidate candidate{{face, span}, {}, {}, {}, {}};
      const int number = static_cast<int>(candidates_.size());
      if (const auto box = surface.box(face, span); !box.isEmpty()) {
        candidate.low = box.min();
        candidate.high = box.max();
        inTree_.push_back(number);
      } else {
        candidate.low.setConstant(-std::numeric_limits<double>::infinity());
        candidate.high.setConstant(std::numeric_limits<double>::infinity());
        others_.push_back(number);
      }
      const int count = surface.basis(face).functionsPerSpan();
      candidate.samples.resize(Dim, count);
      std::vector<Point> normals;
      for (int k = 0; k < count; ++k) {
        const SurfacePoint<Dim> sample = surface.at(samplePlace(surface, face, span, k));
        candidate.samples.col(k) = sample.x;
        normals.push_back(sample.normal);
      }
      if (withNormals) {
        addCornerNormals(surface, face, span, normals);
        candidate.normals.resize(Dim, std::ssize(normals));
        for (std::size_t k = 0; k < normals.size(); ++k)
          candidate.normals.col(static_cast<Eigen::Index>(k)) = normals[k];
      }
      candidates_.push_back(std::move(candidate));
    }
  const auto count = static_cast<Eigen::Index>(inTree_.size());
  Eigen::Matrix3Xd low(3, count), high(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Candidate& candidate = candidates_[static_cast<std::size_t>(inTree_[static_cast<std::size_t>(k)])];
    low.col(k) = inSpace<Dim>(candidate.low);
    high.col(k) = inSpace<Dim>(candidate.high);
  }
  tree_ = BoxTree(low, high);
}

template <int Dim>
std::optional<Foot<Dim>> MasterSearch<Dim>::nearest(const MasterSurface<Dim>& surface, const Point& position,
                                                    double reach,
                                                    const std::function<bool(const Foot<Dim>&)>& suits,
                                                    const MayHold& mayHold) const {
  std::vector<std::pair<double, const Candidate*>> near;
  const auto add = [&](int number) {
    const Candidate& candidate = candidates_[static_cast<std::size_t>(number)];
    if (mayHold && !mayHold(candidate.span, candidate.normals)) return;
    near.emplace_back((candidate.low - position).cwiseMax(position - candidate.high).cwiseMax(0.0).norm(),
                      &candidate);
  };
  const Point margin = Point::Constant(reach);
  for (const int number : others_) add(number);
  for (const int k : tree_.meeting(inSpace<Dim>(position - margin), inSpace<Dim>(position + margin)))
    add(inTree_[static_cast<std::size_t>(k)]);
  std::sort(near.begin(), near.end());
  std::optional<Foot<Dim>> best;
  double smallest = reach;
  for (const auto& [boxDistance, candidate] : near) {
    if (boxDistance > smallest) break;
    Eigen::Index nearest = 0;
    (candidate->samples.colwise() - position).colwise().squaredNorm().minCoeff(&nearest);
    auto foot =
        surface.project(position, samplePlace(surface, candidate->span.face, candidate->span.span, nearest));
    if (!foot) continue;
    const double distance = (position - foot->point.x).norm();
    if ((best && distance >= smallest) || distance > smallest || !suits(*foot)) continue;
    smallest = distance;
    best = std::move(foot);
  }
  return best;
}

template class MasterSearch<2>;
template class MasterSearch<3>;

}  // namespace burnish::inline contact
