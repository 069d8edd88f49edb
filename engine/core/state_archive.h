#pragma once
#include <Eigen/Dense>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace burnish::inline core {

/// Values under names: what the rest of a run depends on.
using SavedState = std::map<std::string, Eigen::VectorXd>;

/// Saves or restores the state of objects, bit by bit. An object names its values once, in a member function
///
///     void archive(StateArchive& a) { a.field("time", time_); a.part("history", history_); … }
///
/// that serves both directions.
class StateArchive {
 public:
  /// An archive that saves.
  StateArchive() = default;

  /// An archive that restores.
  explicit StateArchive(SavedState saved) : values_(std::move(saved)), restores_(true) {}

  bool restores() const { return restores_; }
  const SavedState& values() const { return values_; }

  /// Restoring throws `Error` if there is no such value or it is of another kind.
  void field(std::string_view name, double& value);
  void field(std::string_view name, bool& value);
  void field(std::string_view name, int& value);
  void field(std::string_view name, long& value);
  void field(std::string_view name, std::vector<double>& values);
  void field(std::string_view name, std::vector<bool>& values);
  void field(std::string_view name, Eigen::VectorXd& values);
  void field(std::string_view name, Eigen::MatrixXd& values);
  void field(std::string_view name, Eigen::Vector3d& value);

  /// An enumeration, by its number.
  template <class E>
  requires std::is_enum_v<E>
  void field(std::string_view name, E& value) {
    int number = static_cast<int>(value);
    field(name, number);
    value = static_cast<E>(number);
  }

  /// A matrix of fixed size, column by column.
  template <int Rows, int Columns>
  requires(Rows > 0 && Columns > 1) void field(std::string_view name,
                                               Eigen::Matrix<double, Rows, Columns>& value) {
    Eigen::VectorXd values = value.reshaped();
    fixedField(name, values);
    value = values.reshaped(Rows, Columns);
  }

  /// Several numbers and truth values under one name: a field of its own costs a file more than its value.
  template <class... Values>
  void together(std::string_view name, Values&... values) {
    std::array<double, sizeof...(Values)> numbers{static_cast<double>(values)...};
    exchange(name, numbers);
    const double* next = numbers.data();
    ((values = static_cast<Values>(*next++)), ...);
  }

  /// As `field`; restoring also throws if the number of values is not the one that the object has now.
  template <class Vector>
  void fixedField(std::string_view name, Vector& values) {
    const auto size = values.size();
    field(name, values);
    if (values.size() != size) failAt(name);
  }

  /// Values of a part of the object: their names begin with that of the part.
  template <class Part>
  void part(std::string_view name, Part& part) {
    const std::size_t length = prefix_.size();
    prefix_.append(name).append(".");
    part.archive(*this);
    prefix_.resize(length);
  }

 private:
  /// The saved values of this name; empty on saving.
  Eigen::VectorXd& at(std::string_view name);
  double& single(std::string_view name);

  /// Saves or restores so many numbers.
  void exchange(std::string_view name, std::span<double> numbers);

  [[noreturn]] void failAt(std::string_view name) const;

  SavedState values_;
  bool restores_ = false;
  std::string prefix_;
};

}  // namespace burnish::inline core
