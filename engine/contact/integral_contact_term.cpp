#include "engine/contact/integral_contact_term.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/contact/unknown_lists.h"

namespace burnish::inline contact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Pieces of a span between whose ends a change of sign is looked for, in the plane.
constexpr int kSampledPieces = 20;

/// Lengths of a span and multiples of its largest multiplier from which on no point of it can be pressed:
/// gaps change by no more than the way between two points, λ is no larger than so many of its coefficients.
constexpr double kFarSpans = 2.0;
constexpr double kFarMultipliers = 8.0;

/// Places in a span's sums of the components α of its n functions' τ.
template <int Dim>
auto tangentialRows(Eigen::Index n, Eigen::Index alpha) {
  return Eigen::seqN(n + alpha, n, Dim - 1);
}

/// Points per direction of a rule with twice those of another one.
template <class Span>
int finePoints(const Span& rule) {
  const auto directions = static_cast<double>(rule.xi.rows());
  return 2 *
         static_cast<int>(std::lround(std::pow(static_cast<double>(rule.weights.size()), 1.0 / directions)));
}

/// Zero of a function between a and b, where it has different signs: regula falsi (Illinois) to rounding,
/// halving where it is not finite.
template <class F>
double zeroBetween(double a, double fa, double b, double fb, const F& f) {
  constexpr int kMost = 200;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
  const bool negativeFirst = fa < 0.0;
  int kept = 0;  // the end that has been kept the last time: -1 the first, 1 the second
  double last = a;
  for (int k = 0; k < kMost && b - a > rounding; ++k) {
    double m = (a * fb - b * fa) / (fb - fa);
    if (!(m > a && m < b)) m = 0.5 * (a + b);
    const double fm = f(m);
    if (fm == 0.0 || std::abs(m - last) <= 0.25 * rounding) return m;
    last = m;
    if ((fm < 0.0) == negativeFirst) {
      a = m;
      fa = fm;
      if (kept == 1) fb *= 0.5;
      kept = 1;
    } else {
      b = m;
      fb = fm;
      if (kept == -1) fa *= 0.5;
      kept = -1;
    }
  }
  return 0.5 * (a + b);
}

/// Where a statement that holds at a, and not at b, ceases to hold: halving to rounding.
template <class F>
double changeBetween(double a, double b, const F& holds) {
  for (double m = 0.5 * (a + b); m > a && m < b; m = 0.5 * (a + b)) (holds(m) ? a : b) = m;
  return b;
}

template <int Dim>
std::vector<double> spanSizes(const FaceQuadrature<Dim>& face) {
  std::vector<double> sizes;
  for (const auto& span : face.spans()) sizes.push_back(span.size);
  return sizes;
}

}  // namespace

/// What a span interpolates, by its functions.
template <int Dim>
struct IntegralContactTerm<Dim>::SpanValues {
  std::size_t number = 0;
  std::span<const int> unknowns;  ///< displacement components
  Eigen::MatrixXd points;         ///< current, Dim x n
  Eigen::VectorXd lambda;         ///< λ
  Eigen::VectorXd origin;         ///< gaps that count as zero
  Eigen::MatrixXd accepted;       ///< positions in the accepted state, Dim x n; with friction alone
  Eigen::MatrixXd tau;            ///< τ, (Dim-1) x n; with friction alone
};

/// Residual and tangent of a span: λ of the span's functions, with friction τ of these; where it touches, its
/// displacements and those unknowns of the partner that its points depend on, so that the partner's size does
/// not count.
template <int Dim>
struct IntegralContactTerm<Dim>::Contributions {
  Contributions(std::vector<int> ofMultipliers, bool hasTangent, bool hasFreeTurns)
      : multipliers(std::move(ofMultipliers)),
        wantsTangent(hasTangent),
        wantsDragged(hasTangent && hasFreeTurns) {
    resize();
  }

  /// Places of a point's unknowns, which get there if they are not. Unknowns of the span that are the partner's,
  /// too, have two places.
  std::vector<Eigen::Index> placesOf(const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact) {
    displacements = point.unknowns;
    std::vector<Eigen::Index> places(displacements.size());
    std::iota(places.begin(), places.end(), std::ssize(multipliers));
    const auto first = std::ssize(multipliers) + std::ssize(displacements);
    const std::span<const int> all = contact.unknowns;
    for (const int place : placesAmong(partners, all.subspan(displacements.size())))
      places.push_back(first + place);
    resize();
    return places;
  }

