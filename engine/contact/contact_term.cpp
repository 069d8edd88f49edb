#include "engine/contact/contact_term.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

namespace burnish::inline contact {

/// Integrals over the reference face at one state.
template <int Dim>
struct ContactTerm<Dim>::Mortar {
  Eigen::MatrixXd positions;        ///< current, Dim x quadrature points
  std::vector<ToolGap> points;      ///< quadrature points
  std::vector<LimitedGap> limited;  ///< their gaps as averages take them
  Eigen::VectorXd G;                ///< ∫ R_A g dΓ of limited gaps
  Eigen::VectorXd S;                ///< ∫ R_A φ' dΓ of their slopes
  std::vector<Eigen::VectorXd>
      D;  ///< ∂G: (29), over the unknowns of A's support and the free degrees of freedom
};

template <int Dim>
ContactTerm<Dim>::ContactTerm(const Body<Dim>& body, int patch, FaceId face, const Tool& tool,
                              const Options& options, int firstMultiplier)
    : FaceContact<Dim>(body, patch, face, options, firstMultiplier), tool_(tool), passage_(tool) {
  A_ = Eigen::VectorXd::Zero(face_.numFunctions());
  for (std::size_t dof = 0; dof < kToolDofs; ++dof)
    if (tool.isFree(dof)) dofs_.push_back(dof);
  std::vector<std::set<int>> supports(static_cast<std::size_t>(face_.numFunctions()));
  for (const auto& span : face_.spans()) {
    A_(span.functions) += span.R * span.weights;
    for (const int a : span.functions)
      supports[static_cast<std::size_t>(a)].insert(span.functions.begin(), span.functions.end());
  }
  for (const auto& support : supports) supports_.emplace_back(support.begin(), support.end());
  if (options_.method != Enforcement::PointwisePenalty) requireAveragedGaps(A_, axisymmetric_);
  for (const auto& span : face_.spans()) {
    std::vector<std::vector<int>> table;
    for (const int a : span.functions) {
      const auto& support = supports_[static_cast<std::size_t>(a)];
      std::vector<int> row;
      for (const int b : span.functions)
        row.push_back(
            static_cast<int>(std::lower_bound(support.begin(), support.end(), b) - support.begin()));
      table.push_back(std::move(row));
    }
    slots_.push_back(std::move(table));
  }
}

template <int Dim>
int ContactTerm<Dim>::numMultipliers() const {
  return options_.method == Enforcement::AugmentedLagrangian ? face_.numFunctions() : 0;
}

template <int Dim>
std::vector<int> ContactTerm<Dim>::unknownsOf(const std::vector<int>& functions) const {
  std::vector<int> unknowns;
  for (const int a : functions)
    for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
  for (const std::size_t dof : dofs_) unknowns.push_back(tool_.unknowns[dof]);
  return unknowns;
}

template <int Dim>
Eigen::VectorXd ContactTerm<Dim>::gapDerivative(const typename FaceQuadrature<Dim>::Span& span,
                                                Eigen::Index q, const ToolGap& query) const {
  const auto n = span.R.rows(), numDofs = static_cast<Eigen::Index>(dofs_.size());
  Eigen::VectorXd N(Dim * n + numDofs);
  for (Eigen::Index a = 0; a < n; ++a)
    N.segment<Dim>(Dim * a) = span.R(a, q) * query.point.normal.template head<Dim>();
  N.tail(numDofs) = query.dDofs(dofs_);
  return N;
}

template <int Dim>
CouplingGroups ContactTerm<Dim>::couplings() const {
  // Spans first, then (mortar only) one group per function: its support and, with multipliers, its own.
  CouplingGroups groups;
  for (const auto& span : face_.spans()) groups.push_back(unknownsOf(span.functions));
  if (options_.method == Enforcement::PointwisePenalty) return groups;
  for (std::size_t a = 0; a < supports_.size(); ++a) {
    auto group = unknownsOf(supports_[a]);
    if (numMultipliers() > 0) group.push_back(firstMultiplier_ + static_cast<int>(a));
    groups.push_back(std::move(group));
  }
  return groups;
}

template <int Dim>
typename ContactTerm<Dim>::Mortar ContactTerm<Dim>::integrate(const ToolPose& pose,
                                                              const Eigen::VectorXd& x) const {
  const auto numDofs = static_cast<Eigen::Index>(dofs_.size());
  Mortar mortar;
  mortar.G = Eigen::VectorXd::Zero(face_.numFunctions());
  mortar.S = Eigen::VectorXd::Zero(face_.numFunctions());
  for (const auto& support : supports_)
    mortar.D.push_back(Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(support.size()) + numDofs));
  mortar.positions = face_.positions(x);
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      point.head<Dim>() = mortar.positions.col(span.firstPoint + q);
      auto& query = mortar.points.emplace_back();
      if (dofs_.empty())
        query.point = tool_.query(pose, point);
      else
        query = tool_.queryWithDofs(pose, point);
      const auto& limited = mortar.limited.emplace_back(
          limitedGap(query.point.gap, options_.gapLimit.value_or(kAnyGap) * span.size));
      const Eigen::Vector<double, Dim> n = limited.slope * query.point.normal.template head<Dim>();
      for (std::size_t a = 0; a < span.functions.size(); ++a) {
        const int A = span.functions[a];
        const double wR = span.weights(q) * span.R(static_cast<Eigen::Index>(a), q);
        mortar.G(A) += wR * limited.value;
        mortar.S(A) += wR * limited.slope;
        auto& D = mortar.D[static_cast<std::size_t>(A)];
        for (std::size_t b = 0; b < span.functions.size(); ++b)
          D.template segment<Dim>(Dim * slots_[e][a][b]) += wR * span.R(static_cast<Eigen::Index>(b), q) * n;
        D.tail(numDofs) += wR * limited.slope * query.dDofs(dofs_);
      }
    }
  }
  return mortar;
}

