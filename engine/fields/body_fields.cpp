#include "engine/fields/body_fields.h"

#include <array>
#include <cmath>
#include <utility>

namespace burnish::inline fields {
namespace {

/// Names of the stress components in the order of a record, and their places in `kVoigt` order.
template <int Dim>
std::pair<std::vector<std::string>, std::vector<int>> stressComponents() {
  if constexpr (Dim == 2)
    return {{"xx", "yy", "xy", "zz"}, {0, 1, 3, 2}};
  else
    return {{"xx", "yy", "zz", "xy", "yz", "zx"}, {0, 1, 2, 3, 4, 5}};
}

template <int Dim>
double vonMises(const Eigen::Vector<double, kVoigt<Dim>>& sigma) {
  const Eigen::Vector3d normal = sigma.template head<3>();
  const Eigen::Vector3d deviator = normal.array() - normal.mean();
  return std::sqrt(1.5 *
                   (deviator.squaredNorm() + 2.0 * sigma.template tail<kVoigt<Dim> - 3>().squaredNorm()));
}

}  // namespace

template <int Dim>
std::map<std::string, FieldRecord> quadratureFields(const BulkTerm<Dim>& bulk,
                                                    const std::string& stressUnit) {
  const auto& tau = bulk.kirchhoffStress();
  const auto points = static_cast<Eigen::Index>(tau.size());
  const auto [names, places] = stressComponents<Dim>();
  FieldRecord stress{names, stressUnit, Eigen::MatrixXd(static_cast<Eigen::Index>(names.size()), points)};
  FieldRecord mises{{}, stressUnit, Eigen::MatrixXd(1, points)};
  FieldRecord pressure{{}, stressUnit, Eigen::MatrixXd(1, points)};
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto point = static_cast<std::size_t>(q);
    const Eigen::Vector<double, kVoigt<Dim>> sigma = tau[point] / bulk.jacobians()[point];
    stress.values.col(q) = sigma(places);
    mises.values(0, q) = vonMises<Dim>(sigma);
    pressure.values(0, q) = -sigma.template head<3>().mean();
  }
  std::map<std::string, FieldRecord> fields{{"stress", stress}, {"von_mises", mises}, {"pressure", pressure}};
  for (const FieldKind& field : bulk.points().fields())
    fields[field.name] = {field.components, field.unit == "stress" ? stressUnit : field.unit,
                          bulk.points().field(field.name)};
  return fields;
}

std::map<std::string, FieldRecord> whole(const Portion& portion, std::map<std::string, FieldRecord> fields,
                                         Receivers receivers) {
  bool isHere = true;
  for (auto& [name, field] : fields) {
    field.values = portion.whole(std::move(field.values), receivers);
    isHere = field.values.cols() == portion.count();
  }
  if (!isHere) fields.clear();
  return fields;
}

template <int Dim>
std::map<std::string, FieldRecord> projected(const Projection<Dim>& projection,
                                             std::map<std::string, FieldRecord> fields) {
  for (auto& [name, field] : fields)
    field.values = projection.project(field.values.transpose()).transpose().eval();
  return fields;
}

template std::map<std::string, FieldRecord> quadratureFields(const BulkTerm<2>&, const std::string&);
template std::map<std::string, FieldRecord> quadratureFields(const BulkTerm<3>&, const std::string&);
template std::map<std::string, FieldRecord> projected(const Projection<2>&,
                                                      std::map<std::string, FieldRecord>);
template std::map<std::string, FieldRecord> projected(const Projection<3>&,
                                                      std::map<std::string, FieldRecord>);

}  // namespace burnish::inline fields
