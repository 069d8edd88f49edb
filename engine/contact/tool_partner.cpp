#include "engine/contact/tool_partner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace burnish::inline contact {

template <int Dim>
ToolPartner<Dim>::ToolPartner(const Tool& tool) : tool_(tool), passage_(tool) {
  for (std::size_t dof = 0; dof < kToolDofs; ++dof)
    if (tool.isFree(dof)) dofs_.push_back(dof);
  for (std::size_t dof = kSpin; dof < kAllToolDofs; ++dof)
    if (tool.isFree(dof)) spins_.push_back(dof);
}

template <int Dim>
ToolGap ToolPartner<Dim>::query(const Eigen::Vector3d& x) const {
  if (!dofs_.empty()) return tool_.queryWithDofs(pose_, x);
  ToolGap answer;
  answer.point = tool_.query(pose_, x);
  return answer;
}

template <int Dim>
const ToolGap& ToolPartner<Dim>::queryAt(const SlavePoint<Dim>& point, ToolGap& storage) const {
  if (point.number >= 0) return queries_[static_cast<std::size_t>(point.number)];
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  x.head<Dim>() = point.x;
  return storage = query(x);
}

template <int Dim>
bool ToolPartner<Dim>::update(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) {
  pose_ = tool_.pose(t, x);
  queries_.resize(static_cast<std::size_t>(positions.cols()));
  for (Eigen::Index q = 0; q < positions.cols(); ++q) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    place.head<Dim>() = positions.col(q);
    queries_[static_cast<std::size_t>(q)] = query(place);
  }
  if (!hasAccepted_) chooseAccepted();
  return passage_.admits(pose_, positions,
                         [&](Eigen::Index q) { return queries_[static_cast<std::size_t>(q)].point.gap; });
}

template <int Dim>
std::optional<ContactPoint<Dim>> ToolPartner<Dim>::at(const SlavePoint<Dim>& point,
                                                      PointDetail detail) const {
  ToolGap storage;
  const ToolGap& found = queryAt(point, storage);
  ContactPoint<Dim> contact;
  contact.gap = found.point.gap;
  contact.normal = found.point.normal.template head<Dim>();
  contact.part = found.point.part;
  if (detail == PointDetail::Gap) return contact;

  const Eigen::Index n = point.R.size(), numDofs = std::ssize(dofs_), size = Dim * n + numDofs;
  contact.unknowns.assign(point.unknowns.begin(), point.unknowns.end());
  for (const std::size_t dof : dofs_) contact.unknowns.push_back(tool_.unknowns[dof]);
  contact.dGap.resize(size);
  for (Eigen::Index a = 0; a < n; ++a)
    contact.dGap.template segment<Dim>(Dim * a) = point.R(a) * contact.normal;
  if (numDofs > 0) contact.dGap.tail(numDofs) = found.dDofs(dofs_);
  if (detail == PointDetail::Derivatives) return contact;

  const Eigen::Matrix<double, Dim, Dim> dn = found.point.dNormal.template topLeftCorner<Dim, Dim>();
  contact.d2Gap.resize(size, size);
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = 0; a < n; ++a)
      contact.d2Gap.template block<Dim, Dim>(Dim * a, Dim * b) = point.R(a) * point.R(b) * dn;
  if (numDofs == 0) return contact;
  const Rows byDofs = found.dNormal.template topRows<Dim>()(Eigen::all, dofs_);
  for (Eigen::Index a = 0; a < n; ++a)
    contact.d2Gap.block(Dim * a, Dim * n, Dim, numDofs) = point.R(a) * byDofs;
  contact.d2Gap.bottomLeftCorner(numDofs, Dim * n) =
      contact.d2Gap.topRightCorner(Dim * n, numDofs).transpose();
  contact.d2Gap.bottomRightCorner(numDofs, numDofs) = found.d2(dofs_, dofs_);
  return contact;
}

template <int Dim>
Eigen::Vector3d ToolPartner<Dim>::movedFoot(const SlavePoint<Dim>& point) const {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  x.head<Dim>() = point.xAccepted;
  const GapQuery accepted = tool_.query(acceptedPose_, x);
  const Eigen::Vector3d inTool = tool_.toReference(acceptedPose_, x - accepted.gap * accepted.normal);
  const Eigen::Vector3d arm = inTool - tool_.pivot;
  if (tool_.spins()) return spun().rotation * arm + pivot();
  return Eigen::AngleAxisd(pose_.angle, tool_.axis) * arm + tool_.pivot + pose_.displacement;
}