template <int Dim>
typename ContactTerm<Dim>::LinearGaps ContactTerm<Dim>::linearReferenceGaps(const ToolPose& pose) const {
  const int lastNode = *std::max_element(face_.nodes().begin(), face_.nodes().end());
  const Mortar mortar = integrate(pose, Eigen::VectorXd::Zero(Dim * (lastNode + 1)));
  LinearGaps gaps{mortar.G.cwiseQuotient(A_),
                  Eigen::MatrixXd::Zero(face_.numFunctions(), Dim * face_.numFunctions()),
                  mortar.S.cwiseQuotient(A_)};
  for (std::size_t a = 0; a < supports_.size(); ++a) {
    const auto A = static_cast<Eigen::Index>(a);
    for (std::size_t b = 0; b < supports_[a].size(); ++b)
      gaps.gradient.row(A).template segment<Dim>(Dim * supports_[a][b]) =
          mortar.D[a].template segment<Dim>(Dim * static_cast<Eigen::Index>(b)) / A_(A);
  }
  return gaps;
}

template <int Dim>
double ContactTerm<Dim>::smallestReferenceGap(const GapAt& gapAt) const {
  return options_.method == Enforcement::PointwisePenalty ? this->smallestGapOfPoints(gapAt)
                                                          : FaceContact<Dim>::smallestReferenceGap(gapAt);
}

