#include "postproc/export/nurbs_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/results/check_records.h"
#include "postproc/mesh/index_box.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/tensor_points.h"
#include "postproc/text/json_text.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

struct KnotRow {
  int degree = 1;
  std::vector<double> knots;

  int count() const { return static_cast<int>(knots.size()) - degree - 1; }
};

/// A patch where it is now: points as dim x functions, first direction fastest.
struct NurbsPatch {
  std::vector<KnotRow> directions;
  Eigen::MatrixXd points;
  Eigen::VectorXd weights;

  bool isRational() const { return (weights.array() != weights(0)).any(); }
};

/// Knots of the splines that are polynomials on each element and continuous.
KnotRow knotsOfElements(const UnivariateBasis& basis) {
  KnotRow row{basis.degree(), {}};
  const std::vector<double>& breakpoints = basis.breakpoints();
  for (std::size_t k = 0; k < breakpoints.size(); ++k) {
    const bool isEnd = k == 0 || k + 1 == breakpoints.size();
    row.knots.insert(row.knots.end(), static_cast<std::size_t>(row.degree + (isEnd ? 1 : 0)), breakpoints[k]);
  }
  return row;
}

NurbsPatch nurbsOf(const PatchRecord& patch, const Eigen::MatrixXd& displacement) {
  NurbsPatch nurbs;
  const bool isSpline = std::ranges::all_of(
      patch.directions, [](const DirectionRecord& d) { return d.family == BasisFamily::BSpline; });
  if (isSpline) {
    for (const DirectionRecord& d : patch.directions) nurbs.directions.push_back({d.degree, d.knots});
    nurbs.points = patch.points;
    for (Eigen::Index a = 0; a < nurbs.points.cols(); ++a)
      nurbs.points.col(a) += displacement.col(patch.nodes[static_cast<std::size_t>(a)]);
    nurbs.weights = patch.weights;
    return nurbs;
  }
  std::vector<PointRow> rows;
  for (const DirectionRecord& d : patch.directions) {
    const UnivariateBasis basis = basisOf(d);
    nurbs.directions.push_back(knotsOfElements(basis));
    rows.push_back(bernsteinPoints(basis));
  }
  const TensorPoints points(patch, std::move(rows));
  nurbs.points = points.referencePoints() + points.evaluate(displacement);
  nurbs.weights = points.weights();
  return nurbs;
}

std::string g2Text(const NurbsPatch& patch) {
  const bool isRational = patch.isRational();
  std::string text = fmt::format("{} 1 0 0\n{} {}\n", patch.directions.size() == 2 ? 200 : 700,
                                 patch.points.rows(), isRational ? 1 : 0);
  for (const KnotRow& row : patch.directions)
    text += fmt::format("{} {}\n{}\n", row.count(), row.degree + 1, fmt::join(row.knots, " "));
  for (Eigen::Index a = 0; a < patch.points.cols(); ++a) {
    const double weight = isRational ? patch.weights(a) : 1.0;
    const Eigen::VectorXd point = weight * patch.points.col(a);
    text += fmt::format("{}", fmt::join(point, " "));
    text += isRational ? fmt::format(" {}\n", weight) : "\n";
  }
  return text + "\n";
}

/// Numbers of the control points in the order of geomdl: the second direction fastest, then the first one.
std::vector<Eigen::Index> geomdlOrder(const NurbsPatch& patch) {
  IndexBox box;
  for (std::size_t d = 0; d < patch.directions.size(); ++d) box.extent[d] = patch.directions[d].count();
  std::vector<Eigen::Index> order;
  for (int w = 0; w < box.extent[2]; ++w)
    for (int u = 0; u < box.extent[0]; ++u)
      for (int v = 0; v < box.extent[1]; ++v) order.push_back(box.number({u, v, w}));
  return order;
}

std::string jsonText(const NurbsPatch& patch, const std::string& name) {
  std::string text = fmt::format("      {{\"name\": {}, \"rational\": true, \"dimension\": {},\n",
                                 compactText(Json::Value(name)), patch.points.rows());
  for (std::size_t d = 0; d < patch.directions.size(); ++d)
    text += fmt::format("       \"degree_{0}\": {1}, \"size_{0}\": {2}, \"knotvector_{0}\": [{3}],\n",
                        "uvw"[d], patch.directions[d].degree, patch.directions[d].count(),
                        fmt::join(patch.directions[d].knots, ", "));
  std::vector<std::string> points;
  std::vector<double> weights;
  for (const Eigen::Index a : geomdlOrder(patch)) {
    points.push_back(fmt::format("[{}]", fmt::join(patch.points.col(a), ", ")));
    weights.push_back(patch.weights(a));
  }
  return text + fmt::format("       \"control_points\": {{\"points\": [{}],\n        \"weights\": [{}]}}}}",
                            fmt::join(points, ", "), fmt::join(weights, ", "));
}

/// A face of a patch: its two directions, and its functions, first direction fastest.
struct FaceOfPatch {
  std::array<std::size_t, 2> directions{};
  std::vector<Eigen::Index> functions{};
};

FaceOfPatch faceOfPatch(const NurbsPatch& patch, FaceId face) {
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) box.extent[d] = patch.directions[d].count();
  const auto normal = static_cast<std::size_t>(face / 2);
  FaceOfPatch found{.directions = {normal == 0 ? 1U : 0U, normal == 2 ? 1U : 2U}};
  IndexBox::Index index{};
  index[normal] = face % 2 == 0 ? 0 : box.extent[normal] - 1;
  const auto [u, v] = found.directions;
  for (index[v] = 0; index[v] < box.extent[v]; ++index[v])
    for (index[u] = 0; index[u] < box.extent[u]; ++index[u]) found.functions.push_back(box.number(index));
  return found;
}

