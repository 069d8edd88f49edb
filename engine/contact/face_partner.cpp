#include "engine/contact/face_partner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/contact/pair_rows.h"
#include "engine/contact/unknown_lists.h"
#include "engine/core/error.h"

namespace burnish::inline contact {
namespace {

/// Cosine between the outward normals of partners: at least 120 degrees apart.
constexpr double kOpposed = -0.5;

/// A closest point is used up to this share of the distance to the centre of curvature, where it ends to be
/// one: for new partners, and during a step.
constexpr double kShareOfRadius = 0.75;
constexpr double kLargestShareOfRadius = 0.95;

/// New partners are found before they touch, as the two sides of a thin part of the body, which face away
/// from each other, penetrate one another. But where a fold closes, within a span of the slave, beside a
/// slave that has a partner, and on new meshes they may do so by a part of the length of the face between
/// them, and of the slave's span.
constexpr double kFold = 1.0;
constexpr double kShareOfLength = 0.05;
constexpr double kShareOfSpan = 0.25;

/// A partner is left for a foot that is nearer by more than this part of the slave's span.
constexpr double kNearer = 1e-3;

/// Rounding errors of gaps in parts of the coordinates, and of overhangs: touching parts are outside of one
/// another, an end is not beyond itself.
constexpr double kRounding = 1e-12;
constexpr double kRoundedOverhang = 1e-12;

/// Numbers that a segment is saved as.
constexpr int kNumbersPerSegment = 5;

/// Lists of segments, each list behind its length.
class SavedSegments {
 public:
  explicit SavedSegments(const std::vector<double>& numbers)
      : next_(numbers.data()), end_(numbers.data() + numbers.size()) {}

  /// Calls a function for the numbers of every segment of the next list. Throws `Error` if it is cut short.
  template <class F>
  void forEach(F&& f) {
    if (next_ == end_ || !(*next_ >= 0.0) ||
        !(kNumbersPerSegment * *next_ < static_cast<double>(end_ - next_)))
      throw Error("saved state: a list of segments of a pair of faces is cut short");
    const auto count = static_cast<int>(*next_++);
    for (int k = 0; k < count; ++k, next_ += kNumbersPerSegment) f(next_);
  }

 private:
  const double *next_, *end_;
};

}  // namespace

/// A quadrature point.
template <int Dim>
struct FacePartner<Dim>::Slave {
  Eigen::Vector<double, Dim - 1> xi;
  Vector x, normal;
  Vector X;  ///< in the reference state
  double spanSize = 0.0;
  bool isBeside = false;  ///< a partner's neighbour, or on a new mesh
};

template <int Dim>
FacePartner<Dim>::FacePartner(const FaceQuadrature<Dim>& slave, Patch<Dim - 1, Dim> slaveTrace,
                              double outward, MasterSurface<Dim> surface, const PartnerRules& rules)
    : slave_(slave),
      outward_(outward),
      slaveTrace_(std::move(slaveTrace)),
      surface_(std::move(surface)),
      reference_(surface_),
      acceptedSurface_(surface_),
      rules_(rules),
      slavePoints_(slave.points()),
      positions_(Dim, slave.numPoints()),
      feet_(static_cast<std::size_t>(slave.numPoints())),
      places_(feet_.size()) {
  for (const auto& span : slave_.spans())
    positions_.middleCols(span.firstPoint, span.R.cols()) = slavePoints_(Eigen::all, span.functions) * span.R;
  chooseAnew(rules_.isNewMesh);
}

/// Moves both faces, the slave's quadrature points to the positions.
template <int Dim>
void FacePartner<Dim>::moveTo(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) {
  addedGap_ = ramp_.at(t);
  surface_.moveTo(x);
  positions_ = positions;
  slavePoints_ = slave_.points();
  for (int a = 0; a < slave_.numFunctions(); ++a)
    slavePoints_.col(a) += x.template segment<Dim>(Dim * slave_.nodes()[static_cast<std::size_t>(a)]);
}

template <int Dim>
void FacePartner<Dim>::beginAt(double t, const Eigen::VectorXd& x) {
  moveTo(t, x, slave_.positions(x));
  feet_.assign(feet_.size(), std::nullopt);
  chooseAnew(rules_.isNewMesh);
}

template <int Dim>
bool FacePartner<Dim>::update(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) {
  moveTo(t, x, positions);
  for (std::size_t e = 0; e < slave_.spans().size(); ++e) {
    const auto& span = slave_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(span.firstPoint + q);
      feet_[number].reset();
      if (!places_[number]) continue;
      const Place& start = *places_[number];
      auto foot = surface_.project(positions_.col(span.firstPoint + q), start);
      if (!foot || foot->shareOfRadius() > kLargestShareOfRadius) return false;
      if (hasSlippedTooFar(start, *foot)) return false;
      feet_[number] = std::move(foot);
    }
  }
  return !anyHasCrossed();
}

