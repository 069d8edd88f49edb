#include "engine/contact/pair_rows.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <tuple>

#include "engine/contact/unknown_lists.h"
#include "tests/engine/contact/surface_samples.h"

namespace burnish {
namespace {

using test::kFront;
using test::kRight;
using test::kTop;

/// A slave point of three functions before a master surface, over the unknowns of the slave, then the body.
template <int Dim>
struct Scene {
  static constexpr int kSlaves = 3;
  using Vector = Eigen::Vector<double, Dim>;
  using Frame = Eigen::Matrix<double, Dim, Dim - 1>;

  Body<Dim> body;
  MasterSurface<Dim> surface;
  Eigen::Vector3d R;
  Vector place;                  ///< of the slave point at zero unknowns
  SurfacePlace<Dim> start, old;  ///< of the foot; where it was
  Frame origin;
  Vector originNormal;

  struct Answer {
    std::vector<int> unknowns;
    Foot<Dim> foot;
    Eigen::VectorXd dGap;
    Eigen::MatrixXd d2Gap, virtualSlip, dSlip, frictionTangent;
    Eigen::Vector<double, Dim - 1> slip;
    Eigen::MatrixXd frame;
    Vector x, traction;
  };

  Scene(Body<Dim> made, const std::vector<FacePlace>& faces)
      : body(numberedBehind(std::move(made))), surface(body, faces), R(0.5, -0.2, 0.7) {}

  /// The first numbers of nodes are the slave's.
  static Body<Dim> numberedBehind(Body<Dim> body) {
    for (int& node : body.nodes.front()) node += kSlaves;
    body.numNodes += kSlaves;
    return body;
  }

  Eigen::Index size() const { return Dim * body.numNodes; }
  Eigen::Vector<double, Dim - 1> components() const { return Eigen::Vector2d(0.8, -0.5).head<Dim - 1>(); }

  Answer at(const Eigen::VectorXd& u, bool withTangents = true) {
    surface.moveTo(u);
    Vector x = place;
    for (int a = 0; a < kSlaves; ++a) x += R(a) * u.segment<Dim>(Dim * a);
    Answer answer;
    answer.x = x;
    const auto found = surface.project(x, start);
    if (!found) throw std::runtime_error("no foot");
    answer.foot = *found;
    const SurfacePoint<Dim> before = surface.at(old);
    std::vector<int> nodes = found->point.nodes;
    const auto places = placesAmong(nodes, before.nodes);
    const PairRows<Dim> rows(R, answer.foot, static_cast<int>(nodes.size() - found->point.nodes.size()));
    const auto frame = carriedFrame<Dim>(origin, originNormal, found->normal);
    const Vector way = x - before.x;
    answer.frame = frame.vectors;
    answer.slip = frame.vectors.transpose() * way;
    answer.traction = frame.vectors * components();
    Eigen::Matrix<double, Dim, Dim> byNormal = Eigen::Matrix<double, Dim, Dim>::Zero();
    for (int k = 0; k < Dim - 1; ++k)
      byNormal += components()(k) * frame.byNormal[static_cast<std::size_t>(k)];

    for (int k = 0; k < Dim * kSlaves; ++k) answer.unknowns.push_back(k);
    for (const int node : nodes)
      for (int d = 0; d < Dim; ++d) answer.unknowns.push_back(Dim * node + d);
    const auto scattered = [&](const Eigen::MatrixXd& local) {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size(), local.cols());
      for (std::size_t k = 0; k < answer.unknowns.size(); ++k)
        all.row(answer.unknowns[k]) += local.row(static_cast<Eigen::Index>(k));
      return all;
    };
    answer.dGap = scattered(rows.dGap());
    answer.virtualSlip = scattered(rows.virtualSlip(frame));
    answer.dSlip = scattered(rows.dSlip(frame, way, rows.differenceTo(before.shape.R, places)));
    if (!withTangents) return answer;
    answer.d2Gap = scattered(scattered(rows.d2Gap()).transpose());
    answer.frictionTangent =
        scattered(scattered(rows.frictionTangent(answer.traction, byNormal)).transpose()).transpose();
    return answer;
  }

