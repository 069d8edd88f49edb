#include "engine/core/state_archive.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish {
namespace {

/// Whole numbers are kept as real ones, which are exact up to 2^53.
template <class Integer>
void exchangeInteger(double& stored, Integer& value, bool restores) {
  if (restores)
    value = static_cast<Integer>(stored);
  else
    stored = static_cast<double>(value);
}

}  // namespace

void StateArchive::failAt(std::string_view name) const {
  throw Error(fmt::format("the saved state has no {}{} of the size that this run needs", prefix_, name));
}

Eigen::VectorXd& StateArchive::at(std::string_view name) {
  const std::string full = prefix_ + std::string(name);
  if (!restores_) return values_[full];
  const auto found = values_.find(full);
  if (found == values_.end()) failAt(name);
  return found->second;
}

double& StateArchive::single(std::string_view name) {
  Eigen::VectorXd& values = at(name);
  if (!restores_) values.resize(1);
  if (values.size() != 1) failAt(name);
  return values(0);
}

void StateArchive::field(std::string_view name, double& value) {
  double& stored = single(name);
  (restores_ ? value : stored) = restores_ ? stored : value;
}

void StateArchive::field(std::string_view name, int& value) {
  exchangeInteger(single(name), value, restores_);
}

void StateArchive::field(std::string_view name, long& value) {
  exchangeInteger(single(name), value, restores_);
}

void StateArchive::field(std::string_view name, std::vector<double>& values) {
  Eigen::VectorXd& stored = at(name);
  if (restores_)
    values.assign(stored.begin(), stored.end());
  else
    stored = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

void StateArchive::field(std::string_view name, std::vector<bool>& values) {
  std::vector<double> numbers(values.begin(), values.end());
  field(name, numbers);
  values.clear();
  for (const double number : numbers) values.push_back(number != 0.0);
}

void StateArchive::field(std::string_view name, Eigen::VectorXd& values) {
  Eigen::VectorXd& stored = at(name);
  (restores_ ? values : stored) = restores_ ? stored : values;
}

void StateArchive::field(std::string_view name, Eigen::Vector3d& value) {
  Eigen::VectorXd values = value;
  fixedField(name, values);
  value = values;
}

}  // namespace burnish
