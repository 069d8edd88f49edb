#include "engine/scene/cad_net.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/core/error.h"
#include "engine/core/key_error.h"
#include "engine/core/quoted.h"
#include "engine/core/unit_label.h"
#include "engine/scene/cad_unit.h"
#include "engine/tools/surface_file.h"

namespace burnish::inline scene {
namespace {

YamlNode scalarAt(const Place& place, double value) {
  return {.kind = YamlNode::Kind::Scalar, .place = place, .text = fmt::format("{}", value)};
}

/// A face as the mapping that a file of its net would hold; all of it is at a place. turned: its directions change places.
YamlNode netOf(const CadFace& face, bool turned, const Place& place) {
  const auto list = [&place](const char* key = "") {
    return YamlNode{.kind = YamlNode::Kind::Sequence, .place = place, .key = key, .keyPlace = place};
  };
  YamlNode degrees = list("degrees"), knots = list("knots"), points = list("points"),
           weights = list("weights");
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t d = turned ? 1 - k : k;
    degrees.children.push_back(scalarAt(place, face.degrees[d]));
    YamlNode& row = knots.children.emplace_back(list());
    for (const double knot : face.knots[d]) row.children.push_back(scalarAt(place, knot));
  }
  const auto count = [&face](std::size_t d) { return std::ssize(face.knots[d]) - face.degrees[d] - 1; };
  const Eigen::Index n = count(0), m = count(1);
  for (Eigen::Index k = 0; k < n * m; ++k) {
    const Eigen::Index a = turned ? k / m + n * (k % m) : k;
    YamlNode& point = points.children.emplace_back(list());
    for (const double x : face.points.col(a)) point.children.push_back(scalarAt(place, x));
    weights.children.push_back(scalarAt(place, face.weights(a)));
  }
  YamlNode net{.kind = YamlNode::Kind::Mapping, .place = place};
  net.children = {std::move(degrees), std::move(knots), std::move(points)};
  if ((face.weights.array() != 1.0).any()) net.children.push_back(std::move(weights));
  return net;
}

/// The unit into which the lengths of a CAD file are converted for a net.
std::optional<LengthUnit> unitFor(const YamlNode& shape, const std::string& path, const YamlNode& root,
                                  Diagnostics& errors) {
  const YamlNode* given = shape.find("unit");
  if (given == nullptr) {
    const auto label = cadUnitOf(root, path, errors);
    return label ? lengthUnitOf(*label) : std::nullopt;
  }
  const auto unit = lengthUnitOf(given->text);
  if (!unit)
    errors.add(given->place, path + ".unit",
               fmt::format("found {}; allowed: {}.",
                           given->kind == YamlNode::Kind::Scalar ? quoted(given->text) : given->describe(),
                           kLengthLabels));
  return unit;
}

/// Whether a plane face is seen from behind.
bool isClockwise(const CadFace& face) {
  const Eigen::Index n = std::ssize(face.knots[0]) - face.degrees[0] - 1, m = face.points.cols() / n;
  std::vector<Eigen::Index> rim;
  for (Eigen::Index i = 0; i < n; ++i) rim.push_back(i);
  for (Eigen::Index j = 1; j < m; ++j) rim.push_back(n - 1 + n * j);
  for (Eigen::Index i = n - 2; i >= 0; --i) rim.push_back(i + n * (m - 1));
  for (Eigen::Index j = m - 2; j > 0; --j) rim.push_back(n * j);
  double twiceArea = 0.0;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const Eigen::Vector3d p = face.points.col(rim[k]), q = face.points.col(rim[(k + 1) % rim.size()]);
    twiceArea += p.x() * q.y() - q.x() * p.y();
  }
  return twiceArea < 0.0;
}

/// Makes the third coordinates of a face in the plane z = 0 zero; returns whether it is one.
bool layFlat(CadFace& face) {
  constexpr double kRounding = 1e-9;  // of the largest coordinate
  if (face.points.row(2).cwiseAbs().maxCoeff() > kRounding * face.points.cwiseAbs().maxCoeff()) return false;
  face.points.row(2).setZero();
  return true;
}

/// Whether the keys beside the name of a file are what they should be.
bool checkKeys(const YamlNode& shape, const std::string& path, Diagnostics& errors) {
  if (const YamlNode* entry = shape.find("entry"))
    errors.add(entry->keyPlace, path + ".entry", "found beside a CAD file; allowed: face, which chooses.");
  if (const YamlNode* flip = shape.find("flip");
      flip != nullptr && flip->text != "true" && flip->text != "false")
    errors.add(flip->place, path + ".flip",
               fmt::format("found {}; allowed: true or false.", flip->describe()));
  if (const YamlNode* face = shape.find("face"); face != nullptr && face->kind != YamlNode::Kind::Scalar)
    errors.add(face->place, path + ".face",
               fmt::format("found {}; allowed: the name of a face, or its number from 1.", face->describe()));
  return errors.clean(path);
}

YamlNode readFace(const std::string& file, const YamlNode& shape, LengthUnit unit, bool isPlaneBody) {
  const YamlNode *face = shape.find("face"), *flip = shape.find("flip");
  requireFile(file, "STEP or IGES model");
  CadFace found = readCadFace(file, face != nullptr ? face->text : "", unit);
  const bool isFlat = layFlat(found);
  if (isPlaneBody && !isFlat)
    throw KeyError(
        "face", fmt::format("{}: found a face that does not lie in the plane z = 0; allowed: one that does, "
                            "or, for a body in space, shape: extrusion, revolution or sweep with it as "
                            "profile",
                            file));
  const bool isSeenFromBehind = isPlaneBody ? isClockwise(found) : found.reversed;
  return netOf(found, isSeenFromBehind != (flip != nullptr && flip->text == "true"),
               shape.find("file")->place);
}

}  // namespace

std::optional<YamlNode> netOfCad(const std::filesystem::path& file, const YamlNode& shape,
                                 const YamlNode& root, const std::string& path, bool isPlaneBody,
                                 Diagnostics& errors) {
  const Place place = shape.find("file")->place;
  const auto unit = unitFor(shape, path, root, errors);
  if (!checkKeys(shape, path, errors) || !unit) return std::nullopt;
  try {
    return readFace(file.string(), shape, *unit, isPlaneBody);
  } catch (const KeyError& problem) {
    const YamlNode* at = shape.find(problem.key());
    errors.add(at != nullptr ? at->place : place, fmt::format("{}.{}", path, problem.key()),
               fmt::format("{}.", problem.what()));
  } catch (const Error& problem) {
    errors.add(place, path + ".file", fmt::format("{}.", problem.what()));
  }
  return std::nullopt;
}

}  // namespace burnish::inline scene
