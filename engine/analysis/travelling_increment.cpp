#include "engine/analysis/travelling_increment.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/collocation.h"
#include "engine/nurbs/refinement.h"

namespace burnish::inline analysis {
namespace {

constexpr double kSameShare = 1e-9;

/// Functions of a tensor product before those of a direction, all of them together.
template <int P>
Eigen::Index strideOf(const TensorBasis<P>& basis, int direction) {
  Eigen::Index stride = 1;
  for (int d = 0; d < direction; ++d) stride *= basis.direction(d).numFunctions();
  return stride;
}

/// Of a coordinate that follows one direction of a patch alone: its values at the functions of that direction. Empty
/// if there is no such coordinate, or if it does not grow or fall all along.
template <int Dim>
Eigen::VectorXd coordinatesAlong(const Patch<Dim>& patch, int direction, int axis) {
  const TensorBasis<Dim>& basis = patch.basis();
  const Eigen::Index stride = strideOf(basis, direction), count = basis.direction(direction).numFunctions();
  const Eigen::RowVectorXd all = patch.points().row(axis);
  const double size = all.maxCoeff() - all.minCoeff();
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; k < count; ++k) values(k) = all(k * stride);
  for (Eigen::Index k = 0; k < all.size(); ++k)
    if (std::abs(all(k) - values(k / stride % count)) > kSameShare * size) return {};
  const Eigen::VectorXd steps = values.tail(count - 1) - values.head(count - 1);
  if (!(steps.minCoeff() > 0.0 || steps.maxCoeff() < 0.0)) return {};
  return values;
}

/// Number of a direction of a patch among those of the trace of a face.
int directionOnFace(int direction, FaceId face) {
  return direction < face / 2 ? direction : direction - 1;
}

/// Transforms a field of several components that are numbered together, function by function.
void transform(Eigen::Ref<Eigen::VectorXd> field, Eigen::Index components, const Eigen::MatrixXd& T,
               Eigen::Index stride) {
  const Eigen::MatrixXd values = field.reshaped(components, field.size() / components).transpose();
  field = appliedAlong(values, T, stride).transpose().reshaped();
}

}  // namespace

template <int Dim>
TravellingIncrement<Dim>::TravellingIncrement(const Model<Dim>& model) : model_(model) {
  const auto& contacts = model.contacts();
  if (Dim == 2 || model.bodies().size() != 1 || model.body().patches.size() != 1 || contacts.size() != 1 ||
      !model.pairs().empty() || !model.selfContacts().empty())
    return;
  const Patch<Dim>& patch = model.body().patches.front();
  if (patch.weights().maxCoeff() - patch.weights().minCoeff() > kSameShare * patch.weights().maxCoeff())
    return;
  for (int direction = 0; direction < Dim; ++direction) {
    if (direction == contacts.front().place.face / 2) continue;
    for (int axis = 0; axis < Dim; ++axis)
      if (Eigen::VectorXd values = coordinatesAlong(patch, direction, axis); values.size() > 0)
        along_.push_back({direction, axis, std::move(values)});
  }
}

template <int Dim>
Eigen::MatrixXd TravellingIncrement<Dim>::movedBy(const Along& along, double way) const {
  const UnivariateBasis& basis = model_.body().patches.front().basis().direction(along.direction);
  const Eigen::MatrixXd atAnchors = valuesAtAnchors(basis, basis);
  const auto coordinateAt = [&](double xi) -> double {
    return functionValuesAt(basis, {xi}).row(0) * along.coordinates;
  };
  const double begin = basis.breakpoints().front(), end = basis.breakpoints().back();
  const bool grows = along.coordinates(0) < along.coordinates(along.coordinates.size() - 1);
  std::vector<double> behind;
  for (const double anchor : Eigen::VectorXd(atAnchors * along.coordinates)) {
    double low = begin, high = end;
    constexpr int kBisections = 50;
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (low + high);
      ((coordinateAt(middle) < anchor - way) == grows ? low : high) = middle;
    }
    behind.push_back(low);
  }
  return atAnchors.partialPivLu().solve(functionValuesAt(basis, behind));
}

template <int Dim>
void TravellingIncrement<Dim>::move(double before, double to, Eigen::VectorXd& increment) const {
  if (along_.empty()) return;
  const ContactPair<Dim>& contact = model_.contacts().front();
  const Tool& tool = *model_.tools()[contact.tool];
  // The pattern of a step stands in its middle.
  const Eigen::Vector3d way = 0.5 * (tool.pose(to).displacement - tool.pose(before).displacement);
  const TensorBasis<Dim>& basis = model_.body().patches.front().basis();
  const auto trace = contact.term->face().trace().basis();
  for (const Along& along : along_) {
    if (way(along.axis) == 0.0) continue;
    const Eigen::MatrixXd T = movedBy(along, way(along.axis));
    transform(increment.head(model_.numDisplacements()), Dim, T, strideOf(basis, along.direction));
    if (!contact.term->hasAllMultipliers()) continue;
    const Eigen::Index stride = strideOf(trace, directionOnFace(along.direction, contact.place.face)),
                       first = contact.term->firstMultiplier(), count = trace.numFunctions();
    transform(increment.segment(first, count), 1, T, stride);
    if (contact.term->options().hasFriction())
      transform(increment.segment(first + count, (Dim - 1) * count), Dim - 1, T, stride);
  }
}

template class TravellingIncrement<2>;
template class TravellingIncrement<3>;

}  // namespace burnish::inline analysis