  void resize() {
    const auto size = std::ssize(multipliers) + std::ssize(displacements) + std::ssize(partners);
    if (size == force.size()) return;
    force.conservativeResizeLike(Eigen::VectorXd::Zero(size));
    if (wantsTangent) K.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
    if (wantsDragged) dragged.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
  }

  std::vector<int> multipliers;        ///< -1 for one that there is not
  std::span<const int> displacements;  ///< none while nothing has touched
  std::vector<int> partners;           ///< in the order in which points asked for them
  bool wantsTangent, wantsDragged;
  Eigen::VectorXd force;
  Eigen::MatrixXd K;        ///< empty if no tangent is wanted
  Eigen::MatrixXd dragged;  ///< what K has more if the partner is, see `Drag`; empty without free turns
};

template <int Dim>
IntegralContactTerm<Dim>::IntegralContactTerm(const Body<Dim>& body, int patch, FaceId face,
                                              const PartnerMaker<Dim>& makePartner,
                                              const ContactOptions& options, int firstMultiplier,
                                              const std::vector<bool>& held,
                                              const std::vector<DefinitionSpec>& definitions)
    : FaceContact<Dim>(body, patch, face, options, firstMultiplier, definitions),
      body_(body),
      partner_(makePartner(face_)),
      hasFriction_(options.hasFriction()),
      relativeLength_(face_.trace().basis(), spanSizes(face_)) {
  const HeldControlPoints points = heldControlPoints(body, patch, face, held);
  multipliers_ = MultiplierBasis(face_.trace().basis(), points.across);
  tangential_ = MultiplierBasis(face_.trace().basis(), points.along);
  A_ = Eigen::VectorXd::Zero(numMultipliers());
  addSpanTables();
  const auto& trace = face_.trace();
  for (int A = 0; A < face_.numFunctions(); ++A) {
    const Parameter xi = trace.basis().anchor(A);
    const int span = trace.findSpan(xi);
    anchors_.push_back({static_cast<std::size_t>(span), xi, trace.shape(span, xi)});
  }
}

template <int Dim>
void IntegralContactTerm<Dim>::addSpanTables() {
  const auto& trace = face_.trace();
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const Span& span = face_.spans()[e];
    Eigen::VectorXd weights = span.weights;
    for (Eigen::Index q = 0; q < weights.size(); ++q)
      weights(q) *= relativeLength_.at(span.number, span.xi.col(q));
    mass_.emplace_back(span.R * weights.asDiagonal() * span.R.transpose());
    std::vector<int> unknowns;
    for (const int a : span.functions)
      for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
    unknowns_.push_back(std::move(unknowns));
    const Eigen::VectorXd sizes = span.R.cwiseAbs() * span.weights;
    const auto multipliers = multiplierUnknowns(e);
    for (std::size_t k = 0; k < multipliers.size(); ++k) {
      const std::size_t n = span.functions.size(),
                        a = k < n ? k : (k - n) / static_cast<std::size_t>(Dim - 1);
      if (multipliers[k] >= 0) A_(multipliers[k] - firstMultiplier_) += sizes(static_cast<Eigen::Index>(a));
    }
    const auto box = spanBox(trace.basis(), span.number);
    rules_.push_back({span});
    auto& fine = fine_.emplace_back();
    if (Dim == 3 || hasFriction_) fine.push_back(face_.part(body_, span.number, box, finePoints(span)));
    Samples samples;
    if constexpr (Dim == 2) {
      samples.xi.resize(1, kSampledPieces + 1);
      samples.R.resize(span.R.rows(), kSampledPieces + 1);
      for (int k = 0; k <= kSampledPieces; ++k) {
        samples.xi(0, k) = std::lerp(box.begin(0), box.end(0), static_cast<double>(k) / kSampledPieces);
        samples.R.col(k) = trace.shape(span.number, samples.xi.col(k)).R;
      }
    } else {
      samples = {fine.back().xi, fine.back().R};
    }
    samples_.push_back(std::move(samples));
  }
  cuts_.resize(rules_.size());
  splitSpans();
}

