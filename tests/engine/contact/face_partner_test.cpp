#include "engine/contact/face_partner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/core/error.h"
#include "tests/engine/contact/surface_samples.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

using test::kBottom;
using test::kTop;

/// A block whose bottom is the slave over one whose top is the master, with common numbers of nodes.
template <int Dim>
struct Pair {
  Body<Dim> upper, lower;
  FaceQuadrature<Dim> slave;
  std::unique_ptr<FacePartner<Dim>> partner;
  Eigen::VectorXd x;

  Pair(const Patch<Dim>& above, const Patch<Dim>& below, const PartnerRules& rules)
      : upper(makeBody(above)), lower(makeBody(below)), slave(upper, 0, kBottom, 3) {
    for (int& node : lower.nodes.front()) node += upper.numNodes;
    partner =
        std::make_unique<FacePartner<Dim>>(slave, tracePatch(above, kBottom), outwardSign(above, kBottom),
                                           MasterSurface<Dim>(lower, {{0, kTop}}), rules);
    x = Eigen::VectorXd::Zero(Dim * (upper.numNodes + lower.numNodes));
  }

  bool update() { return partner->update(0.0, x, slave.positions(x)); }

  void moveUpper(const Eigen::Vector<double, Dim>& way) {
    for (int node = 0; node < upper.numNodes; ++node) x.template segment<Dim>(Dim * node) += way;
  }

  std::vector<int> unknowns(std::size_t span) const {
    std::vector<int> result;
    for (const int a : slave.spans()[span].functions)
      for (int d = 0; d < Dim; ++d) result.push_back(Dim * slave.nodes()[static_cast<std::size_t>(a)] + d);
    return result;
  }

  int numPartners() const {
    int count = 0;
    for (int k = 0; k < slave.numPoints(); ++k) count += partner->foot(k).has_value();
    return count;
  }
};

template <int Dim>
Patch<Dim> moved(const Patch<Dim>& patch, const Eigen::Vector<double, Dim>& way, double stretch = 1.0) {
  Eigen::MatrixXd points = patch.points();
  points.row(0) *= stretch;
  return {patch.basis(), points.colwise() + way, patch.weights()};
}

Patch<2> block(int spans) {
  return refined(rectangle({0.0, 0.0}, {1.0, 1.0}),
                 {KnotVector::uniform(2, spans), KnotVector::uniform(1, 1)});
}

/// What a partner says about one point, over all unknowns.
template <int Dim>
Eigen::VectorXd answers(Pair<Dim>& pair, std::size_t span, int number,
                        const Eigen::Vector<double, Dim - 1>& xi, const Eigen::VectorXd& accepted,
                        const Eigen::VectorXd& x, Eigen::MatrixXd* tangents) {
  const auto& functions = pair.slave.spans()[span].functions;
  const auto trace = tracePatch(pair.upper.patches.front(), kBottom);
  const Eigen::VectorXd R = trace.shape(trace.findSpan(xi), xi).R;
  const std::vector<int> unknowns = pair.unknowns(span);
  const Eigen::MatrixXd reference = pair.slave.points()(Eigen::all, functions);
  const auto place = [&](const Eigen::VectorXd& state) {
    return Eigen::Vector<double, Dim>((reference + state(unknowns).reshaped(Dim, std::ssize(functions))) * R);
  };
  pair.x = x;
  EXPECT_TRUE(pair.update());
  const SlavePoint<Dim> point{span, number, xi, unknowns, R, place(x), place(accepted)};
  auto contact = pair.partner->at(point, PointDetail::SecondDerivatives);
  if (!contact) throw std::runtime_error("no partner");
  pair.partner->addSlip(point, *contact);
  const Eigen::Vector<double, Dim - 1> traction = Eigen::Vector2d(0.6, -0.9).head<Dim - 1>();
  const Eigen::MatrixXd friction = pair.partner->frictionTangent(point, *contact, traction);
  const auto n = x.size();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(1 + 2 * n + Dim - 1);
  values(0) = contact->gap;
  values.tail(Dim - 1) = contact->slip;
  const Eigen::VectorXd virtualWork = contact->virtualSlip * traction;
  for (std::size_t i = 0; i < contact->unknowns.size(); ++i) {
    values(1 + contact->unknowns[i]) += contact->dGap(static_cast<Eigen::Index>(i));
    values(1 + n + contact->unknowns[i]) += virtualWork(static_cast<Eigen::Index>(i));
  }
  if (tangents == nullptr) return values;
  *tangents = Eigen::MatrixXd::Zero(values.size(), n);
  for (std::size_t j = 0; j < contact->unknowns.size(); ++j) {
    const auto column = contact->unknowns[j];
    const auto jj = static_cast<Eigen::Index>(j);
    (*tangents)(0, column) += contact->dGap(jj);
    tangents->col(column).tail(Dim - 1) += contact->dSlip.row(jj).transpose();
    for (std::size_t i = 0; i < contact->unknowns.size(); ++i) {
      (*tangents)(1 + contact->unknowns[i], column) += contact->d2Gap(static_cast<Eigen::Index>(i), jj);
      (*tangents)(1 + n + contact->unknowns[i], column) += friction(static_cast<Eigen::Index>(i), jj);
    }
  }
  return values;
}

