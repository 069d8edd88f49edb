#include "engine/solid/joined_body.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/solid/face_match.h"

namespace burnish::inline solid {
namespace {

/// Lengths below this share of the body's size are nothing.
constexpr double kSame = 1e-10;

/// A face lies on another one if it is closer than this share of its own size: far more than what Lagrange
/// elements of different size miss of the same curve, far less than a gap that is meant.
constexpr double kTouching = 0.01;

/// Faces that are not joined are apart by more than this share of the smaller one's size.
constexpr double kClose = 1e-3;

/// Disjoint groups of numbers from 0 on.
class Groups {
 public:
  explicit Groups(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int leader(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void merge(int i, int j) { parent(leader(i)) = leader(j); }
  int count() const { return static_cast<int>(parents_.size()); }

 private:
  int& parent(int i) { return parents_[static_cast<std::size_t>(i)]; }

  std::vector<int> parents_;
};

/// Joins the patches' faces, pair by pair.
template <int Dim>
class Joiner {
 public:
  Joiner(Body<Dim>& body, const std::vector<std::string>& names)
      : body_(body),
        names_(names),
        tolerance_(kSame * body.size()),
        nodes_(countFunctions()),
        joined_(static_cast<int>(body.patches.size())) {}

  void join() {
    for (int p = 0; p < numPatches(); ++p)
      for (FaceId face = 0; face < 2 * Dim; ++face) addFace(p, face);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t j = i + 1; j < faces_.size(); ++j) joinPair(static_cast<int>(i), static_cast<int>(j));
    for (int p = 1; p < numPatches(); ++p)
      if (joined_.leader(p) != joined_.leader(0))
        throw Error(fmt::format(
            "patch '{}' is not connected to patch '{}'; allowed: patches that all share whole faces", name(p),
            name(0)));
    requireSealed();
    numberNodes();
  }

 private:
  struct Face {
    int patch;
    FaceId id;
    Patch<Dim - 1, Dim> trace;
    std::vector<int> functions;  ///< of all patches, counted on: those of the trace
    double size;
    int partner = -1;  ///< number of the face that it is joined to
  };

  int numPatches() const { return static_cast<int>(body_.patches.size()); }
  const std::string& name(int patch) const { return names_[static_cast<std::size_t>(patch)]; }

  int countFunctions() {
    int count = 0;
    for (const auto& patch : body_.patches) {
      offsets_.push_back(count);
      count += patch.basis().numFunctions();
    }
    return count;
  }

  /// Merges collapsed lines of a face; a face that they make a line or a point joins nothing.
  void addFace(int p, FaceId id) {
    const auto& patch = body_.patches[static_cast<std::size_t>(p)];
    auto trace = tracePatch(patch, id);
    auto functions = faceFunctions(patch.basis(), id);
    for (int& a : functions) a += offsets_[static_cast<std::size_t>(p)];
    bool collapsed = false;
    for (int d = 0; d < Dim - 1; ++d) collapsed = mergeCollapsedLines(trace, functions, d) || collapsed;
    const double size = (trace.points().rowwise().maxCoeff() - trace.points().rowwise().minCoeff()).norm();
    if (!collapsed) faces_.push_back({p, id, std::move(trace), std::move(functions), size});
  }

  /// Whether all lines of control points along direction d are collapsed to a point.
  bool mergeCollapsedLines(const Patch<Dim - 1, Dim>& trace, const std::vector<int>& functions, int d) {
    const auto& basis = trace.basis();
    bool all = true;
    for (int a = 0; a < basis.numFunctions(); ++a) {
      auto index = basis.functionIndex(a);
      if (index[static_cast<std::size_t>(d)] != 0) continue;
      std::vector<int> line;
      for (int i = 0; i < basis.direction(d).numFunctions(); ++i) {
        index[static_cast<std::size_t>(d)] = i;
        line.push_back(basis.functionNumber(index));
      }
      const Eigen::MatrixXd points = trace.points()(Eigen::all, line);
      const bool isPoint = (points.colwise() - points.col(0)).colwise().norm().maxCoeff() <= tolerance_;
      all = all && isPoint;
      if (!isPoint) continue;
      for (const int b : line)
        nodes_.merge(functions[static_cast<std::size_t>(b)], functions[static_cast<std::size_t>(a)]);
    }
    return all;
  }

  Face& face(int number) { return faces_[static_cast<std::size_t>(number)]; }

  void joinPair(int first, int second) {
    Face &a = face(first), &b = face(second);
    std::optional<std::string> difference;
    for (const auto& orientation : faceOrientations<Dim - 1>()) {
      if (!cornersMeet(a.trace, b.trace, orientation, tolerance_)) continue;
      difference = faceDifference(a.trace, b.trace, orientation, tolerance_);
      if (difference) continue;
      for (const Face* one : {&a, &b})
        if (one->partner >= 0)
          throw Error(
              fmt::format("face '{}' of patch '{}' matches two other faces; allowed: one, a face has no more "
                          "than two sides",
                          faceName(one->id), name(one->patch)));
      a.partner = second;
      b.partner = first;
      return merge(a, b, orientation);
    }
    // Two faces of one patch may enclose it and be close, in a thin lens.
    if (difference && a.patch != b.patch && liesOn(a.trace, b.trace, kTouching * a.size))
      throw Error(
          fmt::format("face '{}' of patch '{}' and face '{}' of patch '{}' lie on each other but do not "
                      "match: {}; allowed: the same degree, knots, weights and control points along both",
                      faceName(a.id), name(a.patch), faceName(b.id), name(b.patch), *difference));
  }

  /// Faces of two patches that touch along a stretch without being joined would let the body open there.
  void requireSealed() const {
    std::vector<FaceSamples> samples;
    for (const Face& face : faces_) samples.push_back(samplesOf(face.trace));
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t j = 0; j < faces_.size(); ++j) {
        const Face &a = faces_[i], &b = faces_[j];
        const double close = kClose * std::min(a.size, b.size);
        if (a.patch == b.patch || a.partner == static_cast<int>(j) || distanceOfBoxes(a, b) > close) continue;
        if (touches(samples[i], b.trace, samples[j], close))
          throw Error(
              fmt::format("face '{}' of patch '{}' and face '{}' of patch '{}' touch but are not joined; "
                          "allowed: faces that match as a whole, with the same control points",
                          faceName(a.id), name(a.patch), faceName(b.id), name(b.patch)));
      }
  }