template <int Dim>
bool FacePartner<Dim>::hasSlippedTooFar(const Place& start, const Foot<Dim>& foot) const {
  if (!std::isfinite(rules_.largestSlip)) return false;
  const SurfacePoint<Dim> before = surface_.at(start);
  const auto index = surface_.basis(start.face).spanIndex(start.span);
  double length = 0.0;
  for (int d = 0; d < Dim - 1; ++d) {
    const UnivariateBasis& direction = surface_.basis(start.face).direction(d);
    const int span = index[static_cast<std::size_t>(d)];
    length = std::max(length,
                      before.tangents.col(d).norm() * (direction.spanEnd(span) - direction.spanBegin(span)));
  }
  return (foot.point.x - before.x).norm() > rules_.largestSlip * length;
}

/// Points without a partner that have gone no farther than the reach, both surfaces' ways taken together, are
/// where partners are found, or outside; of others the nearest feet tell, then and now. Not asked of a surface of
/// its own, whose folds begin inside of one another.
template <int Dim>
bool FacePartner<Dim>::anyHasCrossed() const {
  if (rules_.ownFace) return false;
  const double masters = surface_.largestWayFrom(acceptedSurface_);
  const double slaves = (slavePoints_ - acceptedSlavePoints_).colwise().norm().maxCoeff();
  const double deepest = std::min(rules_.newPenetration, rules_.reach);
  if (!(masters + slaves > deepest)) return false;
  std::optional<MasterSearch<Dim>> before, now;
  for (std::size_t e = 0; e < slave_.spans().size(); ++e) {
    const auto& span = slave_.spans()[e];
    const Eigen::MatrixXd accepted = acceptedSlavePoints_(Eigen::all, span.functions) * span.R;
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const Vector x = positions_.col(span.firstPoint + q);
      const double way = masters + (x - accepted.col(q)).norm();
      if (places_[static_cast<std::size_t>(span.firstPoint + q)] || !(way > deepest)) continue;
      if (!before) {
        before.emplace(acceptedSurface_);
        now.emplace(surface_);
      }
      const auto gapOf = [&](const MasterSearch<Dim>& search, const MasterSurface<Dim>& surface,
                             const Slave& slave) {
        const auto foot = search.nearest(surface, slave.x, way, [&](const Foot<Dim>& other) {
          return faces(slave, other) && surface.overhang(other.point.place) <= kRoundedOverhang;
        });
        return foot ? foot->gap : 0.0;
      };
      if (gapOf(*now, surface_, slaveAt(e, q, slavePoints_, x)) < -deepest &&
          gapOf(*before, acceptedSurface_, slaveAt(e, q, acceptedSlavePoints_, accepted.col(q))) > 0.0)
        return true;
    }
  }
  return false;
}

/// The quadrature point of a span whose parameters are nearest.
template <int Dim>
int FacePartner<Dim>::nearestNumber(std::size_t span, const Eigen::Vector<double, Dim - 1>& xi) const {
  const auto& rule = slave_.spans()[span];
  Eigen::Index nearest = 0;
  (rule.xi.colwise() - xi).colwise().squaredNorm().minCoeff(&nearest);
  return rule.firstPoint + static_cast<int>(nearest);
}

/// A place near the foot of a point between quadrature points: of the segment or of a neighbour. None if the
/// point has no partner.
template <int Dim>
std::optional<typename FacePartner<Dim>::Place> FacePartner<Dim>::startOf(const SlavePoint<Dim>& point,
                                                                          bool inAcceptedState) const {
  if constexpr (Dim == 2) {
    const auto& segments = segments_[point.span];
    const auto found = std::find_if(segments.begin(), segments.end(),
                                    [&](const Segment& segment) { return point.xi(0) <= segment.end; });
    if (found != segments.end()) return found->foot;
  }
  const auto number = static_cast<std::size_t>(nearestNumber(point.span, point.xi));
  if (inAcceptedState || !feet_[number]) return places_[number];
  return feet_[number]->point.place;
}