/// Rules for pressed spans, from the partner's segments.
template <int Dim>
void IntegralContactTerm<Dim>::splitSpans() {
  if constexpr (Dim == 2) {
    for (std::size_t e = 0; e < rules_.size(); ++e) {
      const Span& span = face_.spans()[e];
      std::vector<double> cuts;
      for (const Segment& segment : partner_->segments(e)) cuts.push_back(segment.end);
      if (!cuts.empty()) cuts.pop_back();
      if (cuts == cuts_[e]) continue;
      cuts_[e] = std::move(cuts);
      rules_[e] = rulesBetween(e, cuts_[e], static_cast<int>(span.weights.size()));
      if (hasFriction_) fine_[e] = rulesBetween(e, cuts_[e], finePoints(span));
    }
  }
}

/// Rules over the parts of a span between its ends and places in it, in any order.
template <int Dim>
std::vector<typename IntegralContactTerm<Dim>::Span> IntegralContactTerm<Dim>::rulesBetween(
    std::size_t e, const std::vector<double>& ends, int points) const {
  const int number = face_.spans()[e].number;
  const auto box = spanBox(face_.trace().basis(), number);
  std::vector<double> all = ends;
  all.insert(all.end(), {box.begin(0), box.end(0)});
  std::sort(all.begin(), all.end());
  std::vector<Span> rules;
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k] < all[k + 1])
      rules.push_back(
          face_.part(body_, number, {Parameter::Constant(all[k]), Parameter::Constant(all[k + 1])}, points));
  return rules;
}

template <int Dim>
CouplingGroups IntegralContactTerm<Dim>::couplings() const {
  CouplingGroups groups;
  for (std::size_t e = 0; e < unknowns_.size(); ++e) {
    auto& group = groups.emplace_back(unknowns_[e]);
    const auto others = partner_->couplings(e);
    group.insert(group.end(), others.begin(), others.end());
    for (const int unknown : multiplierUnknowns(e))
      if (unknown >= 0) group.push_back(unknown);
  }
  return groups;
}

template <int Dim>
int IntegralContactTerm<Dim>::multiplierOf(int function, int component) const {
  const int A = (component == 0 ? multipliers_ : tangential_).multiplierOf(function);
  if (A < 0) return -1;
  if (component == 0) return firstMultiplier_ + A;
  return firstMultiplier_ + multipliers_.size() + (Dim - 1) * A + component - 1;
}

template <int Dim>
std::vector<int> IntegralContactTerm<Dim>::multiplierUnknowns(std::size_t e) const {
  std::vector<int> unknowns;
  for (const int a : face_.spans()[e].functions) unknowns.push_back(multiplierOf(a, 0));
  if (!hasFriction_) return unknowns;
  for (const int a : face_.spans()[e].functions)
    for (int component = 1; component < Dim; ++component) unknowns.push_back(multiplierOf(a, component));
  return unknowns;
}

template <int Dim>
typename IntegralContactTerm<Dim>::SpanValues IntegralContactTerm<Dim>::valuesOf(
    std::size_t e, const Eigen::VectorXd& x) const {
  const auto& functions = face_.spans()[e].functions;
  SpanValues values{e, unknowns_[e], face_.points()(Eigen::all, functions), {}, {}, {}, {}};
  values.points += x(unknowns_[e]).reshaped(Dim, std::ssize(functions));
  values.lambda = multipliers_.coefficients(functions, x.segment(firstMultiplier_, multipliers_.size()));
  values.origin = gapOrigin_.size() > 0 ? Eigen::VectorXd(gapOrigin_(functions))
                                        : Eigen::VectorXd::Zero(std::ssize(functions));
  if (!hasFriction_) return values;
  values.accepted = face_.points()(Eigen::all, functions);
  values.accepted += work_.acceptedUnknowns()(unknowns_[e]).reshaped(Dim, std::ssize(functions));
  values.tau.resize(Dim - 1, std::ssize(functions));
  const auto components = x.segment(firstMultiplier_ + multipliers_.size(), (Dim - 1) * tangential_.size())
                              .reshaped(Dim - 1, tangential_.size());
  for (int alpha = 0; alpha < Dim - 1; ++alpha)
    values.tau.row(alpha) =
        tangential_.coefficients(functions, components.row(alpha).transpose()).transpose();
  return values;
}

template <int Dim>
SlavePoint<Dim> IntegralContactTerm<Dim>::pointOf(const SpanValues& values, const Parameter& xi,
                                                  const Eigen::Ref<const Eigen::VectorXd>& R, int number) {
  Eigen::Vector<double, Dim> accepted = Eigen::Vector<double, Dim>::Zero();
  if (values.accepted.size() > 0) accepted = values.accepted * R;
  return {values.number, number, xi, values.unknowns, R, values.points * R, accepted};
}

