#include "engine/contact/contact_term.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/error.h"

namespace burnish {

int ContactState::numActive() const {
  return static_cast<int>(std::count(active.begin(), active.end(), true));
}

double ContactState::largestPenetration() const {
  return gap.size() == 0 ? 0.0 : std::max(0.0, -gap.minCoeff());
}

/// Integrals over the reference face at one state.
template <int Dim>
struct ContactTerm<Dim>::Mortar {
  std::vector<GapQuery> points;    ///< quadrature points
  Eigen::VectorXd G;               ///< ∫ R_A g dΓ
  std::vector<Eigen::VectorXd> D;  ///< ∫ R_A N dΓ (29), over the displacement unknowns of A's support
  Eigen::MatrixXd d;               ///< ∫ R_A n dΓ, 3 x functions
};

namespace {

/// Smallest integral of a basis function over the contact face, as a share of the largest, that an averaged
/// gap is made with; what vanishes in exact arithmetic stays below it.
constexpr double kSmallestShare = 1e-12;

/// A point that is deeper inside a round tool than this share of its radius is about to leave it on the far
/// side, where the nearest surface would pull it on: such a state is not admissible.
constexpr double kDeepestShare = 0.5;

template <int Dim>
int contactPoints(const Body<Dim>& body, int patch, int wanted) {
  if (wanted > 0) return wanted;
  int degree = 1;
  for (int d = 0; d < Dim; ++d)
    degree = std::max(degree, body.patches[static_cast<std::size_t>(patch)].basis().direction(d).degree());
  return 2 * degree;
}

}  // namespace

template <int Dim>
ContactTerm<Dim>::ContactTerm(const Body<Dim>& body, int patch, FaceId face, const Tool& tool,
                              Options options, int firstMultiplier)
    : face_(body, patch, face, contactPoints(body, patch, options.pointsPerDirection)),
      tool_(tool),
      options_(options),
      firstMultiplier_(firstMultiplier),
      axisymmetric_(body.axisymmetric),
      A_(Eigen::VectorXd::Zero(face_.numFunctions())) {
  std::vector<std::set<int>> supports(static_cast<std::size_t>(face_.numFunctions()));
  for (const auto& span : face_.spans()) {
    A_(span.functions) += span.R * span.weights;
    for (const int a : span.functions)
      supports[static_cast<std::size_t>(a)].insert(span.functions.begin(), span.functions.end());
  }
  for (const auto& support : supports) supports_.emplace_back(support.begin(), support.end());
  if (options_.enforcement != Enforcement::PointwisePenalty &&
      !(A_.minCoeff() > kSmallestShare * A_.maxCoeff()))
    throw Error(fmt::format(
        "contact: a basis function has no positive integral over the contact face, so its averaged "
        "gap is not defined; use a NURBS basis{}",
        axisymmetric_ ? ", or Lagrange elements of degree 1 where the face meets the axis"
                      : " or Lagrange elements of degree 7 at most"));
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
  return options_.enforcement == Enforcement::AugmentedLagrangian ? face_.numFunctions() : 0;
}

template <int Dim>
std::vector<int> ContactTerm<Dim>::displacementUnknowns(const std::vector<int>& functions) const {
  std::vector<int> unknowns;
  for (const int a : functions)
    for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
  return unknowns;
}

template <int Dim>
CouplingGroups ContactTerm<Dim>::couplings() const {
  // Spans first, then (mortar only) one group per function: its support and, with multipliers, its own.
  CouplingGroups groups;
  for (const auto& span : face_.spans()) groups.push_back(displacementUnknowns(span.functions));
  if (options_.enforcement == Enforcement::PointwisePenalty) return groups;
  for (std::size_t a = 0; a < supports_.size(); ++a) {
    auto group = displacementUnknowns(supports_[a]);
    if (numMultipliers() > 0) group.push_back(firstMultiplier_ + static_cast<int>(a));
    groups.push_back(std::move(group));
  }
  return groups;
}

template <int Dim>
Eigen::MatrixXd ContactTerm<Dim>::positions(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd result(Dim, face_.numPoints());
  for (const auto& span : face_.spans()) {
    Eigen::MatrixXd current = face_.points()(Eigen::all, span.functions);
    for (std::size_t a = 0; a < span.functions.size(); ++a)
      current.col(static_cast<Eigen::Index>(a)) +=
          x.template segment<Dim>(Dim * face_.nodes()[static_cast<std::size_t>(span.functions[a])]);
    result.middleCols(span.firstPoint, span.R.cols()) = current * span.R;
  }
  return result;
}

template <int Dim>
typename ContactTerm<Dim>::Mortar ContactTerm<Dim>::integrate(const Tool& tool, double t,
                                                              const Eigen::VectorXd& x) const {
  Mortar mortar;
  mortar.G = Eigen::VectorXd::Zero(face_.numFunctions());
  mortar.d = Eigen::MatrixXd::Zero(3, face_.numFunctions());
  for (const auto& support : supports_)
    mortar.D.push_back(Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(support.size())));
  const Eigen::MatrixXd current = positions(x);
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      point.head<Dim>() = current.col(span.firstPoint + q);
      const GapQuery query = tool.query(t, point);
      mortar.points.push_back(query);
      const Eigen::Vector<double, Dim> n = query.normal.head<Dim>();
      for (std::size_t a = 0; a < span.functions.size(); ++a) {
        const int A = span.functions[a];
        const double wR = span.weights(q) * span.R(static_cast<Eigen::Index>(a), q);
        mortar.G(A) += wR * query.gap;
        mortar.d.col(A) += wR * query.normal;
        auto& D = mortar.D[static_cast<std::size_t>(A)];
        for (std::size_t b = 0; b < span.functions.size(); ++b)
          D.template segment<Dim>(Dim * slots_[e][a][b]) += wR * span.R(static_cast<Eigen::Index>(b), q) * n;
      }
    }
  }
  return mortar;
}

