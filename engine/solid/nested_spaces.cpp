#include "engine/solid/nested_spaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/nurbs/refinement.h"
#include "engine/solid/face_match.h"

namespace burnish::inline solid {
namespace {

/// Functions of two patches are one if they belong to the same place, up to this share of the body's size.
constexpr double kSamePlace = 1e-8;

/// Two directions of patches along which their common face runs.
struct Link {
  std::size_t patch;
  int direction;
  std::size_t other;
  int along;
  bool reversed;
};

/// The two directions of a face, or the one.
template <int Dim>
std::array<int, Dim - 1> directionsOf(FaceId face) {
  std::array<int, Dim - 1> directions{};
  for (int d = 0, k = 0; d < Dim; ++d)
    if (d != face / 2) directions[static_cast<std::size_t>(k++)] = d;
  return directions;
}

/// Links between the patches' directions, from the nodes that their faces have in common.
template <int Dim>
std::vector<Link> findLinks(const Body<Dim>& body) {
  struct Face {
    std::size_t patch;
    FaceId id;
    std::vector<int> nodes;
  };
  std::vector<Face> faces;
  for (std::size_t p = 0; p < body.patches.size(); ++p)
    for (FaceId id = 0; id < 2 * Dim; ++id) {
      Face face{p, id, {}};
      for (const int a : faceFunctions(body.patches[p].basis(), id))
        face.nodes.push_back(body.nodes[p][static_cast<std::size_t>(a)]);
      auto sorted = face.nodes;
      std::sort(sorted.begin(), sorted.end());
      const bool collapsed = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
      if (!collapsed) faces.push_back(std::move(face));
    }

  std::vector<Link> links;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      const Face &a = faces[i], &b = faces[j];
      if (a.nodes.size() != b.nodes.size() ||
          std::find(b.nodes.begin(), b.nodes.end(), a.nodes.front()) == b.nodes.end())
        continue;
      const auto first = tracePatch(body.patches[a.patch], a.id).basis(),
                 second = tracePatch(body.patches[b.patch], b.id).basis();
      for (const auto& orientation : faceOrientations<Dim - 1>()) {
        const auto meets = [&] {
          for (int d = 0; d < Dim - 1; ++d)
            if (first.direction(d).numFunctions() !=
                second.direction(orientation.along[static_cast<std::size_t>(d)]).numFunctions())
              return false;
          const auto other = counterparts(first, second, orientation);
          for (std::size_t k = 0; k < other.size(); ++k)
            if (a.nodes[k] != b.nodes[static_cast<std::size_t>(other[k])]) return false;
          return true;
        };
        if (!meets()) continue;
        for (std::size_t d = 0; d < Dim - 1; ++d)
          links.push_back({a.patch, directionsOf<Dim>(a.id)[d], b.patch,
                           directionsOf<Dim>(b.id)[static_cast<std::size_t>(orientation.along[d])],
                           orientation.reversed[d]});
        break;
      }
    }
  return links;
}

/// The same numbers when they are counted from the other end.
std::vector<int> mirrored(std::vector<int> numbers) {
  const int last = numbers.back();
  for (int& number : numbers) number = last - number;
  std::reverse(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

template <int Dim>
NestedSpaces<Dim>::NestedSpaces(const Body<Dim>& body) : body_(body), numNodes_(body.numNodes) {
  for (std::size_t p = 0; p < body.patches.size(); ++p)
    patches_.push_back({body.patches[p].basis(), body.patches[p].weights(), body.nodes[p]});
  findStrips();
}

template <int Dim>
void NestedSpaces<Dim>::findStrips() {
  const auto links = findLinks(body_);
  const auto count = body_.patches.size();

  bodyOf_.assign(count, -1);
  for (std::size_t p = 0; p < count; ++p) {
    if (bodyOf_[p] >= 0) continue;
    std::vector<std::size_t> reached{p};
    bodyOf_[p] = numBodies_++;
    while (!reached.empty()) {
      const std::size_t here = reached.back();
      reached.pop_back();
      for (const Link& link : links)
        for (const auto& [from, to] : {std::pair{link.patch, link.other}, std::pair{link.other, link.patch}})
          if (from == here && bodyOf_[to] < 0) {
            bodyOf_[to] = bodyOf_[p];
            reached.push_back(to);
          }
    }
  }

  std::vector<std::array<bool, Dim>> known(count);
  for (std::size_t p = 0; p < count; ++p)
    for (int d = 0; d < Dim; ++d) {
      if (known[p][static_cast<std::size_t>(d)]) continue;
      Strip strip{{{p, d, false}}, bodyOf_[p], false};
      known[p][static_cast<std::size_t>(d)] = true;
      for (std::size_t k = 0; k < strip.members.size(); ++k) {
        const auto here = strip.members[k];
        const auto follow = [&](std::size_t patch, int direction, std::size_t other, int along,
                                bool reversed) {
          if (patch != here.patch || direction != here.direction) return;
          const bool turned = here.reversed != reversed;
          bool& isKnown = known[other][static_cast<std::size_t>(along)];
          if (!isKnown) strip.members.push_back({other, along, turned});
          isKnown = true;
          for (const auto& member : strip.members)
            if (member.patch == other && member.direction == along && member.reversed != turned)
              strip.isFixed = true;
        };
        for (const Link& link : links) {
          follow(link.patch, link.direction, link.other, link.along, link.reversed);
          follow(link.other, link.along, link.patch, link.direction, link.reversed);
        }
      }
      strips_.push_back(std::move(strip));
    }
}

/// Along the line through the middle of the other directions.
template <int Dim>
std::vector<double> NestedSpaces<Dim>::lengths(const typename Strip::Member& member) const {
  const auto& patch = body_.patches[member.patch];
  const auto& basis = patches_[member.patch].basis;
  Eigen::Vector<double, Dim> xi;
  for (int d = 0; d < Dim; ++d) xi(d) = basis.direction(d).parameterAt(0.5);
  std::vector<double> result;
  Eigen::Vector<double, Dim> before;
  for (const double breakpoint : basis.direction(member.direction).breakpoints()) {
    xi(member.direction) = breakpoint;
    const Eigen::Vector<double, Dim> here = patch.position(xi);
    if (breakpoint != basis.direction(member.direction).breakpoints().front())
      result.push_back((here - before).norm());
    before = here;
  }
  if (member.reversed) std::reverse(result.begin(), result.end());
  return result;
}

/// The smallest among its members.
template <int Dim>
std::vector<double> NestedSpaces<Dim>::lengths(const Strip& strip) const {
  std::vector<double> smallest = lengths(strip.members.front());
  for (const auto& member : strip.members) {
    const auto ofMember = lengths(member);
    for (std::size_t e = 0; e < smallest.size(); ++e) smallest[e] = std::min(smallest[e], ofMember[e]);
  }
  return smallest;
}

template <int Dim>
bool NestedSpaces<Dim>::coarsen(const MergeRule& rule) {
  std::vector<std::vector<double>> lengthsOf;
  std::vector<double> shortest(static_cast<std::size_t>(numBodies_), std::numeric_limits<double>::infinity());
  for (const Strip& strip : strips_) {
    lengthsOf.push_back(lengths(strip));
    double& least = shortest[static_cast<std::size_t>(strip.body)];
    // A single span does not become longer.
    if (lengthsOf.back().size() > 1 && !strip.isFixed)
      least = std::min(least, *std::min_element(lengthsOf.back().begin(), lengthsOf.back().end()));
  }

  bool changes = false;
  std::vector<std::array<std::vector<int>, Dim>> kept(patches_.size());
  for (std::size_t s = 0; s < strips_.size(); ++s) {
    const Strip& strip = strips_[s];
    std::vector<int> ofStrip(lengthsOf[s].size() + 1);
    std::iota(ofStrip.begin(), ofStrip.end(), 0);
    if (!strip.isFixed && lengthsOf[s].size() > 1)
      ofStrip = mergedBreakpoints(lengthsOf[s], shortest[static_cast<std::size_t>(strip.body)], rule);
    changes = changes || ofStrip.size() <= lengthsOf[s].size();
    for (const auto& member : strip.members)
      kept[member.patch][static_cast<std::size_t>(member.direction)] =
          member.reversed ? mirrored(ofStrip) : ofStrip;
  }
  if (!changes) return false;

  finer_ = std::move(patches_);
  patches_.clear();
  transfers_.clear();
  for (std::size_t p = 0; p < finer_.size(); ++p) {
    std::vector<UnivariateBasis> directions;
    Transfers T;
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const auto& fine = finer_[p].basis.direction(d);
      directions.push_back(coarsened(fine, kept[p][k]));
      T[k] = transferMatrix(directions.back(), fine);
    }
    patches_.push_back({TensorBasis<Dim>(std::move(directions)), coarseWeights(finer_[p].weights, T), {}});
    transfers_.push_back(std::move(T));
  }
  const int numFiner = numNodes_;
  numberNodes();
  makeProlongation(numFiner);
  return true;
}

/// Those that the finer weights are nearest to; ones if these are not positive.
template <int Dim>
Eigen::VectorXd NestedSpaces<Dim>::coarseWeights(const Eigen::VectorXd& fine, const Transfers& T) {
  Eigen::Index count = 1;
  for (const Prolongation& direction : T) count *= direction.cols();
  if ((fine.array() == fine(0)).all()) return Eigen::VectorXd::Constant(count, fine(0));
  Eigen::MatrixXd weights = fine;
  Eigen::Index stride = 1;
  for (const Prolongation& direction : T) {
    const Eigen::MatrixXd normal = Eigen::MatrixXd(direction.transpose() * direction);
    weights = appliedAlong(weights, normal.llt().solve(Eigen::MatrixXd(direction.transpose())), stride);
    stride *= direction.cols();
  }
  if (weights.minCoeff() <= 0.0) return Eigen::VectorXd::Ones(count);
  return weights;
}

/// Functions on faces whose anchors are at one place are one node: those of joined faces and of collapsed
/// lines.
template <int Dim>
void NestedSpaces<Dim>::numberNodes() {
  struct Anchor {
    double order;  ///< a coordinate in which hardly two places are the same
    Eigen::Vector<double, Dim> place;
    std::size_t patch;
    int function;
    int leader;  ///< number of the first anchor at this place
  };
  std::vector<Anchor> anchors;
  Eigen::Vector<double, Dim> askew;
  for (int d = 0; d < Dim; ++d) askew(d) = std::pow(0.61803398874989485, d);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const auto& basis = patches_[p].basis;
    for (int a = 0; a < basis.numFunctions(); ++a) {
      const auto index = basis.functionIndex(a);
      bool isOnFace = false;
      for (int d = 0; d < Dim; ++d) {
        const int i = index[static_cast<std::size_t>(d)];
        isOnFace = isOnFace || i == 0 || i == basis.direction(d).numFunctions() - 1;
      }
      if (!isOnFace) continue;
      const Eigen::Vector<double, Dim> place = body_.patches[p].position(basis.anchor(a));
      anchors.push_back({askew.dot(place), place, p, a, -1});
    }
  }
  std::sort(anchors.begin(), anchors.end(),
            [](const Anchor& a, const Anchor& b) { return a.order < b.order; });
  const double near = kSamePlace * body_.size();
  std::vector<std::vector<int>> leaders;
  for (const auto& patch : patches_) leaders.emplace_back(patch.basis.numFunctions(), -1);
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    Anchor& anchor = anchors[i];
    anchor.leader = static_cast<int>(i);
    for (std::size_t j = i; j-- > 0 && anchor.order - anchors[j].order <= near * askew.norm();)
      if (bodyOf_[anchor.patch] == bodyOf_[anchors[j].patch] &&
          (anchor.place - anchors[j].place).norm() <= near)
        anchor.leader = anchors[j].leader;
    leaders[anchor.patch][static_cast<std::size_t>(anchor.function)] = anchor.leader;
  }