template <int Dim>
bool ContactTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  if (this->hasLostTouch()) return this->reportUntouched();
  const ToolPose pose = tool_.pose(t, x);
  Mortar mortar = integrate(pose, x);
  if (gapOrigin_.size() > 0) mortar.G -= A_.cwiseProduct(gapOrigin_);
  const auto gapAt = [&](Eigen::Index q) { return mortar.points[static_cast<std::size_t>(q)].point.gap; };
  if (!passage_.admits(pose, mortar.positions, gapAt)) return false;
  const std::vector<bool> before = std::move(state_.active);
  state_ = {};
  state_.averageGap = mortar.G.cwiseQuotient(A_);
  state_.gap.resize(face_.numPoints());
  state_.normal.resize(3, face_.numPoints());
  for (Eigen::Index q = 0; q < state_.gap.size(); ++q) {
    const GapQuery& point = mortar.points[static_cast<std::size_t>(q)].point;
    state_.gap(q) = point.gap;
    state_.normal.col(q) = point.normal;
  }
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  state_.lambdaHat = Eigen::VectorXd::Zero(face_.numFunctions());
  if (options_.method == Enforcement::PointwisePenalty)
    evaluatePointwise(out, mortar);
  else
    evaluateMortar(x, out, mortar);
  state_.countChanges(before);
  measureReaction(pose, mortar);
  if (out.system != nullptr) addGeometricTangent(out, mortar);
  return true;
}

template <int Dim>
void ContactTerm<Dim>::accept() {
  if (this->hasLostTouch()) return;
  passage_.accept();
}

template <int Dim>
void ContactTerm<Dim>::chooseActive(const Eigen::VectorXd& x, const Mortar& mortar) {
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const double lambda = numMultipliers() > 0 ? x(firstMultiplier_ + A) : 0.0;
    state_.lambdaHat(A) = lambda + parameter() * state_.averageGap(A);
  }
  Eigen::Index nearest = 0;
  const double lowest = state_.lambdaHat.minCoeff(&nearest);
  state_.active.assign(supports_.size(), false);
  for (std::size_t a = 0; a < supports_.size(); ++a) {
    const auto A = static_cast<Eigen::Index>(a);
    state_.active[a] = state_.lambdaHat(A) <= 0.0 && mortar.S(A) > kOpenSlope * A_(A);
  }
  if (keepsInTouch_ && lowest > 0.0 && isAlone()) {
    state_.active[static_cast<std::size_t>(nearest)] = true;
    state_.pull = lowest * A_(nearest);
  }
}

template <int Dim>
void ContactTerm<Dim>::evaluateMortar(const Eigen::VectorXd& x, Assembly& out, const Mortar& mortar) {
  const double eps = parameter();
  const bool hasMultipliers = numMultipliers() > 0;
  chooseActive(x, mortar);
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const auto a = static_cast<std::size_t>(A);
    const double lambda = hasMultipliers ? x(firstMultiplier_ + A) : 0.0;
    const bool active = state_.active[a];
    const std::size_t group = face_.spans().size() + a;
    const auto& D = mortar.D[a];
    const Eigen::Index n = D.size();
    if (active) {
      if (!hasMultipliers) state_.energy += 0.5 * eps * state_.averageGap(A) * mortar.G(A);
      out.force(unknownsOf(supports_[a])) += state_.lambdaHat(A) * D;
      if (hasMultipliers) out.force(firstMultiplier_ + A) += mortar.G(A);
    } else {
      state_.lambdaHat(A) = 0.0;
      if (hasMultipliers) out.force(firstMultiplier_ + A) -= lambda * A_(A) / eps;
    }
    if (out.system == nullptr) continue;
    Eigen::MatrixXd K;
    if (active) {
      K = averagedGapTangent(D, eps / A_(A), hasMultipliers);
    } else {
      K = Eigen::MatrixXd::Zero(n + (hasMultipliers ? 1 : 0), n + (hasMultipliers ? 1 : 0));
      if (hasMultipliers) K(n, n) = -A_(A) / eps;
    }
    out.system->add(out.term, group, K);
  }
  for (const auto& span : face_.spans())
    state_.pressure.segment(span.firstPoint, span.R.cols()) =
        -span.R.transpose() * state_.lambdaHat(span.functions);
  for (Eigen::Index q = 0; q < state_.pressure.size(); ++q)
    state_.pressure(q) *= mortar.limited[static_cast<std::size_t>(q)].slope;
}

