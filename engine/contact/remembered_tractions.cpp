#include "engine/contact/remembered_tractions.h"

namespace burnish::inline contact {

template <int Dim>
void RememberedTractions<Dim>::accept(const Components& tractions, const Components& along) {
  tractions_ = tractions;
  if constexpr (Dim == 3) {
    const auto turnOf = [](const Eigen::Vector2d& direction) {
      Eigen::Matrix2d turn;
      turn << direction(0), -direction(1), direction(1), direction(0);
      return turn;
    };
    for (Eigen::Index k = 0; k < tractions_.cols(); ++k) {
      const Eigen::Matrix2d before = turnOf(along_.col(k));
      const double length = along.col(k).norm();
      along_.col(k) = length > 0.0 ? Eigen::Vector2d(along.col(k) / length) : Eigen::Vector2d::UnitX();
      tractions_.col(k) = turnOf(along_.col(k)) * (before.transpose() * tractions.col(k));
    }
  }
}

template <int Dim>
void RememberedTractions<Dim>::archive(StateArchive& archive) {
  const auto exchange = [&](const char* name, Components& components) {
    Eigen::VectorXd values = components.reshaped();
    archive.fixedField(name, values);
    components = values.reshaped(Dim - 1, components.cols());
  };
  exchange("tractions", tractions_);
  if constexpr (Dim == 3) exchange("along", along_);
}

template class RememberedTractions<2>;
template class RememberedTractions<3>;

}  // namespace burnish::inline contact