  numNodes_ = 0;
  std::vector<int> numbers(anchors.size(), -1);
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (const int leader : leaders[p]) {
      if (leader < 0) {
        patches_[p].nodes.push_back(numNodes_++);
        continue;
      }
      int& number = numbers[static_cast<std::size_t>(leader)];
      if (number < 0) number = numNodes_++;
      patches_[p].nodes.push_back(number);
    }
}

template <int Dim>
template <class F>
void NestedSpaces<Dim>::forEachCoarse(std::size_t patch, const typename TensorBasis<Dim>::Index& fine,
                                      const F& f) const {
  const auto& basis = patches_[patch].basis;
  const auto& T = transfers_[patch];
  typename TensorBasis<Dim>::Index coarse{};
  const auto descend = [&](const auto& self, std::size_t d, double product) -> void {
    for (Prolongation::InnerIterator entry(T[d], fine[d]); entry; ++entry) {
      coarse[d] = static_cast<int>(entry.col());
      if (d == 0)
        f(basis.functionNumber(coarse), product * entry.value());
      else
        self(self, d - 1, product * entry.value());
    }
  };
  descend(descend, Dim - 1, 1.0);
}

template <int Dim>
void NestedSpaces<Dim>::makeProlongation(int numFiner) {
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<bool> isDone(static_cast<std::size_t>(numFiner), false);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const PatchSpace &coarse = patches_[p], &fine = finer_[p];
    for (int a = 0; a < fine.basis.numFunctions(); ++a) {
      const int node = fine.nodes[static_cast<std::size_t>(a)];
      if (isDone[static_cast<std::size_t>(node)]) continue;
      isDone[static_cast<std::size_t>(node)] = true;
      forEachCoarse(p, fine.basis.functionIndex(a), [&](int c, double coefficient) {
        triplets.emplace_back(node, coarse.nodes[static_cast<std::size_t>(c)],
                              coefficient * coarse.weights(c) / fine.weights(a));
      });
    }
  }
  prolongation_.resize(numFiner, numNodes_);
  prolongation_.setFromTriplets(triplets.begin(), triplets.end());
}

