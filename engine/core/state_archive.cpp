#include "engine/core/state_archive.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish::inline core {
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

void StateArchive::exchange(std::string_view name, std::span<double> numbers) {
  Eigen::Map<Eigen::VectorXd> here(numbers.data(), std::ssize(numbers));
  Eigen::VectorXd values = here;
  fixedField(name, values);
  here = values;
}

void StateArchive::field(std::string_view name, double& value) {
  double& stored = single(name);
  (restores_ ? value : stored) = restores_ ? stored : value;
}

void StateArchive::field(std::string_view name, bool& value) {
  int number = value ? 1 : 0;
  field(name, number);
  value = number != 0;
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

/// The number of rows stands before the entries.
void StateArchive::field(std::string_view name, Eigen::MatrixXd& values) {
  Eigen::VectorXd stored(1 + values.size());
  stored << static_cast<double>(values.rows()), values.reshaped();
  field(name, stored);
  if (!restores_) return;
  const auto entries = stored.size() - 1;
  const auto rows = entries < 0 ? -1 : static_cast<Eigen::Index>(stored(0));
  if (rows < 0 || (rows == 0 ? entries != 0 : entries % rows != 0)) failAt(name);
  values = stored.tail(entries).reshaped(rows, rows == 0 ? 0 : entries / rows);
}

void StateArchive::field(std::string_view name, Eigen::Vector3d& value) {
  Eigen::VectorXd values = value;
  fixedField(name, values);
  value = values;
}

}  // namespace burnish::inline core