template <int Dim>
std::optional<Foot<Dim>> FacePartner<Dim>::footOf(const SlavePoint<Dim>& point) const {
  if (point.number >= 0) return feet_[static_cast<std::size_t>(point.number)];
  const auto start = startOf(point, false);
  if (!start) return std::nullopt;
  return surface_.project(point.x, *start);
}

/// The place of the foot in the accepted state; of the present one if there was none between the quadrature
/// points.
template <int Dim>
typename FacePartner<Dim>::Place FacePartner<Dim>::acceptedPlaceOf(const SlavePoint<Dim>& point,
                                                                   const Foot<Dim>& foot) const {
  if (point.number >= 0) return *places_[static_cast<std::size_t>(point.number)];
  const auto start = startOf(point, true);
  const auto accepted = start ? acceptedSurface_.project(point.xAccepted, *start) : std::nullopt;
  return accepted ? accepted->point.place : foot.point.place;
}

template <int Dim>
std::optional<ContactPoint<Dim>> FacePartner<Dim>::at(const SlavePoint<Dim>& point,
                                                      PointDetail detail) const {
  const auto foot = footOf(point);
  if (!foot) return std::nullopt;
  ContactPoint<Dim> contact;
  contact.gap = foot->gap + addedGap_;
  contact.normal = foot->normal;
  if (detail == PointDetail::Gap) return contact;
  contact.unknowns.assign(point.unknowns.begin(), point.unknowns.end());
  for (const int node : foot->point.nodes)
    for (int d = 0; d < Dim; ++d) contact.unknowns.push_back(Dim * node + d);
  const PairRows<Dim> rows(point.R, *foot);
  contact.dGap = rows.dGap();
  if (detail == PointDetail::SecondDerivatives) contact.d2Gap = rows.d2Gap();
  return contact;
}

template <int Dim>
void FacePartner<Dim>::addSlip(const SlavePoint<Dim>& point, ContactPoint<Dim>& contact) const {
  const Foot<Dim> foot = *footOf(point);
  const SurfacePoint<Dim> before = surface_.at(acceptedPlaceOf(point, foot));
  std::vector<int> nodes = foot.point.nodes;
  const auto places = placesAmong(nodes, before.nodes);
  for (std::size_t k = foot.point.nodes.size(); k < nodes.size(); ++k)
    for (int d = 0; d < Dim; ++d) contact.unknowns.push_back(Dim * nodes[k] + d);
  const auto size = std::ssize(contact.unknowns);
  contact.dGap.conservativeResizeLike(Eigen::VectorXd::Zero(size));
  if (contact.d2Gap.size() > 0) contact.d2Gap.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));

  const PairRows<Dim> rows(point.R, foot, static_cast<int>(nodes.size() - foot.point.nodes.size()));
  const auto frame = carriedFrame<Dim>(origin_, originNormal_, foot.normal);
  const Vector way = point.x - before.x;
  contact.frame = frame.vectors;
  contact.slip = frame.vectors.transpose() * way;
  contact.virtualSlip = rows.virtualSlip(frame);
  contact.dSlip = rows.dSlip(frame, way, rows.differenceTo(before.shape.R, places));
}

template <int Dim>
Eigen::MatrixXd FacePartner<Dim>::frictionTangent(const SlavePoint<Dim>& point,
                                                  const ContactPoint<Dim>& contact,
                                                  const Eigen::Vector<double, Dim - 1>& traction) const {
  const Foot<Dim> foot = *footOf(point);
  const auto own = point.R.size() + std::ssize(foot.point.nodes);
  const PairRows<Dim> rows(point.R, foot, static_cast<int>(std::ssize(contact.unknowns) / Dim - own));
  const auto frame = carriedFrame<Dim>(origin_, originNormal_, foot.normal);
  Eigen::Matrix<double, Dim, Dim> byNormal = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (int k = 0; k < Dim - 1; ++k) byNormal += traction(k) * frame.byNormal[static_cast<std::size_t>(k)];
  return rows.frictionTangent(frame.vectors * traction, byNormal);
}

template <int Dim>
double FacePartner<Dim>::smallestGap() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& foot : feet_)
    if (foot) smallest = std::min(smallest, foot->gap);
  return smallest;
}

template <int Dim>
std::vector<int> FacePartner<Dim>::couplings(std::size_t) const {
  std::vector<int> unknowns;
  for (int face = 0; face < surface_.numFaces(); ++face)
    for (const int node : surface_.nodes(face))
      for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * node + d);
  sortOnce(unknowns);
  return unknowns;
}