template <int Dim>
Eigen::VectorXd ContactTerm<Dim>::referenceGaps(const Tool& tool, double t) const {
  const int lastNode = *std::max_element(face_.nodes().begin(), face_.nodes().end());
  return integrate(tool, t, Eigen::VectorXd::Zero(Dim * (lastNode + 1))).G.cwiseQuotient(A_);
}

template <int Dim>
bool ContactTerm<Dim>::passesThrough(const Mortar& mortar) const {
  const double deepest = -kDeepestShare * curvatureRadius(tool_.shape);
  return std::any_of(mortar.points.begin(), mortar.points.end(),
                     [&](const GapQuery& query) { return query.gap < deepest; });
}

template <int Dim>
bool ContactTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  const Mortar mortar = integrate(tool_, t, x);
  if (passesThrough(mortar)) return false;
  state_ = {};
  state_.averageGap = mortar.G.cwiseQuotient(A_);
  state_.gap.resize(face_.numPoints());
  for (Eigen::Index q = 0; q < state_.gap.size(); ++q)
    state_.gap(q) = mortar.points[static_cast<std::size_t>(q)].gap;
  state_.pressure = Eigen::VectorXd::Zero(face_.numPoints());
  state_.lambdaHat = Eigen::VectorXd::Zero(face_.numFunctions());
  if (options_.enforcement == Enforcement::PointwisePenalty)
    evaluatePointwise(out, mortar);
  else
    evaluateMortar(x, out, mortar);
  if (axisymmetric_) state_.reaction(0) = 0.0;  // radial forces around the ring balance one another
  if (out.system != nullptr) addGeometricTangent(out, mortar);
  return true;
}