template <int Dim>
double IntegralContactTerm<Dim>::augmented(const SpanValues& values, const SlavePoint<Dim>& point,
                                           double gap) const {
  return values.lambda.dot(point.R) + parameter() / lengthAt(point) * (gap - values.origin.dot(point.R));
}

template <int Dim>
double IntegralContactTerm<Dim>::augmented(const SpanValues& values, const SlavePoint<Dim>& point) const {
  const auto contact = partner_->at(point, PointDetail::Gap);
  return contact ? augmented(values, point, contact->gap) : kInfinity;
}

template <int Dim>
FrictionTraction<Dim - 1> IntegralContactTerm<Dim>::frictionAt(
    const SpanValues& values, const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact, double p,
    const Eigen::Ref<const Eigen::MatrixXd>& dR) const {
  const Tangential trial = values.tau * point.R + frictionParameter() / lengthAt(point) * contact.slip;
  const auto& functions = face_.spans()[values.number].functions;
  const FrictionPlace place{
      referencePlace(functions, point.R), time_, slipped_(functions).dot(point.R),
      frictionLaw_.needsStretch() ? areaStretch(functions, values.accepted, point.R, dR) : 1.0};
  return coulombTraction<Dim - 1>(trial, p, frictionLaw_.at(place, -p));
}

template <int Dim>
void IntegralContactTerm<Dim>::reportFriction(const SpanValues& values, const Span& span, Eigen::Index q,
                                              const SlavePoint<Dim>& point, double p) {
  const auto number = static_cast<Eigen::Index>(point.number);
  state_.sliding[static_cast<std::size_t>(number)] = 0;
  if (!(p < 0.0)) return;
  auto contact = *partner_->at(point, PointDetail::Derivatives);
  partner_->addSlip(point, contact);
  const auto law = frictionAt(values, point, contact, p, span.dR.middleCols((Dim - 1) * q, Dim - 1));
  state_.traction.col(number).template head<Dim>() = contact.frame * law.traction;
  state_.slip.col(number).template head<Dim>() = contact.frame * contact.slip;
  state_.sliding[static_cast<std::size_t>(number)] = law.slips ? 2 : 1;
}

template <int Dim>
void IntegralContactTerm<Dim>::reportPoints(const SpanValues& values) {
  const Span& span = face_.spans()[values.number];
  for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
    const auto number = static_cast<int>(span.firstPoint + q);
    const auto point = pointOf(values, span.xi.col(q), span.R.col(q), number);
    const auto contact = partner_->at(point, PointDetail::Gap);
    if (!contact) continue;
    state_.gap(number) = contact->gap;
    state_.normal.col(number).template head<Dim>() = contact->normal;
    const double p = augmented(values, point, contact->gap);
    state_.pressure(number) = std::max(0.0, -p);
    if (hasFriction_) reportFriction(values, span, q, point, p);
  }
}

template <int Dim>
void IntegralContactTerm<Dim>::reportAnchors(const std::vector<SpanValues>& values) {
  for (std::size_t A = 0; A < anchors_.size(); ++A) {
    const Anchor& anchor = anchors_[A];
    const SpanValues& here = values[anchor.span];
    const auto point = pointOf(here, anchor.xi, anchor.shape.R);
    auto contact = partner_->at(point, hasFriction_ ? PointDetail::Derivatives : PointDetail::Gap);
    if (!contact) continue;
    const auto a = static_cast<Eigen::Index>(A);
    state_.averageGap(a) = contact->gap;
    state_.lambdaHat(a) = std::min(0.0, augmented(here, point, contact->gap));
    state_.active[A] = state_.lambdaHat(a) < 0.0;
    if (!hasFriction_ || !state_.active[A]) continue;
    partner_->addSlip(point, *contact);
    const bool slips = frictionAt(here, point, *contact, state_.lambdaHat(a), anchor.shape.dR).slips;
    ++(slips ? state_.slipping : state_.sticking);
  }
}