/// Numbers of the quadrature points next to one of a span, in all directions of the face.
template <int Dim>
std::vector<int> FacePartner<Dim>::neighbours(std::size_t span, Eigen::Index point) const {
  const auto& basis = slaveTrace_.basis();
  const Eigen::Index numPoints = slave_.spans()[span].R.cols();
  Eigen::Index count = 1;  // per direction
  while ((Dim == 2 ? count : count * count) < numPoints) ++count;
  std::vector<int> numbers;
  Eigen::Index stride = 1;
  for (int d = 0; d < Dim - 1; ++d, stride *= count)
    for (const int step : {-1, 1}) {
      auto index = basis.spanIndex(slave_.spans()[span].number);
      int& across = index[static_cast<std::size_t>(d)];
      const Eigen::Index place = point / stride % count;
      Eigen::Index next = place + step;
      if (next < 0 || next == count) {
        across += step;
        next -= step * count;
      }
      if (across < 0 || across == basis.direction(d).numSpans()) continue;
      numbers.push_back(slave_.spans()[static_cast<std::size_t>(basis.spanNumber(index))].firstPoint +
                        static_cast<int>(point + (next - place) * stride));
    }
  return numbers;
}

/// Whether a place comes after a slave that may be on the same face.
template <int Dim>
bool FacePartner<Dim>::isLater(const Place& place, const Slave& slave) const {
  if (place.face != *rules_.ownFace) return place.face > *rules_.ownFace;
  double farthest = 0.0;
  for (int d = 0; d < Dim - 1; ++d) {
    const UnivariateBasis& basis = slaveTrace_.basis().direction(d);
    const double share =
        (place.xi(d) - slave.xi(d)) / (basis.spanEnd(basis.numSpans() - 1) - basis.spanBegin(0));
    if (std::abs(share) > std::abs(farthest)) farthest = share;
  }
  return farthest > 0.0;
}

/// Whether a span of the slave's own surface is worth a search: a part of it comes after the slave and looks
/// back at it.
template <int Dim>
bool FacePartner<Dim>::mayHoldPartner(const Span& span,
                                      const Eigen::Matrix<double, Dim, Eigen::Dynamic>& normals,
                                      const Slave& slave) const {
  const double spread = (normals.colwise() - normals.col(0)).colwise().norm().maxCoeff();
  if ((normals.transpose() * slave.normal).minCoeff() - spread >= kOpposed) return false;
  if (span.face != *rules_.ownFace) return span.face > *rules_.ownFace;
  const auto& basis = slaveTrace_.basis();
  const auto index = basis.spanIndex(span.span);
  for (int d = 0; d < Dim - 1; ++d)
    if (basis.direction(d).spanEnd(index[static_cast<std::size_t>(d)]) > slave.xi(d)) return true;
  return false;
}

/// Length in the reference state of the way along straight parameters from a slave to a foot on its own face;
/// through the body to other faces.
template <int Dim>
double FacePartner<Dim>::wayTo(const Place& place, const Slave& slave) const {
  constexpr int kChords = 16;
  if (place.face != *rules_.ownFace) return (reference_.at(place).x - slave.X).norm();
  double length = 0.0;
  Vector last = slave.X;
  for (int k = 1; k <= kChords; ++k) {
    const double share = static_cast<double>(k) / kChords;
    const Vector next =
        reference_.at(reference_.placeOf(place.face, (1.0 - share) * slave.xi + share * place.xi)).x;
    length += (next - last).norm();
    last = next;
  }
  return length;
}

/// How deep inside a slave may find a partner.
template <int Dim>
double FacePartner<Dim>::deepestNew(const Slave& slave, const Foot<Dim>& foot) const {
  const double deepest = std::min(rules_.newPenetration, rules_.reach);
  if (!rules_.ownFace) return deepest;
  const double length = wayTo(foot.point.place, slave);
  if (!slave.isBeside && length >= kFold * slave.spanSize) return deepest;
  return std::max(deepest, std::min(kShareOfLength * length, kShareOfSpan * slave.spanSize));
}

/// Whether slave and master look at each other, the slave being the earlier one on a surface of its own.
template <int Dim>
bool FacePartner<Dim>::faces(const Slave& slave, const Foot<Dim>& foot) const {
  const Place& place = foot.point.place;
  if (rules_.ownFace && !isLater(place, slave)) return false;
  return foot.normal.dot(slave.normal) < kOpposed;
}