  /// Sums of forces and moments of forces on all control points, and of the magnitudes inside.
  std::tuple<Vector, Eigen::Vector3d, double> resultants(const Eigen::VectorXd& force,
                                                         const Answer& answer) const {
    const auto at3 = [](const auto& v) {
      Eigen::Vector3d result = Eigen::Vector3d::Zero();
      result.head<Dim>() = v;
      return result;
    };
    const Eigen::MatrixXd X = body.nodePositions();
    // The slave's forces are R_a times one vector: they act at x together.
    Vector sum = Vector::Zero();
    for (int a = 0; a < kSlaves; ++a) sum += force.segment<Dim>(Dim * a);
    Eigen::Vector3d moment = at3(answer.x).cross(at3(sum));
    double size = answer.x.norm() * sum.norm();
    for (int node = kSlaves; node < body.numNodes; ++node) {
      const Vector f = force.segment<Dim>(Dim * node);
      sum += f;
      moment += at3(X.col(node)).cross(at3(f));
      size += X.col(node).norm() * f.norm();
    }
    return {sum, moment, size};
  }
};

enum class Where { Inside, Line, Corner, Rounded, RoundedCrossing };

/// Parameters across which a foot there is on a rounded kink.
template <int Dim>
std::array<bool, Dim - 1> roundedAt(Where where) {
  std::array<bool, Dim - 1> rounded{};
  if (where == Where::RoundedCrossing) rounded.fill(true);
  if (where == Where::Rounded) rounded[0] = true;
  return rounded;
}

/// A scene with a foot of a kind at a random place; none if there is no such foot there.
template <int Dim>
std::optional<Scene<Dim>> sceneAt(Where where, BasisFamily family, int degree, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<FacePlace> faces{{0, kTop}, {0, kRight}};
  if (Dim == 3) faces.push_back({0, kFront});
  const auto rounded = roundedAt<Dim>(where);
  const bool isRounded = rounded[0];
  // So flat that kinks are no corners, where they are to be rounded.
  const double amplitude = isRounded ? 0.25 / degree : 0.25;
  Scene<Dim> scene(makeBody(test::wavy<Dim>(family, degree, where == Where::Inside ? 1 : 2, amplitude, seed)),
                   faces);
  if (isRounded) scene.surface.roundKinks();
  const auto& surface = scene.surface;
  const int face = static_cast<int>(random() % faces.size());
  Eigen::Vector<double, Dim - 1> xi;
  for (double& parameter : xi) parameter = 0.2 + 0.6 * uniform(random);
  if (where != Where::Inside && !isRounded)
    xi(static_cast<Eigen::Index>(random() % (Dim - 1))) = random() % 2 ? 0.5 : 1.0;
  if (where == Where::Corner)
    for (double& parameter : xi) parameter = random() % 2 ? 0.5 : 1.0;
  for (std::size_t d = 0; d < rounded.size(); ++d)
    if (rounded[d]) xi(static_cast<Eigen::Index>(d)) = 0.5 + 0.01 * (uniform(random) - 0.5);
  scene.start = surface.placeOf(face, xi);
  const auto point = surface.at(scene.start);
  Eigen::Vector<double, Dim> way = Eigen::Vector<double, Dim>::Zero();
  for (const auto& place : surface.around(scene.start))
    way += (0.2 + uniform(random)) * surface.at(place).normal;
  double gap = -0.2 + 0.7 * uniform(random);
  if (where != Where::Inside && std::abs(gap) < 0.1) gap = 0.1;
  if (isRounded) gap *= 0.02;
  scene.place = point.x + gap * way.normalized();
  scene.old = scene.start;
  for (double& parameter : scene.old.xi) parameter += 0.05;
  scene.old = surface.placeOf(face, scene.old.xi);
  scene.originNormal = (way.normalized() + 0.2 * Eigen::Vector<double, Dim>::Ones()).normalized();
  scene.origin = anyFrame<Dim>(scene.originNormal);
  const auto foot = surface.project(scene.place, scene.start);
  if (!foot || foot->shareOfRadius() > 0.6 || surface.overhang(foot->point.place) > 0.0) return std::nullopt;
  int moving = 0;
  for (const bool moves : foot->moves) moving += moves;
  if (moving != (where == Where::Line ? 1 : where == Where::Corner ? 0 : Dim - 1)) return std::nullopt;
  if (foot->point.isRounded != rounded) return std::nullopt;
  return scene;
}

struct RowsCase {
  Where where;
  BasisFamily family;
  int degree;
};

template <int Dim>
void forEachScene(const RowsCase& c, int count, const std::function<void(Scene<Dim>&)>& check) {
  int found = 0;
  for (unsigned seed = 1; found < count && seed < 400; ++seed) {
    auto scene = sceneAt<Dim>(c.where, c.family, c.degree, seed);
    if (!scene) continue;
    ++found;
    SCOPED_TRACE(seed);
    check(*scene);
  }
  EXPECT_EQ(found, count);
}

template <int Dim>
void expectDerivatives(Scene<Dim>& scene, double step = 1e-4) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(scene.size());
  const auto exact = scene.at(zero);
  const Eigen::Index n = scene.size();
  const auto all = test::differences(
      [&](const Eigen::VectorXd& u) {
        const auto answer = scene.at(u, false);
        EXPECT_EQ(answer.foot.moves, exact.foot.moves);
        Eigen::VectorXd values(1 + 2 * n + Dim - 1);
        values << answer.foot.gap, answer.dGap, answer.virtualSlip * scene.components(), answer.slip;
        return values;
      },
      zero, exact.unknowns, step);
  const auto error = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff() / std::max(1.0, b.cwiseAbs().maxCoeff());
  };
  EXPECT_LT(error(all.row(0).transpose(), exact.dGap), 1e-8);
  EXPECT_LT(error(all.middleRows(1, n), exact.d2Gap), 1e-7);
  EXPECT_LT(error(all.middleRows(1 + n, n), exact.frictionTangent), 1e-7);
  EXPECT_LT(error(all.bottomRows(Dim - 1).transpose(), exact.dSlip), 1e-8);
  EXPECT_LT(error(exact.d2Gap, exact.d2Gap.transpose()), 1e-14);
}