template <int Dim>
typename IntegralContactTerm<Dim>::SpanState IntegralContactTerm<Dim>::stateOf(
    const SpanValues& values) const {
  const Span& span = face_.spans()[values.number];
  const auto points = Eigen::seqN(span.firstPoint, span.R.cols());
  const Eigen::VectorXd extent = values.points.rowwise().maxCoeff() - values.points.rowwise().minCoeff();
  if (parameter() / relativeLength_.largestOn(span.number) *
          (state_.gap(points).minCoeff() - kFarSpans * extent.norm() - values.origin.cwiseAbs().sum()) >
      kFarMultipliers * values.lambda.cwiseAbs().maxCoeff())
    return SpanState::Open;
  bool anyPressed = state_.pressure(points).maxCoeff() > 0.0;
  bool anyOpen = !(state_.pressure(points).minCoeff() > 0.0);
  const Samples& samples = samples_[values.number];
  for (Eigen::Index k = 0; k < samples.R.cols() && !(anyPressed && anyOpen); ++k) {
    const bool isPressed = augmented(values, pointOf(values, samples.xi.col(k), samples.R.col(k))) < 0.0;
    anyPressed = anyPressed || isPressed;
    anyOpen = anyOpen || !isPressed;
  }
  return !anyPressed ? SpanState::Open : anyOpen ? SpanState::Cut : SpanState::Closed;
}

template <int Dim>
std::vector<typename IntegralContactTerm<Dim>::Span> IntegralContactTerm<Dim>::rulesOf(
    const SpanValues& values, SpanState state) const {
  const std::size_t e = values.number;
  const Span& span = face_.spans()[e];
  if (hasFriction_ && state != SpanState::Open) return fine_[e];
  if (state == SpanState::Open) return {span};
  if constexpr (Dim == 3) {
    return state == SpanState::Closed ? rules_[e] : fine_[e];
  } else {
    std::vector<double> ends = partEnds(values);
    if (state == SpanState::Closed && ends.empty()) return rules_[e];
    if (state == SpanState::Cut) std::ranges::copy(signChanges(values), std::back_inserter(ends));
    ends.insert(ends.end(), cuts_[e].begin(), cuts_[e].end());
    return rulesBetween(e, ends, static_cast<int>(span.weights.size()));
  }
}

/// Where λ + r g changes its sign in a span, in the plane.
template <int Dim>
std::vector<double> IntegralContactTerm<Dim>::signChanges(const SpanValues& values) const {
  const Samples& samples = samples_[values.number];
  const int span = face_.spans()[values.number].number;
  const auto value = [&](double xi) {
    const Parameter place = Parameter::Constant(xi);
    const Eigen::VectorXd R = face_.trace().shape(span, place).R;
    return augmented(values, pointOf(values, place, R));
  };
  std::vector<double> changes;
  double before = augmented(values, pointOf(values, samples.xi.col(0), samples.R.col(0)));
  for (Eigen::Index k = 1; k < samples.R.cols(); ++k) {
    const double here = augmented(values, pointOf(values, samples.xi.col(k), samples.R.col(k)));
    if ((before < 0.0) != (here < 0.0))
      changes.push_back(zeroBetween(samples.xi(0, k - 1), before, samples.xi(0, k), here, value));
    before = here;
  }
  return changes;
}

/// Where another part of the partner begins below a span, in the plane.
template <int Dim>
std::vector<double> IntegralContactTerm<Dim>::partEnds(const SpanValues& values) const {
  const Span& span = face_.spans()[values.number];
  const Samples& samples = samples_[values.number];
  const auto partAt = [&](const Parameter& xi, const Eigen::Ref<const Eigen::VectorXd>& R, int number = -1) {
    const auto contact = partner_->at(pointOf(values, xi, R, number), PointDetail::Gap);
    return contact ? contact->part : 0;
  };
  const auto partOfSample = [&](Eigen::Index k) { return partAt(samples.xi.col(k), samples.R.col(k)); };
  const int first = partOfSample(0);
  bool isOne = partOfSample(samples.R.cols() - 1) == first;
  for (Eigen::Index q = 0; q < span.R.cols() && isOne; ++q)
    isOne = partAt(span.xi.col(q), span.R.col(q), static_cast<int>(span.firstPoint + q)) == first;
  if (isOne) return {};
  std::vector<double> ends;
  int before = first;
  for (Eigen::Index k = 1; k < samples.R.cols(); ++k) {
    const int here = partOfSample(k);
    if (here == before) continue;
    ends.push_back(changeBetween(samples.xi(0, k - 1), samples.xi(0, k), [&](double xi) {
      const Parameter place = Parameter::Constant(xi);
      return partAt(place, face_.trace().shape(span.number, place).R) == before;
    }));
    before = here;
  }
  return ends;
}