template <int Dim>
bool FacePartner<Dim>::suits(const Slave& slave, const Foot<Dim>& foot, bool isNew) const {
  const Place& place = foot.point.place;
  if (!faces(slave, foot)) return false;
  const double deepest = isNew ? deepestNew(slave, foot) : rules_.reach;
  const double rounding = kRounding * (slave.x.norm() + foot.point.x.norm());
  if (!(foot.gap < rules_.reach) || !(foot.gap > -deepest - rounding)) return false;
  if (surface_.overhang(place) > (isNew ? rules_.newOverhang : rules_.overhang) + kRoundedOverhang)
    return false;
  return foot.shareOfRadius() <= kShareOfRadius;
}

/// A quadrature point. controlPoints: of the slave, x: its own place.
template <int Dim>
typename FacePartner<Dim>::Slave FacePartner<Dim>::slaveAt(std::size_t e, Eigen::Index q,
                                                           const Eigen::MatrixXd& controlPoints,
                                                           const Vector& x) const {
  const auto& span = slave_.spans()[e];
  const Eigen::Matrix<double, Dim, Dim - 1> tangents =
      controlPoints(Eigen::all, span.functions) * span.dR.middleCols((Dim - 1) * q, Dim - 1);
  return {span.xi.col(q),
          x,
          outward_ * areaVector<Dim>(tangents).normalized(),
          slave_.points()(Eigen::all, span.functions) * span.R.col(q),
          span.size,
          false};
}

template <int Dim>
void FacePartner<Dim>::choosePartners(bool isNewMesh) {
  const MasterSearch<Dim> search(surface_, rules_.ownFace.has_value());
  std::vector<bool> had;
  for (const auto& foot : feet_) had.push_back(foot.has_value());
  const auto isBeside = [&](std::size_t e, Eigen::Index q) {
    if (isNewMesh || !rules_.ownFace) return isNewMesh;
    const auto numbers = neighbours(e, q);
    return std::any_of(numbers.begin(), numbers.end(),
                       [&](int number) { return had[static_cast<std::size_t>(number)]; });
  };
  for (std::size_t e = 0; e < slave_.spans().size(); ++e) {
    const auto& span = slave_.spans()[e];
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      const auto number = static_cast<std::size_t>(span.firstPoint + q);
      Slave slave = slaveAt(e, q, slavePoints_, positions_.col(span.firstPoint + q));
      slave.isBeside = isBeside(e, q);
      auto& foot = feet_[number];
      if (foot && !suits(slave, *foot, false)) foot.reset();
      if (!foot || rules_.takesNearer) {
        const double reach = foot ? std::min(rules_.reach, std::abs(foot->gap)) : rules_.reach;
        typename MasterSearch<Dim>::MayHold mayHold;
        if (rules_.ownFace)
          mayHold = [&](const Span& other, const auto& normals) {
            return mayHoldPartner(other, normals, slave);
          };
        auto found = search.nearest(
            surface_, slave.x, reach, [&](const Foot<Dim>& other) { return suits(slave, other, true); },
            mayHold);
        if (found && (!foot || std::abs(found->gap) < std::abs(foot->gap) - kNearer * span.size))
          foot = std::move(found);
      }
      places_[number] = foot ? std::optional(foot->point.place) : std::nullopt;
    }
  }
  cutSegments(search);
}

template <int Dim>
void FacePartner<Dim>::cutSegments(const MasterSearch<Dim>& search) {
  segments_.assign(slave_.spans().size(), {});
  if constexpr (Dim == 2) {
    if (!rules_.segments) return;
    const UnivariateBasis& basis = slaveTrace_.basis().direction(0);
    for (std::size_t e = 0; e < segments_.size(); ++e) {
      const auto& functions = slave_.spans()[e].functions;
      const int span = slaveTrace_.findSpan(slave_.spans()[e].xi.col(0));
      const Eigen::Matrix2Xd points = slavePoints_(Eigen::all, functions);
      const auto footAt = [&](double xi) -> std::optional<Foot<2>> {
        const Eigen::Vector<double, 1> parameter(xi);
        const auto shape = slaveTrace_.shape(span, parameter);
        const Slave slave{parameter,
                          points * shape.R,
                          outward_ * areaVector<2>(Eigen::Vector2d(points * shape.dR)).normalized(),
                          slave_.points()(Eigen::all, functions) * shape.R,
                          slave_.spans()[e].size,
                          false};
        const auto isPartner = [&](const Foot<2>& foot) {
          return suits(slave, foot, false) &&
                 surface_.overhang(foot.point.place) <= rules_.newOverhang + kRoundedOverhang;
        };
        std::optional<Foot<2>> foot;
        if (const auto& start = places_[static_cast<std::size_t>(nearestNumber(e, parameter))])
          foot = surface_.project(slave.x, *start);
        if (!foot || !isPartner(*foot)) foot = search.nearest(surface_, slave.x, rules_.reach, isPartner);
        return foot;
      };
      segments_[e] = segmentsOf(basis.spanBegin(span), basis.spanEnd(span), footAt);
    }
  }
}