template <int Dim>
void expectBalance(Scene<Dim>& scene) {
  const auto answer = scene.at(Eigen::VectorXd::Zero(scene.size()));
  const auto [force, moment, size] = scene.resultants(answer.dGap, answer);
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size);

  // Friction: what is left over is g n x t_⟂, with the part of t in which the foot does not move.
  Eigen::Vector<double, Dim> across = answer.traction;
  for (int d = 0; d < Dim - 1; ++d)
    if (answer.foot.moves[static_cast<std::size_t>(d)] && !answer.foot.isSmooth()) {
      const Eigen::Vector<double, Dim> along = answer.foot.point.tangents.col(d).normalized();
      across -= along.dot(across) * along;
    }
  if (answer.foot.isSmooth()) across.setZero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero(), t = n;
  n.template head<Dim>() = answer.foot.normal;
  t.template head<Dim>() = across;
  const auto [friction, turn, sizeOfTurn] = scene.resultants(answer.virtualSlip * scene.components(), answer);
  EXPECT_LT(friction.norm(), 1e-13 * sizeOfTurn);
  EXPECT_LT((turn - answer.foot.gap * n.cross(t)).norm(), 1e-13 * sizeOfTurn);
}

class PairRowsAt : public testing::TestWithParam<RowsCase> {
 protected:
  static bool isInPlane() {
    return GetParam().where != Where::Line && GetParam().where != Where::RoundedCrossing;
  }
};

TEST_P(PairRowsAt, DerivativesAgreeWithDifferences) {
  // What is rounded is short, and so are the differences.
  const double step = roundedAt<2>(GetParam().where)[0] ? 1e-5 : 1e-4;
  if (isInPlane())
    forEachScene<2>(GetParam(), 6, [&](Scene<2>& scene) { expectDerivatives<2>(scene, step); });
  forEachScene<3>(GetParam(), 4, [&](Scene<3>& scene) { expectDerivatives<3>(scene, step); });
}

TEST_P(PairRowsAt, ForcesAndMomentsBalance) {
  if (isInPlane()) forEachScene<2>(GetParam(), 10, expectBalance<2>);
  forEachScene<3>(GetParam(), 10, expectBalance<3>);
}

/// A master whose surface is a circle or a sphere is what a rigid tool of that shape is: ∂n/∂x = (I - n⊗n)/(R + g).
template <int Dim>
void expectRoundTool(const Body<Dim>& body, double radius, const Eigen::Vector<double, Dim>& way,
                     double gap) {
  const MasterSurface<Dim> surface(body, {{0, kRight}});
  const Eigen::Vector<double, Dim> x = (radius + gap) * way;
  const auto start = surface.placeOf(0, Eigen::Vector<double, Dim - 1>::Constant(0.5));
  const auto foot = surface.project(x, start);
  ASSERT_TRUE(foot);
  EXPECT_NEAR(foot->gap, gap, 1e-14);
  const Eigen::Vector2d R(0.3, 0.7);
  const PairRows<Dim> rows(R, *foot);
  const Eigen::VectorXd N = rows.dGap();
  const Eigen::MatrixXd second = rows.d2Gap();
  const auto frame = carriedFrame<Dim>(anyFrame<Dim>(way), way, foot->normal);
  const Eigen::MatrixXd T = rows.virtualSlip(frame);
  const Eigen::Matrix<double, Dim, Dim> across =
      Eigen::Matrix<double, Dim, Dim>::Identity() - way * way.transpose();
  const Eigen::Matrix<double, Dim, Dim> turn = across / (radius + gap);
  for (int a = 0; a < 2; ++a) {
    EXPECT_LT((N.segment<Dim>(Dim * a) - R(a) * way).norm(), 1e-14);
    EXPECT_LT((T.middleRows<Dim>(Dim * a) - R(a) * frame.vectors).norm(), 1e-14);
    for (int b = 0; b < 2; ++b)
      EXPECT_LT((second.block<Dim, Dim>(Dim * a, Dim * b) - R(a) * R(b) * turn).norm(), 3e-14);
  }
}