template <int Dim>
void IntegralContactTerm<Dim>::addOpenSpan(const SpanValues& values, Contributions& sums) {
  const Eigen::MatrixXd& mass = mass_[values.number];
  const Eigen::Index n = mass.rows();
  const Eigen::VectorXd force = mass * values.lambda / parameter();
  sums.force.head(n) -= force;
  state_.energy -= 0.5 * values.lambda.dot(force);
  if (sums.wantsTangent) sums.K.topLeftCorner(n, n) -= mass / parameter();
  if (!hasFriction_) return;
  for (Eigen::Index alpha = 0; alpha < Dim - 1; ++alpha) {
    const auto rows = tangentialRows<Dim>(n, alpha);
    sums.force(rows) -= mass * values.tau.row(alpha).transpose() / frictionParameter();
    if (sums.wantsTangent) sums.K(rows, rows) -= mass / frictionParameter();
  }
}

template <int Dim>
void IntegralContactTerm<Dim>::addPoint(const SpanValues& values, const Span& rule, Eigen::Index q,
                                        bool mustTouch, Contributions& sums) {
  const auto R = rule.R.col(q);
  const Eigen::Index n = R.size();
  const auto point = pointOf(values, rule.xi.col(q), R);
  const double r = parameter() / lengthAt(point), w = rule.weights(q), lambda = values.lambda.dot(R);
  const auto multipliers = Eigen::seqN(0, n);
  auto contact =
      partner_->at(point, sums.wantsTangent ? PointDetail::SecondDerivatives : PointDetail::Derivatives);
  const double p = contact ? augmented(values, point, contact->gap) : kInfinity;
  const bool isPressed = p < 0.0, rubs = hasFriction_ && isPressed;
  if (hasFriction_ && !isPressed) addOpenTangential(values, point, w, sums);
  if (!isPressed && !mustTouch) {
    sums.force(multipliers) -= w / r * lambda * R;
    state_.energy -= 0.5 * w / r * lambda * lambda;
    if (sums.wantsTangent) sums.K(multipliers, multipliers) -= w / r * R * R.transpose();
    return;
  }
  if (rubs) partner_->addSlip(point, *contact);  // may add unknowns
  const auto places = sums.placesOf(point, *contact);
  sums.force(places) += w * p * contact->dGap;
  sums.force(multipliers) += w / r * (p - lambda) * R;
  state_.energy += 0.5 * w / r * (p * p - lambda * lambda);
  state_.area += w;
  state_.pressed -= w * p;
  if (mustTouch && p > 0.0) state_.pull += w * p;
  addForce(w * p * contact->normal, point, state_.reaction, state_.moment);
  if (sums.wantsTangent) {
    sums.K(places, places) += w * (r * contact->dGap * contact->dGap.transpose() + p * contact->d2Gap);
    const Eigen::MatrixXd border = w * contact->dGap * R.transpose();
    sums.K(places, multipliers) += border;
    sums.K(multipliers, places) += border.transpose();
  }
  if (rubs) addFriction(values, rule, q, p, point, *contact, places, sums);
}

template <int Dim>
void IntegralContactTerm<Dim>::addForce(const Eigen::Vector<double, Dim>& force, const SlavePoint<Dim>& point,
                                        Eigen::Vector3d& sum, Eigen::Vector3d& moment) const {
  Eigen::Vector3d inSpace = Eigen::Vector3d::Zero(), arm = -partner_->pivot();
  inSpace.head<Dim>() = force;
  arm.head<Dim>() += point.x;
  sum += inSpace;
  moment += arm.cross(inSpace);
}

template <int Dim>
void IntegralContactTerm<Dim>::addOpenTangential(const SpanValues& values, const SlavePoint<Dim>& point,
                                                 double w, Contributions& sums) const {
  const auto& R = point.R;
  const double weight = w * lengthAt(point) / frictionParameter();
  const Tangential tau = values.tau * R;
  for (Eigen::Index alpha = 0; alpha < Dim - 1; ++alpha) {
    const auto rows = tangentialRows<Dim>(R.size(), alpha);
    sums.force(rows) -= weight * tau(alpha) * R;
    if (sums.wantsTangent) sums.K(rows, rows) -= weight * R * R.transpose();
  }
}

