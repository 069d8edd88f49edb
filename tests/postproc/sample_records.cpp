#include "tests/postproc/sample_records.h"

#include <functional>
#include <numbers>
#include <numeric>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish::samples {
namespace {

template <int P>
PatchRecord record(const Patch<P>& patch) {
  PatchRecord result;
  for (int d = 0; d < P; ++d) {
    const UnivariateBasis& basis = patch.basis().direction(d);
    result.directions.push_back({basis.family(), basis.degree(), basis.knots()});
  }
  result.points = patch.points();
  result.weights = patch.weights();
  result.nodes.resize(static_cast<std::size_t>(patch.points().cols()));
  std::iota(result.nodes.begin(), result.nodes.end(), 0);
  return result;
}

template <int P>
Sample sampleOf(const Patch<P>& patch, const std::string& title) {
  Sample sample;
  sample.model.title = title;
  sample.model.dim = P;
  sample.model.mesh.numNodes = static_cast<int>(patch.points().cols());
  sample.model.mesh.patches = {record(patch)};
  sample.frame.displacement = Eigen::MatrixXd::Zero(P, sample.model.mesh.numNodes);
  return sample;
}

void addTool(Sample& sample, const ToolRecord& tool, const Eigen::VectorXd& displacement) {
  sample.model.tools = {tool};
  sample.frame.toolDisplacement = displacement;
}

/// One coefficient per control point, from the point's own position.
Eigen::MatrixXd perPoint(const Eigen::MatrixXd& points,
                         const std::function<double(const Eigen::VectorXd&)>& value) {
  Eigen::MatrixXd values(1, points.cols());
  for (Eigen::Index a = 0; a < points.cols(); ++a) values(0, a) = value(points.col(a));
  return values;
}

/// Coefficients of ξ² in quadratic B-splines on [0, 1]: products of neighbouring knots.
Eigen::VectorXd squareCoefficients(const KnotVector& knots) {
  Eigen::VectorXd c(knots.numFunctions());
  for (int i = 0; i < c.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    c(i) = knots.knots()[k + 1] * knots.knots()[k + 2];
  }
  return c;
}

Eigen::VectorXd linearCoefficients(const KnotVector& knots) {
  Eigen::VectorXd c(knots.numFunctions());
  for (int i = 0; i < c.size(); ++i) c(i) = knots.greville(i);
  return c;
}

/// Coefficients of f(s) g(t), first direction fastest.
Eigen::RowVectorXd product(const Eigen::VectorXd& f, const Eigen::VectorXd& g) {
  const Eigen::MatrixXd both = f * g.transpose();
  return both.reshaped().transpose();
}

}  // namespace

Sample slab(const std::array<int, 2>& spans) {
  const KnotVector s = KnotVector::uniform(2, spans[0]), t = KnotVector::uniform(2, spans[1]);
  Sample sample = sampleOf(refined(rectangle({0, 0}, {3, 1}), {s, t}), "Slab under a cylinder");
  const Eigen::VectorXd bump = linearCoefficients(s) - squareCoefficients(s);
  sample.model.lengthUnit = "mm";
  sample.frame.time = 1.5;
  sample.frame.displacement.row(1) = -0.6 * product(bump, linearCoefficients(t));
  sample.frame.fields["plastic_strain"] = {{}, "", 4.0 * product(bump, squareCoefficients(t))};
  ToolRecord cylinder{"cylinder", Cylinder{{1.5, 1.5, 0.0}, {0.0, 0.0, 1.0}, 0.5}};
  cylinder.halfThickness = 0.5;
  addTool(sample, cylinder, Eigen::Vector2d(0.0, -0.15));
  return sample;
}