TEST(PairRows, AgreeWithRigidToolsOfTheSameShape) {
  const Body<2> disc = makeBody(refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.2, 1.4),
                                        {KnotVector::uniform(1, 1), KnotVector::uniform(3, 4)}));
  const Body<3> ball =
      makeBody(refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 2.0, {0.1, 1.2}, {-0.6, 0.7}),
                       {KnotVector::uniform(1, 1), KnotVector::uniform(2, 2), KnotVector::uniform(3, 2)}));
  for (const double gap : {-0.3, 0.0, 0.2, 1.0})
    for (const double angle : {0.4, 0.7, 1.1}) {
      expectRoundTool<2>(disc, 2.0, {std::cos(angle), std::sin(angle)}, gap);
      expectRoundTool<3>(ball, 2.0, Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.3).normalized(), gap);
    }
}

/// Both bodies turn and move together.
template <int Dim>
void expectNoSlip(Scene<Dim>& scene, const Eigen::Matrix<double, Dim, Dim>& turn) {
  const auto before = scene.surface.project(scene.place, scene.start);
  scene.old = before->point.place;
  const Eigen::MatrixXd X = scene.body.nodePositions();
  const Eigen::Vector<double, Dim> way = Eigen::Vector<double, Dim>::Constant(0.3);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(scene.size());
  for (int node = Scene<Dim>::kSlaves; node < scene.body.numNodes; ++node)
    u.segment<Dim>(Dim * node) = turn * X.col(node) + way - X.col(node);
  // Functions of the slave sum up to one.
  for (int a = 0; a < 3; ++a) u.segment<Dim>(Dim * a) = turn * scene.place + way - scene.place;
  const auto answer = scene.at(u);
  EXPECT_LT(answer.slip.norm(), 1e-14);
  EXPECT_NEAR(answer.foot.gap, before->gap, 1e-14);
}

TEST_P(PairRowsAt, RigidMotionsAreNoSlip) {
  const Eigen::Matrix2d plane = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  const Eigen::Matrix3d space =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  if (isInPlane()) forEachScene<2>(GetParam(), 5, [&](Scene<2>& scene) { expectNoSlip<2>(scene, plane); });
  forEachScene<3>(GetParam(), 5, [&](Scene<3>& scene) { expectNoSlip<3>(scene, space); });
}

TEST(CarriedFrame, StaysAcrossTheNormalAndTurnsWithIt) {
  const Eigen::Vector3d origin = Eigen::Vector3d(0.2, -0.4, 1.0).normalized();
  const Eigen::Matrix<double, 3, 2> E = anyFrame<3>(origin);
  const Eigen::Vector3d n = Eigen::Vector3d(-0.5, 0.1, 0.9).normalized();
  const auto frame = carriedFrame<3>(E, origin, n);
  EXPECT_LT((frame.vectors.transpose() * frame.vectors - Eigen::Matrix2d::Identity()).norm(), 1e-15);
  EXPECT_LT((frame.vectors.transpose() * n).norm(), 1e-15);
  EXPECT_LT((carriedFrame<3>(E, origin, origin).vectors - E).norm(), 1e-15);
  const Eigen::Vector3d turn = 1e-6 * n.cross(Eigen::Vector3d(0.3, 0.7, -0.2));
  const auto after = carriedFrame<3>(E, origin, (n + turn).normalized());
  const auto before = carriedFrame<3>(E, origin, (n - turn).normalized());
  for (int k = 0; k < 2; ++k)
    EXPECT_LT(
        (0.5 * (after.vectors - before.vectors).col(k) - frame.byNormal[static_cast<std::size_t>(k)] * turn)
            .norm(),
        1e-15);
}

INSTANTIATE_TEST_SUITE_P(Feet, PairRowsAt,
                         testing::Values(RowsCase{Where::Inside, BasisFamily::BSpline, 2},
                                         RowsCase{Where::Inside, BasisFamily::BSpline, 3},
                                         RowsCase{Where::Line, BasisFamily::BSpline, 1},
                                         RowsCase{Where::Line, BasisFamily::Lagrange, 2},
                                         RowsCase{Where::Corner, BasisFamily::BSpline, 1},
                                         RowsCase{Where::Corner, BasisFamily::Lagrange, 2},
                                         RowsCase{Where::Rounded, BasisFamily::BSpline, 1},
                                         RowsCase{Where::Rounded, BasisFamily::Lagrange, 2},
                                         RowsCase{Where::RoundedCrossing, BasisFamily::BSpline, 1},
                                         RowsCase{Where::RoundedCrossing, BasisFamily::Lagrange, 2}));

}  // namespace
}  // namespace burnish