template <int Dim>
typename ToolPartner<Dim>::Rows ToolPartner<Dim>::relativeMotion(const SlavePoint<Dim>& point,
                                                                 const Eigen::Vector3d& y,
                                                                 const Eigen::Matrix3d& spin) const {
  const Eigen::Index n = point.R.size();
  Rows motion(Dim, Dim * n + std::ssize(dofs_) + std::ssize(spins_));
  for (Eigen::Index a = 0; a < n; ++a)
    motion.template middleCols<Dim>(Dim * a) = point.R(a) * Eigen::Matrix<double, Dim, Dim>::Identity();
  for (std::size_t k = 0; k < dofs_.size(); ++k) {
    const Eigen::Vector3d velocity = dofs_[k] == kTurn
                                         ? Eigen::Vector3d((tool_.axis / tool_.turnLength).cross(y - pivot()))
                                         : tool_.direction(dofs_[k], pose_);
    motion.col(Dim * n + static_cast<Eigen::Index>(k)) = -velocity.head<Dim>();
  }
  for (std::size_t k = 0; k < spins_.size(); ++k) {
    const Eigen::Vector3d turn = spin.col(static_cast<Eigen::Index>(spins_[k] - kSpin)) / tool_.turnLength;
    motion.col(Dim * n + static_cast<Eigen::Index>(dofs_.size() + k)) =
        -turn.cross(y - pivot()).template head<Dim>();
  }
  return motion;
}

template <int Dim>
typename ToolPartner<Dim>::Rows ToolPartner<Dim>::normalMotion(const SlavePoint<Dim>& point) const {
  ToolGap storage;
  const ToolGap& found = queryAt(point, storage);
  const Eigen::Index n = point.R.size();
  Rows motion = Rows::Zero(Dim, Dim * n + std::ssize(dofs_) + std::ssize(spins_));
  for (Eigen::Index a = 0; a < n; ++a)
    motion.template middleCols<Dim>(Dim * a) =
        point.R(a) * found.point.dNormal.template topLeftCorner<Dim, Dim>();
  if (!dofs_.empty())
    motion.middleCols(Dim * n, std::ssize(dofs_)) = found.dNormal.template topRows<Dim>()(Eigen::all, dofs_);
  return motion;
}

template <int Dim>
void ToolPartner<Dim>::addSpins(ContactPoint<Dim>& contact) const {
  for (const std::size_t dof : spins_) contact.unknowns.push_back(tool_.unknowns[dof]);
  const auto size = std::ssize(contact.unknowns);
  contact.dGap.conservativeResizeLike(Eigen::VectorXd::Zero(size));
  if (contact.d2Gap.size() > 0) contact.d2Gap.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
}

template <int Dim>
void ToolPartner<Dim>::addSlip(const SlavePoint<Dim>& point, ContactPoint<Dim>& contact) const {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  x.head<Dim>() = point.x;
  const Eigen::Vector3d y = movedFoot(point);
  const Vector v = (x - y).template head<Dim>();
  const auto frame = carriedFrame<Dim>(E_, n0_, contact.normal);
  const Rows turn = normalMotion(point);
  contact.frame = frame.vectors;
  contact.slip = contact.frame.transpose() * v;
  contact.virtualSlip = relativeMotion(point, x, Eigen::Matrix3d::Identity()).transpose() * contact.frame;
  contact.dSlip = relativeMotion(point, y, spun().byVector).transpose() * contact.frame;
  addSpins(contact);
  for (std::size_t alpha = 0; alpha < frame.byNormal.size(); ++alpha)
    contact.dSlip.col(static_cast<Eigen::Index>(alpha)) +=
        turn.transpose() * (frame.byNormal[alpha].transpose() * v);
}