template <int Dim>
void IntegralContactTerm<Dim>::addFriction(const SpanValues& values, const Span& rule, Eigen::Index q,
                                           double p, const SlavePoint<Dim>& point,
                                           const ContactPoint<Dim>& contact,
                                           const std::vector<Eigen::Index>& places, Contributions& sums) {
  const auto law = frictionAt(values, point, contact, p, rule.dR.middleCols((Dim - 1) * q, Dim - 1));
  const auto& R = point.R;
  const Eigen::Index n = R.size();
  const double w = rule.weights(q), length = lengthAt(point), r = parameter() / length,
               rT = frictionParameter() / length;
  const Tangential tau = values.tau * R;
  const Eigen::VectorXd force = w * contact.virtualSlip * law.traction;
  sums.force(places) += force;
  for (std::size_t i = 0; i < places.size(); ++i)
    work_.force()(contact.unknowns[i]) += force(static_cast<Eigen::Index>(i));
  const Eigen::Vector<double, Dim> onPartner = w * contact.frame * law.traction;
  addForce(onPartner, point, work_.reaction(), work_.moment());
  state_.frictionForce += onPartner.norm();
  drag_.add(law, onPartner);
  const auto rowsOf = [&](Eigen::Index alpha) { return tangentialRows<Dim>(n, alpha); };
  for (Eigen::Index alpha = 0; alpha < Dim - 1; ++alpha)
    sums.force(rowsOf(alpha)) += w / rT * (law.traction(alpha) - tau(alpha)) * R;
  if (!sums.wantsTangent) return;

  const auto multipliers = Eigen::seqN(0, n);
  const auto& N = contact.dGap;
  const auto& T = contact.virtualSlip;
  const Eigen::VectorXd Tc = T * law.byPressure;
  const Eigen::MatrixXd TM = T * law.byTrial, MS = law.byTrial * contact.dSlip.transpose();
  sums.K(places, places) +=
      w * (rT * T * MS + r * Tc * N.transpose() + partner_->frictionTangent(point, contact, law.traction));
  sums.K(places, multipliers) += w * Tc * R.transpose();
  for (Eigen::Index alpha = 0; alpha < Dim - 1; ++alpha) {
    sums.K(places, rowsOf(alpha)) += w * TM.col(alpha) * R.transpose();
    sums.K(rowsOf(alpha), places) += w * R * (MS.row(alpha) + r / rT * law.byPressure(alpha) * N.transpose());
    sums.K(rowsOf(alpha), multipliers) += w / rT * law.byPressure(alpha) * R * R.transpose();
    for (Eigen::Index beta = 0; beta < Dim - 1; ++beta)
      sums.K(rowsOf(alpha), rowsOf(beta)) +=
          w / rT * (law.byTrial(alpha, beta) - (alpha == beta ? 1.0 : 0.0)) * R * R.transpose();
  }
  if (!sums.wantsDragged || !law.slips) return;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!drag_.isFreeTurn(contact.unknowns[i])) continue;
    const auto turn = static_cast<Eigen::Index>(i);
    const Eigen::Index place = places[i];
    drag_.addSlope(N(turn));
    const Tangential more = law.share * contact.dSlip.row(turn).transpose() - MS.col(turn);
    sums.dragged(places, place) += w * rT * T * more;
    for (Eigen::Index alpha = 0; alpha < Dim - 1; ++alpha)
      sums.dragged(rowsOf(alpha), place) += w * more(alpha) * R;
    sums.dragged(place, places) -= w * r * Tc(turn) * N.transpose();
    sums.dragged(place, multipliers) -= w * Tc(turn) * R.transpose();
  }
}