template <int Dim>
void expectTangents(BasisFamily family) {
  Eigen::Vector<double, Dim> above = Eigen::Vector<double, Dim>::Zero();
  above(0) = 0.07;
  above(1) = 1.03;
  Pair<Dim> pair(moved<Dim>(test::wavy<Dim>(family, 2, 2, 0.05, 3), above),
                 test::wavy<Dim>(family, 2, 3, 0.05, 4), {.reach = 0.3});
  const Eigen::VectorXd accepted = test::randomState(pair.x.size(), 2e-3, 5);
  pair.x = accepted;
  ASSERT_TRUE(pair.update());
  pair.partner->accept();
  // A step in which the slave slides over a third of a span.
  pair.moveUpper(Eigen::Vector<double, Dim>(0.1 * Eigen::Vector<double, Dim>::Unit(0)));
  pair.x += test::randomState(pair.x.size(), 2e-3, 6);
  const Eigen::VectorXd x = pair.x;
  const auto& span = pair.slave.spans().front();
  for (const int q : {-1, 0, static_cast<int>(span.R.cols()) - 1}) {
    const Eigen::Vector<double, Dim - 1> xi =
        q < 0 ? Eigen::Vector<double, Dim - 1>(0.5 * (span.xi.col(0) + span.xi.col(1)))
              : Eigen::Vector<double, Dim - 1>(span.xi.col(q));
    Eigen::MatrixXd exact;
    const Eigen::VectorXd values = answers<Dim>(pair, 0, q, xi, accepted, x, &exact);
    EXPECT_GT(values.tail(Dim - 1).norm(), 0.05);
    std::vector<int> involved;
    for (int j = 0; j < x.size(); ++j)
      if (!exact.col(j).isZero(0.0)) involved.push_back(j);
    ASSERT_GT(involved.size(), 8u);
    const auto differences = test::differences(
        [&](const Eigen::VectorXd& state) { return answers<Dim>(pair, 0, q, xi, accepted, state, nullptr); },
        x, involved, 1e-4);
    for (const int j : involved)
      EXPECT_LT((differences.col(j) - exact.col(j)).norm(), 1e-7 * exact.norm()) << "unknown " << j;
  }
}

TEST(FacePartner, DerivativesAgreeWithDifferencesInAStepThatSlides) {
  for (const BasisFamily family : {BasisFamily::BSpline, BasisFamily::Lagrange}) {
    expectTangents<2>(family);
    expectTangents<3>(family);
  }
}

TEST(FacePartner, FindsPartnersInReachOnly) {
  Pair<2> far(moved<2>(block(4), {0.0, 1.2}), block(5), {.reach = 0.1});
  EXPECT_EQ(far.numPartners(), 0);
  Pair<2> near(moved<2>(block(4), {0.0, 1.05}), block(5), {.reach = 0.1});
  EXPECT_EQ(near.numPartners(), near.slave.numPoints());
  EXPECT_NEAR(near.partner->foot(0)->gap, 0.05, 1e-15);
  // Found at the next accepted state, not before, and then also inside.
  far.moveUpper({0.0, -0.23});
  ASSERT_TRUE(far.update());
  EXPECT_EQ(far.numPartners(), 0);
  far.partner->accept();
  EXPECT_EQ(far.numPartners(), far.slave.numPoints());
  EXPECT_NEAR(far.partner->foot(0)->gap, -0.03, 1e-15);
}