/// The variation δx - w(x) meets the turning frame; under a turn of the tool, w = δθ × (x - c), also x and c
/// move.
template <int Dim>
Eigen::MatrixXd ToolPartner<Dim>::frictionTangent(const SlavePoint<Dim>& point,
                                                  const ContactPoint<Dim>& contact,
                                                  const Eigen::Vector<double, Dim - 1>& traction) const {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), t = x;
  x.head<Dim>() = point.x;
  t.head<Dim>() = contact.frame * traction;
  const auto frame = carriedFrame<Dim>(E_, n0_, contact.normal);
  Eigen::Matrix<double, Dim, Dim> byNormal = traction(0) * frame.byNormal[0];
  for (std::size_t alpha = 1; alpha < frame.byNormal.size(); ++alpha)
    byNormal += traction(static_cast<Eigen::Index>(alpha)) * frame.byNormal[alpha];
  Eigen::MatrixXd K =
      relativeMotion(point, x, Eigen::Matrix3d::Identity()).transpose() * (byNormal * normalMotion(point));
  const Eigen::Index n = point.R.size();
  const auto addTurn = [&](Eigen::Index row, const Eigen::Vector3d& axis) {
    const Eigen::Vector3d moment = t.cross(axis / tool_.turnLength);  // t · (a × Δ) = (t × a) · Δ
    for (Eigen::Index a = 0; a < n; ++a)
      K.row(row).template segment<Dim>(Dim * a) -= point.R(a) * moment.head<Dim>().transpose();
    for (std::size_t k = 0; k < dofs_.size(); ++k)
      if (dofs_[k] != kTurn)
        K(row, Dim * n + static_cast<Eigen::Index>(k)) += moment.dot(tool_.direction(dofs_[k], pose_));
  };
  const Eigen::Index behindDofs = Dim * n + std::ssize(dofs_);
  if (tool_.isFree(kTurn)) addTurn(behindDofs - 1, tool_.axis);  // the turn comes last among these
  for (std::size_t k = 0; k < spins_.size(); ++k)
    addTurn(behindDofs + static_cast<Eigen::Index>(k),
            Eigen::Vector3d::Unit(static_cast<Eigen::Index>(spins_[k] - kSpin)));
  return K;
}

template <int Dim>
typename ToolPartner<Dim>::Vector ToolPartner<Dim>::meanNormal() const {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const ToolGap& found : queries_) {
    nearest = std::min(nearest, std::abs(found.point.gap));
    farthest = std::max(farthest, std::abs(found.point.gap));
  }
  constexpr double kNear = 0.01;  // of the span of gaps: how far points count in full
  const double scale = nearest + kNear * farthest + std::numeric_limits<double>::min();
  Vector sum = Vector::Zero();
  for (const ToolGap& found : queries_) {
    const double far = found.point.gap / scale;
    sum += found.point.normal.template head<Dim>() / (1.0 + far * far);
  }
  return sum.norm() > 0.0 ? Vector(sum.normalized()) : Vector(Vector::Unit(Dim - 1));
}

template <int Dim>
void ToolPartner<Dim>::chooseAccepted() {
  hasAccepted_ = true;
  acceptedPose_ = pose_;
  if constexpr (Dim == 3) {
    n0_ = meanNormal();
    E_ = anyFrame<Dim>(n0_);
  }
}

template <int Dim>
double ToolPartner<Dim>::prescribedWork(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const {
  Eigen::Vector3d way = pose_.displacement - acceptedPose_.displacement;
  double work = 0.0;
  if (tool_.followsSurface()) {
    way -= 0.5 * (pose_.alongNormal - acceptedPose_.alongNormal) * (pose_.normal + acceptedPose_.normal);
    work = force.dot(way);
  } else {
    for (std::size_t dof = 0; dof < kTurn; ++dof)
      if (const auto d = static_cast<Eigen::Index>(dof); !tool_.isFree(dof)) work += force(d) * way(d);
  }
  if (!tool_.isFree(kTurn)) work += tool_.axis.dot(moment) * (pose_.angle - acceptedPose_.angle);
  return work;
}

template <int Dim>
std::vector<int> ToolPartner<Dim>::freeTurns() const {
  std::vector<int> unknowns;
  for (std::size_t dof = kTurn; dof < kAllToolDofs; ++dof)
    if (tool_.isFree(dof)) unknowns.push_back(tool_.unknowns[dof]);
  return unknowns;
}

template <int Dim>
void ToolPartner<Dim>::accept() {
  passage_.accept();
  chooseAccepted();
}

template <int Dim>
void ToolPartner<Dim>::archive(StateArchive& archive) {
  passage_.archive(archive);
  archive.field("has_accepted", hasAccepted_);
  archive.field("accepted_displacement", acceptedPose_.displacement);
  archive.field("accepted_angle", acceptedPose_.angle);
  if (tool_.spins()) archive.field("accepted_spin", acceptedPose_.spin);
  if (tool_.followsSurface()) {
    archive.field("accepted_normal", acceptedPose_.normal);
    archive.field("accepted_along_normal", acceptedPose_.alongNormal);
  }
  Eigen::VectorXd frame(Dim * Dim);
  frame << n0_, E_.reshaped();
  archive.fixedField("frame", frame);
  n0_ = frame.head<Dim>();
  E_ = frame.tail(Dim * (Dim - 1)).reshaped(Dim, Dim - 1);
}

template class ToolPartner<2>;
template class ToolPartner<3>;

}  // namespace burnish::inline contact