template <int Dim>
bool IntegralContactTerm<Dim>::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  if (this->hasLostTouch()) return this->reportUntouched();
  if (!partner_->update(t, x, face_.positions(x))) return false;
  time_ = t;
  drag_ = hasFriction_ ? Drag<Dim>(partner_->freeTurns()) : Drag<Dim>();
  const std::vector<bool> before = std::move(state_.active);
  this->clearState(hasFriction_);
  state_.active.assign(anchors_.size(), false);
  if (hasFriction_) work_.start(x);

  std::vector<SpanValues> values;
  std::vector<SpanState> states;
  for (std::size_t e = 0; e < unknowns_.size(); ++e) {
    values.push_back(valuesOf(e, x));
    reportPoints(values[e]);
    states.push_back(stateOf(values[e]));
  }
  reportAnchors(values);
  state_.countChanges(before);
  const bool anyPressed =
      std::any_of(states.begin(), states.end(), [](SpanState state) { return state != SpanState::Open; });
  Eigen::Index nearest = -1;  // the point that keeps a free tool in touch
  if (keepsInTouch_ && !anyPressed && isAlone()) state_.gap.minCoeff(&nearest);

  std::vector<Contributions> dragged;
  for (std::size_t e = 0; e < unknowns_.size(); ++e) {
    const Span& span = face_.spans()[e];
    const Eigen::Index touching = nearest - span.firstPoint;
    const bool touches = nearest >= 0 && touching >= 0 && touching < span.R.cols();
    Contributions sums(multiplierUnknowns(e), out.system != nullptr, drag_.isPossible());
    if (states[e] == SpanState::Open && !touches) {
      addOpenSpan(values[e], sums);
    } else {
      for (const Span& rule : rulesOf(values[e], states[e]))
        for (Eigen::Index q = 0; q < rule.R.cols(); ++q)
          addPoint(values[e], rule, q, touches && q == touching, sums);
    }
    addToSystem(sums, out);
    if (sums.wantsDragged && states[e] != SpanState::Open) dragged.push_back(std::move(sums));
  }
  if (drag_)
    for (Contributions& sums : dragged) {
      sums.force.setZero();
      sums.K = std::move(sums.dragged);
      addToSystem(sums, out);
    }
  if (hasFriction_) endFriction();
  if (axisymmetric_) state_.keepAxialReaction();
  return true;
}

/// The tool bears the traction, and with it friction does work on the tool's own motion.
template <int Dim>
void IntegralContactTerm<Dim>::endFriction() {
  work_.end(*partner_);
  state_.frictionWork = work_.work();
  this->reportSlipped();
  state_.reaction += work_.reaction();
  state_.moment += work_.moment();
}

template <int Dim>
void IntegralContactTerm<Dim>::accept() {
  if (this->hasLostTouch()) return;
  partner_->accept();
  splitSpans();
  if (!hasFriction_) return;
  work_.accept();
  this->acceptSlipped();
}

template <int Dim>
void IntegralContactTerm<Dim>::archive(StateArchive& archive) {
  partner_->archive(archive);
  if (archive.restores()) splitSpans();
  if (!hasFriction_) return;
  archive.part("friction", work_);
  archive.fixedField("slipped", slipped_);
}

/// Without multipliers that there are not.
template <int Dim>
void IntegralContactTerm<Dim>::addToSystem(const Contributions& sums, Assembly& out) const {
  std::vector<int> unknowns;
  std::vector<Eigen::Index> rows;
  Eigen::Index row = 0;
  const auto add = [&](std::span<const int> part) {
    for (const int unknown : part) {
      if (unknown >= 0) {
        unknowns.push_back(unknown);
        rows.push_back(row);
        out.force(unknown) += sums.force(row);
      }
      ++row;
    }
  };
  add(sums.multipliers);
  add(sums.displacements);
  add(sums.partners);
  if (out.system != nullptr) out.system->add(unknowns, sums.K(rows, rows));
}

template <int Dim>
Eigen::VectorXd IntegralContactTerm<Dim>::referenceGaps(const GapAt& gapAt) const {
  Eigen::VectorXd gaps(std::ssize(anchors_));
  for (std::size_t A = 0; A < anchors_.size(); ++A) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head<Dim>() =
        face_.points()(Eigen::all, face_.spans()[anchors_[A].span].functions) * anchors_[A].shape.R;
    gaps(static_cast<Eigen::Index>(A)) = gapAt(x);
  }
  return gaps;
}

template <int Dim>
double IntegralContactTerm<Dim>::smallestReferenceGap(const GapAt& gapAt) const {
  double smallest = kInfinity;
  for (std::size_t e = 0; e < samples_.size(); ++e)
    smallest = std::min(smallest,
                        this->smallestGapAmong(
                            face_.points()(Eigen::all, face_.spans()[e].functions) * samples_[e].R, gapAt));
  return smallest;
}

template class IntegralContactTerm<2>;
template class IntegralContactTerm<3>;

}  // namespace burnish::inline contact