template <int Dim>
std::vector<bool> NestedSpaces<Dim>::held(const std::vector<bool>& finer) const {
  std::vector<bool> result(static_cast<std::size_t>(Dim * numNodes_), false);
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (FaceId face = 0; face < 2 * Dim; ++face) {
      // A component of a coarse function that no free one of this face is made of.
      std::vector<std::array<bool, Dim>> isFree(patches_[p].nodes.size());
      for (const int a : faceFunctions(finer_[p].basis, face)) {
        const int node = finer_[p].nodes[static_cast<std::size_t>(a)];
        forEachCoarse(p, finer_[p].basis.functionIndex(a), [&](int c, double) {
          for (int d = 0; d < Dim; ++d)
            if (!finer[static_cast<std::size_t>(Dim * node + d)])
              isFree[static_cast<std::size_t>(c)][static_cast<std::size_t>(d)] = true;
        });
      }
      for (const int c : faceFunctions(patches_[p].basis, face))
        for (int d = 0; d < Dim; ++d)
          if (!isFree[static_cast<std::size_t>(c)][static_cast<std::size_t>(d)])
            result[static_cast<std::size_t>(Dim * patches_[p].nodes[static_cast<std::size_t>(c)] + d)] = true;
    }
  return result;
}

template class NestedSpaces<2>;
template class NestedSpaces<3>;

}  // namespace burnish::inline solid