template <int Dim>
void ContactTerm<Dim>::evaluatePointwise(Assembly& out, const Mortar& mortar) {
  const double eps = parameter();
  Eigen::Index nearest = -1;
  if (keepsInTouch_ && state_.gap.minCoeff(&nearest) < 0.0) nearest = -1;
  if (nearest >= 0 && !isAlone()) nearest = -1;
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const auto unknowns = unknownsOf(span.functions);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns.size()),
                                              static_cast<Eigen::Index>(unknowns.size()));
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const ToolGap& query = mortar.points[static_cast<std::size_t>(span.firstPoint + q)];
      const double gap = query.point.gap;
      if (!(gap < 0.0) && span.firstPoint + q != nearest) continue;
      const double w = span.weights(q);
      const Eigen::VectorXd N = gapDerivative(span, q, query);
      out.force(unknowns) += w * eps * gap * N;
      K += w * eps * N * N.transpose();
      state_.pressure(span.firstPoint + q) = -eps * gap;
      state_.energy += 0.5 * w * eps * gap * gap;
      if (span.firstPoint + q == nearest) state_.pull = w * eps * gap;
    }
    if (out.system != nullptr) out.system->add(out.term, e, K);
  }
}

/// ∫ λ̂_I (φ' ∂N + φ'' N Nᵀ) dΓ with the pressure field λ̂_I of (37) and gaps that count as φ(g), N the gap's
/// derivative; of ∂N the part R_a R_b ∂n/∂x, and the same by the tool's degrees of freedom.
template <int Dim>
void ContactTerm<Dim>::addGeometricTangent(Assembly& out, const Mortar& mortar) {
  const auto numDofs = static_cast<Eigen::Index>(dofs_.size());
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const Eigen::Index n = span.R.rows();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Dim * n + numDofs, Dim * n + numDofs);
    bool any = false;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const double pressure = state_.pressure(span.firstPoint + q);
      if (pressure == 0.0) continue;
      any = true;
      const auto point = static_cast<std::size_t>(span.firstPoint + q);
      const ToolGap& query = mortar.points[point];
      const double weighted = -span.weights(q) * pressure;
      if (const LimitedGap& limited = mortar.limited[point]; limited.curvature != 0.0) {
        const Eigen::VectorXd N = gapDerivative(span, q, query);
        K += weighted * limited.curvature / limited.slope * N * N.transpose();
      }
      const Eigen::Matrix<double, Dim, Dim> dn = query.point.dNormal.template topLeftCorner<Dim, Dim>();
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a)
          K.block<Dim, Dim>(Dim * a, Dim * b) += weighted * span.R(a, q) * span.R(b, q) * dn;
      if (numDofs == 0) continue;
      const Eigen::MatrixXd byDofs = query.dNormal.template topRows<Dim>()(Eigen::all, dofs_);
      for (Eigen::Index a = 0; a < n; ++a)
        K.block(Dim * a, Dim * n, Dim, numDofs) += weighted * span.R(a, q) * byDofs;
      K.bottomRightCorner(numDofs, numDofs) += weighted * query.d2(dofs_, dofs_);
    }
    if (!any) continue;
    K.bottomLeftCorner(numDofs, Dim * n) = K.topRightCorner(Dim * n, numDofs).transpose();
    out.system->add(out.term, e, K);
  }
}

template <int Dim>
void ContactTerm<Dim>::measureReaction(const ToolPose& pose, const Mortar& mortar) {
  const Eigen::Vector3d pivot = tool_.pivot + pose.displacement;
  for (const auto& span : face_.spans())
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Eigen::Index point = span.firstPoint + q;
      if (state_.pressure(point) == 0.0) continue;
      Eigen::Vector3d arm = -pivot;
      arm.head<Dim>() += mortar.positions.col(point);
      const Eigen::Vector3d force = -span.weights(q) * state_.pressure(point) *
                                    mortar.points[static_cast<std::size_t>(point)].point.normal;
      state_.reaction += force;
      state_.moment += arm.cross(force);
    }
  if (axisymmetric_) state_.keepAxialReaction();
}

template class ContactTerm<2>;
template class ContactTerm<3>;

}  // namespace burnish::inline contact