  static double distanceOfBoxes(const Face& a, const Face& b) {
    const auto box = [](const Face& f) {
      return Eigen::AlignedBox<double, Dim>(f.trace.points().rowwise().minCoeff(),
                                            f.trace.points().rowwise().maxCoeff());
    };
    return box(a).exteriorDistance(box(b));
  }

  void merge(const Face& a, const Face& b, const FaceOrientation<Dim - 1>& orientation) {
    const auto other = counterparts(a.trace.basis(), b.trace.basis(), orientation);
    for (std::size_t i = 0; i < other.size(); ++i)
      nodes_.merge(a.functions[i], b.functions[static_cast<std::size_t>(other[i])]);
    joined_.merge(a.patch, b.patch);
  }

  /// Nodes in the order in which the patches' functions name them first.
  void numberNodes() {
    std::vector<int> numbers(static_cast<std::size_t>(nodes_.count()), -1);
    int function = 0;
    for (const auto& patch : body_.patches) {
      auto& nodes = body_.nodes.emplace_back();
      for (int a = 0; a < patch.basis().numFunctions(); ++a) {
        int& number = numbers[static_cast<std::size_t>(nodes_.leader(function++))];
        if (number < 0) number = body_.numNodes++;
        nodes.push_back(number);
      }
    }
  }

  Body<Dim>& body_;
  const std::vector<std::string>& names_;
  double tolerance_;
  std::vector<int> offsets_;  ///< first function of each patch when those of all patches are counted on
  Groups nodes_;
  Groups joined_;
  std::vector<Face> faces_;
};

}  // namespace

template <int Dim>
Body<Dim> joinedBody(std::vector<Patch<Dim>> patches, const std::vector<std::string>& names) {
  Body<Dim> body;
  body.patches = std::move(patches);
  Joiner<Dim>(body, names).join();
  return body;
}

template Body<2> joinedBody(std::vector<Patch<2>>, const std::vector<std::string>&);
template Body<3> joinedBody(std::vector<Patch<3>>, const std::vector<std::string>&);

}  // namespace burnish::inline solid
