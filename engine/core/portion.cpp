#include "engine/core/portion.h"

namespace burnish::inline core {

Portion::Portion(const Team& team, Eigen::Index count, std::vector<int> kept, std::vector<int> own)
    : team_(&team), count_(count), kept_(std::move(kept)), own_(std::move(own)) {}

// Rank by rank, so that no other one needs to have all of them for a while.
Eigen::MatrixXd Portion::whole(Eigen::MatrixXd here, Receivers receivers) const {
  if (team_->isAlone()) return here;
  const bool receives = receivers == Receivers::All || team_->isFirst();
  const Eigen::Index rows = here.rows();
  Eigen::MatrixXd all(rows, receives ? count_ : 0), sent;  // sent: the thing's number before its column
  for (int rank = 0; rank < team_->size(); ++rank) {
    const bool isMine = rank == team_->rank();
    auto columns = isMine ? static_cast<double>(own_.size()) : 0.0;
    team_->share({&columns, 1}, rank);
    sent.resize(rows + 1, static_cast<Eigen::Index>(columns));
    if (isMine)
      for (Eigen::Index k = 0; k < sent.cols(); ++k) {
        const int place = own_[static_cast<std::size_t>(k)];
        sent.col(k) << kept_[static_cast<std::size_t>(place)], here.col(place);
      }
    team_->share(asSpan(sent), rank);
    if (!receives) continue;
    for (const auto& column : sent.colwise())
      all.col(static_cast<Eigen::Index>(column(0))) = column.tail(rows);
  }
  return all;
}

Eigen::MatrixXd Portion::part(Eigen::MatrixXd all) const {
  if (team_->isAlone()) return all;
  return all(Eigen::all, kept_);
}

}  // namespace burnish::inline core