template <int Dim>
void ContactTerm<Dim>::evaluateMortar(const Eigen::VectorXd& x, Assembly& out, const Mortar& mortar) {
  const double eps = options_.parameter;
  const bool hasMultipliers = numMultipliers() > 0;
  state_.active.assign(supports_.size(), false);
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const auto a = static_cast<std::size_t>(A);
    const double lambda = hasMultipliers ? x(firstMultiplier_ + A) : 0.0;
    const double lambdaHat = lambda + eps * state_.averageGap(A);
    const bool active = lambdaHat <= 0.0;
    state_.active[a] = active;
    const std::size_t group = face_.spans().size() + a;
    const auto& D = mortar.D[a];
    const Eigen::Index n = D.size();
    if (active) {
      state_.lambdaHat(A) = lambdaHat;
      state_.reaction += lambdaHat * mortar.d.col(A);
      if (!hasMultipliers) state_.energy += 0.5 * eps * state_.averageGap(A) * mortar.G(A);
      out.force(displacementUnknowns(supports_[a])) += lambdaHat * D;
      if (hasMultipliers) out.force(firstMultiplier_ + A) += mortar.G(A);
    } else if (hasMultipliers) {
      out.force(firstMultiplier_ + A) -= lambda * A_(A) / eps;
    }
    if (out.system == nullptr) continue;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + (hasMultipliers ? 1 : 0), n + (hasMultipliers ? 1 : 0));
    if (active) {
      K.topLeftCorner(n, n) = eps / A_(A) * D * D.transpose();
      if (hasMultipliers) {
        K.col(n).head(n) = D;
        K.row(n).head(n) = D.transpose();
      }
    } else if (hasMultipliers) {
      K(n, n) = -A_(A) / eps;
    }
    out.system->add(out.term, group, K);
  }
  for (const auto& span : face_.spans())
    state_.pressure.segment(span.firstPoint, span.R.cols()) =
        -span.R.transpose() * state_.lambdaHat(span.functions);
}

template <int Dim>
void ContactTerm<Dim>::evaluatePointwise(Assembly& out, const Mortar& mortar) {
  const double eps = options_.parameter;
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const auto unknowns = displacementUnknowns(span.functions);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns.size()),
                                              static_cast<Eigen::Index>(unknowns.size()));
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const GapQuery& query = mortar.points[static_cast<std::size_t>(span.firstPoint + q)];
      if (!(query.gap < 0.0)) continue;
      const double w = span.weights(q);
      Eigen::VectorXd N(K.rows());
      for (Eigen::Index a = 0; a < span.R.rows(); ++a)
        N.segment<Dim>(Dim * a) = span.R(a, q) * query.normal.head<Dim>();
      out.force(unknowns) += w * eps * query.gap * N;
      K += w * eps * N * N.transpose();
      state_.pressure(span.firstPoint + q) = -eps * query.gap;
      state_.reaction += w * eps * query.gap * query.normal;
      state_.energy += 0.5 * w * eps * query.gap * query.gap;
    }
    if (out.system != nullptr) out.system->add(out.term, e, K);
  }
}

/// ∫ λ̂_I R_a R_b ∂n/∂x dΓ with the pressure field λ̂_I of (37).
template <int Dim>
void ContactTerm<Dim>::addGeometricTangent(Assembly& out, const Mortar& mortar) {
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const Eigen::Index n = span.R.rows();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Dim * n, Dim * n);
    bool any = false;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const double pressure = state_.pressure(span.firstPoint + q);
      if (pressure == 0.0) continue;
      any = true;
      const Eigen::Matrix<double, Dim, Dim> dn = mortar.points[static_cast<std::size_t>(span.firstPoint + q)]
                                                     .dNormal.template topLeftCorner<Dim, Dim>();
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a)
          K.block<Dim, Dim>(Dim * a, Dim * b) -=
              span.weights(q) * pressure * span.R(a, q) * span.R(b, q) * dn;
    }
    if (any) out.system->add(out.term, e, K);
  }
}

template class ContactTerm<2>;
template class ContactTerm<3>;

}  // namespace burnish
