#include "engine/material/material_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>

#include "engine/core/error.h"

namespace burnish::inline material {
namespace {

/// Appends the numbers of a state.
template <class State>
void addNumbers(State& state, std::vector<double>& numbers) {
  state.forEachMember([&](auto& member) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(member)>>)
      numbers.push_back(member);
    else
      numbers.insert(numbers.end(), member.data(), member.data() + member.size());
  });
}

/// Takes the numbers of a state; returns where those of the next one begin.
template <class State>
const double* setNumbers(State& state, const double* numbers) {
  state.forEachMember([&](auto& member) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(member)>>) {
      member = *numbers++;
    } else {
      std::copy_n(numbers, member.size(), member.data());
      numbers += member.size();
    }
  });
  return numbers;
}

/// The states of all points under one name, point by point.
template <class State>
void archiveStates(StateArchive& archive, const Portion& portion, std::vector<State>& states) {
  std::vector<double> list;
  State any;
  addNumbers(any, list);
  const Eigen::Index width = std::ssize(list);  // numbers of a state
  list.clear();
  for (auto& state : states) addNumbers(state, list);
  Eigen::MatrixXd numbers = Eigen::Map<Eigen::MatrixXd>(list.data(), width, std::ssize(states));
  if (archive.restores())
    numbers.resize(width, portion.count());
  else
    numbers = portion.whole(std::move(numbers), Receivers::First);
  Eigen::VectorXd all = numbers.reshaped();
  archive.fixedField("history", all);
  if (!archive.restores()) return;
  numbers = portion.part(all.reshaped(width, portion.count()));
  const double* next = numbers.data();
  for (auto& state : states) next = setNumbers(state, next);
}

}  // namespace

MaterialPoints::MaterialPoints(Material material, std::size_t count)
    : points_(std::visit(
          [count]<class Law>(Law& law) {
            const std::vector<typename Law::State> states(count);
            return MaterialLaws::Each<PointsOf>(PointsOf<Law>{std::move(law), states, states});
          },
          material)),
      portion_(static_cast<Eigen::Index>(count)) {}

Material MaterialPoints::material() const {
  return visit([](const auto& points) { return Material(points.law); });
}

void MaterialPoints::startEvaluation(double t) {
  if (std::isnan(time_)) time_ = t;
  trialTime_ = t;
  visit([&](auto& points) { points.timeStep = t > time_ ? t - time_ : lastStep_; });
}

bool MaterialPoints::hasSymmetricTangent() const {
  return visit([]<class Law>(const PointsOf<Law>& points) {
    if constexpr (MayBeUnsymmetric<Law>)
      return points.law.hasSymmetricTangent();
    else
      return true;
  });
}

void MaterialPoints::accept() {
  if (trialTime_ > time_) lastStep_ = trialTime_ - time_;
  time_ = trialTime_;
  visit([](auto& points) { points.accepted = points.trial; });
}

void MaterialPoints::divide(Portion portion) {
  portion_ = std::move(portion);
  visit([&](auto& points) {
    portion_.reduce(points.accepted);
    portion_.reduce(points.trial);
  });
}

void MaterialPoints::archive(StateArchive& archive) {
  visit([&]<class Law>(PointsOf<Law>& points) {
    if constexpr (!std::is_empty_v<typename Law::State>) archiveStates(archive, portion_, points.accepted);
    if constexpr (RateDependent<Law>) {
      archive.field("time", time_);
      archive.field("last_step", lastStep_);
    }
  });
}

std::vector<FieldKind> MaterialPoints::fields() const {
  return visit([]<class Law>(const PointsOf<Law>&) { return fieldKindsOf<Law>(); });
}

bool MaterialPoints::hasField(const std::string& name) const {
  const auto kinds = fields();
  return std::any_of(kinds.begin(), kinds.end(), [&](const FieldKind& kind) { return kind.name == name; });
}

Eigen::MatrixXd MaterialPoints::field(const std::string& name) const {
  return visit([&]<class Law>(const PointsOf<Law>& points) -> Eigen::MatrixXd {
    for (const auto& field : fieldsOf<Law>()) {
      if (field.name != name) continue;
      Eigen::MatrixXd values(std::max<Eigen::Index>(1, std::ssize(field.components)),
                             std::ssize(points.accepted));
      for (Eigen::Index q = 0; q < values.cols(); ++q)
        field.write(points.accepted[static_cast<std::size_t>(q)],
                    std::span(values.col(q).data(), static_cast<std::size_t>(values.rows())));
      return values;
    }
    throw Error(fmt::format("the material has no field {}", name));
  });
}

PointStates MaterialPoints::carried(const std::vector<Eigen::Matrix3d>& F) const {
  return visit([&]<class Law>(const PointsOf<Law>& points) {
    const auto carried = carriedOf<Law>();
    PointStates states;
    states.kinds.assign(carried.begin(), carried.end());
    states.numbers.resize(std::ssize(carried), std::ssize(points.accepted));
    for (std::size_t q = 0; q < points.accepted.size(); ++q) {
      states.b_e.push_back(points.law.elasticDeformation(F[q], points.accepted[q]));
      typename Law::State state = points.accepted[q];
      if constexpr (requires { points.law.toSpace(F[q], state); }) state = points.law.toSpace(F[q], state);
      for (std::size_t k = 0; k < carried.size(); ++k)
        states.numbers(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q)) = carried[k].of(state);
    }
    return states;
  });
}

void MaterialPoints::begin(const std::vector<Eigen::Matrix3d>& stretch, const Eigen::MatrixXd& numbers) {
  visit([&]<class Law>(PointsOf<Law>& points) {
    const auto carried = carriedOf<Law>();
    for (std::size_t q = 0; q < points.accepted.size(); ++q) {
      auto& state = points.accepted[q];
      if constexpr (requires { Law::begin(stretch[q]); }) state = Law::begin(stretch[q]);
      for (std::size_t k = 0; k < carried.size(); ++k)
        carried[k].of(state) = numbers(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q));
      if constexpr (requires { points.law.fromSpace(state); }) state = points.law.fromSpace(state);
    }
  });
}

}  // namespace burnish::inline material