TEST(FacePartner, HasNoPartnersBeyondAFreeEndUnlessTheySlideThere) {
  // The slave is half as long again as the master.
  Pair<2> wide(moved<2>(block(12), {-0.25, 1.01}, 1.5), block(5), {.reach = 0.1});
  int inside = 0;
  for (int k = 0; k < wide.slave.numPoints(); ++k) {
    const double place = wide.slave.positions(wide.x)(0, k);
    EXPECT_EQ(wide.partner->foot(k).has_value(), place >= 0.0 && place <= 1.0);
    inside += place >= 0.0 && place <= 1.0;
  }
  EXPECT_EQ(wide.numPartners(), inside);

  // Partners are kept for a quarter of the master's spans, which are 0.2 long.
  Pair<2> equal(moved<2>(block(12), {0.0, 1.01}), block(5), {.reach = 0.1});
  equal.moveUpper({0.1, 0.0});
  ASSERT_TRUE(equal.update());
  EXPECT_EQ(equal.numPartners(), equal.slave.numPoints());
  EXPECT_NEAR(equal.partner->foot(equal.slave.numPoints() - 1)->gap, 0.01, 1e-15);
  equal.partner->accept();
  const Eigen::MatrixXd positions = equal.slave.positions(equal.x);
  for (int k = 0; k < equal.slave.numPoints(); ++k)
    EXPECT_EQ(equal.partner->foot(k).has_value(), positions(0, k) < 1.05);
}

TEST(FacePartner, DoesNotSeeTheSurfaceFromBehind) {
  // The slave lies below a thin master and faces the same way as its top.
  Patch<2> thin =
      refined(rectangle({0.0, 0.0}, {1.0, 0.02}), {KnotVector::uniform(2, 5), KnotVector::uniform(1, 1)});
  Pair<2> pair(moved<2>(block(4), {0.0, 0.01}), thin, {.reach = 0.1});
  EXPECT_EQ(pair.numPartners(), pair.slave.numPoints());  // the bottom of the slave faces it
  const Body<2> below = makeBody(moved<2>(block(4), {0.0, -1.01}));
  const FaceQuadrature<2> top(below, 0, kTop, 3);
  Body<2> master = makeBody(thin);
  for (int& node : master.nodes.front()) node += below.numNodes;
  const FacePartner<2> partner(top, tracePatch(below.patches.front(), kTop),
                               outwardSign(below.patches.front(), kTop),
                               MasterSurface<2>(master, {{0, kTop}}), {.reach = 0.1});
  for (int k = 0; k < top.numPoints(); ++k) EXPECT_FALSE(partner.foot(k));
}

TEST(FacePartner, RefusesStatesThatSlipTooFar) {
  Pair<2> pair(moved<2>(block(4), {0.0, 1.01}), block(10), {.reach = 0.05, .largestSlip = 1.0});
  pair.moveUpper({-0.05, 0.0});
  EXPECT_TRUE(pair.update());
  pair.moveUpper({-0.1, 0.0});
  EXPECT_FALSE(pair.update());
}

