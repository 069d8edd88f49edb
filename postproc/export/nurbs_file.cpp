#include "postproc/export/nurbs_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
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

}  // namespace

std::string nurbsText(const ModelRecord& model, const FrameRecord& frame, NurbsFormat format) {
  checkFrame(frame, model, fmt::format("frame {}", frame.index));
  std::string g2;
  std::vector<std::string> shapes;
  for (const PatchRecord& patch : meshOf(model, frame).patches) {
    const NurbsPatch nurbs = nurbsOf(patch, frame.displacement);
    const std::string body =
        model.bodies.empty() ? "body" : model.bodies[static_cast<std::size_t>(patch.body)];
    format == NurbsFormat::G2 ? void(g2 += g2Text(nurbs)) : shapes.push_back(jsonText(nurbs, body));
  }
  if (format == NurbsFormat::G2) return g2;
  return fmt::format(
      "{{\n  \"time\": {},\n  \"unit\": {},\n  \"shape\": {{\n    \"type\": \"{}\",\n    \"count\": {},\n    "
      "\"data\": [\n{}\n    ]\n  }}\n}}\n",
      plainTime(frame.time), compactText(Json::Value(model.lengthUnit)),
      model.dim == 2 ? "surface" : "volume", shapes.size(), fmt::join(shapes, ",\n"));
}

}  // namespace burnish