Sample rubbedSlab() {
  constexpr int kSpans = 12, kPoints = 4 * kSpans;
  Sample sample = slab({kSpans, 6});
  sample.model.stressUnit = "MPa";
  ContactRecord contact;
  contact.tool = "disc";
  contact.face = "top";
  const Eigen::RowVectorXd s = Eigen::RowVectorXd::LinSpaced(kPoints, 0.5, kPoints - 0.5) / kPoints;
  const Eigen::RowVectorXd distance = (s.array() - 0.5).abs();
  const Eigen::RowVectorXd none = Eigen::RowVectorXd::Zero(kPoints);
  contact.quadraturePoints = Eigen::MatrixXd::Ones(2, kPoints);
  contact.quadraturePoints.row(0) = 3.0 * s;
  contact.quadraturePoints.row(1).array() -= 0.6 * s.array() * (1.0 - s.array());
  contact.quadraturePressure = (10.0 - 40.0 * distance.array()).cwiseMax(0.0).transpose();
  contact.quadratureGap = none.transpose();
  contact.quadratureNormal = Eigen::Vector2d(0, 1).replicate(1, kPoints);
  contact.quadratureFriction.resize(2, kPoints);
  contact.quadratureFriction << 0.3 * contact.quadraturePressure.transpose(), none;
  for (const double d : distance) contact.quadratureSliding.push_back(d < 0.1 ? 1 : d < 0.25 ? 2 : 0);
  contact.quadratureSlip = Eigen::MatrixXd::Zero(2, kPoints);
  for (int k = 0; k < kPoints; ++k)
    if (contact.quadratureSliding[static_cast<std::size_t>(k)] == 2) contact.quadratureSlip(0, k) = 0.02;
  contact.quadratureSlipped = s.transpose();
  sample.frame.contact = {contact};
  return sample;
}

Sample ring(const std::array<int, 2>& spans) {
  const KnotVector r = KnotVector::uniform(2, spans[0]), angle = KnotVector::uniform(2, spans[1]);
  Sample sample = sampleOf(refined(annulus({0, 0}, 1.0, 2.0, 0.0, std::numbers::pi / 2), {r, angle}), "Ring");
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(angle.numFunctions());
  sample.frame.fields["von_mises"] = {{}, "MPa", 100.0 * product(linearCoefficients(r), ones)};
  sample.frame.toolDisplacement.resize(2, 0);
  return sample;
}

Sample square() {
  const std::vector<double> breakpoints{0.0, 0.25, 0.5, 0.75, 1.0};
  const auto patch = lagrangeInterpolant(rectangle({0, 0}, {1, 1}), 3, {breakpoints, breakpoints});
  Sample sample = sampleOf(patch, "");
  const Eigen::MatrixXd& x = patch.points();
  sample.model.stressUnit = "Pa";
  sample.frame.time = 0.25;
  sample.frame.displacement.row(0) = 0.2 * x.row(1);
  sample.frame.fields["pressure"] = {
      {}, "Pa", perPoint(x, [](const Eigen::VectorXd& p) { return 1e-5 * (p(0) * p(0) * p(0) - p(1)); })};
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(4, x.cols());
  stress.row(0) = -1e5 * x.row(0);
  sample.frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "Pa", stress};
  addTool(sample, {"plate", Plane{{0.0, 1.1, 0.0}, {0.0, -1.0, 0.0}}}, Eigen::Vector2d(0.0, -0.1));
  return sample;
}

Sample cube(int spans) {
  const KnotVector knots = KnotVector::uniform(2, spans);
  const auto patch = refined(box({0, 0, 0}, {1, 1, 1}), {knots, knots, knots});
  Sample sample = sampleOf(patch, "Cube");
  sample.frame.fields["pressure"] = {{}, "", patch.points().colwise().sum()};
  addTool(sample, {"ball", Sphere{{0.5, 1.25, 0.5}, 0.25}}, Eigen::Vector3d::Zero());
  return sample;
}

Sample twoBodies() {
  Sample sample = slab();
  MeshRecord& mesh = sample.model.mesh;
  PatchRecord stamp =
      record(refined(rectangle({3.5, 0}, {1, 1}), {KnotVector::uniform(2, 3), KnotVector::uniform(2, 3)}));
  const int first = mesh.numNodes;
  for (int& node : stamp.nodes) node += first;
  stamp.body = 1;
  mesh.numNodes += static_cast<int>(stamp.nodes.size());
  mesh.patches.push_back(std::move(stamp));
  sample.model.bodies = {"block", "stamp"};
  sample.model.title = "Two bodies";

  const auto extended = [&](const Eigen::MatrixXd& values) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(values.rows(), mesh.numNodes);
    all.leftCols(first) = values;
    return all;
  };
  sample.frame.displacement = extended(sample.frame.displacement);
  FieldRecord& strain = sample.frame.fields.at("plastic_strain");
  strain.values = extended(strain.values);
  strain.bodies = {"block"};
  Eigen::MatrixXd mises(1, mesh.numNodes);
  for (const PatchRecord& patch : mesh.patches) mises(0, patch.nodes) = 10.0 * patch.points.row(0);
  sample.frame.fields["von_mises"] = {{}, "MPa", mises, {}};
  return sample;
}

Sample meshedAnew(const Sample& before, const Sample& after) {
  Sample sample{before.model, after.frame};
  sample.frame.mesh = after.model.mesh;
  return sample;
}

}  // namespace burnish::samples