TEST(FacePartner, RefusesStatesInWhichAFaceHasGoneThroughUnseen) {
  for (const double way : {0.26, 0.3, 1.4}) {
    Pair<2> pair(moved<2>(block(4), {0.0, 1.2}), block(10), {.reach = 0.05});
    EXPECT_EQ(pair.numPartners(), 0);
    pair.moveUpper({0.0, -0.19});
    EXPECT_TRUE(pair.update()) << "farther than the reach, but not through";
    pair.moveUpper({0.0, 0.19});
    pair.moveUpper({0.02, -way});
    EXPECT_FALSE(pair.update());
  }
  // The master may come, too, and a face that goes along the other one does not cross it.
  Pair<2> pair(moved<2>(block(4), {0.0, 1.2}), block(10), {.reach = 0.05});
  pair.moveUpper({0.0, -0.1});
  for (int node = 0; node < pair.lower.numNodes; ++node) pair.x(2 * (pair.upper.numNodes + node) + 1) = 0.16;
  EXPECT_FALSE(pair.update());
  pair.x.setZero();
  pair.moveUpper({0.7, -0.12});
  EXPECT_TRUE(pair.update());
  pair.partner->accept();
  pair.moveUpper({0.0, -0.04});
  EXPECT_TRUE(pair.update());
  pair.partner->accept();
  pair.moveUpper({-0.7, 0.0});
  EXPECT_TRUE(pair.update()) << "points without a partner have come over the surface, none is behind it";
  Pair<2> beside(moved<2>(block(4), {1.1, 0.7}), block(10), {.reach = 0.05});
  beside.moveUpper({-0.5, 0.0});
  EXPECT_TRUE(beside.update()) << "from the side, not from before the surface";
}

TEST(FacePartner, ArchivesFeetInTheMiddleOfASlide) {
  const auto make = [] {
    return Pair<3>(moved<3>(test::wavy<3>(BasisFamily::BSpline, 2, 2, 0.05, 3), {0.07, 1.03, 0.0}),
                   test::wavy<3>(BasisFamily::BSpline, 2, 3, 0.05, 4), {.reach = 0.3});
  };
  Pair<3> run = make(), resumed = make(), fresh = make();
  run.moveUpper({0.1, -0.02, 0.05});
  ASSERT_TRUE(run.update());
  const Eigen::VectorXd accepted = run.x;
  run.partner->accept();
  StateArchive saved;
  run.partner->archive(saved);
  StateArchive restored(saved.values());
  resumed.partner->archive(restored);
  run.moveUpper({0.05, 0.0, 0.0});
  const Eigen::VectorXd x = run.x;
  for (const int q : {-1, 2}) {
    const Eigen::Vector2d xi =
        q < 0 ? Eigen::Vector2d(0.11, 0.23) : Eigen::Vector2d(run.slave.spans()[0].xi.col(q));
    const auto expected = answers<3>(run, 0, q, xi, accepted, x, nullptr);
    EXPECT_EQ(answers<3>(resumed, 0, q, xi, accepted, x, nullptr), expected);
    EXPECT_NE(answers<3>(fresh, 0, q, xi, accepted, x, nullptr),
              expected);  // its feet are those of the begin
  }
  for (std::size_t e = 0; e < run.slave.spans().size(); ++e)
    EXPECT_EQ(resumed.partner->couplings(e), run.partner->couplings(e));

  SavedState damaged = saved.values();
  damaged.at("feet")(1) = 1000.0;
  StateArchive broken(damaged);
  EXPECT_THAT([&] { fresh.partner->archive(broken); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("not there")));
}

TEST(FacePartner, CrossesToTheNearerSideOfAConcaveCornerAtAcceptedStates) {
  // A step in the master's top, as a chain of straight pieces: a floor, a wall of 60 degrees.
  Patch<2> sheet =
      refined(rectangle({0.0, 0.0}, {2.0, 1.0}), {KnotVector::uniform(1, 2), KnotVector::uniform(1, 1)});
  Eigen::MatrixXd points = sheet.points();
  points.col(5) = Eigen::Vector2d(1.5, 1.0 + 0.5 * std::sqrt(3.0));
  const Patch<2> master(sheet.basis(), points, sheet.weights());
  const Patch<2> small =
      refined(rectangle({0.6, 1.01}, {0.1, 0.1}), {KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)});
  Pair<2> pair(small, master, {.reach = 0.4});
  const int last = pair.slave.numPoints() - 1;
  EXPECT_EQ(pair.partner->foot(last)->point.place.span, 0);
  pair.moveUpper({0.29, 0.1});
  ASSERT_TRUE(pair.update());
  EXPECT_EQ(pair.partner->foot(last)->point.place.span, 0);  // kept during the step
  const double before = pair.partner->foot(last)->gap;
  pair.partner->accept();
  EXPECT_EQ(pair.partner->foot(last)->point.place.span, 1);
  EXPECT_LT(pair.partner->foot(last)->gap, before);
}

