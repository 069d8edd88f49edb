#include "engine/contact/segments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/face_partner.h"
#include "tests/engine/contact/surface_samples.h"

namespace burnish {
namespace {

using test::kBottom;
using test::kTop;

Patch<2> sheet(BasisFamily family, int degree, int spans, const Eigen::Vector2d& origin, double width) {
  const Patch<2> plain = rectangle(origin, {width, 1.0});
  const KnotVector along = KnotVector::uniform(degree, spans), across = KnotVector::uniform(1, 1);
  if (family == BasisFamily::BSpline) return refined(plain, {along, across});
  return lagrangeInterpolant(plain, degree, {along.breakpoints(), {0.0, 1.0}});
}

/// The lower face of a sheet in front of the upper face of another one.
struct Faces {
  Body<2> slave, master;
  FaceQuadrature<2> face;
  Patch<1, 2> trace;
  FacePartner<2> partner;

  Faces(const Patch<2>& above, const Patch<2>& below)
      : slave(makeBody(above)),
        master(makeBody(below)),
        face(slave, 0, kBottom, 2 * above.basis().direction(0).degree()),
        trace(tracePatch(above, kBottom)),
        partner(face, trace, outwardSign(above, kBottom), MasterSurface<2>(master, {{0, kTop}}),
                {.reach = 0.3, .segments = true}) {}

  /// ∫ R_b(η̄(ξ)) dΓ over the slave, per node of the master.
  Eigen::VectorXd forces(bool withSegments, int points) const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(master.numNodes);
    const auto& basis = trace.basis().direction(0);
    for (std::size_t e = 0; e < face.spans().size(); ++e) {
      const int span = static_cast<int>(e);
      const auto segments =
          withSegments
              ? partner.segments(e)
              : std::vector<Segment>{{basis.spanBegin(span), basis.spanEnd(span), SurfacePlace<2>{}}};
      for (const Segment& segment : segments) {
        if (!segment.foot) continue;
        using Parameter = Eigen::Vector<double, 1>;
        const auto rule = face.part(slave, span, {Parameter(segment.begin), Parameter(segment.end)}, points);
        const Eigen::Matrix2Xd positions = face.points()(Eigen::all, rule.functions) * rule.R;
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
          const SlavePoint<2> point{e, -1, rule.xi.col(q), {}, rule.R.col(q), positions.col(q), {}};
          const auto contact = partner.at(point, PointDetail::Derivatives);
          if (!contact) continue;
          const auto own = static_cast<std::size_t>(2 * rule.R.rows());
          for (std::size_t b = 0; b < contact->unknowns.size(); ++b)
            if (contact->unknowns[b] % 2 == 1)
              sums(contact->unknowns[b] / 2) -=
                  rule.weights(q) * contact->dGap(static_cast<Eigen::Index>(own + b));
        }
      }
    }
    return sums;
  }

  /// ∫ R_b dΓ over the master's own face.
  Eigen::VectorXd exactForces() const {
    const FaceQuadrature<2> own(master, 0, kTop, 0);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(master.numNodes);
    for (const auto& span : own.spans())
      for (std::size_t a = 0; a < span.functions.size(); ++a)
        sums(own.nodes()[static_cast<std::size_t>(span.functions[a])]) +=
            span.R.row(static_cast<Eigen::Index>(a)).dot(span.weights);
    return sums;
  }
};

TEST(Segments, IntegrateForcesOnTheMasterExactly) {
  for (const BasisFamily family : {BasisFamily::BSpline, BasisFamily::Lagrange})
    for (const int degree : {1, 2, 3, 4}) {
      const Faces faces(sheet(family, degree, 7, {0.0, 1.1}, 2.0), sheet(family, degree, 5, {0.0, 0.0}, 2.0));
      const Eigen::VectorXd exact = faces.exactForces();
      EXPECT_EQ(segmentPoints(faces.trace), degree + 1);
      EXPECT_LT((faces.forces(true, degree + 1) - exact).cwiseAbs().maxCoeff(), 1e-13);
      // A rule of the slave's spans alone is not exact.
      EXPECT_GT((faces.forces(false, degree + 1) - exact).cwiseAbs().maxCoeff(), 1e-7);
    }
}

TEST(Segments, EndWhereTheMasterEnds) {
  const Faces faces(sheet(BasisFamily::BSpline, 2, 7, {-0.3, 1.1}, 3.0),
                    sheet(BasisFamily::BSpline, 2, 5, {0.0, 0.0}, 2.0));
  EXPECT_LT((faces.forces(true, 3) - faces.exactForces()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_FALSE(faces.partner.segments(0).front().foot);
  EXPECT_TRUE(faces.partner.segments(0).back().foot);
  EXPECT_FALSE(faces.partner.segments(6).back().foot);
}

TEST(Segments, AreCutOnBothSidesOfAKink) {
  // A gable whose sides rise by 45 degrees to (1, 1.5): feet stay on it for slaves above its wedge.
  Patch<2> roof = sheet(BasisFamily::BSpline, 1, 2, {0.0, 0.0}, 2.0);
  Eigen::MatrixXd points = roof.points();
  points(1, 4) = 2.0;
  roof = Patch<2>(roof.basis(), points, roof.weights());
  const Faces faces(sheet(BasisFamily::BSpline, 2, 1, {0.0, 2.1}, 2.0), roof);
  const auto& segments = faces.partner.segments(0);
  ASSERT_EQ(segments.size(), 5u);  // beyond reach at both ends
  EXPECT_FALSE(segments.front().foot || segments.back().foot);
  EXPECT_NEAR(segments[1].end, 0.45, 1e-12);
  EXPECT_NEAR(segments[2].end, 0.55, 1e-12);
}

TEST(Segments, CurvedFacesTakeMorePoints) {
  const Patch<2> ring = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
  EXPECT_EQ(segmentPoints(tracePatch(ring, 1)), 4);
}

}  // namespace
}  // namespace burnish