template <int Dim>
void FacePartner<Dim>::chooseFrame() {
  Vector sum = Vector::Zero();
  for (const auto& foot : feet_)
    if (foot) sum += foot->normal;
  originNormal_ = sum.norm() > 0.0 ? Vector(sum.normalized()) : Vector(Vector::Unit(Dim - 1));
  origin_ = anyFrame<Dim>(originNormal_);
}

template <int Dim>
void FacePartner<Dim>::accept() {
  chooseAnew(false);
}

template <int Dim>
void FacePartner<Dim>::chooseAnew(bool isNewMesh) {
  surface_.roundKinks();
  choosePartners(isNewMesh);
  chooseFrame();
  acceptedSurface_ = surface_;
  acceptedSlavePoints_ = slavePoints_;
}

/// Throws `Error` if the surface has no such span.
template <int Dim>
typename FacePartner<Dim>::Span FacePartner<Dim>::savedSpan(double face, double span) const {
  const bool exists = face >= 0.0 && face < surface_.numFaces() && span >= 0.0 &&
                      span < surface_.basis(static_cast<int>(face)).numSpans();
  if (!exists) throw Error("saved state: a foot of a pair of faces lies on a span that is not there");
  return {static_cast<int>(face), static_cast<int>(span)};
}

template <int Dim>
void FacePartner<Dim>::archive(StateArchive& archive) {
  // Per quadrature point face, span and parameters; face -1 without a partner.
  Eigen::VectorXd feet = Eigen::VectorXd::Constant((Dim + 1) * std::ssize(places_), -1.0);
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (const auto& place = places_[k])
      feet.segment<Dim + 1>((Dim + 1) * static_cast<Eigen::Index>(k)) << place->face, place->span, place->xi;
  archive.fixedField("feet", feet);

  // Per span of the slave the number of segments, then begin, end and foot of each, as above.
  std::vector<double> segments;
  for (const auto& pieces : segments_) {
    segments.push_back(static_cast<double>(pieces.size()));
    for (const Segment& piece : pieces) {
      const auto foot = piece.foot.value_or(SurfacePlace<2>{-1, -1, Eigen::Vector<double, 1>(0.0)});
      segments.insert(segments.end(), {piece.begin, piece.end, static_cast<double>(foot.face),
                                       static_cast<double>(foot.span), foot.xi(0)});
    }
  }
  archive.field("segments", segments);
  Eigen::VectorXd frame(Dim * Dim);
  frame << originNormal_, origin_.reshaped();
  archive.fixedField("frame", frame);
  archive.part("accepted", acceptedSurface_);
  Eigen::VectorXd slavePoints = acceptedSlavePoints_.reshaped();
  archive.fixedField("accepted_slave", slavePoints);
  acceptedSlavePoints_ = slavePoints.reshaped(Dim, acceptedSlavePoints_.cols());
  if (!archive.restores()) return;

  acceptedSurface_.roundKinks();
  surface_ = acceptedSurface_;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto saved = feet.segment<Dim + 1>((Dim + 1) * static_cast<Eigen::Index>(k));
    places_[k].reset();
    if (!(saved(0) >= 0.0)) continue;
    const Span span = savedSpan(saved(0), saved(1));
    places_[k] = Place{span.face, span.span, saved.template tail<Dim - 1>()};
  }
  SavedSegments savedSegments(segments);
  for (auto& pieces : segments_) {
    pieces.clear();
    savedSegments.forEach([&](const double* entry) {
      Segment piece{entry[0], entry[1], std::nullopt};
      if (entry[2] >= 0.0) {
        const Span span = savedSpan(entry[2], entry[3]);
        piece.foot = SurfacePlace<2>{span.face, span.span, Eigen::Vector<double, 1>(entry[4])};
      }
      pieces.push_back(piece);
    });
  }
  originNormal_ = frame.head<Dim>();
  origin_ = frame.tail(Dim * (Dim - 1)).reshaped(Dim, Dim - 1);
}

template class FacePartner<2>;
template class FacePartner<3>;

}  // namespace burnish::inline contact