/// A ring around a flat hole, open on its right: two jaws that face each other across the hole.
Body<2> jaws(BasisFamily family) {
  const Patch<2> sheet = rectangle({1.0, 0.5}, {0.5, 5.3});  // radii and angles
  const KnotVector across = KnotVector::uniform(2, 2), around = KnotVector::uniform(2, 12);
  const Patch<2> polar =
      family == BasisFamily::BSpline
          ? refined(sheet, {across, around})
          : lagrangeInterpolant(sheet, 2, {across.breakpoints(), KnotVector::uniform(1, 12).breakpoints()});
  Eigen::MatrixXd points = polar.points();
  for (auto point : points.colwise())
    point =
        Eigen::Vector2d(3.0, 0.0) + point(0) * Eigen::Vector2d(std::cos(point(1)), 0.2 * std::sin(point(1)));
  return makeBody(Patch<2>(polar.basis(), std::move(points), polar.weights()));
}

using test::kInner;

/// The inner face of the jaws and its partners on itself.
struct Jaws {
  FaceQuadrature<2> face;
  FacePartner<2> partner;

  explicit Jaws(const Body<2>& body, bool isNewMesh = false)
      : face(body, 0, kInner, 4),
        partner(face, tracePatch(body.patches.front(), kInner), outwardSign(body.patches.front(), kInner),
                MasterSurface<2>(body, {{0, kInner}}), selfContactRules(0.6, 0, isNewMesh)) {}

  int numPartners() const {
    int partners = 0;
    for (int k = 0; k < face.numPoints(); ++k) partners += partner.foot(k).has_value();
    return partners;
  }
};

TEST(FacePartner, OfOneFaceWithItselfIsALaterPointThatLooksBack) {
  const Body<2> body = jaws(BasisFamily::BSpline);
  Jaws made(body);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * body.numNodes);
  int partners = 0;
  for (int step = 0; step < 6; ++step) {
    // The jaws close.
    const Eigen::MatrixXd X = body.nodePositions();
    for (int node = 0; node < body.numNodes; ++node)
      x(2 * node + 1) = -0.12 * step * X(1, node) * std::exp(X(0, node) - 4.0);
    const Eigen::MatrixXd positions = made.face.positions(x);
    ASSERT_TRUE(made.partner.update(0.0, x, positions));
    made.partner.accept();
    for (const auto& span : made.face.spans())
      for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
        const auto number = span.firstPoint + q;
        const auto& foot = made.partner.foot(static_cast<int>(number));
        if (!foot) continue;
        ++partners;
        EXPECT_GT(foot->point.place.xi(0), span.xi(0, q));
        const Eigen::Vector2d way = positions.col(number) - foot->point.x;
        EXPECT_LT(std::abs(way.dot(foot->point.tangents)), 1e-13);
        EXPECT_NEAR(foot->gap, way.norm(), 1e-14);
        EXPECT_LT(foot->normal.dot(Eigen::Vector2d::UnitY()) * (positions(1, number) > 0.0 ? -1.0 : 1.0),
                  -0.5);
      }
  }
  EXPECT_GT(partners, 60);
}

TEST(FacePartner, PartsOfANewMeshMayBeginALittleInside) {
  // A thin hole, through which a bump of its upper face reaches into the lower one.
  Body<2> body = jaws(BasisFamily::BSpline);
  const Patch<2>& patch = body.patches.front();
  Eigen::MatrixXd points = patch.points();
  for (const int a : faceFunctions(patch.basis(), kInner)) {
    points(1, a) *= 0.02;
    if (points(1, a) > 0.0 && std::abs(points(0, a) - 3.0) < 0.4) points(1, a) -= 0.012;
  }
  body = makeBody(Patch<2>(patch.basis(), points, patch.weights()));
  EXPECT_GT(Jaws(body, true).numPartners(), Jaws(body).numPartners() + 5);
}

}  // namespace
}  // namespace burnish
