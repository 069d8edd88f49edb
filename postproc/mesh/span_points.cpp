#include "postproc/mesh/span_points.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// What a point makes of the coefficients of the functions of its span.
struct Combination {
  Eigen::VectorXd factors;
  double weight = 1.0;
};

/// The points put together so far.
struct Parts {
  std::vector<Eigen::Triplet<double>> combination;
  std::vector<double> coordinates;  ///< dim per point
  std::vector<double> weights;
  int numPoints = 0;

  void add(const PatchRecord& record, const std::vector<int>& functions, const Combination& point) {
    for (std::size_t a = 0; a < functions.size(); ++a)
      combination.emplace_back(numPoints, record.nodes[static_cast<std::size_t>(functions[a])],
                               point.factors(static_cast<Eigen::Index>(a)));
    const Eigen::VectorXd x = record.points(Eigen::all, functions) * point.factors;
    coordinates.insert(coordinates.end(), x.begin(), x.end());
    weights.push_back(point.weight);
    ++numPoints;
  }
};

/// Σ N_A w_A q_A in Bernstein polynomials has the coefficients Σ C_Ab w_A q_A; those of Σ N_A w_A divide
/// them.
template <int Dim>
Combination coefficientOf(const Patch<Dim>& patch, int span, const IndexBox::Index& local) {
  const auto spans = patch.basis().spanIndex(span);
  Eigen::VectorXd factors = patch.weights()(patch.basis().spanFunctions(span));
  Eigen::Index block = 1;
  for (int d = 0; d < Dim; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const Eigen::VectorXd column = patch.basis().direction(d).extraction(spans[k]).col(local[k]);
    for (Eigen::Index a = 0; a < factors.size(); ++a) factors(a) *= column((a / block) % column.size());
    block *= column.size();
  }
  const double weight = factors.sum();
  return {factors / weight, weight};
}

template <int Dim>
PatchLattice addPatch(const PatchRecord& record, PointMeaning meaning,
                      const std::function<int(const DirectionRecord&)>& steps, Parts& parts) {
  const Patch<Dim> patch = patchGeometry<Dim>(record);
  PatchLattice lattice;
  lattice.firstPoint = parts.numPoints;
  std::array<std::vector<double>, std::size_t{Dim}> parameters;
  for (std::size_t d = 0; d < std::size_t{Dim}; ++d) {
    const UnivariateBasis& basis = patch.basis().direction(static_cast<int>(d));
    lattice.steps[d] = steps(record.directions[d]);
    lattice.spans.extent[d] = basis.numSpans();
    parameters[d] = subdividedSpans(basis, lattice.steps[d]);
  }
  const IndexBox points = lattice.points();
  for (int i = 0; i < points.size(); ++i) {
    const IndexBox::Index index = points.index(i);
    IndexBox::Index span{0, 0, 0}, local{0, 0, 0};
    typename Patch<Dim>::Parameter xi;
    for (std::size_t d = 0; d < std::size_t{Dim}; ++d) {
      // The last point of a direction belongs to its last span.
      span[d] = std::min(index[d] / lattice.steps[d], lattice.spans.extent[d] - 1);
      local[d] = index[d] - span[d] * lattice.steps[d];
      xi(static_cast<Eigen::Index>(d)) = parameters[d][static_cast<std::size_t>(index[d])];
    }
    const int number = lattice.spans.number(span);
    parts.add(record, patch.basis().spanFunctions(number),
              meaning == PointMeaning::Value ? Combination{patch.shape(number, xi).R}
                                             : coefficientOf<Dim>(patch, number, local));
  }
  return lattice;
}

}  // namespace

IndexBox PatchLattice::points() const {
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) box.extent[d] = spans.extent[d] * steps[d] + 1;
  return box;
}

int PatchLattice::point(const IndexBox::Index& span, const IndexBox::Index& local) const {
  IndexBox::Index index;
  for (std::size_t d = 0; d < 3; ++d) index[d] = span[d] * steps[d] + local[d];
  return firstPoint + points().number(index);
}

SpanPoints::SpanPoints(const ModelRecord& model, PointMeaning meaning,
                       const std::function<int(const DirectionRecord&)>& steps) {
  checkModel(model, "model");
  Parts parts;
  for (const PatchRecord& patch : model.patches) {
    const auto add = model.dim == 2 ? addPatch<2> : addPatch<3>;
    patches_.push_back(add(patch, meaning, steps, parts));
  }
  combination_.resize(parts.numPoints, model.numNodes);
  combination_.setFromTriplets(parts.combination.begin(), parts.combination.end());
  referencePoints_ = Eigen::Map<const Eigen::MatrixXd>(parts.coordinates.data(), model.dim, parts.numPoints);
  weights_ = Eigen::Map<const Eigen::VectorXd>(parts.weights.data(), parts.numPoints);
}

Eigen::MatrixXd SpanPoints::evaluate(const Eigen::MatrixXd& coefficients) const {
  if (coefficients.cols() != combination_.cols())
    throw Error(fmt::format("field: found values at {} nodes; the model has {}", coefficients.cols(),
                            combination_.cols()));
  return (combination_ * coefficients.transpose()).transpose();
}

void setPoints(vtkUnstructuredGrid& grid, const SpanPoints& points, const FrameRecord& frame, bool deformed,
               const std::string& lengthUnit) {
  const Eigen::MatrixXd u = points.evaluate(frame.displacement);
  if (u.rows() != points.dim())
    throw Error(
        fmt::format("displacement: found {} components; the body has {} dimensions", u.rows(), points.dim()));
  const Eigen::MatrixXd& X = points.referencePoints();
  grid.SetPoints(makePoints(deformed ? Eigen::MatrixXd(X + u) : X));
  grid.GetPointData()->AddArray(makeArray(labelled("displacement", lengthUnit), inSpace(u), kAxes));
  for (const auto& [name, field] : frame.fields)
    grid.GetPointData()->AddArray(
        makeArray(labelled(name, field.unit), points.evaluate(field.values), field.components));
}

}  // namespace burnish