std::vector<int> nodesOf(const PatchRecord& record, const FaceOfPatch& face) {
  std::vector<int> nodes;
  for (const Eigen::Index a : face.functions) nodes.push_back(record.nodes[static_cast<std::size_t>(a)]);
  return nodes;
}

/// Whether all lines of a face in one of its directions are the same line, or points. count: functions in its first direction.
bool isCollapsed(const std::vector<int>& nodes, int count) {
  bool alongFirst = true, alongSecond = true;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t column = k % static_cast<std::size_t>(count);
    alongFirst = alongFirst && nodes[k] == nodes[k - column];
    alongSecond = alongSecond && nodes[k] == nodes[column];
  }
  return alongFirst || alongSecond;
}

CadFace cadFace(const NurbsPatch& patch, const FaceOfPatch& face, bool reversed, std::string name) {
  CadFace made{.reversed = reversed, .name = std::move(name)};
  for (std::size_t d = 0; d < 2; ++d) {
    made.degrees[d] = patch.directions[face.directions[d]].degree;
    made.knots[d] = patch.directions[face.directions[d]].knots;
  }
  made.points = Eigen::Matrix3Xd::Zero(3, std::ssize(face.functions));
  made.points.topRows(patch.points.rows()) = patch.points(Eigen::all, face.functions);
  made.weights = patch.weights(face.functions);
  return made;
}

/// In a patch of right-handed parameters ∂1 x ∂2 points inwards on these of its faces.
bool pointsInwards(FaceId face) {
  const bool isEnd = face % 2 == 1;
  return face / 2 == 1 ? isEnd : !isEnd;
}

std::vector<NurbsPatch> patchesOf(const MeshRecord& mesh, const FrameRecord& frame) {
  std::vector<NurbsPatch> patches;
  for (const PatchRecord& patch : mesh.patches) patches.push_back(nurbsOf(patch, frame.displacement));
  return patches;
}

std::string nameOf(const ModelRecord& model, const PatchRecord& patch) {
  return model.bodies.empty() ? "body" : model.bodies[static_cast<std::size_t>(patch.body)];
}

}  // namespace

std::vector<CadBody> nurbsBodies(const ModelRecord& model, const FrameRecord& frame) {
  checkFrame(frame, model, fmt::format("frame {}", frame.index));
  const MeshRecord& mesh = meshOf(model, frame);
  const std::vector<NurbsPatch> patches = patchesOf(mesh, frame);
  std::vector<CadBody> bodies;
  const auto addFace = [&](std::size_t k, CadFace face) {
    const std::string name = nameOf(model, mesh.patches[k]);
    auto body = std::ranges::find(bodies, name, &CadBody::name);
    if (body == bodies.end()) body = bodies.insert(body, {.name = name});
    face.name = fmt::format("{}.{}", name, face.name);
    body->faces.push_back(std::move(face));
  };
  if (model.dim == 2) {
    for (std::size_t k = 0; k < patches.size(); ++k) {
      FaceOfPatch all{.directions = {0, 1}};
      for (Eigen::Index a = 0; a < patches[k].points.cols(); ++a) all.functions.push_back(a);
      addFace(k, cadFace(patches[k], all, false, fmt::format("{}", k + 1)));
    }
    return bodies;
  }
  const auto sortedNodes = [&](std::size_t k, FaceId face) {
    auto nodes = nodesOf(mesh.patches[k], faceOfPatch(patches[k], face));
    std::ranges::sort(nodes);
    return nodes;
  };
  std::map<std::vector<int>, int> count;  // of the faces with the same nodes
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (FaceId face = 0; face < 6; ++face) ++count[sortedNodes(k, face)];
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (FaceId face = 0; face < 6; ++face) {
      const FaceOfPatch found = faceOfPatch(patches[k], face);
      if (count[sortedNodes(k, face)] > 1 ||
          isCollapsed(nodesOf(mesh.patches[k], found), patches[k].directions[found.directions[0]].count()))
        continue;
      addFace(k,
              cadFace(patches[k], found, pointsInwards(face), fmt::format("{}.{}", k + 1, faceName(face))));
    }
  return bodies;
}

std::string nurbsText(const ModelRecord& model, const FrameRecord& frame, NurbsFormat format) {
  checkFrame(frame, model, fmt::format("frame {}", frame.index));
  std::string g2;
  std::vector<std::string> shapes;
  for (const PatchRecord& patch : meshOf(model, frame).patches) {
    const NurbsPatch nurbs = nurbsOf(patch, frame.displacement);
    format == NurbsFormat::G2 ? void(g2 += g2Text(nurbs))
                              : shapes.push_back(jsonText(nurbs, nameOf(model, patch)));
  }
  if (format == NurbsFormat::G2) return g2;
  return fmt::format(
      "{{\n  \"time\": {},\n  \"unit\": {},\n  \"shape\": {{\n    \"type\": \"{}\",\n    \"count\": {},\n    "
      "\"data\": [\n{}\n    ]\n  }}\n}}\n",
      plainTime(frame.time), compactText(Json::Value(model.lengthUnit)),
      model.dim == 2 ? "surface" : "volume", shapes.size(), fmt::join(shapes, ",\n"));
}

}  // namespace burnish
